//! One finite but wrong reading that is accepted: how far it throws the set-points, and how that dies out.
#![allow(unsafe_code, reason = "the functions are called as C calls them")]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::large_stack_arrays, reason = "the memory that C gives")]

mod vehicle_tables;

use std::ptr::null_mut;
use std::sync::LazyLock;
use vehicle_tables::{table, tool, vehicle};
use wrasse_dynamics::{Frame, Robot, State, kinematics};
use wrasse_flight_c::{
    WRASSE_FLIGHT_WORDS, WRASSE_JOINTS, WrasseArmReference, WrasseControlOutput, WrasseFlight,
    WrasseLaws, WrasseSensed, WrasseStatus, frame_from_table, robot_from_tables,
    wrasse_flight_period, wrasse_flight_set_up,
};
use wrasse_testing::{larger, largest};

const VEHICLE: &str = "atlas-class";
const PERIOD: f64 = 0.01;
const TOOL_GAIN: f64 = 2.0;
const RATE_LIMIT: f64 = 0.2;

fn set_up(law: i32, posture: &[f64; WRASSE_JOINTS]) -> WrasseFlight {
    let laws = WrasseLaws {
        law,
        task: 0,
        feedforward: 1,
        measurement: 1,
        period: PERIOD,
        tool_gain: TOOL_GAIN,
        joint_bandwidth: 10.0,
        joint_damping: 1.0,
        attitude_bandwidth: 0.3,
        attitude_damping: 1.0,
        damped_below: 0.02,
        kept_attitude: [1.0, 0.0, 0.0, 0.0],
        posture: *posture,
        rate_limit: [RATE_LIMIT; WRASSE_JOINTS],
        effort_limit: [500.0; WRASSE_JOINTS],
    };
    let mut flight = WrasseFlight { memory: [0; WRASSE_FLIGHT_WORDS] };
    let vehicle = vehicle(VEHICLE);
    let ((base, links), tool) = (table(&vehicle), tool(&vehicle));
    let (base, arm, tool) = (&raw const base, links.as_ptr(), &raw const tool);
    // SAFETY: all point to what they are; the complaint may be null.
    let status = unsafe {
        wrasse_flight_set_up(&raw mut flight, base, arm, 7, tool, &raw const laws, null_mut())
    };
    assert_eq!(status, WrasseStatus::WRASSE_OK);
    flight
}

/// The arm out in front of the bus, elbow bent, all at rest.
fn sensed() -> WrasseSensed {
    let mut joint_position = [0.0; WRASSE_JOINTS];
    joint_position[..7].copy_from_slice(&[0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4]);
    WrasseSensed {
        attitude: [1.0, 0.0, 0.0, 0.0],
        position: [0.0; 3],
        angular_velocity: [0.0; 3],
        velocity: [0.0; 3],
        joint_position,
        joint_rate: [0.0; WRASSE_JOINTS],
        wrench_measured: 0,
        wrench: [0.0; 6],
    }
}

/// Read once: it is asked for in every period.
static ROBOT: LazyLock<(Robot<f64, WRASSE_JOINTS>, Frame<f64>)> = LazyLock::new(|| {
    let vehicle = vehicle(VEHICLE);
    let (base, links) = table(&vehicle);
    (robot_from_tables(&base, &links).unwrap(), frame_from_table(&tool(&vehicle)))
});

/// Where the tool is with these joints, on a base that stays (m).
fn tool_at(joint_position: &[f64; WRASSE_JOINTS]) -> [f64; 3] {
    let (robot, tool) = &*ROBOT;
    let state = State { q: *joint_position, ..State::default() };
    kinematics(robot, &state).pose(tool).translation.to_array()
}

/// The tool stays where it is at the start, but for 2 cm along x, held as it is turned then.
fn asked(posture_gain: f64) -> WrasseArmReference {
    let (robot, tool) = &*ROBOT;
    let state = State { q: sensed().joint_position, ..State::default() };
    let X = kinematics(robot, &state).pose(tool);
    let quat = wrasse_spatial::Quat::from_matrix(&X.rotation);
    let [x, y, z] = X.translation.to_array();
    WrasseArmReference {
        kind: 0,
        axes: 0,
        tool_position: [x + 0.02, y, z],
        tool_attitude: [quat.w, quat.x, quat.y, quat.z],
        tool_velocity: [0.0; 6],
        tool_acceleration: [0.0; 6],
        posture_gain,
        posture_gain_rate: 0.0,
        joint_position: [0.0; WRASSE_JOINTS],
        joint_rate: [0.0; WRASSE_JOINTS],
        joint_acceleration: [0.0; WRASSE_JOINTS],
    }
}

fn fly(
    flight: &mut WrasseFlight,
    sensed: &WrasseSensed,
    asked: &WrasseArmReference,
) -> (WrasseStatus, WrasseControlOutput) {
    let mut told = WrasseControlOutput::default();
    // SAFETY: all point to what they are; the complaint may be null.
    let status = unsafe { wrasse_flight_period(flight, sensed, asked, &raw mut told, null_mut()) };
    (status, told)
}

fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// Period of the wrong reading: the tool is on its way.
const WRONG: usize = 50;

/// How far a flight with one wrong reading is from one without, for each period from the wrong one on:
/// joints (rad) and tool (m) at their set-points, efforts (N·m). Nothing if the reading is refused; every
/// later period must be flown.
fn traces(
    law: i32,
    posture_gain: f64,
    spoil: &dyn Fn(&mut WrasseSensed),
    periods: usize,
) -> Option<Vec<[f64; 3]>> {
    let posture = sensed().joint_position;
    let (mut good, mut bad) = (set_up(law, &posture), set_up(law, &posture));
    let (mut read_good, mut read_bad) = (sensed(), sensed());
    let asked = asked(posture_gain);
    let mut traces = vec![];
    for k in 0..WRONG + periods {
        let mut read = read_bad;
        if k == WRONG {
            spoil(&mut read);
        }
        let (status, expected) = fly(&mut good, &read_good, &asked);
        assert_eq!(status, WrasseStatus::WRASSE_OK);
        let (status, told) = fly(&mut bad, &read, &asked);
        if k == WRONG && status != WrasseStatus::WRASSE_OK {
            return None;
        }
        assert_eq!(status, WrasseStatus::WRASSE_OK, "refused in period {k}");
        // The joints follow their set-points.
        (read_good.joint_position, read_good.joint_rate) =
            (expected.joint_position, expected.joint_rate);
        (read_bad.joint_position, read_bad.joint_rate) = (told.joint_position, told.joint_rate);
        if k >= WRONG {
            let (q, q_expected) = (&told.joint_position, &expected.joint_position);
            let tool = apart(&tool_at(q), &tool_at(q_expected));
            traces.push([apart(q, q_expected), tool, apart(&told.effort, &expected.effort)]);
        }
    }
    Some(traces)
}

/// What makes a reading wrong.
type Fault = Box<dyn Fn(&mut WrasseSensed)>;

/// Every word of a reading wrong by a little, by much, and at its bound.
fn wrong_readings() -> Vec<Fault> {
    let mut all: Vec<Fault> = vec![];
    for share in [-0.1, 1.0] {
        for k in 0..3 {
            all.push(Box::new(move |s| s.position[k] = 1e6 * share));
            all.push(Box::new(move |s| s.position[k] = share));
            all.push(Box::new(move |s| s.angular_velocity[k] = 10.0 * share));
            all.push(Box::new(move |s| s.velocity[k] = 100.0 * share));
            all.push(Box::new(move |s| s.velocity[k] = share));
            all.push(Box::new(move |s| (s.wrench_measured, s.wrench[k]) = (1, 1e6 * share)));
            let (half_sin, half_cos) = (1.5 * share).sin_cos();
            all.push(Box::new(move |s| {
                (s.attitude[0], s.attitude[k + 1]) = (half_cos, half_sin);
            }));
        }
        for j in 0..7 {
            all.push(Box::new(move |s| s.joint_position[j] = 1e6 * share));
            all.push(Box::new(move |s| s.joint_position[j] = share));
            all.push(Box::new(move |s| s.joint_rate[j] = 100.0 * share));
        }
    }
    all
}

/// The page's statement, over every law. The tool's error loses `1 - gain × period` in a period, which is
/// slower than the exponential by no more than `gain² × period × time / 2`: 0 to 20 % at ten time
/// constants. The set-points of both flights are held to their rate limit, but for the jump of a velocity
/// that is wrong by 100 m/s. Measured: thrown by 7.43 mrad at most (by the angular velocity at its
/// bound); after one time constant 0.3684 of it is left, after ten 4.64e-5; then the joints are within
/// 1.3e-5 rad and the efforts within 2.6e-6 N·m of the flight without. Of 252 wrong readings none is
/// refused.
#[test]
fn a_wrong_reading_throws_no_set_point_far_and_dies_out_with_the_gain_of_the_tool() {
    let constant = 50;
    let ten = 10 * constant;
    for law in 0..3 {
        for (number, spoil) in wrong_readings().iter().enumerate() {
            let t = traces(law, 0.0, &**spoil, ten + 4).expect("it is within its bounds");
            // The wrong reading is felt in its own period and in the next.
            let thrown = largest(t[..4].iter().map(|t| t[0]));
            let left = |periods: usize| t[3 + periods][1] / larger(t[3][1], 1e-9);
            let [joints, _, effort] = t[3 + ten];
            let case =
                format!("law {law}, reading {number}: {thrown}, {}, {}", left(constant), left(ten));
            assert!(thrown < 4.0 * RATE_LIMIT * PERIOD, "{case}");
            assert!(left(constant) < 1.01 * (-1.0_f64).exp(), "{case}");
            assert!(left(ten) < 1.1 * (-10.0_f64).exp(), "{case}");
            assert!(joints < 2e-5 && effort < 1e-5, "{case}: {joints} rad, {effort} N·m");
        }
    }
}

/// The test above can fail: with a reading that stays wrong the tool goes elsewhere.
#[test]
fn a_reading_that_stays_wrong_does_not_die_out() {
    let posture = sensed().joint_position;
    let (mut good, mut bad) = (set_up(1, &posture), set_up(1, &posture));
    let (mut read_good, mut read_bad) = (sensed(), sensed());
    read_bad.position[0] = 0.05;
    let mut tools = [[0.0; 3]; 2];
    for _ in 0..600 {
        for (flight, read, tool) in [(&mut good, &mut read_good, 0), (&mut bad, &mut read_bad, 1)] {
            let (status, told) = fly(flight, read, &asked(0.0));
            assert_eq!(status, WrasseStatus::WRASSE_OK);
            (read.joint_position, read.joint_rate) = (told.joint_position, told.joint_rate);
            tools[tool] = tool_at(&told.joint_position);
        }
    }
    // The tool is 5 cm short of where it would be, for the base is believed to be 5 cm ahead.
    assert!((tools[0][0] - tools[1][0] - 0.05).abs() < 1e-4, "{tools:?}");
}

/// Where no tool is followed nothing is remembered of a reading: after the second period the same bits.
#[test]
fn with_the_joints_asked_for_a_wrong_reading_is_forgotten_after_two_periods() {
    let posture = sensed().joint_position;
    for kind in [1, 2] {
        for law in 0..3 {
            for (number, spoil) in wrong_readings().iter().enumerate() {
                let mut asked = asked(0.0);
                (asked.kind, asked.joint_position) = (kind, posture);
                let (mut good, mut bad) = (set_up(law, &posture), set_up(law, &posture));
                let mut told = [WrasseControlOutput::default(); 2];
                for k in 0..5 {
                    let mut read = sensed();
                    told[0] = fly(&mut good, &read, &asked).1;
                    if k == 2 {
                        spoil(&mut read);
                    }
                    let (status, wrong) = fly(&mut bad, &read, &asked);
                    assert_eq!(status, WrasseStatus::WRASSE_OK);
                    told[1] = wrong;
                }
                assert_eq!(told[0], told[1], "kind {kind}, law {law}, reading {number}");
            }
        }
    }
}

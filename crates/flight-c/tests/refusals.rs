//! Bad input from C is refused with the place, the finding and the expectation, and changes nothing.
#![allow(unsafe_code, reason = "the functions are called as C calls them")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::large_stack_arrays, reason = "the memory that C gives")]

use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};
use wrasse_flight_c::{
    WRASSE_FLIGHT_WORDS, WRASSE_JOINTS, WRASSE_REFERENCE_STILL, WrasseArmReference, WrasseBody,
    WrasseComplaint, WrasseControlOutput, WrasseFlight, WrasseFrame, WrasseJoint, WrasseLaws,
    WrasseLink, WrasseSensed, WrasseStatus, wrasse_flight_period, wrasse_flight_set_up,
    wrasse_status_text,
};

const UNTURNED: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// What is given to the set-up; a test spoils one thing.
struct Given {
    base: WrasseBody,
    links: Vec<WrasseLink>,
    tool: WrasseFrame,
    laws: WrasseLaws,
}

fn good() -> Given {
    let body =
        WrasseBody { mass: 5.0, inertia: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0], ..Default::default() };
    let joint = WrasseJoint {
        parent: -1,
        rotation: UNTURNED,
        axis: [0.0, 0.0, 1.0],
        ..WrasseJoint::default()
    };
    let second = WrasseJoint { parent: 0, position: [1.0, 0.0, 0.0], ..joint };
    Given {
        base: WrasseBody { mass: 500.0, inertia: [90.0, 90.0, 90.0, 0.0, 0.0, 0.0], ..body },
        links: vec![WrasseLink { joint, body }, WrasseLink { joint: second, body }],
        tool: WrasseFrame { link: 1, position: [0.5, 0.0, 0.0], rotation: UNTURNED },
        laws: WrasseLaws {
            law: 1,
            task: 1,
            feedforward: 1,
            measurement: 1,
            period: 0.01,
            tool_gain: 1.0,
            joint_bandwidth: 5.0,
            joint_damping: 1.0,
            attitude_bandwidth: 0.3,
            attitude_damping: 1.0,
            damped_below: 0.02,
            kept_attitude: [1.0, 0.0, 0.0, 0.0],
            posture: [0.0; WRASSE_JOINTS],
            rate_limit: [0.2; WRASSE_JOINTS],
            effort_limit: [0.0; WRASSE_JOINTS],
        },
    }
}

fn zeros() -> WrasseFlight {
    WrasseFlight { memory: [0; WRASSE_FLIGHT_WORDS] }
}

fn nothing_said() -> WrasseComplaint {
    WrasseComplaint { field: null(), index: -1, found: 0.0, expected: null() }
}

fn text(pointer: *const c_char) -> String {
    // SAFETY: the library hands out texts that last as long as the program.
    unsafe { CStr::from_ptr(pointer) }.to_str().unwrap().to_owned()
}

fn set_up(flight: &mut WrasseFlight, given: &Given) -> (WrasseStatus, WrasseComplaint) {
    let mut complaint = nothing_said();
    let count = u32::try_from(given.links.len()).unwrap();
    let (base, links) = (&raw const given.base, given.links.as_ptr());
    let (tool, laws) = (&raw const given.tool, &raw const given.laws);
    // SAFETY: all point to what they are.
    let status =
        unsafe { wrasse_flight_set_up(flight, base, links, count, tool, laws, &raw mut complaint) };
    (status, complaint)
}

#[track_caller]
fn refuses(spoil: impl Fn(&mut Given), status: WrasseStatus, field: &str, index: i32) {
    let (mut flight, mut given) = (zeros(), good());
    spoil(&mut given);
    let (found, complaint) = set_up(&mut flight, &given);
    assert_eq!((found, text(complaint.field).as_str(), complaint.index), (status, field, index));
    assert!(text(complaint.expected).len() > 5);
    assert!(flight.memory.iter().all(|word| *word == 0), "refused, yet written");
}

#[test]
fn each_bad_table_is_refused_by_its_field() {
    use WrasseStatus::{
        WRASSE_BAD_NUMBER, WRASSE_PARENT_AFTER_CHILD, WRASSE_TOO_MANY_LINKS, WRASSE_UNKNOWN_CHOICE,
    };
    assert_eq!(set_up(&mut zeros(), &good()).0, WrasseStatus::WRASSE_OK);
    let number = WRASSE_BAD_NUMBER;
    refuses(|g| g.links[1].joint.axis = [0.0; 3], number, "WrasseJoint.axis, its square", 1);
    refuses(|g| g.links[1].joint.rotation[0][1] = 0.1, number, "WrasseJoint.rotation", 1);
    refuses(|g| g.links[0].body.inertia[0] = 9.0, number, "WrasseBody.inertia", 0);
    refuses(|g| g.links[0].body.mass = f64::NAN, number, "WrasseBody.mass", 0);
    refuses(|g| g.tool.link = 2, number, "WrasseFrame.link", -1);
    refuses(|g| g.laws.period = 0.0, number, "WrasseLaws.period", -1);
    refuses(|g| g.laws.rate_limit[1] = -1.0, number, "WrasseLaws.rate_limit", 1);
    refuses(|g| g.laws.law = 3, WRASSE_UNKNOWN_CHOICE, "WrasseLaws.law", -1);
    let late = WRASSE_PARENT_AFTER_CHILD;
    refuses(|g| g.links[0].joint.parent = 0, late, "WrasseJoint.parent", 0);
    refuses(|g| g.base.inertia[2] = 200.0, number, "WrasseBody.inertia", -1);
    refuses(|g| g.base.inertia[2] = 0.0, number, "WrasseBody.inertia of the base", -1);
    refuses(|g| g.base.inertia = [0.0; 6], number, "WrasseBody.inertia of the base", -1);
    let products = "WrasseBody.inertia, its products";
    refuses(|g| g.links[1].body.inertia[3] = 0.9, number, products, 1);
    let tool = "WrasseLaws.tool_gain, times period";
    refuses(|g| g.laws.tool_gain = 100.0, number, tool, -1);
    refuses(|g| g.laws.effort_limit[0] = 5e-324, number, "WrasseLaws.effort_limit", 0);
    let fifteen = |g: &mut Given| g.links = vec![g.links[0]; WRASSE_JOINTS + 1];
    refuses(fifteen, WRASSE_TOO_MANY_LINKS, "link_count", -1);
}

fn sensed() -> WrasseSensed {
    WrasseSensed {
        attitude: [1.0, 0.0, 0.0, 0.0],
        position: [0.0; 3],
        angular_velocity: [0.01, 0.0, 0.0],
        velocity: [0.0; 3],
        joint_position: [0.4; WRASSE_JOINTS],
        joint_rate: [0.0; WRASSE_JOINTS],
        wrench_measured: 0,
        wrench: [0.0; 6],
    }
}

fn still() -> WrasseArmReference {
    WrasseArmReference {
        kind: WRASSE_REFERENCE_STILL,
        axes: 0,
        tool_position: [0.0; 3],
        tool_attitude: [1.0, 0.0, 0.0, 0.0],
        tool_velocity: [0.0; 6],
        tool_acceleration: [0.0; 6],
        posture_gain: 0.0,
        posture_gain_rate: 0.0,
        joint_position: [0.0; WRASSE_JOINTS],
        joint_rate: [0.0; WRASSE_JOINTS],
        joint_acceleration: [0.0; WRASSE_JOINTS],
    }
}

fn period(flight: &mut WrasseFlight, sensed: &WrasseSensed) -> (WrasseStatus, WrasseControlOutput) {
    let (status, told, _) = period_asked(flight, sensed, &still());
    (status, told)
}

fn period_asked(
    flight: &mut WrasseFlight,
    sensed: &WrasseSensed,
    asked: &WrasseArmReference,
) -> (WrasseStatus, WrasseControlOutput, WrasseComplaint) {
    // What stood there before must not be taken for what is told.
    let mut told =
        WrasseControlOutput { effort: [7.0; WRASSE_JOINTS], ..WrasseControlOutput::default() };
    let mut complaint = nothing_said();
    // SAFETY: all point to what they are.
    let status =
        unsafe { wrasse_flight_period(flight, sensed, asked, &raw mut told, &raw mut complaint) };
    (status, told, complaint)
}

/// A reading or a wish that is spoilt, the field it is in and its bound.
type Spoilt = (fn(&mut WrasseSensed, &mut WrasseArmReference, f64), &'static str, f64);

/// Just above its bound a number is refused with its field, the number and its bounds; at the bound it
/// is not refused for that.
#[test]
fn a_number_just_beyond_its_bound_is_refused_by_its_field_and_without_torque() {
    let fields: [Spoilt; 12] = [
        (|s, _, x| s.position[1] = x, "WrasseSensed.position", 1e6),
        (|s, _, x| s.angular_velocity[1] = x, "WrasseSensed.angular_velocity", 10.0),
        (|s, _, x| s.velocity[1] = x, "WrasseSensed.velocity", 100.0),
        (|s, _, x| s.joint_position[1] = x, "WrasseSensed.joint_position", 1e6),
        (|s, _, x| s.joint_rate[1] = x, "WrasseSensed.joint_rate", 100.0),
        (|s, _, x| (s.wrench_measured, s.wrench[1]) = (1, x), "WrasseSensed.wrench", 1e6),
        (|_, a, x| a.tool_position[1] = x, "WrasseArmReference.tool_position", 1e6),
        (|_, a, x| a.tool_velocity[1] = x, "WrasseArmReference.tool_velocity", 10.0),
        (|_, a, x| a.tool_acceleration[1] = x, "WrasseArmReference.tool_acceleration", 100.0),
        (
            |_, a, x| (a.kind, a.joint_position[1]) = (1, x),
            "WrasseArmReference.joint_position",
            1e6,
        ),
        (|_, a, x| (a.kind, a.joint_rate[1]) = (1, x), "WrasseArmReference.joint_rate", 100.0),
        (
            |_, a, x| (a.kind, a.joint_acceleration[1]) = (1, x),
            "WrasseArmReference.joint_acceleration",
            1e4,
        ),
    ];
    let mut flight = zeros();
    assert_eq!(set_up(&mut flight, &good()).0, WrasseStatus::WRASSE_OK);
    let (status, first) = period(&mut flight, &sensed());
    assert_eq!(status, WrasseStatus::WRASSE_OK);
    for (spoil, field, bound) in fields {
        for found in [bound.next_up(), -bound.next_up(), 1e308, f64::NAN] {
            let (mut sensed, mut asked) = (sensed(), WrasseArmReference { kind: 0, ..still() });
            spoil(&mut sensed, &mut asked, found);
            let before = flight;
            let (status, told, complaint) = period_asked(&mut flight, &sensed, &asked);
            let of_sensed = field.starts_with("WrasseSensed");
            let refused = if of_sensed {
                WrasseStatus::WRASSE_BAD_READING
            } else {
                WrasseStatus::WRASSE_BAD_NUMBER
            };
            assert_eq!(
                (status, text(complaint.field).as_str(), complaint.index),
                (refused, field, 1)
            );
            assert!(text(complaint.expected).starts_with("between -"));
            assert_eq!(complaint.found.to_bits(), found.to_bits());
            assert_eq!(flight.memory, before.memory, "{field}: the memory has changed");
            // Zeros, at the set-points that were told last.
            let safe = WrasseControlOutput {
                joint_position: first.joint_position,
                ..WrasseControlOutput::default()
            };
            assert_eq!(told, safe);
        }
        let (mut sensed, mut asked) = (sensed(), WrasseArmReference { kind: 0, ..still() });
        spoil(&mut sensed, &mut asked, bound);
        let mut copy = flight;
        let (status, ..) = period_asked(&mut copy, &sensed, &asked);
        assert!(
            [WrasseStatus::WRASSE_OK, WrasseStatus::WRASSE_BAD_RESULT].contains(&status),
            "{field}: {status:?}"
        );
    }
}

/// The attitude law turns a turning base back: it was sensed, so the period did run.
#[test]
fn a_bad_reading_changes_nothing_and_the_next_good_one_is_flown() {
    let mut flight = zeros();
    assert_eq!(period(&mut flight, &sensed()).0, WrasseStatus::WRASSE_NOT_SET_UP);
    assert_eq!(set_up(&mut flight, &good()).0, WrasseStatus::WRASSE_OK);
    let mut untouched = flight;
    let mut blind = sensed();
    blind.joint_rate[1] = f64::INFINITY;
    let (status, told) = period(&mut flight, &blind);
    assert_eq!((status, told), (WrasseStatus::WRASSE_BAD_READING, WrasseControlOutput::default()));
    let (status, told) = period(&mut flight, &sensed());
    assert_eq!((status, told), period(&mut untouched, &sensed()), "the refusal left a trace");
    assert_eq!(status, WrasseStatus::WRASSE_OK);
    assert!(told.attitude_torque[0] < -0.1, "{told:?}");
    // A joint that is not there is not read.
    blind.joint_rate[1] = 0.0;
    blind.joint_rate[2] = f64::NAN;
    assert_eq!(period(&mut flight, &blind).0, WrasseStatus::WRASSE_OK);
}

#[test]
fn null_pointers_are_refused_and_every_status_has_its_text() {
    // SAFETY: null is allowed and refused.
    let status =
        unsafe { wrasse_flight_period(null_mut(), null(), null(), null_mut(), null_mut()) };
    assert_eq!(status, WrasseStatus::WRASSE_NULL_POINTER);
    let texts: Vec<String> = (-1..=10).map(|k| text(wrasse_status_text(k))).collect();
    assert_eq!(texts[0], texts[11]);
    assert!((1..10).all(|k| texts[k] != texts[k + 1] && texts[k] != texts[0]), "{texts:?}");
}

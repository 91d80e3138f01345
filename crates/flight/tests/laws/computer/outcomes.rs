//! The flight computer's phases: their order and end, what cannot begin, and the same bits again.

use crate::laws::flights::{Flight, PERIOD, aside, at_rest, drifting, robot, setup};
use crate::laws::postures::LAWS;
use wrasse_dynamics::{State, kinematics, momentum};
use wrasse_flight::trajectory::{MotionLimits, ProfileShape, Quantity};
use wrasse_flight::{
    ArmLaw, Axes, FlightComputer, Grip, Held, JointTarget, JointTiming, Measurement, NoWay, Phase,
    STEPS, Target, Timing,
};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3, vec3};
use wrasse_testing::arms::{cube, difference};
use wrasse_testing::{Worst, larger};

fn hold(what: Held, duration: f64) -> Phase<f64, 7> {
    Phase::Hold { what, duration }
}

fn still<T: Copy>() -> JointTarget<T, 7> {
    JointTarget::Positions([None; 7])
}

#[test]
fn phases_follow_each_other_and_then_all_is_done() {
    let phases = [
        aside(Axes::Inertial, 1.0),
        hold(Held::Tool, 0.3),
        Phase::Grip { action: Grip::Grasp(3), keep: Held::Joints },
        hold(Held::Joints, 0.101),
        Phase::Grip { action: Grip::Release(3), keep: Held::Joints },
        hold(Held::Nothing, 0.05),
    ];
    let mut flight =
        Flight::new(&setup(ArmLaw::AttitudeHeld, Measurement::None), at_rest(), &phases);
    assert!(!flight.computer.done());
    let commands = flight.fly_on();
    // A duration takes the periods that cover it, a grip one.
    let periods: Vec<_> =
        (0..6).map(|k| commands.iter().filter(|c| c.phase == k).count()).collect();
    assert_eq!(periods, [100, 30, 1, 11, 1, 5]);
    assert!(commands.is_sorted_by_key(|c| c.phase));
    let grips: Vec<_> = commands.iter().filter_map(|c| Some((c.phase, c.grip?))).collect();
    assert_eq!(grips, [(2, Grip::Grasp(3)), (4, Grip::Release(3))]);
    // Whoever goes on is told to stand still.
    let last = commands.last().unwrap().set_points;
    for _ in 0..3 {
        let command = flight.step().unwrap();
        assert_eq!((command.phase, command.grip), (6, None));
        assert_eq!(command.set_points.map(|s| s.position), last.map(|s| s.position));
        assert!(flight.computer.done());
    }
}

/// The line ends where its target says: aside and turned by a rotation vector, in the phase's axes; or
/// at a pose. Measured 7.0e-17 m or rad.
#[test]
fn a_tool_is_sent_aside_or_to_a_pose_in_the_axes_of_the_phase() {
    let (mut worst, setup) = (Worst::none(), setup(ArmLaw::AttitudeHeld, Measurement::None));
    let (displacement, turn) = (vec3(0.05, 0.1, -0.02), vec3(0.1, -0.2, 0.15));
    for axes in [Axes::Inertial, Axes::Base] {
        let X_NB = if axes == Axes::Base { Pose::identity() } else { at_rest().X_NB };
        let seen = State { X_NB, ..at_rest() };
        let X = kinematics(&robot(), &seen).pose(&setup.assignment.tool);
        let turned = Quat::exp(turn).to_matrix() * X.rotation;
        let end = Pose::new(turned, X.translation + displacement);
        for target in [Target::By { displacement, turn }, Target::To(end)] {
            let phases = [Phase::MoveTool { target, axes, timing: Timing::Duration(3.0) }];
            let mut flight = Flight::new(&setup, at_rest(), &phases);
            let last = *flight.fly_on().last().unwrap();
            let (m, rad) = difference(&last.reference.X_NE, &end);
            worst.see(larger(m, rad));
            assert_eq!(last.axes, axes);
        }
    }
    worst.is_below(1e-14);
}

#[test]
fn without_phases_all_is_done_as_soon_as_it_has_looked() {
    let mut flight = Flight::new(&setup(ArmLaw::Terrestrial, Measurement::None), at_rest(), &[]);
    assert_eq!(flight.fly_on().len(), 1);
}

#[test]
fn there_is_room_for_so_many_phases_and_no_more() {
    let phases = [hold(Held::Joints, PERIOD); STEPS + 5];
    let mut flight =
        Flight::new(&setup(ArmLaw::Terrestrial, Measurement::None), at_rest(), &phases);
    assert_eq!(flight.fly_on().len(), STEPS);
}

/// A tool move whose numbers are no motion, after one that is.
fn refused(target: Target<f64>, timing: Timing<f64>) -> (usize, NoWay<f64>) {
    let phases =
        [hold(Held::Joints, 0.05), Phase::MoveTool { target, axes: Axes::Inertial, timing }];
    first_refusal(&phases)
}

fn first_refusal(phases: &[Phase<f64, 7>]) -> (usize, NoWay<f64>) {
    let mut flight =
        Flight::new(&setup(ArmLaw::AttitudeHeld, Measurement::None), at_rest(), phases);
    for _ in 0..5 {
        flight.step().unwrap();
    }
    let bad = flight.step().unwrap_err();
    (bad.phase, bad.reason)
}

#[test]
fn a_move_whose_numbers_are_no_motion_is_refused_when_it_should_begin() {
    let by = |x| Target::By { displacement: vec3(x, 0.0, 0.0), turn: Vec3::zero() };
    let none = MotionLimits { speed: 0.0, acceleration: 1.0, jerk: 1.0 };
    let limits = Timing::Limits { shape: ProfileShape::SCurve, linear: none, angular: none };
    let nowhere = Target::To(Pose { translation: vec3(f64::NAN, 0.0, 0.0), ..Pose::identity() });
    for (target, timing, quantity) in [
        (by(0.1), Timing::Duration(0.0), Quantity::Duration),
        (by(0.1), Timing::Duration(-3.0), Quantity::Duration),
        (by(0.1), Timing::Duration(f64::NAN), Quantity::Duration),
        (by(f64::INFINITY), Timing::Duration(3.0), Quantity::Way),
        (by(0.1), limits, Quantity::SpeedLimit),
        (nowhere, Timing::Duration(3.0), Quantity::Way),
    ] {
        let (phase, NoWay::Numbers(numbers)) = refused(target, timing) else {
            panic!("{target:?} {timing:?}: not because of its numbers")
        };
        assert_eq!((phase, numbers.iter().next().unwrap().quantity), (1, quantity));
    }
    let timing = JointTiming::Duration(-1.0);
    let (phase, reason) =
        first_refusal(&[hold(Held::Joints, 0.05), Phase::MoveJoints { to: still(), timing }]);
    assert!(phase == 1 && matches!(reason, NoWay::Numbers(_)), "{reason:?}");
}

/// The arm reaches 1.05 m from its mount and the tool is sent to 3 m: what is left is said.
#[test]
fn a_pose_out_of_reach_is_refused_with_what_is_left() {
    let away = Pose { translation: vec3(3.9, 0.5, 0.0), ..Pose::identity() };
    let to = JointTarget::Tool(away, Axes::Base);
    let phases =
        [hold(Held::Joints, 0.05), Phase::MoveJoints { to, timing: JointTiming::Duration(9.0) }];
    let (phase, NoWay::Unreachable(left)) = first_refusal(&phases) else { panic!("it went") };
    assert_eq!(phase, 1);
    // Whatever it leaves of the angle, it cannot come nearer than 1.95 m.
    assert!((1.9499..2.5).contains(&left.position_error), "{left:?}");
}

/// By a law of its own, in the base's axes and in inertial ones: measured 9.0e-13 m or rad off.
#[test]
fn joints_sent_to_a_tool_pose_bring_the_tool_there() {
    let mut worst = Worst::none();
    for law in LAWS {
        for axes in [Axes::Inertial, Axes::Base] {
            let state = match axes {
                Axes::Inertial => at_rest(),
                Axes::Base => State { X_NB: Pose::identity(), ..at_rest() },
            };
            let mut flight = Flight::new(&setup(law, Measurement::None), at_rest(), &[]);
            let tool = *flight.computer.tool();
            let X = kinematics(&robot(), &state).pose(&tool);
            let turn = Quat::exp(vec3(0.1, -0.1, 0.2)).to_matrix();
            let X = Pose::new(turn * X.rotation, X.translation + vec3(0.05, 0.1, -0.05));
            let to = JointTarget::Tool(X, axes);
            let phases = [Phase::MoveJoints { to, timing: JointTiming::Duration(4.0) }];
            flight = Flight::new(&setup(law, Measurement::None), at_rest(), &phases);
            flight.fly_on();
            let mut believed = flight.computer.believed_state();
            if axes == Axes::Base {
                believed.X_NB = Pose::identity();
            }
            let found = kinematics(&robot(), &believed).pose(&tool);
            // With a free attitude the base turns on the way: in inertial axes it cannot be known
            // before.
            if (law, axes) != (ArmLaw::FreeFloating, Axes::Inertial) {
                worst.see((found.translation - X.translation).norm());
                let R = found.rotation.transpose() * X.rotation;
                worst.see(Quat::from_matrix(&R).log().norm());
            }
        }
    }
    worst.is_below(1e-11);
}

/// Though joints and attitude are off from where they should be.
#[test]
fn while_it_coasts_nothing_acts() {
    let phases = [aside(Axes::Inertial, 0.5), hold(Held::Nothing, 0.5)];
    let mut start = drifting();
    start.v = [0.01, -0.02, 0.01, 0.02, -0.01, 0.03, 0.02];
    let mut flight = Flight::new(&setup(ArmLaw::AttitudeHeld, Measurement::Base), start, &phases);
    let (moving, coasting): (Vec<_>, Vec<_>) =
        flight.fly_on().into_iter().partition(|c| c.phase == 0);
    assert!(moving.iter().all(|c| c.effort != [0.0; 7] && c.attitude_torque_B != Vec3::zero()));
    for command in &coasting {
        assert_eq!((command.effort, command.attitude_torque_B), ([0.0; 7], Vec3::zero()));
    }
    assert_eq!(coasting.len(), 50);
    // The joints are believed to move on as they did.
    let rates = |c: &wrasse_flight::Command<f64, 7>| c.set_points.map(|s| s.rate);
    assert_eq!(rates(coasting.last().unwrap()), rates(moving.last().unwrap()));
}

/// What was floating at the grip's own twist changes nothing of it: the base goes on as it did.
/// Measured 6.9e-16 of the momentum.
#[test]
fn taking_hold_of_a_payload_continues_the_believed_motion() {
    let phases = [
        hold(Held::Joints, 0.1),
        Phase::Grip { action: Grip::Grasp(0), keep: Held::Joints },
        hold(Held::Joints, 0.1),
    ];
    let mut flight =
        Flight::new(&setup(ArmLaw::FreeFloating, Measurement::None), drifting(), &phases);
    for _ in 0..11 {
        flight.step().unwrap();
    }
    let before = flight.computer.believed_state();
    let tool = *flight.computer.tool();
    let laden = robot().with_payload(&tool, &cube(300.0, Vec3::zero()));
    flight.computer.robot_changed(&laden);
    assert_eq!(flight.computer.believed_state(), before);
    let h = momentum(&kinematics(&laden, &before));
    let mut worst = Worst::none();
    for _ in 0..10 {
        flight.step().unwrap();
        let now = momentum(&kinematics(&laden, &flight.computer.believed_state()));
        worst.see((now.angular - h.angular).norm() / h.angular.norm());
        worst.see((now.linear - h.linear).norm() / h.linear.norm());
    }
    worst.is_below(1e-14);
}

#[test]
fn two_computers_that_are_told_the_same_say_the_same_bits() {
    for law in LAWS {
        let again = || {
            let phases = [aside(Axes::Inertial, 2.0), hold(Held::Tool, 0.5)];
            let mut flight = Flight::new(&setup(law, Measurement::Base), drifting(), &phases);
            let commands = flight.fly_on();
            format!("{commands:?}")
        };
        // Text tells zero from minus zero.
        assert_eq!(again(), again());
    }
}

/// Single precision rounds a position of 1 m to 6e-8, and the inverse of the Jacobian passes on a
/// hundred times that; the loop over the tool error takes back what the tool sees of it. Measured
/// 3.4e-5 rad over 200 periods.
#[test]
fn a_computer_in_single_precision_follows_the_one_in_double() {
    let narrow = |x: f64| {
        #[allow(clippy::cast_possible_truncation, reason = "single precision is asked for")]
        let narrow = x as f32;
        narrow
    };
    let mut worst = Worst::none();
    for law in LAWS {
        let start = at_rest();
        let mut wide =
            Flight::new(&setup(law, Measurement::None), start, &[aside(Axes::Inertial, 2.0)]);
        let start = State {
            X_NB: Pose::from_f64(&start.X_NB),
            V_NB_B: SpatialVelocity::zero(),
            q: start.q.map(narrow),
            v: [0.0; 7],
        };
        let phases = [aside(Axes::Inertial, 2.0_f32)];
        let computer = FlightComputer::new(setup(law, Measurement::None), &robot(), &phases);
        let mut single = Flight::with(computer, start);
        let (wide, single) = (wide.fly_on(), single.fly_on());
        assert_eq!(wide.len(), single.len());
        for (wide, single) in wide.iter().zip(&single) {
            let position = |s: wrasse_hardware::SetPoint<f32>| f64::from(s.position);
            worst.see_all(wide.set_points.map(|s| s.position), single.set_points.map(position));
        }
    }
    worst.is_below(2e-4);
}

/// Ten days at 100 Hz are the most; a typing error is not to be planned for ever.
#[test]
fn a_phase_longer_than_any_mission_is_refused_with_both_durations() {
    for duration in [1e9, 1e300, f64::INFINITY] {
        let phases = [hold(Held::Joints, 0.05), hold(Held::Joints, duration)];
        let (phase, NoWay::TooLong { duration: found, longest }) = first_refusal(&phases) else {
            panic!("{duration} s began")
        };
        assert_eq!((phase, found), (1, duration));
        assert!((longest / (864_000.0 * 100.0 * PERIOD) - 1.0).abs() < 1e-12, "{longest}");
    }
}

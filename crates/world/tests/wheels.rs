//! Reaction wheels: against closed forms, and against rotors of a multibody that shares nothing with
//! the wheel model but the integrator.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod equipped;

use equipped::{block, turning_block, wheel};
use wrasse_dynamics::{BodyId, Joint, JointKind, MassProperties, Robot, State};
use wrasse_hardware::{ActuatorCommand, List, ReactionWheel, WHEELS};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_testing::largest;
use wrasse_world::{BaseAttitude, Drive, Equipment, Failure, Saturation, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const PERIOD: f64 = 0.01;

fn told(torque: &[f64]) -> ActuatorCommand<f64> {
    let mut command = ActuatorCommand::default();
    command.wheel_torque[..torque.len()].copy_from_slice(torque);
    command
}

/// Wheels that turn (rad/s) at the start.
fn wheels(list: &[ReactionWheel<f64>], speed: &[f64]) -> Equipment {
    let mut equipment = Equipment::default();
    equipment.actuators.wheels = List::new(list);
    equipment.wheel_speed[..speed.len()].copy_from_slice(speed);
    equipment
}

/// Periods in which the wheels are told these torques; all that was cut.
fn run(world: &mut OneSystem<1>, periods: usize, torque: &[f64]) -> Vec<Saturation> {
    let mut cut = Vec::new();
    for _ in 0..periods {
        cut.extend(world.command(&[], Vec3::zero(), &told(torque), PERIOD));
        world.advance(PERIOD).expect("stays finite");
    }
    cut
}

fn speed(world: &OneSystem<1>) -> f64 {
    world.actuator_readings().wheel_speed[0]
}

/// Constant torques about one axis: the integrator is exact, rounding is left. Measured 0.
#[test]
fn a_wheel_that_spins_up_turns_the_base_the_other_way_by_the_ratio_of_inertias() {
    let robot = block(50.0, Sym3::diagonal(4.0, 5.0, 6.0));
    let mut world =
        turning_block(&robot, Vec3::zero(), &wheels(&[wheel(vec3(0.0, 0.0, 1.0))], &[]), 1e-2);
    assert_eq!(run(&mut world, 500, &[0.3]), []);
    // The wheel's own momentum is the motor's; the rest of the base has the opposite.
    let w = world.state().V_NB_B.angular;
    let off = (w.z / (-0.3 * 5.0 / (6.0 - 0.05)) - 1.0).abs();
    let off_speed = (speed(&world) / (0.3 * 5.0 / 0.05 - w.z) - 1.0).abs();
    assert!(off < 1e-13 && off_speed < 1e-13, "{off:e} {off_speed:e}");
    assert_eq!((w.x, w.y), (0.0, 0.0));
}

/// Base, an arm, and three rotors: (pose on the base, inertia across, inertia about the axis, mass).
fn rotors() -> [(Pose<f64>, f64, f64, f64); 3] {
    let at = |turn, shift| Pose::from_quat(Quat::exp(turn), shift);
    [
        (at(vec3(0.4, 0.1, -0.6), vec3(0.3, 0.1, 0.2)), 0.03, 0.05, 5.0),
        (at(vec3(-1.2, 0.7, 0.3), vec3(-0.2, 0.3, 0.1)), 0.02, 0.03, 4.0),
        (at(vec3(0.5, 1.4, 0.2), vec3(0.1, -0.3, -0.2)), 0.05, 0.08, 6.0),
    ]
}
const TORQUES: [f64; 3] = [0.4, -0.2, 0.3];
const SPEEDS: [f64; 3] = [300.0, -200.0, 100.0];

fn base_and_arm() -> (MassProperties<f64>, (Joint<f64>, MassProperties<f64>)) {
    let base =
        MassProperties::from_central(60.0, vec3(0.05, -0.1, 0.02), Sym3::diagonal(5.0, 6.0, 7.0));
    let arm =
        MassProperties::from_central(8.0, vec3(0.6, 0.1, -0.1), Sym3::diagonal(0.2, 0.9, 0.8));
    let mount = Pose::from_quat(Quat::exp(vec3(0.3, 0.5, -0.2)), vec3(0.4, -0.2, 0.5));
    (base, (Joint::new(BodyId::Base, JointKind::Revolute, mount, vec3(0.3, 1.0, 0.2)), arm))
}

fn flying<const J: usize>(
    robot: &Robot<f64, J>,
    v: [f64; J],
    equipment: &Equipment,
    step: f64,
) -> OneSystem<J> {
    let V_NB_B = SpatialVelocity::from_array([0.2, -0.3, 0.15, 0.1, 0.0, -0.2]);
    OneSystem::new(&OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: *equipment,
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step },
        start: State { V_NB_B, v, ..State::default() },
        held: &[],
    })
}

/// The rotors as links that motors turn.
fn as_links(step: f64) -> OneSystem<4> {
    let (base, arm) = base_and_arm();
    let z = vec3(0.0, 0.0, 1.0);
    let mut links = vec![arm];
    for (X, across, about, mass) in rotors() {
        let matter =
            MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(across, across, about));
        links.push((Joint::new(BodyId::Base, JointKind::Revolute, X, z), matter));
    }
    let robot = Robot::new(base, &links).expect("four joints fit");
    let mut world =
        flying(&robot, [0.3, SPEEDS[0], SPEEDS[1], SPEEDS[2]], &Equipment::default(), step);
    let drives = [0.5, TORQUES[0], TORQUES[1], TORQUES[2]].map(Drive::Effort);
    world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), 2.0);
    world
}

/// The rotors as wheels; their matter is the base's.
fn as_wheels(step: f64) -> OneSystem<1> {
    let (mut base, arm) = base_and_arm();
    let mut list = vec![];
    for (X, across, about, mass) in rotors() {
        let matter =
            MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(across, across, about));
        base = base.and(&matter.seen_from(&X));
        let axis_B = X.rotation * vec3(0.0, 0.0, 1.0);
        list.push(ReactionWheel { axis_B, inertia: about, ..wheel(axis_B) });
    }
    let robot = Robot::new(base, &[arm]).expect("a joint fits");
    let mut world = flying(&robot, [0.3], &wheels(&list, &SPEEDS), step);
    assert_eq!(world.command(&[Drive::Effort(0.5)], Vec3::zero(), &told(&TORQUES), 2.0), []);
    world
}

/// Two ways to write the same equations: rounding of the rotors' own w × I w, some 1000 N·m, of which
/// nothing is left. Measured 1.3e-13 rad/s² of 0.35, and 4e-14 in the arm.
#[test]
fn accelerations_are_those_of_a_multibody_with_rotors() {
    let (links, wheels) = (as_links(1e-2), as_wheels(1e-2));
    let (full, found) = (links.dynamics().nudot, wheels.dynamics().nudot);
    let off = largest((full.base - found.base).to_array().iter().map(|x| x.abs()));
    let off_arm = (full.joints[0] - found.joints[0]).abs();
    assert!(off < 1e-12 && off_arm < 1e-12, "{off:e} {off_arm:e}");
}

/// Over 2 s in steps of 1 ms both are within 1e-13 of the motion by their order alone. Measured apart:
/// 7e-16 rad/s, 6e-17 m, 2e-16 rad/s in the arm, 6e-14 rad/s in the wheels (of 300).
#[test]
fn the_motion_is_that_of_a_multibody_with_rotors() {
    let (mut links, mut wheels) = (as_links(1e-3), as_wheels(1e-3));
    links.advance(2.0).expect("stays finite");
    wheels.advance(2.0).expect("stays finite");
    let (full, found) = (links.state(), wheels.state());
    let off = largest((full.V_NB_B - found.V_NB_B).to_array().iter().map(|x| x.abs()));
    let off_place = (full.X_NB.translation - found.X_NB.translation).norm();
    let off_arm = (full.v[0] - found.v[0]).abs();
    let speeds = wheels.actuator_readings().wheel_speed;
    let off_speed = largest((0..3).map(|i| (full.v[1 + i] - speeds[i]).abs()));
    assert!(
        off < 1e-13 && off_place < 1e-13 && off_arm < 1e-13,
        "{off:e} {off_place:e} {off_arm:e}"
    );
    assert!(off_speed < 1e-11, "{off_speed:e}");
}

/// A round body with a wheel along its axis: the turn across the axis goes round at h/I. Measured off:
/// 7.8e-11 after 15 rad in steps of 1 ms, the integrator's error.
#[test]
fn a_body_with_a_spinning_wheel_nutates_at_the_known_rate() {
    let robot = block(50.0, Sym3::diagonal(4.0, 4.0, 6.0));
    let equipment = wheels(&[wheel(vec3(0.0, 0.0, 1.0))], &[400.0]);
    let mut world = turning_block(&robot, vec3(0.01, 0.0, 0.0), &equipment, 1e-3);
    run(&mut world, 300, &[0.0]);
    let rate = 0.05 * 400.0 / 4.0;
    let (sin, cos) = f64::sin_cos(rate * 3.0);
    let off = (world.state().V_NB_B.angular - vec3(0.01 * cos, 0.01 * sin, 0.0)).norm() / 0.01;
    assert!(off < 1e-9, "{off:e}");
}

/// Viscous friction alone: the speed of wheel against base dies away at `c (1/J + 1/I)`. Measured off:
/// 0, steps of 1 ms.
#[test]
fn a_dead_wheel_runs_down_by_its_friction_and_takes_the_base_along() {
    let robot = block(50.0, Sym3::diagonal(4.0, 5.0, 6.0));
    let bearing = ReactionWheel { viscous: 0.01, ..wheel(vec3(0.0, 0.0, 1.0)) };
    let mut world = turning_block(&robot, Vec3::zero(), &wheels(&[bearing], &[300.0]), 1e-3);
    world.fail(Failure::Wheel(0));
    assert_eq!(run(&mut world, 400, &[0.4]), [], "it is told a torque and gives none");
    let rate = 0.01 * (1.0 / 0.05 + 1.0 / 5.95);
    let expected = 300.0 * f64::exp(-rate * 4.0);
    let off = (speed(&world) / expected - 1.0).abs();
    let lost = 0.05 * (300.0 - expected);
    let off_base = (world.state().V_NB_B.angular.z / (lost / (5.95 + 0.05)) - 1.0).abs();
    assert!(off < 1e-12, "{off:e}");
    assert!(off_base < 1e-12, "{off_base:e}");
}

/// Coulomb friction takes the same from any speed; near rest it fades, and the wheel comes to rest.
/// Measured: 3.1e-4 rad/s behind (what fades already at speed), and 0 in the end.
#[test]
fn coulomb_friction_brakes_evenly_and_lets_a_wheel_rest() {
    let robot = block(1e9, Sym3::diagonal(1e9, 1e9, 1e9));
    let bearing = ReactionWheel { coulomb: 0.1, ..wheel(vec3(0.0, 0.0, 1.0)) };
    let mut world = turning_block(&robot, Vec3::zero(), &wheels(&[bearing], &[-100.0]), 1e-3);
    run(&mut world, 1000, &[0.0]);
    // 0.1/0.05 rad/s² for ten seconds; what fades near rest is (0.5/speed)²/2 of it.
    let off = (speed(&world) + 80.0).abs();
    run(&mut world, 9000, &[0.0]);
    assert!(off < 1e-3, "{off:e}");
    assert!(speed(&world).abs() < 1e-6, "{:e}", speed(&world));
}

#[test]
fn torque_is_rounded_then_cut_and_what_is_cut_is_said() {
    let robot = block(50.0, Sym3::diagonal(4.0, 5.0, 6.0));
    let coarse = ReactionWheel { torque_step: 0.02, ..wheel(vec3(0.0, 0.0, 1.0)) };
    for (wanted, given, cut) in [
        (0.107, 0.1, vec![]),
        (-0.095, -0.1, vec![]),
        (0.7, 0.5, vec![Saturation::WheelTorque(0)]),
        (-9.0, -0.5, vec![Saturation::WheelTorque(0)]),
    ] {
        let mut world = turning_block(&robot, Vec3::zero(), &wheels(&[coarse], &[]), 1e-2);
        assert_eq!(run(&mut world, 1, &[wanted]), cut);
        let off = (world.effector_variables(world.id, 0)[0] / (given * PERIOD) - 1.0).abs();
        assert!(off < 1e-14, "{wanted}: off by {off:e}");
    }
}

/// At full speed the motor holds what the bearing takes, and no more. Measured off: 0.
#[test]
fn a_wheel_at_its_speed_limit_goes_no_faster_and_says_so() {
    let robot = block(50.0, Sym3::diagonal(40.0, 50.0, 60.0));
    let bearing = ReactionWheel { viscous: 1e-4, coulomb: 2e-3, ..wheel(vec3(0.0, 0.0, 1.0)) };
    for way in [1.0, -1.0] {
        let start = [599.0 * way];
        let mut world = turning_block(&robot, Vec3::zero(), &wheels(&[bearing], &start), 1e-2);
        let cut = run(&mut world, 200, &[0.5 * way]);
        assert!(cut.iter().all(|c| *c == Saturation::WheelSpeed(0)) && !cut.is_empty());
        let off = (speed(&world) * way / 600.0 - 1.0).abs();
        assert!(off < 1e-12, "{off:e}");
        assert_eq!(run(&mut world, 1, &[-0.4 * way]), [], "the way back is free");
    }
}

#[test]
fn as_many_wheels_as_there_can_be_and_one_that_is_not_there() {
    let robot = block(500.0, Sym3::diagonal(40.0, 50.0, 60.0));
    let equipment = wheels(&[wheel(vec3(0.0, 1.0, 1.0)); WHEELS], &[]);
    let mut world = turning_block(&robot, Vec3::zero(), &equipment, 1e-2);
    world.fail(Failure::Wheel(WHEELS));
    run(&mut world, 10, &[0.1; WHEELS]);
    let all = world.effector_variables(world.id, 0);
    assert!(all.iter().all(|h| (h / 0.01 - 1.0).abs() < 1e-13), "{all:?}");
}

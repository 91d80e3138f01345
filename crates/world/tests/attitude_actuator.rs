//! The ideal attitude actuator: its limits, its ledger, and the attitude that is held exactly.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, moving, robot};
use wrasse_dynamics::State;
use wrasse_hardware::{ActuatorCommand, AttitudeActuator, SetPointMotion};
use wrasse_spatial::{SpatialVelocity, Vec3, vec3};
use wrasse_testing::{larger, largest};
use wrasse_world::{BaseAttitude, Drive, Equipment, Ledger, Saturation, Source, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Control period (s).
const PERIOD: f64 = 0.01;
/// 0.5 N·m about each axis, 1 N·m·s about each axis.
const LIMITS: AttitudeActuator<f64> = AttitudeActuator { torque_limit: 0.5, momentum_limit: 1.0 };

fn world(base: BaseAttitude, start: State<f64, J>) -> OneSystem<J> {
    OneSystem::new(&OneSystemSetup {
        robot: &robot(),
        limits: &[],
        actuator: Some(LIMITS),
        equipment: Equipment::default(),
        base,
        stepper: Stepper::Fixed { step: PERIOD },
        start,
        held: &[],
    })
}

/// Nothing moves but the base turns with `w` (rad/s, base axes).
fn turning(w: Vec3<f64>) -> State<f64, J> {
    State { v: [0.0; J], V_NB_B: SpatialVelocity::new(w, Vec3::zero()), ..moving() }
}

/// The joints are kept where they are.
fn still() -> [Drive; J] {
    moving().q.map(|q| Drive::Follow(SetPointMotion::still(q)))
}

/// Fly for `time` (s) with the same torque commanded all the while; the books, and the largest
/// momentum stored about any axis (N·m·s).
fn fly(world: &mut OneSystem<J>, torque_B: Vec3<f64>, time: f64) -> (Ledger, f64) {
    let mut ledger = world.open_ledger();
    let mut fullest = 0.0_f64;
    let mut left = (time / PERIOD).round();
    while left > 0.0 {
        world.command(&still(), torque_B, &ActuatorCommand::default(), PERIOD);
        world.advance(PERIOD).expect("stays finite");
        world.update_ledger(&mut ledger);
        let stored = world.stored_momentum_B().to_array();
        fullest = larger(fullest, largest(stored.iter().map(|h| h.abs())));
        left -= 1.0;
    }
    (ledger, fullest)
}

#[test]
fn a_torque_beyond_the_limit_is_cut_axis_by_axis_and_reported() {
    let mut world = world(BaseAttitude::Controlled, turning(Vec3::zero()));
    let cut = world.command(&still(), vec3(0.4, -0.7, 2.0), &ActuatorCommand::default(), PERIOD);
    assert_eq!(cut, [Saturation::ActuatorTorque(1), Saturation::ActuatorTorque(2)]);
    assert_eq!(world.actuator_torque_B(), vec3(0.4, -0.5, 0.5));
}

#[test]
fn only_a_base_that_is_controlled_takes_a_torque() {
    for base in [BaseAttitude::Free, BaseAttitude::Held] {
        let mut world = world(base, turning(Vec3::zero()));
        let cut = world.command(&still(), vec3(9.0, 9.0, 9.0), &ActuatorCommand::default(), PERIOD);
        assert_eq!((cut, world.actuator_torque_B()), (vec![], Vec3::zero()));
    }
}

#[test]
fn an_actuator_without_limits_gives_what_is_asked() {
    let setup_robot = robot();
    let mut world: OneSystem<J> = OneSystem::new(&OneSystemSetup {
        robot: &setup_robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Controlled,
        stepper: Stepper::Fixed { step: PERIOD },
        start: turning(Vec3::zero()),
        held: &[],
    });
    assert_eq!(
        world.command(&still(), vec3(1e4, 0.0, -1e4), &ActuatorCommand::default(), PERIOD),
        []
    );
    assert_eq!(world.actuator_torque_B(), vec3(1e4, 0.0, -1e4));
}

/// Asked to turn for 10 s, the actuator is full after 2.5 s. The base turns meanwhile and carries
/// the stored momentum from axis to axis: what the full axis cannot take, the base feels. Measured
/// beyond the limit: 1.3e-7, 3.5e-7 and 8.4e-7 of it, of second order in the turn over a period.
#[test]
fn the_stored_momentum_stays_within_its_limit_though_the_base_turns() {
    for w in [Vec3::zero(), vec3(0.05, -0.02, 0.04), vec3(0.0, 0.0, 0.3)] {
        let mut world = world(BaseAttitude::Controlled, turning(w));
        let (_, fullest) = fly(&mut world, vec3(-0.4, -0.3, 0.1), 10.0);
        assert!(fullest > 0.999, "only {fullest} N·m·s stored: the limit was not reached");
        assert!(fullest < 1.0 + 2e-6, "{fullest} N·m·s stored");
        let cut =
            world.command(&still(), vec3(-0.4, 0.0, 0.0), &ActuatorCommand::default(), PERIOD);
        assert!(cut.contains(&Saturation::ActuatorMomentum(0)), "{cut:?}");
    }
}

/// A full actuator takes a torque that empties it.
#[test]
fn a_full_actuator_can_be_emptied() {
    let mut world = world(BaseAttitude::Controlled, turning(Vec3::zero()));
    fly(&mut world, vec3(-0.5, 0.0, 0.0), 4.0);
    let full = world.stored_momentum_B().x;
    let cut = world.command(&still(), vec3(0.5, 0.0, 0.0), &ActuatorCommand::default(), PERIOD);
    assert!(!cut.contains(&Saturation::ActuatorMomentum(0)), "{cut:?}");
    world.advance(PERIOD).expect("stays finite");
    let emptied = full - world.stored_momentum_B().x;
    // 0.5 N·m over 10 ms are 5e-3 N·m·s; the base turns and carries some. Measured apart: 6e-4.
    assert!((emptied / 5e-3 - 1.0).abs() < 1e-3, "emptied by {emptied} N·m·s");
}

/// The arm pushes, the actuator pushes, both limits cut: the books still close. Measured: angular
/// 1.2e-15, linear 4e-16, energy 4.9e-11 of the largest sums.
#[test]
fn the_books_close_over_a_controlled_base_at_its_limits() {
    let mut world = world(BaseAttitude::Controlled, moving());
    let mut ledger = world.open_ledger();
    let mut seen = vec![];
    for k in 0..500 {
        let t = f64::from(k) * PERIOD;
        let efforts = [0.9, -0.5, 0.7, -0.3].map(|tau| Drive::Effort(tau * (2.0 * t).cos()));
        let wanted = vec3(0.8 * t.sin(), -0.3, 0.4 * (0.7 * t).cos());
        seen.extend(world.command(&efforts, wanted, &ActuatorCommand::default(), PERIOD));
        world.advance(PERIOD).expect("stays finite");
        world.update_ledger(&mut ledger);
    }
    assert!(seen.contains(&Saturation::ActuatorTorque(0)));
    assert!(seen.contains(&Saturation::ActuatorMomentum(1)));
    let given = ledger.sources[Source::AttitudeActuator].angular.norm();
    assert!(given > 0.1, "the actuator gave {given} N·m·s: too little to prove anything");
    // Bounds: momentum is exact; work is a quadrature of order 4.
    for (i, bound) in [1e-14, 1e-14, 1e-8].into_iter().enumerate() {
        let share = ledger.worst[i] / ledger.scale[i];
        assert!(share < bound, "entry {i}: rest {share:e} of the scale");
    }
}

/// What holds an attitude is recorded: its sum over the periods is the change of the bodies' angular
/// momentum. By Simpson's rule over each period. Measured apart: 3e-10 N·m·s
/// of 1.1; what the actuator has stored, 1.4e-10.
#[test]
fn the_torque_that_holds_the_base_adds_up_to_the_change_of_angular_momentum() {
    let start = State { V_NB_B: SpatialVelocity::zero(), ..moving() };
    let mut world = world(BaseAttitude::Held, start);
    let (quat_NB, before) = (world.quat_NB(), world.account().angular);
    let mut sum = Vec3::zero();
    for _ in 0..100 {
        world.command(
            &[0.9, -0.5, 0.7, -0.3].map(Drive::Effort),
            Vec3::zero(),
            &ActuatorCommand::default(),
            PERIOD,
        );
        for weight in [1.0, 4.0] {
            sum += holding_torque(&world) * (weight * PERIOD / 6.0);
            world.advance(0.5 * PERIOD).expect("stays finite");
        }
        sum += holding_torque(&world) * (PERIOD / 6.0);
        // Held to the bit, not to a tolerance.
        assert_eq!(world.quat_NB(), quat_NB);
        assert_eq!(world.state().V_NB_B.angular, Vec3::zero());
    }
    let change = world.account().angular - before;
    let apart = (sum - change).norm();
    assert!(change.norm() > 0.5, "changed by {} N·m·s only", change.norm());
    assert!(apart < 1e-8, "{apart:e} N·m·s apart");
    let stored = quat_NB.to_matrix() * world.stored_momentum_B();
    let apart = (stored + change).norm();
    assert!(apart < 1e-8, "stored momentum {apart:e} N·m·s apart");
}

/// Torque (N·m, inertial axes) that holds the base now.
fn holding_torque(world: &OneSystem<J>) -> Vec3<f64> {
    world.state().X_NB.rotation * world.dynamics().force.base.torque
}

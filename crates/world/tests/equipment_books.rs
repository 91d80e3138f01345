//! The ledger with wheels, CMGs, thrusters, a tank that empties and a body that floats beside: what
//! they give and take is in the books.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;
mod equipped;

use branched::{J, grip, load, moving, robot};
use equipped::{busy, everything};
use wrasse_dynamics::{BodyId, Frame, MassProperties, PerBody, Robot, State};
use wrasse_hardware::List;
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity, Vec3, vec3};
use wrasse_testing::largest;
use wrasse_world::{
    Account, BaseAttitude, Drive, Equipment, Failure, FreeBody, GripOffset, Instant, Ledger,
    Source, Stepper,
};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const EFFORTS: [f64; J] = [0.9, -0.5, 0.7, -0.3];
const PERIOD: f64 = 0.05;

fn setup<'a>(
    robot: &'a Robot<f64, J>,
    equipment: &Equipment,
    stepper: Stepper,
    held: &'a [(Frame<f64>, MassProperties<f64>)],
) -> OneSystemSetup<'a, J> {
    OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: *equipment,
        base: BaseAttitude::Free,
        stepper,
        start: moving(),
        held,
    }
}

fn world(equipment: &Equipment, stepper: Stepper) -> OneSystem<J> {
    let mut world = OneSystem::new(&setup(&robot(), equipment, stepper, &[(grip(), load())]));
    world.set_outside_wrench(
        Box::new(|Instant { time: t, .. }, k| {
            // A force that keeps its direction in inertial axes, on a body that turns.
            let mut on = PerBody::filled(SpatialForce::zero());
            let force = k.X_NB(BodyId::Link(2)).rotation.transpose_mul(vec3(0.5, t, -0.4));
            on[BodyId::Link(2)] = SpatialForce::new(vec3(0.0, -0.2, 0.1), force);
            on
        }),
        &[],
    );
    let V = SpatialVelocity::from_array([0.1, 0.2, -0.1, 0.1, 0.0, -0.2]);
    world.add_body(&FreeBody::new(load(), &Pose::identity(), &V));
    world
}

/// Two seconds in which everything happens; `also` may do more in each period.
fn flown(
    equipment: &Equipment,
    stepper: Stepper,
    also: impl Fn(u32, &mut OneSystem<J>),
) -> (OneSystem<J>, Ledger) {
    let mut world = world(equipment, stepper);
    let mut ledger = world.open_ledger();
    for i in 0..40 {
        also(i, &mut world);
        world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &busy(i), PERIOD);
        world.advance(PERIOD).expect("stays finite");
        world.update_ledger(&mut ledger);
    }
    (world, ledger)
}

const FINE: Stepper = Stepper::Fixed { step: 1e-3 };

/// Impulses and work are quadratures of order 4, in steps of 1 ms. Measured rests: 1.3e-13 N·m·s of 53,
/// 1.2e-14 N·s of 24, 1.1e-11 J of 6.
#[test]
fn with_every_actuator_the_books_close() {
    let (world, ledger) = flown(&everything(1), FINE, |_, _| ());
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-12 && linear < 1e-13, "{angular:e} {linear:e}");
    assert!(energy < 1e-10, "{energy:e}");
    // Each has done something, and what is left in the tank is what did not leave.
    let (start, now) = (ledger.start, ledger.now);
    for source in [Source::Wheels, Source::Cmgs] {
        assert!((now.stored[source as usize] - start.stored[source as usize]).norm() > 1.0);
    }
    assert!(ledger.sources[Source::Thrusters].angular.norm() > 1.0 && ledger.propellant > 0.01);
    let left = world.actuator_readings().propellant;
    assert!((left + ledger.propellant - 8.0).abs() < 1e-13, "{left}");
    for source in [Source::Wheels, Source::Cmgs] {
        assert!(ledger.sources[source].work.abs() > 0.01, "{source:?} must work on the bodies");
    }
}

/// Measured rests: 2.2e-14 N·m·s, 1.3e-14 N·s, 8e-12 J.
#[test]
fn with_error_control_they_close_too() {
    let (_, ledger) = flown(&everything(1), Stepper::Adaptive { tolerance: 1e-9 }, |_, _| ());
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-12 && linear < 1e-13 && energy < 1e-10, "{angular:e} {energy:e}");
}

/// Wheels and CMGs only hand momentum about: the sum stays at any step, be it too long for the motion.
/// Measured rests, of 50 N·m·s and 18 N·s: 1.7e-14 and 0.9e-14 in steps of 50 ms, 2.4e-14 and 1e-14 in
/// 10 ms, 1.3e-13 and 1.1e-14 in 1 ms (the path of the free body is a plain sum).
#[test]
fn wheels_and_cmgs_keep_momentum_to_rounding_at_any_step() {
    for step in [0.05, 0.01, 1e-3] {
        let mut equipment = everything(1);
        equipment.actuators.thrusters = List::empty();
        let mut world = world(&equipment, Stepper::Fixed { step });
        world.set_outside_wrench(Box::new(|_, _| PerBody::filled(SpatialForce::zero())), &[]);
        let mut ledger = world.open_ledger();
        for i in 0..40 {
            world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &busy(i), PERIOD);
            world.advance(PERIOD).expect("stays finite");
            world.update_ledger(&mut ledger);
        }
        let [angular, linear, energy] = ledger.worst;
        assert!(angular < 5e-13 && linear < 5e-14, "step {step}: {angular:e} {linear:e}");
        // The longest steps are far from the motion: momentum stays all the same.
        assert!(step < 0.05 || energy > 1e-6, "{energy:e}");
    }
}

/// The energy line reads twists, the work reads torques: both meet as the steps shrink. A torque of the
/// wrong sign would leave a rest at any step. Measured: 2.6e-8 J in steps of 10 ms, 2.1e-10 J in 2.5 ms,
/// order 3.5 (where a gimbal reaches its largest acceleration the motion bends within a step).
#[test]
fn the_rest_of_energy_shrinks_by_the_order_of_the_steps() {
    let rest = |step| flown(&everything(1), Stepper::Fixed { step }, |_, _| ()).1.worst[2];
    let (coarse, fine) = (rest(0.01), rest(0.0025));
    let order = (coarse / fine).log2() / 2.0;
    assert!(order > 3.2 && order < 4.5, "order {order}");
}

/// Measured rests: 3.6e-13 N·m·s, 1.0e-14 N·s, 7.2e-12 J.
#[test]
fn failures_grasps_and_releases_leave_the_books_closed() {
    let (_, ledger) = flown(&everything(1), FINE, |i, world| match i {
        5 => world.fail(Failure::Gimbal(2)),
        9 => world.fail(Failure::Wheel(1)),
        12 => world.fail(Failure::ThrusterOpen(3)),
        15 => world.fail(Failure::ThrusterShut(0)),
        20 => drop(world.release(0)),
        30 => {
            let any = f64::INFINITY;
            let last = world.systems().last().expect("it was let go");
            let most =
                GripOffset { distance: any, angle: any, angular_speed: any, linear_speed: any };
            assert!(world.grasp(&grip(), last, &most).is_ok());
        }
        _ => (),
    });
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 2e-12 && linear < 1e-13 && energy < 1e-10, "{angular:e} {energy:e}");
}

/// A gimbal that jams shakes joints that are driven by torque; the energy says whether rightly. Measured:
/// the rates jump by up to 0.017 rad/s; rests of 1.6e-15 N·m·s and 3.7e-12 J.
#[test]
fn a_jam_shakes_joints_as_an_impulse_on_the_base_does() {
    let mut equipment = everything(1);
    for cmg in equipment.actuators.cmgs.iter_mut() {
        cmg.gimbal_inertia = 0.4;
    }
    let mut world = world(&equipment, FINE);
    let mut ledger = world.open_ledger();
    world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &busy(0), PERIOD);
    world.advance(PERIOD).expect("stays finite");
    let before = world.state();
    world.fail(Failure::Gimbal(0));
    world.fail(Failure::Gimbal(2));
    let after = world.state();
    world.update_ledger(&mut ledger);
    let [angular, linear, energy] = ledger.residuals();
    let jump = largest((0..J).map(|j| (after.v[j] - before.v[j]).abs()));
    assert!(jump > 0.01, "{jump}");
    assert!(angular < 1e-13 && linear < 1e-13 && energy < 1e-10, "{angular:e} {energy:e}");
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_other_pulses() {
    let end = |seed| flown(&everything(seed), FINE, |_, _| ()).0.bits();
    assert_eq!(end(1), end(1));
    assert_ne!(end(1), end(2));
}

/// A world whose base is held, with this equipment, after a busy second.
fn held(equipment: &Equipment) -> (OneSystem<J>, Ledger) {
    let robot = robot();
    let setup = OneSystemSetup { base: BaseAttitude::Held, ..setup(&robot, equipment, FINE, &[]) };
    let still = State { V_NB_B: SpatialVelocity::zero(), ..setup.start };
    let mut world = OneSystem::new(&OneSystemSetup { start: still, ..setup });
    let mut ledger = world.open_ledger();
    for n in 0..20 {
        world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &busy(n), PERIOD);
        world.fail(Failure::Gimbal(0));
        world.fail(Failure::ThrusterOpen(0));
        world.advance(PERIOD).expect("stays finite");
        world.update_ledger(&mut ledger);
    }
    (world, ledger)
}

/// It dropped them all: the same recoil with an empty tank as with a full one. What units hold stays in
/// the books and passes to nobody, for a base that does not turn carries no momentum on: ω × h = 0.
/// Measured rests: see below.
#[test]
fn a_held_base_keeps_the_mass_of_its_tank_and_what_its_wheels_and_cmgs_hold() {
    let equipment = everything(1);
    let ((world, ledger), (bare, _)) = (held(&equipment), held(&Equipment::default()));
    let tank = equipment.actuators.tank.expect("there is one").propellant;
    assert!((world.robot().mass() - bare.robot().mass() - tank).abs() < 1e-12);
    let readings = world.actuator_readings();
    assert_eq!(readings.propellant, tank);
    assert_eq!(readings.gimbal_angle, equipment.gimbal_angle);
    assert_eq!(readings.gimbal_rate, [0.0; wrasse_hardware::CMGS]);
    for (now, start) in readings.wheel_speed.iter().zip(equipment.wheel_speed) {
        assert!((now - start).abs() <= 1e-12 * start.abs(), "{now} {start}");
    }
    let (start, now) = (&ledger.start, &ledger.now);
    let stored = |of: &Account| [Source::Wheels, Source::Cmgs].map(|s| of.stored[s as usize]);
    let [wheels, cmgs] = stored(start);
    assert!(wheels.norm() > 0.01 && cmgs.norm() > 0.1, "{start:?}");
    assert_eq!(stored(start), stored(now));
    assert_eq!(ledger.propellant, 0.0);
    let [angular, linear, energy] = ledger.residuals();
    assert!(angular < 1e-9 && linear < 1e-12 && energy < 1e-9, "{angular:e} {linear:e} {energy:e}");
    // The heavier base gives way less.
    let shift = |world: &OneSystem<J>| world.state().X_NB.translation.norm();
    assert!(shift(&world) < shift(&bare), "{} {}", shift(&world), shift(&bare));
}

//! A number that is no longer finite stops the world, with what, whose and when.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, load, moving, robot};
use wrasse_dynamics::{BodyId, PerBody, Robot};
use wrasse_hardware::{ActuatorCommand, AttitudeActuator, JointLimits};
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity, Vec3, vec3};
use wrasse_world::{BaseAttitude, Drive, Equipment, FreeBody, Instant, NonFinite, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const STEPPERS: [Stepper; 2] =
    [Stepper::Fixed { step: 0.01 }, Stepper::Adaptive { tolerance: 1e-9 }];

fn setup(robot: &Robot<f64, J>, stepper: Stepper, base: BaseAttitude) -> OneSystemSetup<'_, J> {
    OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base,
        stepper,
        start: moving(),
        held: &[],
    }
}

fn world(stepper: Stepper, base: BaseAttitude) -> OneSystem<J> {
    OneSystem::new(&setup(&robot(), stepper, base))
}

/// One control period of 10 ms after another, until it breaks.
fn broken(world: &mut OneSystem<J>, drives: &[Drive; J], torque_B: Vec3<f64>) -> NonFinite {
    for _ in 0..100 {
        world.command(drives, torque_B, &ActuatorCommand::default(), 0.01);
        if let Err(broken) = world.advance(0.01) {
            return broken;
        }
    }
    panic!("nothing broke in a second")
}

const IDLE: [Drive; J] = [Drive::Effort(0.0); J];

/// A world whose link 3 feels a torque of `bad` N·m from 0.155 s on.
fn disturbed(stepper: Stepper, bad: f64) -> OneSystem<J> {
    let mut world = world(stepper, BaseAttitude::Free);
    world.set_outside_wrench(
        Box::new(move |Instant { time: t, .. }, _| {
            let mut on = PerBody::filled(SpatialForce::zero());
            on[BodyId::Link(3)].torque.x = if t > 0.155 { bad } else { 0.1 };
            on
        }),
        &[],
    );
    world
}

/// Every joint feels the tree, so the first link is named; the time is the end of the step.
#[test]
fn a_wrench_that_is_not_a_number_is_reported_with_quantity_body_and_time() {
    for stepper in STEPPERS {
        for bad in [f64::NAN, f64::INFINITY] {
            let broken = broken(&mut disturbed(stepper, bad), &IDLE, Vec3::zero());
            assert_eq!(broken.quantity, "position or rate of joint 0");
            assert!((broken.time - 0.16).abs() < 1e-12, "at {} s", broken.time);
            assert_eq!(
                broken.to_string(),
                format!("{} is no longer finite at t = {} s", broken.quantity, broken.time)
            );
        }
    }
}

/// It is noticed at the step, not at the end of a long period.
#[test]
fn within_a_long_period_the_time_of_the_step_is_reported() {
    let mut world = disturbed(STEPPERS[0], f64::NAN);
    world.command(&IDLE, Vec3::zero(), &ActuatorCommand::default(), 10.0);
    let broken = world.advance(10.0).expect_err("breaks");
    assert!((broken.time - 0.16).abs() < 1e-12, "at {} s", broken.time);
}

#[test]
fn an_effort_that_is_not_a_number_is_reported_whatever_the_limits() {
    let robot = robot();
    for stepper in STEPPERS {
        for limit in [None, Some(5.0)] {
            let limits = [JointLimits { effort: limit, ..JointLimits::default() }; J];
            let setup =
                OneSystemSetup { limits: &limits, ..setup(&robot, stepper, BaseAttitude::Free) };
            let mut drives = IDLE;
            drives[2] = Drive::Effort(f64::NAN);
            let broken = broken(&mut OneSystem::new(&setup), &drives, Vec3::zero());
            assert_eq!(broken.quantity, "position or rate of joint 0");
        }
    }
}

#[test]
fn an_actuator_torque_that_is_not_a_number_is_reported_whatever_the_limits() {
    let robot = robot();
    let limits = AttitudeActuator { torque_limit: 1.0, momentum_limit: 1.0 };
    for stepper in STEPPERS {
        for actuator in [None, Some(limits)] {
            let setup =
                OneSystemSetup { actuator, ..setup(&robot, stepper, BaseAttitude::Controlled) };
            let broken = broken(&mut OneSystem::new(&setup), &IDLE, vec3(0.0, f64::NAN, 0.0));
            assert_eq!(broken.quantity, "position or rate of joint 0");
        }
    }
}

#[test]
fn a_base_without_joints_is_reported_by_its_attitude_and_a_held_one_by_its_momentum() {
    let bare: Robot<f64, J> = Robot::new(load(), &[]).expect("no joints to refuse");
    for stepper in STEPPERS {
        for (base, quantity) in
            [(BaseAttitude::Free, "attitude of the base"), (BaseAttitude::Held, "angular momentum")]
        {
            let mut world = OneSystem::new(&setup(&bare, stepper, base));
            world.set_outside_wrench(
                Box::new(|_, _| {
                    let mut on = PerBody::filled(SpatialForce::zero());
                    on.base.torque.x = f64::NAN;
                    on
                }),
                &[],
            );
            assert_eq!(broken(&mut world, &IDLE, Vec3::zero()).quantity, quantity);
        }
    }
}

#[test]
fn a_free_body_that_is_nowhere_is_reported_by_its_number() {
    for stepper in STEPPERS {
        let fine = FreeBody::new(load(), &Pose::identity(), &SpatialVelocity::zero());
        let spun = FreeBody { angular: vec3(f64::NAN, 0.0, 0.0), ..fine };
        let gone = FreeBody { linear: vec3(0.0, f64::INFINITY, 0.0), ..fine };
        for (bad, quantity) in
            [(spun, "attitude of the base of system 2"), (gone, "attitude of the base of system 2")]
        {
            let mut world = world(stepper, BaseAttitude::Free);
            world.add_body(&fine);
            world.add_body(&bad);
            let broken = broken(&mut world, &IDLE, Vec3::zero());
            assert_eq!((broken.quantity.as_str(), broken.time), (quantity, 0.01));
        }
    }
}

//! The same again: the same bits for the same run, and for the same time in other portions.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, moving};
use wrasse_dynamics::{BodyId, PerBody, State};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{SpatialForce, Vec3, vec3};
use wrasse_testing::largest;
use wrasse_world::{BaseAttitude, Drive, Equipment, Instant, Ledger, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Length of a control period, and of the steps in it (s): powers of two, so that parts of the
/// period add up to it exactly.
const PERIOD: f64 = 0.0625;
const STEP: f64 = 0.015_625;

fn follow(j: usize) -> Drive {
    let at = |position, rate, acceleration| SetPoint { position, rate, acceleration };
    let (q, v) = (moving().q[j], moving().v[j]);
    Drive::Follow(SetPointMotion::between(at(q, v, 0.0), at(q + v * PERIOD, v, 0.1), PERIOD))
}

/// A world in which everything happens: joints that follow and joints driven by force, a wrench from
/// outside that changes with time.
fn world(stepper: Stepper) -> OneSystem<J> {
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &branched::robot(),
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper,
        start: moving(),
        held: &[],
    });
    world.set_outside_wrench(
        Box::new(|Instant { time: t, .. }, _| {
            let mut on = PerBody::filled(SpatialForce::zero());
            on[BodyId::Link(2)] =
                SpatialForce::new(vec3(0.3 * t, -0.2, 0.1), vec3(0.5, t * t, -0.4));
            on
        }),
        &[],
    );
    world
}

fn drives() -> [Drive; J] {
    [Drive::Effort(0.9), follow(1), follow(2), Drive::Effort(-0.3)]
}

/// One control period, advanced in equal parts.
fn flown(stepper: Stepper, parts: u32) -> (State<f64, J>, Ledger) {
    let mut world = world(stepper);
    let mut ledger = world.open_ledger();
    world.command(&drives(), Vec3::zero(), &ActuatorCommand::default(), PERIOD);
    for _ in 0..parts {
        world.advance(PERIOD / f64::from(parts)).expect("stays finite");
    }
    world.update_ledger(&mut ledger);
    (world.state(), ledger)
}

#[test]
fn the_same_run_gives_the_same_bits() {
    for stepper in [Stepper::Fixed { step: STEP }, Stepper::Adaptive { tolerance: 1e-10 }] {
        let many = || {
            let mut world = world(stepper);
            let mut ledger = world.open_ledger();
            for _ in 0..50 {
                world.command(
                    &[Drive::Effort(0.2); J],
                    vec3(0.1, 0.2, 0.3),
                    &ActuatorCommand::default(),
                    0.01,
                );
                world.advance(0.01).expect("stays finite");
                world.update_ledger(&mut ledger);
            }
            (world.bits(), ledger)
        };
        assert_eq!(many(), many());
    }
}

#[test]
fn a_period_in_parts_is_the_same_period_where_the_steps_are_the_same() {
    let stepper = Stepper::Fixed { step: STEP };
    assert_eq!(flown(stepper, 2), flown(stepper, 1));
    assert_eq!(flown(stepper, 4), flown(stepper, 1));
}

/// Parts that the steps do not fit: other steps, the same motion. Measured apart: 1.4e-12 and
/// 7e-16.
#[test]
fn a_period_in_parts_of_other_steps_is_the_same_motion() {
    let whole = flown(Stepper::Adaptive { tolerance: 1e-12 }, 1).0;
    for stepper in [Stepper::Fixed { step: 1e-3 }, Stepper::Adaptive { tolerance: 1e-12 }] {
        let parts = flown(stepper, 3).0;
        let apart = (0..J).fold(0.0_f64, |m, j| {
            largest([m, (parts.q[j] - whole.q[j]).abs(), (parts.v[j] - whole.v[j]).abs()])
        });
        assert!(apart < 1e-11, "joints {apart:e} apart");
    }
}

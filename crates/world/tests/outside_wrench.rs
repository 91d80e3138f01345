//! A wrench from outside that jumps in the middle of steps.

use wrasse_dynamics::{BodyId, Frame, MassProperties, PerBody, Robot, State};
use wrasse_hardware::ActuatorCommand;
use wrasse_spatial::{Pose, SpatialForce, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, Instant, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// 10 N from 0.203 s for 4 ms, and again from 0.5 s to 0.6 s where steps end anyway.
fn pushed(stepper: Stepper, told: bool) -> (OneSystem<1>, wrasse_world::Ledger) {
    let base =
        MassProperties::from_central(50.0, vec3(0.1, 0.0, 0.0), Sym3::diagonal(4.0, 5.0, 6.0));
    let robot: Robot<f64, 1> = Robot::new(base, &[]).expect("a base alone");
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper,
        start: State::default(),
        held: &[],
    });
    let bends = [0.203, 0.207, 0.5, 0.6];
    world.set_outside_wrench(
        Box::new(move |Instant { time, within }, _| {
            let at = if told { within } else { time };
            let acts = (0.203..=0.207).contains(&at) || (0.5..=0.6).contains(&at);
            let mut on = PerBody::filled(SpatialForce::zero());
            let force = vec3(0.0, if acts { 10.0 } else { 0.0 }, 0.0);
            on[BodyId::Base] = SpatialForce::new(Vec3::zero(), force);
            on
        }),
        if told { &bends } else { &[] },
    );
    let mut ledger = world.open_ledger();
    for _ in 0..100 {
        world.command(&[], Vec3::zero(), &ActuatorCommand::default(), 0.01);
        world.advance(0.01).expect("stays finite");
        world.update_ledger(&mut ledger);
    }
    (world, ledger)
}

/// 1.04 N·s in all: the first push is 0.04 N·s, the second 1 N·s; the base turns a little meanwhile.
/// Measured off: 4.1e-8 N·s, which is that turn.
#[test]
fn a_push_that_begins_and_ends_within_steps_gives_its_whole_impulse() {
    for stepper in [Stepper::Fixed { step: 0.005 }, Stepper::Adaptive { tolerance: 1e-9 }] {
        let (world, ledger) = pushed(stepper, true);
        let given = world.momentum(world.id).0.norm();
        assert!((given - 1.04).abs() < 1e-7, "{given} N·s");
        let [angular, linear, energy] = ledger.worst;
        assert!(angular < 1e-14 && linear < 1e-14, "{angular:e} {linear:e}");
        assert!(energy < 1e-11, "{energy:e} J");
        let tip = world.pose(&Frame { body: BodyId::Base, X_BF: Pose::identity() });
        assert!(tip.translation.norm() > 1e-3, "it moved");
    }
}

/// Without being told of the bends the steps reach over them: the short push is not what it should be.
#[test]
fn the_bends_are_what_makes_it_right() {
    let (world, _) = pushed(Stepper::Fixed { step: 0.005 }, false);
    let given = world.momentum(world.id).0.norm();
    assert!((given - 1.04).abs() > 5e-3, "{given} N·s");
}

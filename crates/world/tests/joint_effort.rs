//! Drives of the joints: what their limits cut, and what is not asked of them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, moving, robot};
use wrasse_hardware::{ActuatorCommand, JointLimits, SetPointMotion};
use wrasse_spatial::Vec3;
use wrasse_world::{BaseAttitude, Drive, Equipment, Saturation, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Joints 0 and 1 give at most 2 and 0.5 (N·m, N); the others are not limited.
fn world() -> OneSystem<J> {
    let limits =
        [2.0, 0.5].map(|effort| JointLimits { effort: Some(effort), ..JointLimits::default() });
    OneSystem::new(&OneSystemSetup {
        robot: &robot(),
        limits: &limits,
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 0.01 },
        start: moving(),
        held: &[],
    })
}

#[test]
fn an_effort_beyond_its_limit_is_cut_with_its_sign_and_reported() {
    let mut world = world();
    let cut = world.command(
        &[-3.0, 0.5, 90.0, -90.0].map(Drive::Effort),
        Vec3::zero(),
        &ActuatorCommand::default(),
        0.01,
    );
    assert_eq!(cut, [Saturation::JointEffort(0)]);
    assert_eq!(world.dynamics().force.joints, [-2.0, 0.5, 90.0, -90.0]);
}

/// Holding 4 joints that move at once takes more than 0.5 N along the second.
#[test]
fn a_joint_that_follows_takes_what_it_needs() {
    let mut world = world();
    let still = moving().q.map(|q| Drive::Follow(SetPointMotion::still(q)));
    let jerk = [still[0], still[1], Drive::Effort(90.0), Drive::Effort(-90.0)];
    assert_eq!(world.command(&jerk, Vec3::zero(), &ActuatorCommand::default(), 0.01), []);
    let force = world.dynamics().force.joints[1];
    assert!(force.abs() > 0.5, "{force} N");
}

/// A drive goes on as it was commanded until it is commanded otherwise.
#[test]
fn drives_that_are_not_mentioned_go_on() {
    let mut world = world();
    world.command(
        &[1.0, 0.1, 0.2, 0.3].map(Drive::Effort),
        Vec3::zero(),
        &ActuatorCommand::default(),
        0.01,
    );
    world.command(&[Drive::Effort(-1.0)], Vec3::zero(), &ActuatorCommand::default(), 0.01);
    assert_eq!(world.dynamics().force.joints, [-1.0, 0.1, 0.2, 0.3]);
}

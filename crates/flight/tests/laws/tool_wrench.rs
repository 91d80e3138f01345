//! Standing against a wrench on the tool, shown by forward dynamics.

use super::flights::{at_rest, robot};
use wrasse_dynamics::{BaseMode, JointDrive, PerBody, driven_dynamics, kinematics};
use wrasse_flight::{ArmLaw, against_tool_wrench};
use wrasse_spatial::{SpatialForce, Vec3, vec3};
use wrasse_testing::arms::atlas_class;
use wrasse_testing::largest;

/// Accelerations of joints and base (rad/s²) when the world pushes and the law stands against it.
fn answer(law: ArmLaw, mode: BaseMode, with_base_torque: bool) -> (f64, Vec3<f64>) {
    let (robot, (_, tool), state) = (robot(), atlas_class(), at_rest());
    let F_E = SpatialForce::new(vec3(3.0, -7.0, 5.0), vec3(40.0, 200.0, -90.0));
    let (effort, on_base_B) = against_tool_wrench(&robot, law, &tool, &state, &F_E);
    let at_body = tool.X_BF.force_to_parent(&F_E);
    let mut on_bodies = PerBody::filled(SpatialForce::zero());
    on_bodies[tool.body] = at_body;
    if with_base_torque {
        on_bodies.base.torque += on_base_B.torque;
    }
    let drives = effort.map(JointDrive::Effort);
    let found = driven_dynamics(&kinematics(&robot, &state), &drives, mode, &on_bodies);
    let joints = largest(found.nudot.joints.iter().map(|x| x.abs()));
    (joints, found.nudot.base.angular)
}

/// The base is free to be pushed away; neither a joint nor the attitude accelerates. Without the
/// torque the same push turns the base by 0.3 rad/s².
#[test]
fn joints_and_attitude_stand_against_a_push_at_the_tool() {
    let (joints, base) = answer(ArmLaw::AttitudeHeld, BaseMode::Free, true);
    assert!(joints < 1e-11, "joints {joints:e} rad/s²");
    assert!(base.norm() < 1e-13, "base {:e} rad/s²", base.norm());
    let (_, turned) = answer(ArmLaw::AttitudeHeld, BaseMode::Free, false);
    assert!(turned.norm() > 0.05, "without torque {:e} rad/s²", turned.norm());
}

/// Nothing turns the base back, and the joints stand still all the same.
#[test]
fn joints_of_a_free_floating_arm_stand_against_a_push_at_the_tool() {
    let (joints, base) = answer(ArmLaw::FreeFloating, BaseMode::Free, false);
    assert!(joints < 1e-11, "joints {joints:e} rad/s²");
    assert!(base.norm() > 0.05, "the base gives way: {:e} rad/s²", base.norm());
}

/// The law of an Earth-bound arm is wrong by what the base gives way.
#[test]
fn joints_under_the_terrestrial_law_give_way() {
    let (joints, _) = answer(ArmLaw::Terrestrial, BaseMode::Free, false);
    assert!(joints > 0.05, "joints {joints:e} rad/s²");
}

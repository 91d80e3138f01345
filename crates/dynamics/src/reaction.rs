//! What the arm does to the base: the reaction at its mount, and the torque that holds the base.

use crate::{BodyId, InverseDynamics, Kinematics};
use wrasse_spatial::{Real, SpatialForce, Vec3};

/// All six components that the parent exerts through joint `j` on what the joint carries, about the
/// joint's origin on the parent's side, in inertial axes (N·m, N). Exact.
///
/// The reaction on the parent is the opposite.
pub fn mount_reaction<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    dynamics: &InverseDynamics<T, J>,
    j: usize,
) -> SpatialForce<T> {
    let X_NB = &k.X_NB(BodyId::Link(j));
    let F_B = dynamics.F_B_B(k, BodyId::Link(j));
    let at_Bo = SpatialForce::new(X_NB.rotation * F_B.torque, X_NB.rotation * F_B.force);
    at_Bo.about(k.joint_origin(j) - X_NB.translation)
}

/// Torque (N·m, inertial axes) that the attitude control must supply about the base body's centre
/// of mass for the motion of `dynamics`: all arms and the base's own inertia included. Exact.
///
/// # Source
/// [`Longman1987`](wrasse_spatial::references::Longman1987): reaction moment compensation.
pub fn attitude_torque<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    dynamics: &InverseDynamics<T, J>,
) -> Vec3<T> {
    let p_BBcm_B = k.robot.inertia(BodyId::Base).centre_of_mass();
    k.state.X_NB.rotation * dynamics.force.base.about(p_BBcm_B).torque
}

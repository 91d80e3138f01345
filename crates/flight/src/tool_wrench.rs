//! A wrench from outside on the tool: what it asks of the joints and of the base.

use crate::law::ArmLaw;
use wrasse_dynamics::{
    Frame, Robot, State, attitude_held_jacobian, generalized_jacobian, jacobian, kinematics,
    mass_matrix,
};
use wrasse_spatial::{Real, SpatialForce, Vec3};

/// Joint torques (N·m, N) and torque on the base (N·m, base axes) that keep joints and attitude from
/// giving way to a wrench on the tool: `τ = -Jᵀ F` with the Jacobian of the law, and the opposite of
/// the wrench's torque about the system's centre of mass. The base still goes where the force pushes.
///
/// `F_E` is at the tool's origin, in its axes. A free-floating law lets the base turn: it needs the
/// joint torques alone.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989) for the generalized Jacobian;
/// the statics follow from the equations of motion with zero acceleration of the joints.
pub fn against_tool_wrench<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    tool: &Frame<T>,
    state: &State<T, J>,
    F_E: &SpatialForce<T>,
) -> ([T; J], Vec3<T>) {
    let k = kinematics(robot, state);
    let (M, J_NE) = (mass_matrix(&k), jacobian(&k, tool));
    let R_NB = &state.X_NB.rotation;
    let columns = match law {
        ArmLaw::Terrestrial => J_NE.joints,
        ArmLaw::AttitudeHeld => attitude_held_jacobian(&J_NE, &M, R_NB),
        ArmLaw::FreeFloating => generalized_jacobian(&J_NE, &M),
    };
    let X_NE = k.pose(tool);
    let F_N = SpatialForce::new(X_NE.rotation * F_E.torque, X_NE.rotation * F_E.force);
    let lever = X_NE.translation - k.centre_of_mass().1;
    let torque_N = F_N.torque + lever.cross(F_N.force);
    (columns.map(|column| -column.power(&F_N)), -R_NB.transpose_mul(torque_N))
}

//! A wrench from outside on the tool: what it asks of the joints and of the base.

use crate::law::ArmLaw;
use wrasse_dynamics::{
    Frame, Robot, State, attitude_held_jacobian, base_rows, generalized_jacobian, jacobian,
    kinematics,
};
use wrasse_spatial::{Real, SpatialForce};

/// Joint torques (N·m, N) that keep the joints from giving way to a wrench on the tool, `τ = -Jᵀ F`
/// with the Jacobian of the law, and what keeps the base from turning and from going where it is
/// pushed: the opposite of the wrench about the system's centre of mass (N·m, N, base axes).
///
/// `F_E` is at the tool's origin, in its axes. An attitude-held law needs the torque and lets the base
/// go with the force, a terrestrial one needs the force too, a free-floating one neither.
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
) -> ([T; J], SpatialForce<T>) {
    let k = kinematics(robot, state);
    let (M, J_NE) = (base_rows(&k), jacobian(&k, tool));
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
    let on_base_B =
        SpatialForce::new(R_NB.transpose_mul(-torque_N), R_NB.transpose_mul(-F_N.force));
    (columns.columns().map(|column| -column.power(&F_N)), on_base_B)
}

//! Computed torque, in the three forms: base fixed, attitude held, free-floating.

use crate::law::{ArmLaw, Tuning};
use wrasse_dynamics::{
    ReducedDynamics, Robot, State, attitude_held_dynamics, bias_force, free_floating_dynamics,
    kinematics, mass_matrix,
};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Real, SpatialVelocity, Vec3};

/// Joint torques (N·m, N) that follow the set-points: `τ = H (q̈_d + 2ζω ė + ω² e) + c`.
///
/// `H` and `c` are those of the law: `M_jj, c_j` (terrestrial), `H̄, c̄` (attitude held), `H*, c*`
/// (free-floating). `acceleration` is the one to feed forward over the period.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989) for the reduced dynamics.
pub fn computed_torque<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    tuning: &Tuning<T>,
    sensed: &State<T, J>,
    now: &[SetPoint<T>; J],
    acceleration: &[T; J],
) -> [T; J] {
    let mut state = *sensed;
    match law {
        ArmLaw::Terrestrial => state.V_NB_B = SpatialVelocity::zero(),
        ArmLaw::AttitudeHeld => state.V_NB_B.angular = Vec3::zero(),
        ArmLaw::FreeFloating => {}
    }
    let k = kinematics(robot, &state);
    let (M, c) = (mass_matrix(&k), bias_force(&k));
    let reduced = match law {
        ArmLaw::Terrestrial => ReducedDynamics { H: M.M_jj, c: c.joints },
        ArmLaw::AttitudeHeld => attitude_held_dynamics(robot, &M, &c),
        ArmLaw::FreeFloating => free_floating_dynamics(robot, &M, &c),
    };
    let stiffness = tuning.joint_bandwidth * tuning.joint_bandwidth;
    let damping = T::from_f64(2.0) * tuning.joint_damping * tuning.joint_bandwidth;
    let mut qddot = *acceleration;
    for j in robot.joints() {
        qddot[j] +=
            damping * (now[j].rate - sensed.v[j]) + stiffness * (now[j].position - sensed.q[j]);
    }
    reduced.effort(robot, &qddot)
}

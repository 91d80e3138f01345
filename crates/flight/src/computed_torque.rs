//! Computed torque, in the three forms: base fixed, attitude held, free-floating.

use crate::law::{ArmLaw, Tuning};
use wrasse_dynamics::{
    BaseMode, Configuration, Generalized, InverseDynamics, Outside, Robot, State,
    drive_configuration,
};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{At, Real, SpatialForce, SpatialVelocity};

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
    let back = joint_feedback(robot, tuning, sensed, now);
    let qddot = core::array::from_fn(|j| acceleration[j] + back[j]);
    let configuration = Configuration::at(robot, &sensed.q);
    let at = (&configuration, &mut InverseDynamics::new());
    law_effort(robot, law, at, (&sensed.V_NB_B, &sensed.v), &qddot)
}

/// Acceleration of each joint that its loop asks for (rad/s², m/s²): `2ζω ė + ω² e`.
#[inline(always)]
pub(crate) fn joint_feedback<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    tuning: &Tuning<T>,
    sensed: &State<T, J>,
    now: &[SetPoint<T>; J],
) -> [T; J] {
    let stiffness = tuning.joint_bandwidth * tuning.joint_bandwidth;
    let damping = T::from_f64(2.0) * tuning.joint_damping * tuning.joint_bandwidth;
    let mut back = [T::zero(); J];
    for j in robot.joints() {
        back[j] =
            damping * (now[j].rate - sensed.v[j]) + stiffness * (now[j].position - sensed.q[j]);
    }
    back
}

/// Forces of the joints (N·m, N) that give them accelerations on a base that moves as the law says.
///
/// `H` and `c` of the law are not formed: the forces of the motion on a base that does not give way come
/// first, then those of its recoil, `M_jb A`.
#[inline(always)]
pub(crate) fn law_effort<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    (configuration, forces): (&Configuration<T, J>, &mut InverseDynamics<T, J>),
    (V_NB_B, qdot): (&SpatialVelocity<T>, &[T; J]),
    qddot: &[T; J],
) -> [T; J] {
    // On a base that does not turn, where it goes has no part in the forces, only that it gives way.
    let base = if law == ArmLaw::FreeFloating { *V_NB_B } else { SpatialVelocity::zero() };
    let still = SpatialVelocity::zero();
    let nu = Generalized { base, joints: *qdot };
    let nudot = Generalized { base: still, joints: *qddot };
    drive_configuration(robot, configuration, &nu, &nudot, Outside::nothing(), forces);
    let M = &configuration.base;
    let A_NB_B = recoil(law.base(), M, &forces.force.base);
    let mut effort = forces.force.joints;
    for j in robot.joints() {
        effort[j] += match law {
            ArmLaw::Terrestrial => T::zero(),
            ArmLaw::AttitudeHeld => A_NB_B.linear.dot(M.M_bj.force.at(j)),
            ArmLaw::FreeFloating => A_NB_B.power(&M.M_bj.at(j)),
        };
    }
    effort
}

/// Acceleration of the base when the force that would hold it on its steady twist is not there.
#[inline(always)]
pub(crate) fn recoil<T: Real, const J: usize>(
    base: BaseMode,
    M: &wrasse_dynamics::BaseRows<T, J>,
    holding: &SpatialForce<T>,
) -> SpatialVelocity<T> {
    match base {
        BaseMode::Fixed => SpatialVelocity::zero(),
        BaseMode::AttitudeHeld => SpatialVelocity::new(
            wrasse_spatial::Vec3::zero(),
            holding.force * (-T::one() / M.M_bb.mass),
        ),
        BaseMode::Free => -M.M_bb.velocity_of(holding),
    }
}

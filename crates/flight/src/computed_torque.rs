//! Computed torque, in the three forms: base fixed, attitude held, free-floating.

use crate::answered_motion::{on_base, recoil};
use crate::law::{ArmLaw, Tuning};
use crate::posture::Posture;
use wrasse_dynamics::{BodyId, Robot, State};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Real, SpatialVelocity, Vec3};

/// Joint torques (N·m, N) that follow the set-points: `τ = H (q̈_d + 2ζω ė + ω² e) + c`.
///
/// `H` and `c` are those of the law: `M_jj, c_j` (terrestrial), `H̄, c̄` (attitude held), `H*, c*`
/// (free-floating). They are not formed: the forces of the motion on a base that does not answer come
/// first, then those of its recoil. `acceleration` is the one to feed forward over the period.
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
    let V_NB_B = match law {
        ArmLaw::Terrestrial => SpatialVelocity::zero(),
        ArmLaw::AttitudeHeld => SpatialVelocity::new(Vec3::zero(), sensed.V_NB_B.linear),
        ArmLaw::FreeFloating => sensed.V_NB_B,
    };
    let stiffness = tuning.joint_bandwidth * tuning.joint_bandwidth;
    let damping = T::from_f64(2.0) * tuning.joint_damping * tuning.joint_bandwidth;
    let mut qddot = *acceleration;
    for j in robot.joints() {
        qddot[j] +=
            damping * (now[j].rate - sensed.v[j]) + stiffness * (now[j].position - sensed.q[j]);
    }
    let posture = Posture::new(robot, &sensed.q);
    let matter = posture.matter(robot);
    let mut F = posture.forces(robot, &matter, &V_NB_B, &sensed.v, &qddot);
    let A_NB_B = recoil(law, &matter.whole, &on_base(robot, &V_NB_B, &F));
    let mut effort = [T::zero(); J];
    for j in robot.joints().rev() {
        // Tip to base: the recoil's part, what the motor feels, and all of it to the parent.
        let carried = F[j] + matter.links[j] * A_NB_B;
        effort[j] = posture.S[j].power(&carried);
        if let BodyId::Link(p) = robot.joint(j).parent
            && p < J
        {
            F[p] += carried;
        }
    }
    effort
}

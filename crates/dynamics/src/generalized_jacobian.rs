//! The generalized Jacobian: what joint rates do to a frame when nothing holds the base.

use crate::{BaseRows, Jacobian};
use wrasse_spatial::{Real, SpatialMomentum, SpatialVelocity};

/// `J* = J_m - J_b M_bb⁻¹ M_bj`: twist of the frame per joint rate at zero total momentum.
///
/// With total momentum the frame's twist is `J* q̇` plus [`velocity_from_momentum`].
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989).
#[inline(always)]
pub fn generalized_jacobian<T: Real, const J: usize>(
    J_frame: &Jacobian<T, J>,
    M: &BaseRows<T, J>,
) -> [SpatialVelocity<T>; J] {
    let (mut columns, per_M_bb) = ([SpatialVelocity::zero(); J], M.M_bb.inverse());
    for j in 0..M.count.min(J) {
        // Unit rate of joint j turns and pushes the base by -M_bb⁻¹ M_bj.
        columns[j] = J_frame.joints[j] - J_frame.of_base(&per_M_bb.velocity_of(&M.M_bj[j]));
    }
    columns
}

/// Twist of the frame that the total momentum alone causes, joints still: `J_b M_bb⁻¹ h`.
///
/// `h_Scm_B` is about the system's centre of mass, in base axes (N·m·s, N·s).
#[inline(always)]
pub fn velocity_from_momentum<T: Real, const J: usize>(
    J_frame: &Jacobian<T, J>,
    M: &BaseRows<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
) -> SpatialVelocity<T> {
    let h_Bo_B = h_Scm_B.about(-M.M_bb.centre_of_mass());
    J_frame.of_base(&M.M_bb.velocity_of(&h_Bo_B))
}

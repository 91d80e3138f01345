//! The generalized Jacobian: what joint rates do to a frame when nothing holds the base.

use crate::momentum::in_all;
use crate::{BaseRows, Jacobian};
use wrasse_spatial::{
    At, InverseInertia, Layout, Real, Rows, SpatialMomentum, SpatialVelocity, Sym3, groups, kernel,
};

/// `J* = J_m - J_b M_bb⁻¹ M_bj`: twist of the frame per joint rate at zero total momentum.
///
/// With total momentum the frame's twist is `J* q̇` plus [`velocity_from_momentum`].
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989).
#[inline]
pub fn generalized_jacobian<T: Real, const J: usize>(
    J_frame: &Jacobian<T, J>,
    M: &BaseRows<T, J>,
) -> SpatialVelocity<[T; J]> {
    let mut columns = Rows::zero_rows();
    generalized_columns(J_frame, M, &mut columns);
    columns
}

kernel! {
    /// [`generalized_jacobian`] into a place.
    pub fn generalized_columns<L, T, J>(
        J_frame: &Jacobian<T, J>,
        M: &BaseRows<T, J>,
        columns: &mut SpatialVelocity<[T; J]>,
    ) {
        let (R, p_BE_N) = (in_all::<L>(&J_frame.R_NB), L::all3(J_frame.p_BE_N));
        let per_M_bb = inverse_in_all::<L>(&M.M_bb.inverse());
        for i in groups::<L, J>(M.count) {
            // Unit rate of a joint turns and pushes the base by -M_bb⁻¹ M_bj.
            let recoil = per_M_bb.velocity_of(&M.M_bj.at(i));
            let recoil = SpatialVelocity::new(R * recoil.angular, R * recoil.linear);
            columns.put(i, J_frame.joints.at(i) - recoil.shifted_by(p_BE_N));
        }
    }
}

/// The same inverse inertia for each.
#[inline(always)]
fn inverse_in_all<L: Layout>(M: &InverseInertia<L::One>) -> InverseInertia<L::Some> {
    let I = M.per_central;
    InverseInertia {
        per_mass: L::all(M.per_mass),
        p_cm: L::all3(M.p_cm),
        per_central: Sym3 {
            xx: L::all(I.xx),
            xy: L::all(I.xy),
            xz: L::all(I.xz),
            yy: L::all(I.yy),
            yz: L::all(I.yz),
            zz: L::all(I.zz),
        },
    }
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

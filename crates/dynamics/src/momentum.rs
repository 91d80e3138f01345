//! Momentum: summed over the bodies, per unit rate, and backwards to the base's twist.

use crate::composite_inertia::link_inertia;
use crate::{BaseRows, Kinematics};
use wrasse_spatial::{
    At, Group, Layout, Mat3, OneByOne, Real, Rows, SpatialForce, SpatialMomentum, SpatialVelocity,
    Vec3, groups, kernel,
};

/// Momentum of the whole system in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Momentum<T> {
    /// Mass (kg).
    pub mass: T,
    /// Centre of mass `p_NScm_N` (m).
    pub p_NScm_N: Vec3<T>,
    /// Angular momentum about the centre of mass (N·m·s).
    pub angular: Vec3<T>,
    /// Linear momentum (N·s).
    pub linear: Vec3<T>,
}

/// Momentum summed body by body from poses and twists, angular about the system's centre of mass.
#[inline]
pub fn momentum<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> Momentum<T> {
    let (mass, p_BScm_B) = k.centre_of_mass_B();
    let (robot, posture, V) = (k.robot, &k.posture, k.link_twists());
    let mut h: SpatialMomentum<[T; J]> = Rows::zero_rows();
    for j in robot.joints() {
        let one: Group<OneByOne<T>> = Group::of(j);
        h.put(j, link_inertia(robot, posture, one) * V.at(j));
    }
    let own = robot.bodies.base.M_F_F * k.state.V_NB_B;
    let whole: SpatialMomentum<T> = robot
        .tips_to_base(own, &mut h, |j, h: SpatialMomentum<T>| h.about(-posture.p_PL_B.at(j)))
        .about(p_BScm_B);
    let X_NB = &k.state.X_NB;
    Momentum {
        mass,
        p_NScm_N: X_NB.point(p_BScm_B),
        angular: X_NB.rotation * whole.torque,
        linear: X_NB.rotation * whole.force,
    }
}

/// The momentum matrix `A`: `[angular about the centre of mass; linear]` in inertial axes per unit of
/// `[w_NB_B; v_NB_B; q̇]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentumMatrix<T, const J: usize> {
    /// Columns of the base's six.
    pub base: [SpatialMomentum<T>; 6],
    /// Columns of the joints, in rows.
    pub joints: SpatialMomentum<[T; J]>,
}

/// The momentum matrix from the base's rows of the mass matrix.
///
/// # Source
/// [`Orin2013`](wrasse_spatial::references::Orin2013): the centroidal momentum matrix.
#[doc(alias = "centroidal momentum matrix")]
#[inline]
pub fn momentum_matrix<T: Real, const J: usize>(
    M: &BaseRows<T, J>,
    R_NB: &Mat3<T>,
) -> MomentumMatrix<T, J> {
    let (base, joints) = ([SpatialMomentum::zero(); 6], Rows::zero_rows());
    let mut A = MomentumMatrix { base, joints };
    momentum_columns(M, R_NB, &mut A);
    A
}

kernel! {
    /// [`momentum_matrix`] into a place.
    pub fn momentum_columns<L, T, J>(
        M: &BaseRows<T, J>,
        R_NB: &Mat3<T>,
        A: &mut MomentumMatrix<T, J>,
    ) {
        let p_BScm_B = M.M_bb.centre_of_mass();
        let (R, p) = (in_all::<L>(R_NB), L::all3(p_BScm_B));
        for i in groups::<L, J>(M.count) {
            let h = M.M_bj.at(i).about(p);
            A.joints.put(i, SpatialForce::new(R * h.torque, R * h.force));
        }
        A.base = columns_of_base(M, R_NB);
    }
}

/// The same matrix for each.
#[inline(always)]
pub(crate) fn in_all<L: Layout>(R: &Mat3<L::One>) -> Mat3<L::Some> {
    let [x, y, z] = R.rows;
    Mat3 { rows: [L::all3(x), L::all3(y), L::all3(z)] }
}

/// About the centre of mass a turn has no linear momentum of its own but that of the lever, and a push
/// no angular one.
#[inline(always)]
fn columns_of_base<T: Real, const J: usize>(
    M: &BaseRows<T, J>,
    R_NB: &Mat3<T>,
) -> [SpatialMomentum<T>; 6] {
    let (o, I) = (Vec3::zero(), M.M_bb.central().to_mat3());
    let turn = (*R_NB * I).transpose().rows;
    let lever = (*R_NB * M.M_bb.first_moment.skew()).transpose().rows;
    let push = R_NB.scaled(M.M_bb.mass).transpose().rows;
    [
        SpatialMomentum::new(turn[0], -lever[0]),
        SpatialMomentum::new(turn[1], -lever[1]),
        SpatialMomentum::new(turn[2], -lever[2]),
        SpatialMomentum::new(o, push[0]),
        SpatialMomentum::new(o, push[1]),
        SpatialMomentum::new(o, push[2]),
    ]
}

/// Base twist `V_NB_B` that the total momentum and the joint rates mean:
/// `M_bb⁻¹ (h - M_bj q̇)`.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `M` | mass matrix in this posture | |
/// | `h_Scm_B` | total momentum about the system's centre of mass, base axes | N·m·s, N·s |
/// | `qdot` | joint rates | rad/s, m/s |
#[inline(always)]
pub fn base_twist<T: Real, const J: usize>(
    M: &BaseRows<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
    qdot: &[T; J],
) -> SpatialVelocity<T> {
    let per_M_bb = M.M_bb.inverse();
    let h_Bo_B = h_Scm_B.about(-per_M_bb.p_cm);
    per_M_bb.velocity_of(&(h_Bo_B - M.momentum_of_rates(qdot)))
}

//! Momentum: summed over the bodies, per unit rate, and backwards to the base's twist.

use crate::{BaseRows, Kinematics, PerBody};
use wrasse_spatial::{Mat3, Real, SpatialMomentum, SpatialVelocity, Vec3};

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
#[inline(always)]
pub fn momentum<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> Momentum<T> {
    let (mass, p_BScm_B) = k.centre_of_mass_B();
    let V = k.link_twists();
    let mut h_B: PerBody<SpatialMomentum<T>, J> = PerBody::filled(SpatialMomentum::zero());
    for body in k.robot.bodies() {
        h_B[body] = *k.robot.inertia_in_link(body) * V[body];
    }
    for j in k.robot.joints().rev() {
        let onto_parent = k.seat(j).force_to_parent(&h_B.links[j]);
        h_B[k.robot.link(j).parent] += onto_parent;
    }
    let X_NB = &k.state.X_NB;
    let about_cm = h_B.base.about(p_BScm_B);
    Momentum {
        mass,
        p_NScm_N: X_NB.point(p_BScm_B),
        angular: X_NB.rotation * about_cm.torque,
        linear: X_NB.rotation * about_cm.force,
    }
}

/// Columns of the momentum matrix `A`: `[angular about the centre of mass; linear]` in inertial
/// axes per unit of `[w_NB_B; v_NB_B; q̇]`.
///
/// # Source
/// [`Orin2013`](wrasse_spatial::references::Orin2013): the centroidal momentum matrix.
#[doc(alias = "centroidal momentum matrix")]
#[inline(always)]
pub fn momentum_matrix<T: Real, const J: usize>(
    M: &BaseRows<T, J>,
    R_NB: &Mat3<T>,
) -> ([SpatialMomentum<T>; 6], [SpatialMomentum<T>; J]) {
    let p_BScm_B = M.M_bb.centre_of_mass();
    let mut joints = [SpatialMomentum::zero(); J];
    for j in 0..M.count.min(J) {
        let h = M.M_bj[j].about(p_BScm_B);
        joints[j] = SpatialMomentum::new(*R_NB * h.torque, *R_NB * h.force);
    }
    // About the centre of mass a turn has no linear momentum of its own but that of the lever, and
    // a push no angular one.
    let (o, I) = (Vec3::zero(), M.M_bb.central().to_mat3());
    let turn = (*R_NB * I).transpose().rows;
    let lever = (*R_NB * M.M_bb.first_moment.skew()).transpose().rows;
    let push = R_NB.scaled(M.M_bb.mass).transpose().rows;
    let base = [
        SpatialMomentum::new(turn[0], -lever[0]),
        SpatialMomentum::new(turn[1], -lever[1]),
        SpatialMomentum::new(turn[2], -lever[2]),
        SpatialMomentum::new(o, push[0]),
        SpatialMomentum::new(o, push[1]),
        SpatialMomentum::new(o, push[2]),
    ];
    (base, joints)
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
    let h_Bo_B = h_Scm_B.about(-M.M_bb.centre_of_mass());
    M.M_bb.velocity_of(&(h_Bo_B - M.momentum_of_rates(qdot)))
}

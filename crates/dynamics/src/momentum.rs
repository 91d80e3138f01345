//! Momentum: summed over the bodies, per unit rate, and backwards to the base's twist.

use crate::{Kinematics, MassMatrix};
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
pub fn momentum<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> Momentum<T> {
    let (mass, p_NScm_N) = k.centre_of_mass();
    let (mut angular, mut linear) = (Vec3::zero(), Vec3::zero());
    for body in k.robot.bodies() {
        let X_NB = &k.X_NB(body);
        let h_B = *k.robot.inertia(body) * k.V_NB_B(body);
        let force = X_NB.rotation * h_B.force;
        linear += force;
        angular += X_NB.rotation * h_B.torque + (X_NB.translation - p_NScm_N).cross(force);
    }
    Momentum { mass, p_NScm_N, angular, linear }
}

/// Columns of the momentum matrix `A`: `[angular about the centre of mass; linear]` in inertial
/// axes per unit of `[w_NB_B; v_NB_B; q̇]`.
///
/// # Source
/// [`Orin2013`](wrasse_spatial::references::Orin2013): the centroidal momentum matrix.
#[doc(alias = "centroidal momentum matrix")]
pub fn momentum_matrix<T: Real, const J: usize>(
    M: &MassMatrix<T, J>,
    R_NB: &Mat3<T>,
) -> ([SpatialMomentum<T>; 6], [SpatialMomentum<T>; J]) {
    let p_BScm_B = M.M_bb.centre_of_mass();
    let to_N = |h_B: SpatialMomentum<T>| {
        let about_cm = h_B.about(p_BScm_B);
        SpatialMomentum::new(*R_NB * about_cm.torque, *R_NB * about_cm.force)
    };
    let unit = |c: usize| {
        SpatialVelocity::from_array(core::array::from_fn(|i| {
            T::from_f64(f64::from(u8::from(i == c)))
        }))
    };
    (core::array::from_fn(|c| to_N(M.M_bb * unit(c))), M.M_bj.map(to_N))
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
    M: &MassMatrix<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
    qdot: &[T; J],
) -> SpatialVelocity<T> {
    let h_Bo_B = h_Scm_B.about(-M.M_bb.centre_of_mass());
    M.M_bb.velocity_of(&(h_Bo_B - M.momentum_of_rates(qdot)))
}

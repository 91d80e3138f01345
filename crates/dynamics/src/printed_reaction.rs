//! Equations (3) and (4) of the paper as printed, kept for comparison. The exact quantities are in
//! `reaction.rs`.

use crate::jacobian::accelerations;
use crate::{BodyId, GeneralizedVelocity, Kinematics};
use wrasse_spatial::{Real, Vec3};

/// The reaction moment of one arm as the paper prints it, inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintedReaction<T> {
    /// `F_T = Σ m a_c` over the arm (N), eq. (4): exact without a force at the tip.
    pub F_T: Vec3<T>,
    /// `N_T = Σ (I ẇ + w × I w)` over the arm's links (N·m), eq. (4).
    pub N_T: Vec3<T>,
    /// Eq. (3), reading `p*_cm` as the centre of mass of the arm and its payload (N·m).
    pub N_r_arm_cm: Vec3<T>,
    /// Eq. (3), reading `p*_cm` as the centre of mass of the whole system (N·m).
    pub N_r_system_cm: Vec3<T>,
}

/// Eqs (3)–(4) as printed, with `R0 s0`, for the arm that joint `root` mounts on the base.
///
/// Lumping `F_T` at one point leaves out `Σ m (r_c - p_a) × (a_c - a_a)`; the moment is about the
/// mount, and the attitude control also needs `R0 s0 × F_T`.
///
/// # Source
/// [`Ellery2004`](wrasse_spatial::references::Ellery2004) eqs (3), (4).
pub fn printed_reaction<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    root: usize,
) -> PrintedReaction<T> {
    let X_NB = k.poses();
    let (mut F_T, mut N_T) = (Vec3::zero(), Vec3::zero());
    let (mut mass, mut moment) = (T::zero(), Vec3::zero());
    for j in k.robot.joints() {
        let body = BodyId::Link(j);
        if k.robot.chain_root(body) != Some(root) {
            continue;
        }
        let (M, I) = (k.robot.inertia(body), *k.robot.inertia_of_parts(body));
        let (X_NB, (w, A)) = (&X_NB[body], accelerations(k, nudot, body));
        let R = k.posture.pose_of(k.robot, body).rotation;
        let turned = |v| R.transpose_mul(v);
        let (w, wdot, a) = (turned(w), turned(A.angular), turned(A.linear));
        // m times the acceleration of Bcm, from m and the first moment alone.
        let h = M.first_moment;
        let m_a = a * M.mass + wdot.cross(h) + w.cross(w.cross(h));
        F_T += X_NB.rotation * m_a;
        N_T += X_NB.rotation * (I * wdot + w.cross(I * w));
        mass += M.mass;
        moment += X_NB.translation * M.mass + X_NB.rotation * h;
    }
    let mount = k.joint_origin(root);
    let lumped_at = |p_cm: Vec3<T>| N_T + (p_cm - mount).cross(F_T);
    PrintedReaction {
        F_T,
        N_T,
        N_r_arm_cm: lumped_at(moment * (T::one() / mass)),
        N_r_system_cm: lumped_at(k.centre_of_mass().1),
    }
}

//! Barycentric vectors λ, and the virtual manipulator that they build.

use crate::{Frame, Kinematics, PerBody};
use wrasse_spatial::{Real, Vec3};

/// Vectors λ of all bodies for one frame: `p_NE = p_NScm + Σ R_NB λ_B`, each in its body's axes
/// (m).
///
/// `λ_B = [B on the way to the frame] l_B - (m_B r_B + Σ_children m_subtree l_child)/m_T`, with
/// `l_B` from Bo to the next joint on the way (or to the frame), `r_B` from Bo to Bcm. Bodies off
/// the way count too: the other arm moves the centre of mass. They are constant but for prismatic
/// joints, whose travel belongs to their parent's vector.
///
/// # Source
/// [`Ellery2004`](wrasse_spatial::references::Ellery2004) eqs (6)–(7), with `R0` before `s0`; the
/// tree form after [`VafaDubowsky1990`](wrasse_spatial::references::VafaDubowsky1990).
#[doc(alias = "virtual manipulator")]
pub fn barycentric_vectors<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> PerBody<Vec3<T>, J> {
    let mut subtree: PerBody<T, J> = PerBody::filled(T::zero());
    let mut lambda: PerBody<Vec3<T>, J> = PerBody::filled(Vec3::zero());
    for body in k.robot.bodies() {
        subtree[body] = k.robot.inertia(body).mass;
    }
    for j in k.robot.joints().rev() {
        let mass = subtree.links[j];
        subtree[k.robot.joint(j).parent] += mass;
    }
    let per_mass = T::one() / subtree.base;
    for body in k.robot.bodies() {
        lambda[body] -= k.robot.inertia(body).first_moment * per_mass;
    }
    for j in k.robot.joints() {
        let l = k.X_PB(j).translation;
        lambda[k.robot.joint(j).parent] -= l * (subtree.links[j] * per_mass);
    }
    // The way from the base to the frame.
    lambda[frame.body] += frame.X_BF.translation;
    for j in k.robot.path_to_base(frame.body) {
        lambda[k.robot.joint(j).parent] += k.X_PB(j).translation;
    }
    lambda
}

/// Position `p_NE_N` (m) of the frame by the virtual manipulator: a chain of the vectors λ that
/// starts at the system's centre of mass, whatever the base does.
///
/// # Source
/// [`VafaDubowsky1990`](wrasse_spatial::references::VafaDubowsky1990).
pub fn virtual_manipulator<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    lambda: &PerBody<Vec3<T>, J>,
    p_NScm_N: Vec3<T>,
) -> Vec3<T> {
    let (mut p, X_NB) = (p_NScm_N, k.poses());
    for body in k.robot.bodies() {
        p += X_NB[body].rotation * lambda[body];
    }
    p
}

//! Kinetic energy.

use crate::Kinematics;
use wrasse_spatial::Real;

/// Kinetic energy `Σ ½ V·M V` (J), summed body by body.
#[inline(always)]
pub fn kinetic_energy<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> T {
    let (mut twice, V_L) = (T::zero(), k.link_twists());
    for body in k.robot.bodies() {
        let V = V_L[body];
        twice += V.power(&(*k.robot.inertia_in_link(body) * V));
    }
    twice * T::from_f64(0.5)
}

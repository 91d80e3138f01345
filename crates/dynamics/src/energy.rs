//! Kinetic energy.

use crate::Kinematics;
use crate::composite_inertia::link_inertia;
use wrasse_spatial::{At, Group, OneByOne, Real};

/// Kinetic energy `Σ ½ V·M V` (J), summed body by body, and that of the rotors of the joints.
#[inline]
pub fn kinetic_energy<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> T {
    let (V_B, V) = (k.state.V_NB_B, k.link_twists());
    let mut twice = V_B.power(&(k.robot.bodies.base.M_F_F * V_B));
    for j in k.robot.joints() {
        let one: Group<OneByOne<T>> = Group::of(j);
        let (V, M) = (V.at(j), link_inertia(k.robot, &k.posture, one));
        let rate = k.state.v[j];
        twice += V.power(&(M * V)) + k.robot.links.rotor[j] * rate * rate;
    }
    twice * T::from_f64(0.5)
}

//! Joint dynamics with the base eliminated: free-floating, and with the attitude held.

use crate::{GeneralizedForce, MassMatrix, Robot};
use wrasse_spatial::{At, Real};

/// `τ = H q̈ + c` in the joints alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedDynamics<T, const J: usize> {
    /// Inertia (kg·m², kg·m, kg); rows and columns from the number of joints on are zero.
    pub H: [[T; J]; J],
    /// Bias force (N·m or N).
    pub c: [T; J],
}

impl<T: Real, const J: usize> ReducedDynamics<T, J> {
    /// `H q̈ + c` (N·m or N).
    #[inline(always)]
    pub fn effort(&self, robot: &Robot<T, J>, qddot: &[T; J]) -> [T; J] {
        let mut tau = self.c;
        for i in robot.joints() {
            for j in robot.joints() {
                tau[i] += self.H[i][j] * qddot[j];
            }
        }
        tau
    }
}

/// Free-floating: `H* = M_jj - M_bjᵀ M_bb⁻¹ M_bj`, `c* = c_j - M_bjᵀ M_bb⁻¹ c_b`.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989).
#[inline(always)]
pub fn free_floating_dynamics<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &MassMatrix<T, J>,
    c: &GeneralizedForce<T, J>,
) -> ReducedDynamics<T, J> {
    let mut reduced = ReducedDynamics { H: M.M_jj, c: c.joints };
    let per_M_bb = M.M_bb.inverse();
    let recoil_of_bias = per_M_bb.velocity_of(&c.base);
    for j in robot.joints() {
        let recoil = per_M_bb.velocity_of(&M.M_bj.at(j));
        for i in robot.joints() {
            reduced.H[i][j] -= recoil.power(&M.M_bj.at(i));
        }
        reduced.c[j] -= recoil_of_bias.power(&M.M_bj.at(j));
    }
    reduced
}

/// Attitude held, translation free: `H̄ = M_jj - M_vjᵀ M_vj/m_T`, `c̄ = c_j - M_vjᵀ c_v/m_T`.
#[inline(always)]
pub fn attitude_held_dynamics<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &MassMatrix<T, J>,
    c: &GeneralizedForce<T, J>,
) -> ReducedDynamics<T, J> {
    let mut reduced = ReducedDynamics { H: M.M_jj, c: c.joints };
    let per_mass = T::one() / M.M_bb.mass;
    for j in robot.joints() {
        let recoil = M.M_bj.at(j).force * per_mass;
        for i in robot.joints() {
            reduced.H[i][j] -= recoil.dot(M.M_bj.at(i).force);
        }
        reduced.c[j] -= recoil.dot(c.base.force);
    }
    reduced
}

//! What the joints' motion and the turning of the base ask of each other.

use wrasse_dynamics::{BaseRows, Configuration, Robot};
use wrasse_spatial::{At, Real, Rows, Vec3};

/// Coupling inertia of the joints: angular momentum of the system about its centre of mass for unit
/// rate of each joint, on a base that does not turn and is not held against sliding (kg·m², base axes;
/// kg·m for sliding joints).
///
/// With the locked inertia I about the centre of mass, `[I N; Nᵀ H̄] [ẇ; q̈]` are the forces of inertia
/// of base and joints, the sliding of the base taken out.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989): the matrix that multiplies
/// the joint rates in the conservation of angular momentum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CouplingInertia<T, const J: usize> {
    columns: Vec3<[T; J]>,
}

impl<T: Real, const J: usize> CouplingInertia<T, J> {
    /// No coupling at all.
    pub(crate) fn zero() -> Self {
        Self { columns: Rows::zero_rows() }
    }

    /// At joint positions `q` (rad or m).
    pub fn new(robot: &Robot<T, J>, q: &[T; J]) -> Self {
        Self::of(&Configuration::at(robot, q).base)
    }

    /// From the base's rows of the mass matrix.
    #[inline(always)]
    pub(crate) fn of(M: &BaseRows<T, J>) -> Self {
        let (p_BScm_B, mut columns) = (M.M_bb.centre_of_mass(), Vec3::zero_rows());
        for j in 0..M.count.min(J) {
            columns.put(j, M.M_bj.at(j).about(p_BScm_B).torque);
        }
        Self { columns }
    }

    /// Torque on the base that joint accelerations (rad/s², m/s²) ask for (N·m, base axes): `N q̈`.
    #[inline(always)]
    pub fn reaction(&self, qddot: &[T; J]) -> Vec3<T> {
        let each = qddot.iter().enumerate();
        each.fold(Vec3::zero(), |sum, (j, &qddot)| sum + self.columns.at(j) * qddot)
    }

    /// Torque of each joint (N·m, N) that keeps it from answering an angular acceleration of the base
    /// (rad/s², base axes): `Nᵀ ẇ`.
    #[inline(always)]
    pub fn effort(&self, wdot_NB_B: Vec3<T>) -> [T; J] {
        core::array::from_fn(|j| self.columns.at(j).dot(wdot_NB_B))
    }
}

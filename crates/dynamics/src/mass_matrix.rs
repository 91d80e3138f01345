//! The mass matrix, in the blocks that the theory names.

use crate::{BodyId, Kinematics, PerBody};
use wrasse_spatial::{Real, SpatialForce, SpatialInertia};

/// `M(q)` in blocks; rows and columns ordered `[w_NB_B; v_NB_B; q̇]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassMatrix<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Base block: inertia of the whole system, joints locked, about Bo in base axes.
    pub M_bb: SpatialInertia<T>,
    /// Columns of the coupling block: momentum about Bo, in base axes, per unit joint rate.
    pub M_bj: [SpatialForce<T>; J],
    /// Joint block; rows and columns from the number of joints on are zero.
    pub M_jj: [[T; J]; J],
}

/// Mass matrix by composite rigid bodies.
///
/// `M` is symmetric positive definite and `½ νᵀ M ν` is the kinetic energy (J).
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 6, table 6.2; ch. 9.4 for
/// the floating base.
#[doc(alias = "crba")]
pub fn mass_matrix<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> MassMatrix<T, J> {
    // Composite inertias, tip to base.
    let mut Mc_B =
        PerBody { base: *k.robot.inertia(BodyId::Base), links: [SpatialInertia::zero(); J] };
    for j in k.robot.joints() {
        Mc_B.links[j] = *k.robot.inertia(BodyId::Link(j));
    }
    for j in k.robot.joints().rev() {
        let in_parent = k.X_PB[j].inertia_to_parent(&Mc_B.links[j]);
        Mc_B[k.robot.joint(j).parent] += in_parent;
    }
    let mut M = MassMatrix {
        count: k.robot.joint_count(),
        M_bb: Mc_B.base,
        M_bj: [SpatialForce::zero(); J],
        M_jj: [[T::zero(); J]; J],
    };
    for j in k.robot.joints() {
        // Momentum of all that joint j carries, for unit rate, handed down to the base.
        let mut F = Mc_B.links[j] * k.robot.joint(j).velocity(T::one());
        M.M_jj[j][j] = k.robot.joint(j).project(&F);
        let mut at = j;
        loop {
            F = k.X_PB[at].force_to_parent(&F);
            match k.robot.joint(at).parent {
                BodyId::Base => break,
                BodyId::Link(p) => {
                    let coupling = k.robot.joint(p).project(&F);
                    M.M_jj[j][p] = coupling;
                    M.M_jj[p][j] = coupling;
                    at = p;
                }
            }
        }
        M.M_bj[j] = F;
    }
    M
}

impl<T: Real, const J: usize> MassMatrix<T, J> {
    /// `M_bj q̇`: momentum about Bo, in base axes, of the joint rates alone (N·m·s, N·s).
    #[inline(always)]
    pub fn momentum_of_rates(&self, qdot: &[T; J]) -> SpatialForce<T> {
        let mut h = SpatialForce::zero();
        for j in 0..self.count.min(J) {
            h += self.M_bj[j] * qdot[j];
        }
        h
    }
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.M_bb.to_matrix()[row][column],
            (None, Some(j)) => self.M_bj[j].to_array()[row],
            (Some(j), None) => self.M_bj[j].to_array()[column],
            (Some(i), Some(j)) => self.M_jj[i][j],
        }
    }
}

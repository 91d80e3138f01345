//! The mass matrix, in the blocks that the theory names.

use crate::robot::within;
use crate::{BodyId, Kinematics, PerBody};
use core::ops::Deref;
use wrasse_spatial::{Pose, Real, SpatialForce, SpatialInertia, Work};

/// The base's rows of `M(q)`: momentum of the whole system about Bo, in base axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseRows<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Base block: inertia of the whole system, joints locked, about Bo in base axes.
    pub M_bb: SpatialInertia<T>,
    /// Columns of the coupling block: momentum about Bo, in base axes, per unit joint rate.
    pub M_bj: [SpatialForce<T>; J],
}

/// `M(q)` in blocks; rows and columns ordered `[w_NB_B; v_NB_B; q̇]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassMatrix<T, const J: usize> {
    /// The rows of the base.
    pub base: BaseRows<T, J>,
    /// Joint block; rows and columns from the number of joints on are zero.
    pub M_jj: [[T; J]; J],
}

impl<T, const J: usize> Deref for MassMatrix<T, J> {
    type Target = BaseRows<T, J>;
    #[inline(always)]
    fn deref(&self) -> &BaseRows<T, J> {
        &self.base
    }
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
    T::apart(AllRows { k })
}

/// The base's rows alone: all that momentum needs.
pub fn base_rows<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> BaseRows<T, J> {
    T::apart(RowsOfBase { k })
}

/// The mass matrix as a piece of work.
struct AllRows<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
}

impl<T: Real, const J: usize> Work for AllRows<'_, T, J> {
    type Out = MassMatrix<T, J>;
    #[inline(always)]
    fn run(self) -> Self::Out {
        let k = self.k;
        let carried = composites(k);
        let mut M_bj = [SpatialForce::zero(); J];
        let mut M_jj = [[T::zero(); J]; J];
        for j in k.robot.joints() {
            let link = k.robot.link(j);
            let mut F = link.momentum(&carried.links[j]);
            M_jj[j][j] = link.project(&F);
            let (mut seat, mut parent) = (k.seat(j), link.parent);
            // The same momentum, as each link on the way to the base feels it.
            while let BodyId::Link(p) = parent {
                let p = within::<J>(p);
                F = seat.force_to_parent(&F);
                let coupling = k.robot.link(p).project(&F);
                M_jj[j][p] = coupling;
                M_jj[p][j] = coupling;
                (seat, parent) = (k.seat(p), k.robot.link(p).parent);
            }
            M_bj[j] = seat.force_to_parent(&F);
        }
        let base = BaseRows { count: k.robot.joint_count(), M_bb: carried.base, M_bj };
        MassMatrix { base, M_jj }
    }
}

/// The base's rows as a piece of work.
struct RowsOfBase<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
}

impl<T: Real, const J: usize> Work for RowsOfBase<'_, T, J> {
    type Out = BaseRows<T, J>;
    #[inline(always)]
    fn run(self) -> Self::Out {
        let k = self.k;
        let (carried, X_BL) = (composites(k), k.link_poses(&Pose::identity()));
        let mut M_bj = [SpatialForce::zero(); J];
        for j in k.robot.joints() {
            M_bj[j] = X_BL.links[j].force_to_parent(&k.robot.link(j).momentum(&carried.links[j]));
        }
        BaseRows { count: k.robot.joint_count(), M_bb: carried.base, M_bj }
    }
}

/// What each joint carries, joints behind it locked, in the link's axes; the base's is all.
#[inline(always)]
fn composites<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> PerBody<SpatialInertia<T>, J> {
    let mut carried = PerBody::filled(*k.robot.inertia(BodyId::Base));
    for j in k.robot.joints() {
        carried.links[j] = k.robot.link(j).M_L;
    }
    for j in k.robot.joints().rev() {
        let behind = k.seat(j).inertia_to_parent(&carried.links[j]);
        carried[k.robot.link(j).parent] += behind;
    }
    carried
}

impl<T: Real, const J: usize> BaseRows<T, J> {
    /// `M_bj q̇`: momentum about Bo, in base axes, of the joint rates alone (N·m·s, N·s).
    #[inline(always)]
    pub fn momentum_of_rates(&self, qdot: &[T; J]) -> SpatialForce<T> {
        let mut h = SpatialForce::zero();
        for j in 0..self.count.min(J) {
            h += self.M_bj[j] * qdot[j];
        }
        h
    }
}

impl<T: Real, const J: usize> MassMatrix<T, J> {
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

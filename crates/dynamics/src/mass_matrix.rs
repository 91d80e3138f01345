//! The mass matrix, in the blocks that the theory names.

use crate::robot::within;
use crate::{BodyId, Kinematics};
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
#[inline]
pub fn mass_matrix<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> MassMatrix<T, J> {
    let mut M = MassMatrix::nothing(k.robot.joint_count());
    T::apart(AllRows { k, M: &mut M });
    M
}

/// The base's rows alone: all that momentum needs.
#[inline]
pub fn base_rows<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> BaseRows<T, J> {
    let mut rows = BaseRows::nothing(k.robot.joint_count());
    T::apart(RowsOfBase { k, rows: &mut rows });
    rows
}

/// The mass matrix as a piece of work, into a place that is zero.
struct AllRows<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
    M: &'a mut MassMatrix<T, J>,
}

impl<T: Real, const J: usize> Work for AllRows<'_, T, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let Self { k, M } = self;
        let mut carried = [SpatialInertia::zero(); J];
        M.base.M_bb = compose(k, &mut carried);
        for j in k.robot.joints() {
            let link = k.robot.link(j);
            let mut F = link.momentum(&carried[j]);
            M.M_jj[j][j] = link.project(&F);
            let (mut seat, mut parent) = (k.seat(j), link.parent);
            // The same momentum, as each link on the way to the base feels it.
            while let BodyId::Link(p) = parent {
                let p = within::<J>(p);
                F = seat.force_to_parent(&F);
                let coupling = k.robot.link(p).project(&F);
                M.M_jj[j][p] = coupling;
                M.M_jj[p][j] = coupling;
                (seat, parent) = (k.seat(p), k.robot.link(p).parent);
            }
            M.base.M_bj[j] = seat.force_to_parent(&F);
        }
    }
}

/// The base's rows as a piece of work, into a place that is zero.
struct RowsOfBase<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
    rows: &'a mut BaseRows<T, J>,
}

impl<T: Real, const J: usize> Work for RowsOfBase<'_, T, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let Self { k, rows } = self;
        let mut carried = [SpatialInertia::zero(); J];
        rows.M_bb = compose(k, &mut carried);
        let base = Pose::identity();
        let mut X_BL = [base; J];
        for j in k.robot.joints() {
            let link = k.robot.link(j);
            X_BL[j] = k.seat(j).pose(link.parent.of(&base, &X_BL));
            rows.M_bj[j] = X_BL[j].force_to_parent(&link.momentum(&carried[j]));
        }
    }
}

/// What each joint carries, joints behind it locked, in the link's axes, into a place that is zero;
/// what the base does with all is returned.
#[inline(always)]
fn compose<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    carried: &mut [SpatialInertia<T>; J],
) -> SpatialInertia<T> {
    let mut all = *k.robot.inertia(BodyId::Base);
    for j in k.robot.joints().rev() {
        let link = k.robot.link(j);
        carried[j] += link.M_L;
        let behind = k.seat(j).inertia_to_parent(&carried[j]);
        *link.parent.of_mut(&mut all, carried) += behind;
    }
    all
}

impl<T: Real, const J: usize> BaseRows<T, J> {
    /// All zero, of a robot with so many joints.
    #[inline(always)]
    fn nothing(count: usize) -> Self {
        Self { count, M_bb: SpatialInertia::zero(), M_bj: [SpatialForce::zero(); J] }
    }
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
    /// All zero, of a robot with so many joints.
    #[inline(always)]
    pub(crate) fn nothing(count: usize) -> Self {
        Self { base: BaseRows::nothing(count), M_jj: [[T::zero(); J]; J] }
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

//! The mass matrix, in the blocks that the theory names.

use crate::composite_inertia::compose_links;
use crate::{BaseRows, BodyId, CompositeInertia, Kinematics, Posture, Robot, compose};
use core::ops::Deref;
use wrasse_spatial::{At, Group, Layout, Real, SpatialForce, kernel};

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
    let mut M = MassMatrix::new();
    fill(k.robot, &k.posture, &mut CompositeInertia::new(), &mut M);
    M
}

/// The base's rows alone: all that momentum needs.
#[inline]
pub fn base_rows<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> BaseRows<T, J> {
    let mut rows = BaseRows::new();
    compose(k.robot, &k.posture, &mut CompositeInertia::new(), &mut rows);
    rows
}

kernel! {
    /// The mass matrix in a posture, into a place whose joint block is zero or of the same tree.
    pub fn fill<L, T, J>(
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        composite: &mut CompositeInertia<T, J>,
        M: &mut MassMatrix<T, J>,
    ) {
        let MassMatrix { base, M_jj } = M;
        compose_links::<L, J>(robot, posture, composite, base);
        for j in robot.joints() {
            joint_row::<L, J>(robot, base, j, M_jj);
        }
    }
}

/// `M_ij = S_iᵀ M_bj`, for a joint j and those joints i of its arm that carry it.
#[inline(always)]
fn joint_row<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    base: &BaseRows<L::One, J>,
    j: usize,
    M_jj: &mut [[L::One; J]; J],
) {
    let (arm, F) = (robot.links.arm[j], base.M_bj.at(j));
    let F = SpatialForce::new(L::all3(F.torque), L::all3(F.force));
    let (above, row) = M_jj.split_at_mut(j);
    let Some(row) = row.first_mut() else { return };
    let first: Group<L> = Group::of(arm.first);
    let mut i = first;
    while i.first() <= j {
        row.put(i, base.S.at(i).power(&F));
        i = i.next();
    }
    // Groups reach over the ends of the arm, into others.
    let end = i.first().min(robot.joint_count());
    if first.first() < arm.first || arm.end < end {
        for i in (first.first()..arm.first).chain(arm.end..end) {
            row.put(i, L::One::zero());
        }
    }
    if robot.links.forked[j] {
        robot.leave_way_to(j, row);
    }
    for (i, other) in above.iter_mut().enumerate().skip(arm.first) {
        other[j] = row[i];
    }
}

impl<T: Real, const J: usize> Robot<T, J> {
    /// Leave of a row only what stands at the joints that carry joint `j`.
    fn leave_way_to(&self, j: usize, row: &mut [T; J]) {
        let way = self.way_to(BodyId::Link(j));
        for i in 0..j {
            row[i] *= way[i];
        }
    }
}

impl<T: Real, const J: usize> MassMatrix<T, J> {
    /// All zero.
    #[inline(always)]
    pub fn new() -> Self {
        Self { base: BaseRows::new(), M_jj: [[T::zero(); J]; J] }
    }
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.M_bb.to_matrix()[row][column],
            (None, Some(j)) => self.M_bj.at(j).to_array()[row],
            (Some(j), None) => self.M_bj.at(j).to_array()[column],
            (Some(i), Some(j)) => self.M_jj[i][j],
        }
    }
}

impl<T: Real, const J: usize> Default for MassMatrix<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

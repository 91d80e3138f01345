//! The mass matrix, in the blocks that the theory names.

use crate::composite_inertia::compose_links;
use crate::robot::within;
use crate::{BaseRows, BodyId, CompositeInertia, Kinematics, Posture, Robot, compose};
use core::ops::Deref;
use wrasse_spatial::{At, Group, Layout, Real, SpatialForce, groups, kernel};

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
            lower_row::<L, J>(robot, base, j, M_jj);
        }
        for rows in groups::<L, J>(robot.joint_count()) {
            mirror::<L, J>(robot, rows, M_jj);
        }
    }
}

/// `M_ij = S_iᵀ M_bj`, for a joint j and those joints i of its arm that carry it. The group of j itself
/// reaches over it, into what [`mirror`] fills.
#[inline(always)]
fn lower_row<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    base: &BaseRows<L::One, J>,
    j: usize,
    M_jj: &mut [[L::One; J]; J],
) {
    let j = within::<J>(j);
    let (arm, F, row) = (robot.links.arm[j], base.M_bj.at(j), &mut M_jj[j]);
    let F = SpatialForce::new(L::all3(F.torque), L::all3(F.force));
    let first: Group<L> = Group::of(arm.first);
    let mut i = first;
    while i.first() <= j {
        row.put(i, base.S.at(i).power(&F));
        i = i.next();
    }
    // The first group may begin in the arm before.
    for i in first.first()..arm.first {
        row[within::<J>(i)] = L::One::zero();
    }
    row[j] += robot.links.rotor[j];
    if robot.links.forked[j] {
        robot.leave_way_to(j, row);
    }
}

/// The columns of a group of joints from their rows.
#[inline(always)]
fn mirror<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    rows: Group<L>,
    M_jj: &mut [[L::One; J]; J],
) {
    let first = within::<J>(rows.first());
    for columns in rows.from(Group::of(robot.links.arm[first].first)) {
        let mut square = L::square(L::Some::zero());
        for r in 0..L::LINKS {
            square[r] = M_jj[within::<J>(first + r)].at(columns);
        }
        let square = L::transpose(square);
        for c in 0..L::LINKS {
            M_jj[within::<J>(columns.first() + c)].put(rows, square[c]);
        }
    }
    for r in 0..L::LINKS {
        for c in 0..r {
            let (r, c) = (within::<J>(first + r), within::<J>(first + c));
            M_jj[c][r] = M_jj[r][c];
        }
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

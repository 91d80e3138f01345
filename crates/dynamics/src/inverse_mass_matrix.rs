//! The inverse of the mass matrix: accelerations per unit force.

use crate::{BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, MassMatrix, Robot};
use core::array;
use core::cmp::Ordering;
use core::ops::Range;
use wrasse_spatial::{Real, SpatialVelocity};

/// `M⁻¹` in the blocks of [`MassMatrix`]; symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseMassMatrix<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Columns of the base block: the base's acceleration per unit wrench on it, torque first.
    pub A_bb: [SpatialVelocity<T>; 6],
    /// Columns of the coupling block: the base's acceleration per unit force of each joint.
    pub A_bj: [SpatialVelocity<T>; J],
    /// Joint block; rows and columns from the number of joints on are zero.
    pub A_jj: [[T; J]; J],
}

/// Inverse of the mass matrix: arm by arm with the base held, then the base with what hangs on it.
///
/// No branch is taken on a value: a mass matrix that is not positive definite gives numbers without
/// meaning.
///
/// # Source
/// [`GolubVanLoan2013`](wrasse_spatial::references::GolubVanLoan2013) ch. 4.1 (`L D Lᵀ`).
pub fn inverse_mass_matrix<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &MassMatrix<T, J>,
) -> InverseMassMatrix<T, J> {
    let mut found = InverseMassMatrix::nothing();
    Elimination::new(robot, M).inverse_into(&mut found);
    found
}

/// The mass matrix, eliminated: arms first, the base last. Joints stand in another order here, arm
/// after arm: they have *places*.
pub(crate) struct Elimination<T, const J: usize> {
    count: usize,
    /// Joint in each place.
    joints: [usize; J],
    /// Places of the arm of the joint in each place.
    arms: [Span; J],
    /// `M_jj⁻¹`: accelerations per unit force while the base is held. Zero between arms.
    held: [[T; J]; J],
    /// `Z = M_bj M_jj⁻¹`: wrench that then holds the base, per unit force of each joint.
    Z: [[T; 6]; J],
    /// `(M_bb - Z M_bjᵀ)⁻¹`: the base block of the inverse.
    A_bb: [[T; 6]; 6],
}

/// Places from the first to the one after the last.
#[derive(Clone, Copy, PartialEq)]
struct Span {
    first: usize,
    end: usize,
}

impl Span {
    #[inline(always)]
    fn of<'a, E>(&self, places: &'a [E]) -> &'a [E] {
        &places[self.first..self.end]
    }
}

/// Joint in each place, and the places of its arm.
#[inline(always)]
fn places<T: Real, const J: usize>(robot: &Robot<T, J>) -> ([usize; J], [Span; J]) {
    let (mut joints, mut arms) = ([0; J], [Span { first: 0, end: 0 }; J]);
    let (mut roots, mut end) = ([0; J], 0);
    for j in robot.joints() {
        roots[j] = match robot.joint(j).parent {
            BodyId::Base => j,
            BodyId::Link(p) => roots[p],
        };
    }
    for root in robot.joints().filter(|&j| robot.joint(j).parent == BodyId::Base) {
        let first = end;
        for j in robot.joints().filter(|&j| roots[j] == root) {
            joints[end] = j;
            end += 1;
        }
        arms[first..end].fill(Span { first, end });
    }
    (joints, arms)
}

impl<T: Real, const J: usize> Elimination<T, J> {
    #[inline(always)]
    pub(crate) fn new(robot: &Robot<T, J>, M: &MassMatrix<T, J>) -> Self {
        let (count, (joints, arms)) = (M.count.min(J), places(robot));
        // 1. Each arm by itself, the base held.
        let mut M_jj = [[T::zero(); J]; J];
        for a in 0..count {
            for b in arms[a].first..arms[a].end {
                M_jj[a][b] = M.M_jj[joints[a]][joints[b]];
            }
        }
        let held = inverse(&M_jj, count, |a| arms[a]);
        // 2. What that takes from the base, and the base with what is left.
        let columns = joints.map(|j| M.M_bj[j].to_array());
        let mut Z = [[T::zero(); 6]; J];
        let mut left = M.M_bb.to_matrix();
        for a in 0..count {
            for (column, x) in arms[a].of(&columns).iter().zip(arms[a].of(&held[a])) {
                take(&mut Z[a], -*x, column);
            }
            for r in 0..6 {
                take(&mut left[r], Z[a][r], &columns[a]);
            }
        }
        let A_bb = inverse(&left, 6, |_| Span { first: 0, end: 6 });
        Self { count, joints, arms, held, Z, A_bb }
    }
    /// The whole inverse, into a place that is zero: `A_bj = -A_bb Z`, `A_jj = M_jj⁻¹ - Zᵀ A_bj`.
    #[inline(always)]
    pub(crate) fn inverse_into(&self, found: &mut InverseMassMatrix<T, J>) {
        found.count = self.count;
        for (column, six) in found.A_bb.iter_mut().zip(&self.A_bb) {
            *column = SpatialVelocity::from_array(*six);
        }
        for a in 0..self.count {
            let j = self.joints[a];
            let mut column = [T::zero(); 6];
            for c in 0..6 {
                take(&mut column, self.Z[a][c], &self.A_bb[c]);
            }
            found.A_bj[j] = SpatialVelocity::from_array(column);
            for b in 0..=a {
                let i = self.joints[b];
                let mut sum = self.held[a][b];
                for r in 0..6 {
                    sum -= self.Z[b][r] * column[r];
                }
                found.A_jj[i][j] = sum;
                found.A_jj[j][i] = sum;
            }
        }
    }
    /// Joint in each place.
    #[inline(always)]
    pub(crate) fn joints(&self) -> &[usize] {
        &self.joints[..self.count]
    }
    /// Places of the arm of the joint in a place.
    #[inline(always)]
    pub(crate) fn arm(&self, place: usize) -> Range<usize> {
        self.arms[place].first..self.arms[place].end
    }
    /// `-M⁻¹ F` of some columns, rows by place. Where a place is given, the columns are zero in all
    /// joints that are not of its arm, and what stands there is not read.
    #[inline(always)]
    pub(crate) fn give_way<const W: usize>(
        &self,
        F: &Rows<T, J, W>,
        place: Option<usize>,
        found: &mut Rows<T, J, W>,
    ) {
        let span = place.map_or(Span { first: 0, end: self.count }, |a| self.arms[a]);
        let mut wrench = F.base;
        for (z, row) in span.of(&self.Z).iter().zip(span.of(&F.joints)) {
            for r in 0..6 {
                take(&mut wrench[r], z[r], row);
            }
        }
        found.base = [[T::zero(); W]; 6];
        for c in 0..6 {
            for r in 0..6 {
                take(&mut found.base[r], self.A_bb[c][r], &wrench[c]);
            }
        }
        for a in 0..self.count {
            let mut row = [T::zero(); W];
            for r in 0..6 {
                take(&mut row, self.Z[a][r], &found.base[r]);
            }
            if span.first <= a && a < span.end {
                let arm = &self.arms[a];
                for (x, other) in arm.of(&self.held[a]).iter().zip(arm.of(&F.joints)) {
                    take(&mut row, *x, other);
                }
            }
            found.joints[a] = row;
        }
    }
}

/// Rows of `W` columns, side by side.
pub(crate) struct Rows<T, const J: usize, const W: usize> {
    pub(crate) base: [[T; W]; 6],
    pub(crate) joints: [[T; W]; J],
}

impl<T: Real, const J: usize, const W: usize> Rows<T, J, W> {
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self { base: [[T::zero(); W]; 6], joints: [[T::zero(); W]; J] }
    }
    /// The base's six of each column.
    #[inline(always)]
    pub(crate) fn set_base(&mut self, columns: [[T; 6]; W]) {
        for r in 0..6 {
            self.base[r] = columns.map(|six| six[r]);
        }
    }
    #[inline(always)]
    pub(crate) fn base_column(&self, column: usize) -> SpatialVelocity<T> {
        SpatialVelocity::from_array(self.base.map(|row| row[column]))
    }
}

/// `row -= s x`.
#[inline(always)]
fn take<T: Real, const W: usize>(row: &mut [T; W], s: T, x: &[T; W]) {
    for c in 0..W {
        row[c] -= s * x[c];
    }
}

impl<T: Real, const J: usize> InverseMassMatrix<T, J> {
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        Self {
            count: 0,
            A_bb: [SpatialVelocity::zero(); 6],
            A_bj: [SpatialVelocity::zero(); J],
            A_jj: [[T::zero(); J]; J],
        }
    }
    /// `M⁻¹ force`.
    #[inline(always)]
    pub fn times(&self, force: &GeneralizedForce<T, J>) -> GeneralizedVelocity<T, J> {
        let n = self.count.min(J);
        let mut found = Generalized { base: SpatialVelocity::zero(), joints: [T::zero(); J] };
        let six = force.base.to_array();
        for c in 0..6 {
            found.base += self.A_bb[c] * six[c];
        }
        for j in 0..n {
            found.base += self.A_bj[j] * force.joints[j];
            found.joints[j] = self.A_bj[j].power(&force.base);
            for i in 0..n {
                found.joints[j] += self.A_jj[j][i] * force.joints[i];
            }
        }
        found
    }
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.A_bb[column].to_array()[row],
            (None, Some(j)) => self.A_bj[j].to_array()[row],
            (Some(j), None) => self.A_bj[j].to_array()[column],
            (Some(i), Some(j)) => self.A_jj[i][j],
        }
    }
}

/// Inverse of a symmetric matrix of blocks along its diagonal, the rest of which is zero; `block`
/// gives that of each row.
#[inline(always)]
fn inverse<T: Real, const N: usize>(
    H: &[[T; N]; N],
    n: usize,
    block: impl Fn(usize) -> Span,
) -> [[T; N]; N] {
    // H = L U with U = D Lᵀ, X = L⁻¹; H⁻¹ is the sum of x xᵀ/d over the rows x of X. Row by row X takes
    // the place of H, and U is in what is left. Whole rows, zeros too: their length is known when this
    // is compiled.
    let (mut rest, mut found) = (*H, [[T::zero(); N]; N]);
    for k in 0..n.min(N) {
        let u = rest[k];
        let per_pivot = T::one() / u[k];
        for row in &mut rest[k + 1..block(k).end.min(N)] {
            let l = row[k] * per_pivot;
            take(row, l, &u);
            row[k] = -l;
        }
        let x: [T; N] = array::from_fn(|c| match c.cmp(&k) {
            Ordering::Less => u[c],
            Ordering::Equal => T::one(),
            Ordering::Greater => T::zero(),
        });
        let reached = block(k).first..=k;
        for (row, s) in found[reached.clone()].iter_mut().zip(&x[reached]) {
            take(row, -(*s * per_pivot), &x);
        }
    }
    found
}

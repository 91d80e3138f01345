//! The mass matrix factorized, arms first and the base last.
//!
//! In base axes the joints' block of the mass matrix falls apart into one block for each arm: arms feel
//! each other through the base alone.

use crate::{BaseMode, BaseRows, BodyId, GeneralizedForce, Robot};
use wrasse_spatial::{
    At, Group, Layout, Mat3, Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3, vec3,
};

/// A row with the base's six columns, angular first; then what forces the row, and a place without use.
type Line<T> = [T; 8];

/// Where in a line its force stands.
const FORCE: usize = 6;

/// `L D Lᵀ` of the arms' blocks, `L⁻¹ [M_jb | τ]`, and what that leaves of the base's block.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 6.4, the zeros that
/// branches cause; [`GolubVanLoan2013`](wrasse_spatial::references::GolubVanLoan2013) ch. 4.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factorization<T, const J: usize> {
    /// `factor[j][i] = L_ij` below the diagonal, and the same times the pivots, `column[j][i] = L_ij D_j`.
    factor: [[T; J]; J],
    column: [[T; J]; J],
    per_pivot: [T; J],
    /// `L⁻¹ [M_jb | τ]`.
    lines: [Line<T>; J],
    /// The base with all joints giving way: what it resists with, and what is left to push it.
    base: BaseBlock<T>,
    push: SpatialForce<T>,
}

/// Columns of a right-hand side or of a solution, in rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Columns<T, const J: usize, const W: usize> {
    pub(crate) base: [[T; W]; 6],
    pub(crate) joints: [[T; W]; J],
}

impl<T: Real, const J: usize> Factorization<T, J> {
    /// Room for one.
    #[inline(always)]
    pub fn new() -> Self {
        let (none, zero) = ([[T::zero(); J]; J], T::zero());
        Self {
            factor: none,
            column: none,
            per_pivot: [zero; J],
            lines: [[zero; 8]; J],
            base: BaseBlock::new(&[[zero; 8]; 6]),
            push: SpatialForce::zero(),
        }
    }

    /// Eliminate the joints, arm by arm, together with a force. Joints that are not `free` (0, not 1)
    /// are held: their rows and columns drop out.
    #[inline(always)]
    pub(crate) fn eliminate<L: Layout<One = T>>(
        &mut self,
        robot: &Robot<T, J>,
        M: &BaseRows<T, J>,
        free: &[T; J],
        force: &GeneralizedForce<T, J>,
    ) {
        for j in robot.joints() {
            self.eliminate_joint::<L>(robot, M, free, j);
            let line = line(M.M_bj.at(j), force.joints.at(j));
            let mut line = InRegisters::<L>::load(&line).times(free.at(j));
            for k in robot.links.arm[j].first..j {
                line.take(self.factor[k][j], &InRegisters::load(&self.lines[k]), 0);
            }
            line.store(&mut self.lines[j]);
        }
        let mut base = base_lines(&M.M_bb, &force.base);
        let [a, b, c, d, e, f] = &base;
        let load = InRegisters::<L>::load;
        let mut rows = [load(a), load(b), load(c), load(d), load(e), load(f)];
        for j in robot.joints() {
            let line = &self.lines[j];
            let scaled = InRegisters::load(line).times(self.per_pivot[j]);
            for c in 0..6 {
                rows[c].take(line[c], &scaled, c);
            }
        }
        for c in 0..6 {
            rows[c].store(&mut base[c]);
        }
        self.base = BaseBlock::new(&base);
        self.push = SpatialForce::from_array(base.map(|row| row[FORCE]));
    }

    /// The column of a joint below its diagonal, and its pivot.
    #[inline(always)]
    fn eliminate_joint<L: Layout<One = T>>(
        &mut self,
        robot: &Robot<T, J>,
        M: &BaseRows<T, J>,
        free: &[T; J],
        j: usize,
    ) {
        let (arm, forked) = (robot.links.arm[j], robot.links.forked[j]);
        let carried = if forked { robot.carried_by(j, free) } else { [T::zero(); J] };
        let kept = if forked { &carried } else { free };
        let (S, free_j) = (M.S.at(j), L::all(free.at(j)));
        let S = SpatialVelocity::new(L::all3(S.angular), L::all3(S.linear));
        // Groups begin before j and end behind the arm: what they hold there is never read.
        let mut i: Group<L> = Group::of(j);
        while i.first() < arm.end {
            let mut column = S.power(&M.M_bj.at(i)) * (kept.at(i) * free_j);
            for k in arm.first..j {
                column -= self.factor[k].at(i) * L::all(self.column[k][j]);
            }
            self.column[j].put(i, column);
            i = i.next();
        }
        self.column[j][j] += robot.links.rotor[j];
        let held = free.at(j).lt(T::from_f64(0.5));
        self.per_pivot[j] = T::select(held, T::zero(), T::one() / self.column[j][j]);
        let mut i: Group<L> = Group::of(j);
        while i.first() < arm.end {
            let column = self.column[j].at(i);
            self.factor[j].put(i, column * L::all(self.per_pivot[j]));
            i = i.next();
        }
    }

    /// Accelerations that the force causes which was eliminated; those of joints that are held are
    /// zero. And what holds the base, about Bo in base axes (N·m, N).
    #[inline(always)]
    pub(crate) fn accelerations(
        &self,
        robot: &Robot<T, J>,
        mode: BaseMode,
        qddot: &mut [T; J],
    ) -> (SpatialVelocity<T>, SpatialForce<T>) {
        let (A, holding) = match mode {
            BaseMode::Free => (self.base.solve(&self.push), SpatialForce::zero()),
            BaseMode::AttitudeHeld => self.base.hold_attitude(&self.push),
            BaseMode::Fixed => (SpatialVelocity::zero(), -self.push),
        };
        for j in robot.joints().rev() {
            let [a, b, c, d, e, f, force, _] = self.lines[j];
            let (w, v) = (A.angular, A.linear);
            let left = force - ((a * w.x + b * w.y + c * w.z) + (d * v.x + e * v.y + f * v.z));
            let mut x = left * self.per_pivot[j];
            for i in (j + 1..robot.links.arm[j].end).rev() {
                x -= self.factor[j][i] * qddot[i];
            }
            qddot[j] = x;
        }
        (A, holding)
    }

    /// The base's acceleration for a wrench on it, all joints giving way.
    #[inline(always)]
    pub(crate) fn push_base(&self, F: &SpatialForce<T>) -> SpatialVelocity<T> {
        self.base.solve(F)
    }

    /// `M⁻¹ F` of some columns.
    #[inline(always)]
    pub(crate) fn solve<const W: usize>(
        &self,
        robot: &Robot<T, J>,
        F: &Columns<T, J, W>,
        found: &mut Columns<T, J, W>,
    ) {
        let mut push = F.base;
        for j in robot.joints() {
            let mut y = F.joints[j];
            for k in robot.links.arm[j].first..j {
                take(&mut y, self.factor[k][j], &found.joints[k]);
            }
            for (row, c) in push.iter_mut().zip(&self.lines[j]) {
                take(row, *c * self.per_pivot[j], &y);
            }
            found.joints[j] = y;
        }
        for c in 0..W {
            let A = self.base.solve(&SpatialForce::from_array(push.map(|row| row[c])));
            for (row, x) in found.base.iter_mut().zip(A.to_array()) {
                row[c] = x;
            }
        }
        for j in robot.joints().rev() {
            let mut x = found.joints[j];
            for (row, c) in found.base.iter().zip(&self.lines[j]) {
                take(&mut x, *c, row);
            }
            x = x.map(|x| x * self.per_pivot[j]);
            for i in (j + 1..robot.links.arm[j].end).rev() {
                take(&mut x, self.factor[j][i], &found.joints[i]);
            }
            found.joints[j] = x;
        }
    }
}

impl<T: Real, const J: usize, const W: usize> Columns<T, J, W> {
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self { base: [[T::zero(); W]; 6], joints: [[T::zero(); W]; J] }
    }
    /// The base's six of each column.
    #[inline(always)]
    pub(crate) fn set_base(&mut self, columns: [SpatialForce<T>; W]) {
        for (c, six) in columns.iter().enumerate() {
            for (row, x) in self.base.iter_mut().zip(six.to_array()) {
                row[c] = x;
            }
        }
    }
    /// The base's six of one column.
    #[inline(always)]
    pub(crate) fn base_column(&self, column: usize) -> SpatialVelocity<T> {
        SpatialVelocity::from_array(self.base.map(|row| row[column]))
    }
}

impl<T: Real, const J: usize> Robot<T, J> {
    /// A row, zero for the links of an arm that joint `j` does not carry.
    fn carried_by(&self, j: usize, row: &[T; J]) -> [T; J] {
        let (mut carried, mut kept) = ([false; J], [T::zero(); J]);
        for i in j..self.links.arm[j].end.min(J) {
            let by_parent = match self.links.parent[i] {
                BodyId::Link(p) if p >= j => carried[p],
                _ => false,
            };
            carried[i] = i == j || by_parent;
            kept[i] = if carried[i] { row[i] } else { T::zero() };
        }
        kept
    }
}

#[inline(always)]
fn line<T: Real>(h: SpatialForce<T>, force: T) -> Line<T> {
    let [a, b, c, d, e, f] = h.to_array();
    [a, b, c, d, e, f, force, T::zero()]
}

/// A line in the registers of a layout.
#[derive(Clone, Copy)]
struct InRegisters<L: Layout>(L::Eight);

impl<L: Layout> InRegisters<L> {
    const GROUPS: usize = 8 / L::LINKS;

    #[inline(always)]
    fn load(line: &Line<L::One>) -> Self {
        let mut groups = L::eight(L::Some::zero());
        for g in 0..Self::GROUPS {
            groups[g] = L::load(&line[g * L::LINKS..]);
        }
        Self(groups)
    }
    #[inline(always)]
    fn store(&self, line: &mut Line<L::One>) {
        for g in 0..Self::GROUPS {
            L::store(self.0[g], &mut line[g * L::LINKS..]);
        }
    }
    #[inline(always)]
    fn times(mut self, s: L::One) -> Self {
        for g in 0..Self::GROUPS {
            self.0[g] *= L::all(s);
        }
        self
    }
    /// `self -= s x`, from the group of a place on.
    #[inline(always)]
    fn take(&mut self, s: L::One, x: &Self, from: usize) {
        for g in from / L::LINKS..Self::GROUPS {
            self.0[g] -= L::all(s) * x.0[g];
        }
    }
}

/// `row -= s x`.
#[inline(always)]
fn take<T: Real, const W: usize>(row: &mut [T; W], s: T, x: &[T; W]) {
    for c in 0..W {
        row[c] -= s * x[c];
    }
}

/// Rows of the base's own block, and what pushes it.
#[inline(always)]
fn base_lines<T: Real>(M: &SpatialInertia<T>, push: &SpatialForce<T>) -> [Line<T>; 6] {
    let (m, h, I, o) = (M.mass, M.first_moment, M.rotational, T::zero());
    let (t, f) = (push.torque, push.force);
    [
        [I.xx, I.xy, I.xz, o, -h.z, h.y, t.x, o],
        [I.xy, I.yy, I.yz, h.z, o, -h.x, t.y, o],
        [I.xz, I.yz, I.zz, -h.y, h.x, o, t.z, o],
        [o, h.z, -h.y, m, o, o, f.x, o],
        [-h.z, o, h.x, o, m, o, f.y, o],
        [h.y, -h.x, o, o, o, m, f.z, o],
    ]
}

/// A symmetric block of six `[A B; Bᵀ C]`, its translation eliminated in closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
struct BaseBlock<T> {
    /// Rows of B.
    coupling: Mat3<T>,
    /// `B C⁻¹`.
    lever: Mat3<T>,
    per_linear: Sym3<T>,
    /// `(A - B C⁻¹ Bᵀ)⁻¹`.
    per_angular: Sym3<T>,
}

impl<T: Real> BaseBlock<T> {
    #[inline(always)]
    fn new(S: &[Line<T>; 6]) -> Self {
        let sym = |r: usize| Sym3 {
            xx: S[r][r],
            xy: S[r][r + 1],
            xz: S[r][r + 2],
            yy: S[r + 1][r + 1],
            yz: S[r + 1][r + 2],
            zz: S[r + 2][r + 2],
        };
        let B = [0, 1, 2].map(|r| vec3(S[r][3], S[r][4], S[r][5]));
        let per_linear = sym(3).inverse();
        let lever = B.map(|row| per_linear * row);
        let [x, y, z] = B;
        let [a, b, c] = lever;
        let given = Sym3 {
            xx: a.dot(x),
            xy: a.dot(y),
            xz: a.dot(z),
            yy: b.dot(y),
            yz: b.dot(z),
            zz: c.dot(z),
        };
        let per_angular = (sym(0) - given).inverse();
        Self { coupling: Mat3 { rows: B }, lever: Mat3 { rows: lever }, per_linear, per_angular }
    }
    #[inline(always)]
    fn solve(&self, F: &SpatialForce<T>) -> SpatialVelocity<T> {
        let w = self.per_angular * (F.torque - self.lever * F.force);
        let v = self.per_linear * (F.force - self.coupling.transpose_mul(w));
        SpatialVelocity::new(w, v)
    }
    /// Acceleration without a turn, and the torque that it takes.
    #[inline(always)]
    fn hold_attitude(&self, F: &SpatialForce<T>) -> (SpatialVelocity<T>, SpatialForce<T>) {
        let v = self.per_linear * F.force;
        let torque = self.coupling * v - F.torque;
        (SpatialVelocity::new(Vec3::zero(), v), SpatialForce::new(torque, Vec3::zero()))
    }
}

impl<T: Real, const J: usize> Default for Factorization<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

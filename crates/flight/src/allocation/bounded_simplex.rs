//! A small linear program with bounds, solved in fixed memory, one goal after the other.

use wrasse_spatial::Scalar;

/// Most exchanges of all goals together. Of 2000 random sets of 24 thrusters none needed more than 47
/// of the first half, and by the second half's rule alone none more than 160.
const EXCHANGES: usize = 400;

/// Variables between zero and an upper bound, tied by equations whose right side is zero.
///
/// The last `R` variables are the start: variable `C - R + r` stands in row `r` alone, with factor
/// one. All variables begin at zero, which solves the equations.
#[derive(Debug, Clone, Copy)]
pub struct BoundedSimplex<T, const R: usize, const C: usize> {
    /// The equations, solved for the variables of the basis.
    rows: [[T; C]; R],
    /// The variable that each row is solved for.
    basis: [usize; R],
    /// Largest value of each variable (–).
    upper: [T; C],
    /// Value of each variable (–).
    value: [T; C],
    place: [Place; C],
    /// Exchanges that are still allowed.
    left: usize,
    largest_pivots: bool,
}

/// Where a variable stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Basis,
    Zero,
    Upper,
    /// An earlier goal keeps it where it is.
    Locked,
}

/// What ends a step along an edge.
enum Stop {
    /// The entering variable reaches its other bound.
    Itself,
    /// The variable of this row reaches zero, or its upper bound.
    Row { row: usize, at_upper: bool },
}

/// Rows and costs are of the order of one; less than this is round-off.
fn nothing<T: Scalar>() -> T {
    T::epsilon() * T::from_f64(1e3)
}

impl<T: Scalar, const R: usize, const C: usize> BoundedSimplex<T, R, C> {
    /// The equations `rows · variables = 0` with `0 <= variables <= upper`.
    pub fn new(rows: [[T; C]; R], upper: [T; C]) -> Self {
        let mut place = [Place::Zero; C];
        place[C - R..].fill(Place::Basis);
        let basis = core::array::from_fn(|r| C - R + r);
        Self {
            rows,
            basis,
            upper,
            value: [T::zero(); C],
            place,
            left: EXCHANGES,
            largest_pivots: false,
        }
    }
    /// Of several variables that end a step at once, the one with the largest pivot leaves, not the
    /// least index (until half of the exchanges). An equation whose factors are a billionth of the
    /// others' is then kept to round-off, and not to a hundred-thousandth.
    #[must_use]
    pub fn with_largest_pivots(mut self) -> Self {
        self.largest_pivots = true;
        self
    }
    /// Value of a variable.
    pub fn value(&self, j: usize) -> T {
        self.value[j]
    }
    /// Give a variable that stands at zero more room.
    pub fn widen(&mut self, j: usize, upper: T) {
        self.upper[j] = upper.max(T::zero());
    }
    /// Least cost among all solutions. Says whether it got there within the exchanges that are left;
    /// if not, what there is is a solution all the same.
    ///
    /// # Source
    /// The largest reduced cost goes first; after half of the exchanges the least index, the rule of
    /// [`Bland1977`](wrasse_spatial::references::Bland1977), which cannot cycle.
    pub fn minimise(&mut self, cost: &[T; C]) -> bool {
        while let Some(entering) = self.entering(cost) {
            if self.left == 0 {
                return false;
            }
            self.left -= 1;
            self.enter(entering);
        }
        true
    }
    /// From now on only solutions of the least cost that has been reached: whatever is outside the
    /// basis and would cost more must stay.
    pub fn lock(&mut self, cost: &[T; C]) {
        for j in 0..C {
            if self.place[j] != Place::Basis && self.reduced(cost, j).abs() > nothing() {
                self.place[j] = Place::Locked;
            }
        }
    }
    /// A variable keeps its value from now on: it leaves the basis for one that may still move.
    pub fn freeze(&mut self, j: usize) {
        if let Some(r) = (0..R).find(|&r| self.basis[r] == j) {
            let size = |c: usize| self.rows[r][c].abs();
            let free = (0..C).filter(|&c| !matches!(self.place[c], Place::Basis | Place::Locked));
            let other = free.reduce(|best, c| if size(c) > size(best) { c } else { best });
            match other.filter(|&c| size(c) > nothing()) {
                Some(c) => self.exchange(r, c),
                // Nothing that moves reaches it.
                None => return,
            }
        }
        self.place[j] = Place::Locked;
    }
    /// The variable that is to move next, if moving any lowers the cost.
    fn entering(&self, cost: &[T; C]) -> Option<usize> {
        let reduced: [T; C] = core::array::from_fn(|j| self.reduced(cost, j));
        let mut paying = (0..C).filter(|&j| self.pays(j, reduced[j]));
        let least_index = self.left < EXCHANGES / 2;
        let first = paying.next()?;
        if least_index {
            return Some(first);
        }
        let larger = |a: usize, b: usize| if reduced[b].abs() > reduced[a].abs() { b } else { a };
        Some(paying.fold(first, larger))
    }
    /// Cost per unit of a variable, what it does to the basis included.
    fn reduced(&self, cost: &[T; C], j: usize) -> T {
        let basis = self.basis.iter().zip(&self.rows);
        basis.fold(cost[j], |sum, (&b, row)| sum - cost[b] * row[j])
    }
    /// Whether moving a variable off its bound lowers the cost.
    fn pays(&self, j: usize, reduced: T) -> bool {
        match self.place[j] {
            Place::Zero => reduced < -nothing::<T>() && self.upper[j] > T::zero(),
            Place::Upper => reduced > nothing(),
            Place::Basis | Place::Locked => false,
        }
    }
    /// Move a variable off its bound, as far as the others let it.
    fn enter(&mut self, j: usize) {
        let up = self.place[j] == Place::Zero;
        let towards = if up { T::one() } else { -T::one() };
        let (step, stop) = self.longest_step(j, towards);
        for r in 0..R {
            let b = self.basis[r];
            let moved = self.value[b] - towards * step * self.rows[r][j];
            self.value[b] = moved.max(T::zero()).min(self.upper[b]);
        }
        self.value[j] += towards * step;
        match stop {
            Stop::Itself => self.rest(j, up),
            Stop::Row { row, at_upper } => {
                self.rest(self.basis[row], at_upper);
                self.exchange(row, j);
            }
        }
    }
    /// How far a variable can move, and what stops it: among those that do, the least index, or the
    /// largest pivot.
    fn longest_step(&self, j: usize, towards: T) -> (T, Stop) {
        let (mut step, mut stop) = (self.upper[j], Stop::Itself);
        let (mut index, mut pivot) = (j, T::zero());
        for r in 0..R {
            let (slope, b) = (towards * self.rows[r][j], self.basis[r]);
            if slope.abs() <= nothing() {
                continue;
            }
            let at_upper = slope < T::zero();
            let room = if at_upper { self.upper[b] - self.value[b] } else { self.value[b] };
            let length = (room / slope.abs()).max(T::zero());
            let by_pivot = self.largest_pivots && self.left >= EXCHANGES / 2;
            let first = if by_pivot { slope.abs() > pivot } else { b < index };
            if length < step || (length == step && first) {
                (step, stop, index) = (length, Stop::Row { row: r, at_upper }, b);
                pivot = slope.abs();
            }
        }
        (step, stop)
    }
    /// A variable comes to rest at one of its bounds.
    fn rest(&mut self, j: usize, at_upper: bool) {
        self.place[j] = if at_upper { Place::Upper } else { Place::Zero };
        self.value[j] = if at_upper { self.upper[j] } else { T::zero() };
    }
    /// Solve a row for a variable, and take that variable out of the other rows.
    fn exchange(&mut self, row: usize, j: usize) {
        let per = T::one() / self.rows[row][j];
        let solved = self.rows[row].map(|x| x * per);
        for r in 0..R {
            let factor = self.rows[r][j];
            for c in 0..C {
                self.rows[r][c] -= factor * solved[c];
            }
            self.rows[r][j] = T::zero();
        }
        self.rows[row] = solved;
        self.rows[row][j] = T::one();
        self.basis[row] = j;
        self.place[j] = Place::Basis;
    }
    /// As after half of the exchanges.
    #[cfg(test)]
    pub(super) fn halfway(mut self) -> Self {
        self.left = EXCHANGES / 2 - 1;
        self
    }
    /// Exchanges made so far.
    #[cfg(test)]
    pub(super) fn exchanges(&self) -> usize {
        EXCHANGES - self.left
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_testing::largest;

    /// Maximise 3x + 2y with x + y + s = 4 w, x + 3y + t = 6 w, x ≤ 3, at the largest w up to one: the
    /// corner is (3, 1).
    fn corner(largest_y: f64) -> (BoundedSimplex<f64, 2, 7>, bool) {
        let rows = [[1.0, 1.0, 1.0, 0.0, -4.0, 1.0, 0.0], [1.0, 3.0, 0.0, 1.0, -6.0, 0.0, 1.0]];
        let mut program = BoundedSimplex::new(rows, [3.0, largest_y, 9.0, 0.5, 1.0, 0.0, 0.0]);
        let whole = program.minimise(&[0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0]);
        program.freeze(4);
        let best = program.minimise(&[-3.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        (program, whole && best)
    }

    #[test]
    fn a_right_side_is_a_variable_that_is_frozen_at_its_bound() {
        let (program, best) = corner(9.0);
        assert!(best);
        // Small whole numbers. Measured 0.
        let off = [3.0, 1.0, 0.0, 0.0, 1.0].iter().enumerate();
        let off = largest(off.map(|(j, x)| (x - program.value(j)).abs()));
        assert!(off < 1e-14, "{off:e}");
    }

    /// The difference of the equations is 2w = 2y + t - s: at most 0.2 + 0.5.
    #[test]
    fn a_right_side_that_cannot_be_met_is_met_in_part() {
        let (program, best) = corner(0.1);
        assert!(best && (program.value(4) - 0.35).abs() < 1e-14, "{}", program.value(4));
    }

    #[test]
    fn a_variable_may_go_from_bound_to_bound_without_entering_the_basis() {
        let mut program = BoundedSimplex::new([[1.0, -1.0, 1.0]], [1.0, 5.0, 0.0]);
        assert!(program.minimise(&[-1.0, 0.0, 0.0]));
        assert_eq!([program.value(0), program.value(1)], [1.0, 1.0]);
    }
}

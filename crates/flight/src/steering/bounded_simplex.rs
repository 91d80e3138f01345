//! A small linear program with bounds, solved in fixed memory, one goal after the other.

use wrasse_spatial::Scalar;

/// Most exchanges of all goals together: a random set of 24 thrusters has needed 71.
const EXCHANGES: usize = 400;

/// Variables between zero and an upper bound, tied by equations whose right side is zero.
///
/// The last `R` variables are the start: variable `C - R + r` stands in row `r` alone, with factor
/// one. All variables begin at zero, which solves the equations.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoundedSimplex<T, const R: usize, const C: usize> {
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
    pub(super) fn new(rows: [[T; C]; R], upper: [T; C]) -> Self {
        let mut place = [Place::Zero; C];
        place[C - R..].fill(Place::Basis);
        let basis = core::array::from_fn(|r| C - R + r);
        Self { rows, basis, upper, value: [T::zero(); C], place, left: EXCHANGES }
    }
    /// Value of a variable.
    pub(super) fn value(&self, j: usize) -> T {
        self.value[j]
    }
    /// Widen a variable that has been held at zero so far.
    pub(super) fn widen(&mut self, j: usize, upper: T) {
        self.upper[j] = upper.max(T::zero());
        if self.place[j] == Place::Locked && self.value[j] == T::zero() {
            self.place[j] = Place::Zero;
        }
    }
    /// Least cost among all solutions that no earlier goal forbids, and from then on no other
    /// solutions. Says whether it got there within the exchanges that are left.
    ///
    /// # Source
    /// [`Bland1977`](wrasse_spatial::references::Bland1977): the rule of least index, which cannot
    /// cycle.
    pub(super) fn minimise(&mut self, cost: &[T; C]) -> bool {
        while let Some(entering) = (0..C).find(|&j| self.pays(j, self.reduced(cost, j))) {
            if self.left == 0 {
                return false;
            }
            self.left -= 1;
            self.enter(entering);
        }
        // Whatever leaves the least cost, the variables outside the basis that cost must stay.
        for j in 0..C {
            if self.place[j] != Place::Basis && self.reduced(cost, j).abs() > nothing() {
                self.place[j] = Place::Locked;
            }
        }
        true
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
    /// How far a variable can move, and what stops it: the least index among those that do.
    fn longest_step(&self, j: usize, towards: T) -> (T, Stop) {
        let (mut step, mut stop) = (self.upper[j], Stop::Itself);
        let mut index = j;
        for r in 0..R {
            let (slope, b) = (towards * self.rows[r][j], self.basis[r]);
            if slope.abs() <= nothing() {
                continue;
            }
            let at_upper = slope < T::zero();
            let room = if at_upper { self.upper[b] - self.value[b] } else { self.value[b] };
            let length = (room / slope.abs()).max(T::zero());
            if length < step || (length == step && b < index) {
                (step, stop, index) = (length, Stop::Row { row: r, at_upper }, b);
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
    /// Exchanges made so far.
    #[cfg(test)]
    fn exchanges(&self) -> usize {
        EXCHANGES - self.left
    }
}

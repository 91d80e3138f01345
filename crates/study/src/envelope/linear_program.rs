//! Small linear programs: few rows, few columns, every variable between bounds.

/// Maximise `gain · x` where `rows x = wanted` and `0 ≤ x ≤ most`.
#[derive(Debug, Clone)]
pub(crate) struct LinearProgram {
    /// One row for each equation, one column for each variable.
    pub(crate) rows: Vec<Vec<f64>>,
    /// Right-hand side.
    pub(crate) wanted: Vec<f64>,
    /// What a unit of each variable brings.
    pub(crate) gain: Vec<f64>,
    /// Upper bounds; infinite where there is none.
    pub(crate) most: Vec<f64>,
}

/// Steps after which the search is given up. Bland's rule does not cycle; this is for NaN.
const STEPS: usize = 2000;

/// Pivots and gains below this share of the largest coefficient are round-off.
const ROUND_OFF: f64 = 1e-11;

/// A basis, the tableau over it, and the values of the basic variables.
struct Tableau {
    rows: Vec<Vec<f64>>,
    basis: Vec<usize>,
    value: Vec<f64>,
    most: Vec<f64>,
    at_most: Vec<bool>,
}

impl LinearProgram {
    /// The variables of a best solution by the simplex method with bounded variables and Bland's
    /// rule; none if the equations cannot be met.
    ///
    /// # Source
    /// G. Dantzig, *Linear Programming and Extensions*, 1963, ch. 18 (bounded variables); the choice
    /// of the pivot by R. Bland, Mathematics of Operations Research 2(2), 1977.
    pub(crate) fn solve(&self) -> Option<Vec<f64>> {
        let (m, n) = (self.rows.len(), self.gain.len());
        // Phase 1: an artificial variable for each row, and none of them is wanted.
        let mut tableau = Tableau::artificial(self);
        let mut gain = vec![0.0; n];
        gain.resize(n + m, -1.0);
        tableau.improve(&gain);
        let scale = self.wanted.iter().fold(1e-300, |most: f64, b| most.max(b.abs()));
        let unmet: f64 = tableau.basic().filter(|(j, _)| *j >= n).map(|(_, x)| x).sum();
        if unmet.is_nan() || unmet > 1e-9 * scale {
            return None;
        }
        // Phase 2: the artificial ones stay at zero.
        tableau.most[n..].fill(0.0);
        let mut gain = self.gain.clone();
        gain.resize(n + m, 0.0);
        tableau.improve(&gain);
        Some(tableau.variables(n))
    }
}

impl Tableau {
    fn artificial(program: &LinearProgram) -> Self {
        let (m, n) = (program.rows.len(), program.gain.len());
        let mut rows = vec![];
        for (i, row) in program.rows.iter().enumerate() {
            // The artificial variable of a row is not negative.
            let sign = if program.wanted[i] < 0.0 { -1.0 } else { 1.0 };
            let mut all: Vec<f64> = row.iter().map(|a| sign * a).collect();
            all.extend((0..m).map(|k| if k == i { 1.0 } else { 0.0 }));
            rows.push(all);
        }
        let mut most = program.most.clone();
        most.resize(n + m, f64::INFINITY);
        Self {
            rows,
            basis: (n..n + m).collect(),
            value: program.wanted.iter().map(|b| b.abs()).collect(),
            most,
            at_most: vec![false; n + m],
        }
    }
    /// Basic variables and their values.
    fn basic(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.basis.iter().copied().zip(self.value.iter().copied())
    }
    fn variables(&self, n: usize) -> Vec<f64> {
        let mut x: Vec<f64> =
            (0..n).map(|j| if self.at_most[j] { self.most[j] } else { 0.0 }).collect();
        for (j, value) in self.basic().filter(|(j, _)| *j < n) {
            x[j] = value.max(0.0);
        }
        x
    }
    /// Pivot until no variable brings more.
    fn improve(&mut self, gain: &[f64]) {
        let least = ROUND_OFF * gain.iter().fold(0.0, |most: f64, g| most.max(g.abs()));
        for _ in 0..STEPS {
            let Some((enters, way)) = self.entering(gain, least) else { return };
            if !self.step(enters, way) {
                return;
            }
        }
    }
    /// The first variable that brings more when it moves off its bound, and which way it moves.
    fn entering(&self, gain: &[f64], least: f64) -> Option<(usize, f64)> {
        for j in 0..self.most.len() {
            if self.basis.contains(&j) || self.most[j] <= 0.0 {
                continue;
            }
            let tied: f64 =
                self.rows.iter().zip(&self.basis).map(|(row, &k)| gain[k] * row[j]).sum();
            let way = if self.at_most[j] { -1.0 } else { 1.0 };
            if way * (gain[j] - tied) > least {
                return Some((j, way));
            }
        }
        None
    }
    /// Move a variable as far as bounds allow; false if nothing ever stops it.
    fn step(&mut self, enters: usize, way: f64) -> bool {
        let scale = self.rows.iter().flatten().fold(0.0, |most: f64, a| most.max(a.abs()));
        let mut far = self.most[enters];
        let mut leaves: Option<usize> = None;
        for i in 0..self.basis.len() {
            let slope = -way * self.rows[i][enters];
            if slope.abs() <= ROUND_OFF * scale {
                continue;
            }
            let room =
                if slope < 0.0 { self.value[i] } else { self.most[self.basis[i]] - self.value[i] };
            let stop = room.max(0.0) / slope.abs();
            let first = leaves.is_none_or(|k| self.basis[i] < self.basis[k]);
            if stop < far || (stop == far && leaves.is_some() && first) {
                (far, leaves) = (stop, Some(i));
            }
        }
        if !far.is_finite() {
            return false;
        }
        for i in 0..self.basis.len() {
            self.value[i] -= way * self.rows[i][enters] * far;
        }
        match leaves {
            None => self.at_most[enters] = way > 0.0,
            Some(i) => self.pivot(i, enters, way, far),
        }
        true
    }
    fn pivot(&mut self, i: usize, enters: usize, way: f64, far: f64) {
        let left = self.basis[i];
        // It left at the bound it ran into.
        self.at_most[left] = way * self.rows[i][enters] < 0.0;
        self.value[i] = if way > 0.0 { far } else { self.most[enters] - far };
        self.basis[i] = enters;
        self.at_most[enters] = false;
        let pivot = self.rows[i][enters];
        self.rows[i].iter_mut().for_each(|a| *a /= pivot);
        let row = self.rows[i].clone();
        for (k, other) in self.rows.iter_mut().enumerate() {
            let factor = other[enters];
            if k != i && factor != 0.0 {
                other.iter_mut().zip(&row).for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_with_a_known_corner_finds_it() {
        // Maximise 3x + 2y with x + y + s = 4, x + 3y + t = 6, x ≤ 3: the corner is (3, 1).
        let program = LinearProgram {
            rows: vec![vec![1.0, 1.0, 1.0, 0.0], vec![1.0, 3.0, 0.0, 1.0]],
            wanted: vec![4.0, 6.0],
            gain: vec![3.0, 2.0, 0.0, 0.0],
            most: vec![3.0, f64::INFINITY, f64::INFINITY, f64::INFINITY],
        };
        assert_eq!(program.solve().unwrap(), [3.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn what_cannot_be_met_has_no_solution() {
        let program = LinearProgram {
            rows: vec![vec![1.0, 1.0]],
            wanted: vec![-1.0],
            gain: vec![0.0, 0.0],
            most: vec![1.0, 1.0],
        };
        assert_eq!(program.solve(), None);
        let too_much = LinearProgram { wanted: vec![2.5], ..program };
        assert_eq!(too_much.solve(), None);
    }

    #[test]
    fn a_variable_may_go_from_bound_to_bound_without_entering_the_basis() {
        let program = LinearProgram {
            rows: vec![vec![1.0, -1.0]],
            wanted: vec![0.0],
            gain: vec![1.0, 0.0],
            most: vec![1.0, 5.0],
        };
        assert_eq!(program.solve().unwrap(), [1.0, 1.0]);
    }
}

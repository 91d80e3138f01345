//! The Dormand–Prince pair of orders 5 and 4.

use super::add_scaled;

/// Nodes and rows of the stages.
const NODES: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
#[rustfmt::skip]
const ROWS: [[f64; 6]; 7] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Fifth-order weights less fourth-order weights.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Places for the stages of a step.
#[derive(Debug, Clone, Default)]
pub struct DormandPrince {
    rates: [Vec<f64>; 7],
    at: Vec<f64>,
    error: Vec<f64>,
}

impl DormandPrince {
    /// For a row of `length` numbers.
    pub fn new(length: usize) -> Self {
        let row = || vec![0.0; length];
        Self { rates: std::array::from_fn(|_| row()), at: row(), error: row() }
    }
    /// A step of `h` (s): `rates(t, displacement, rate)` with `t` (s) from its start. No heap is
    /// touched.
    ///
    /// # Source
    /// [`Hairer1993`](wrasse_spatial::references::Hairer1993) ch. II.5, table 5.2.
    pub fn step(&mut self, h: f64, mut rates: impl FnMut(f64, &[f64], &mut [f64])) {
        for stage in 0..7 {
            self.at.fill(0.0);
            let (earlier, rest) = self.rates.split_at_mut(stage);
            for (weight, rate) in ROWS[stage].iter().zip(earlier.iter()) {
                add_scaled(&mut self.at, h * weight, rate);
            }
            rates(NODES[stage] * h, &self.at, &mut rest[0]);
        }
        self.error.fill(0.0);
        for (weight, rate) in ERROR.iter().zip(&self.rates) {
            add_scaled(&mut self.error, h * weight, rate);
        }
    }
    /// The displacement of order 5.
    pub fn displacement(&self) -> &[f64] {
        &self.at
    }
    /// Largest estimate of the error over all components.
    pub fn largest_error(&self) -> f64 {
        // A NaN counts for more than any number.
        self.error.iter().fold(0.0, |m: f64, x| if x.abs() <= m { m } else { x.abs() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_of_the_pair_sum_to_their_nodes_and_the_error_weights_to_zero() {
        for (row, node) in ROWS.iter().zip(NODES) {
            assert!((row.iter().sum::<f64>() - node).abs() < 1e-15);
        }
        assert!(ERROR.iter().sum::<f64>().abs() < 1e-16);
    }
}

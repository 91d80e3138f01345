//! The classical Runge–Kutta method of order 4.

use super::add_scaled;

/// Places for the stages of a step.
#[derive(Debug, Clone, Default)]
pub struct RungeKutta4 {
    rate: Vec<f64>,
    at: Vec<f64>,
    sum: Vec<f64>,
}

impl RungeKutta4 {
    /// For a row of `length` numbers.
    pub fn new(length: usize) -> Self {
        let row = vec![0.0; length];
        Self { rate: row.clone(), at: row.clone(), sum: row }
    }
    /// The displacement after a step of `h` (s): `rates(t, displacement, rate)` with `t` (s) from its
    /// start. No heap is touched.
    ///
    /// # Source
    /// [`Hairer1993`](wrasse_spatial::references::Hairer1993) ch. II.1.
    pub fn step(&mut self, h: f64, mut rates: impl FnMut(f64, &[f64], &mut [f64])) -> &[f64] {
        self.rate.fill(0.0);
        self.sum.fill(0.0);
        for (node, share) in [(0.0, 6.0), (0.5, 3.0), (0.5, 3.0), (1.0, 6.0)] {
            self.at.fill(0.0);
            add_scaled(&mut self.at, node * h, &self.rate);
            rates(node * h, &self.at, &mut self.rate);
            add_scaled(&mut self.sum, h / share, &self.rate);
        }
        &self.sum
    }
}

//! Runge–Kutta steps. They integrate the displacement from the start of the step, which begins at
//! zero: attitudes stay on their group, and the caller adds the result with care.

/// A displacement that can be scaled and added.
pub trait Displacement: Copy {
    /// No displacement.
    fn zero() -> Self;
    /// `self + rate·h`.
    #[must_use]
    fn plus(&self, h: f64, rate: &Self) -> Self;
}

/// A displacement whose error can be judged.
pub trait Judged: Displacement {
    /// Largest component of `self` relative to the tolerances: at most 1 where they are kept.
    fn error_norm(&self, tolerance: f64) -> f64;
}

/// How the motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepper {
    /// Classical Runge–Kutta of order 4; the step (s) is shortened so that it divides the period.
    Fixed {
        /// Step (s).
        step: f64,
    },
    /// Dormand–Prince 5(4), the step chosen so that each component keeps the tolerance.
    Adaptive {
        /// Error allowed in each step (rad, m, their rates, N·m·s, J).
        tolerance: f64,
    },
}

/// Number (–) and length (s) of the equal steps, at most `step` (s) each, that make up `period` (s).
pub(crate) fn equal_steps(period: f64, step: f64) -> (f64, f64) {
    let count = (period / step - 1e-9).ceil().max(1.0);
    (count, period / count)
}

/// One classical Runge–Kutta step of order 4: `rates(t, displacement)` with `t` from the start.
///
/// # Source
/// [`Hairer1993`](wrasse_spatial::references::Hairer1993) ch. II.1.
#[inline(always)]
pub fn runge_kutta_4<D: Displacement>(h: f64, mut rates: impl FnMut(f64, &D) -> D) -> D {
    let (mut k, mut sum) = (D::zero(), D::zero());
    // One call for all stages: the rates are long, and stand once in what is built.
    for (node, share) in [(0.0, 6.0), (0.5, 3.0), (0.5, 3.0), (1.0, 6.0)] {
        k = rates(node * h, &D::zero().plus(node * h, &k));
        sum = sum.plus(h / share, &k);
    }
    sum
}

/// Stages of the Dormand–Prince pair: nodes and rows.
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

/// One Dormand–Prince step: the displacement of order 5, and its error estimate.
///
/// # Source
/// [`Hairer1993`](wrasse_spatial::references::Hairer1993) ch. II.5, table 5.2.
pub fn dormand_prince<D: Displacement>(h: f64, mut rates: impl FnMut(f64, &D) -> D) -> (D, D) {
    let mut k = [D::zero(); 7];
    let mut at = D::zero();
    for stage in 0..7 {
        at = D::zero();
        for (weight, earlier) in ROWS[stage].iter().zip(&k).take(stage) {
            at = at.plus(h * weight, earlier);
        }
        k[stage] = rates(NODES[stage] * h, &at);
    }
    let mut error = D::zero();
    for (weight, stage) in ERROR.iter().zip(&k) {
        error = error.plus(h * weight, stage);
    }
    (at, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Displacement for f64 {
        fn zero() -> Self {
            0.0
        }
        fn plus(&self, h: f64, rate: &Self) -> Self {
            self + h * rate
        }
    }

    /// y' = y from 1: the step must give e^h up to its order.
    fn order(step: impl Fn(f64) -> f64) -> f64 {
        let error = |h: f64| (step(h) - (h.exp() - 1.0)).abs();
        (error(0.2) / error(0.1)).log2() - 1.0
    }

    #[test]
    fn runge_kutta_is_of_order_4_and_dormand_prince_of_order_5() {
        let rk = order(|h| runge_kutta_4(h, |_, d: &f64| 1.0 + d));
        let dp = order(|h| dormand_prince(h, |_, d: &f64| 1.0 + d).0);
        assert!((rk - 4.0).abs() < 0.1, "{rk}");
        assert!((dp - 5.0).abs() < 0.2, "{dp}");
    }

    #[test]
    fn the_rows_of_the_pair_sum_to_their_nodes_and_the_error_weights_to_zero() {
        for (row, node) in ROWS.iter().zip(NODES) {
            assert!((row.iter().sum::<f64>() - node).abs() < 1e-15);
        }
        assert!(ERROR.iter().sum::<f64>().abs() < 1e-16);
    }

    /// 0.07/0.01 is 7.000000000000001 in floating point.
    #[test]
    fn a_period_of_seven_steps_has_seven_steps() {
        assert_eq!(equal_steps(0.07, 0.01), (7.0, 0.07 / 7.0));
        assert_eq!(equal_steps(0.07, 0.011), (7.0, 0.07 / 7.0));
        assert_eq!(equal_steps(0.01, 1.0), (1.0, 0.01));
    }
}

//! Steps through time. What is integrated is a row of numbers: the displacement of all variables since
//! the start of a step, which begins at zero, so that attitudes stay on their group and the result can
//! be added with compensation.

mod dormand_prince;
mod runge_kutta_4;

pub use dormand_prince::DormandPrince;
pub use runge_kutta_4::RungeKutta4;

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

/// `to += h rate`.
pub(crate) fn add_scaled(to: &mut [f64], h: f64, rate: &[f64]) {
    to.iter_mut().zip(rate).for_each(|(x, v)| *x += h * v);
}

/// `x += dx`, giving back what the last sum lost (Kahan).
pub(crate) fn add_compensated(x: &mut f64, dx: f64, carry: &mut f64) {
    let y = dx - *carry;
    let sum = *x + y;
    *carry = (sum - *x) - y;
    *x = sum;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hundredth a million times. A plain sum is off by 1.7e-7.
    #[test]
    fn a_compensated_sum_is_right_to_the_last_bit() {
        let (mut sum, mut carry) = (0.0, 0.0);
        for _ in 0..1_000_000 {
            add_compensated(&mut sum, 0.01, &mut carry);
        }
        assert_eq!(sum, 1e4);
    }

    /// y' = y from 1: the step must give e^h up to its order.
    fn order(step: impl Fn(f64) -> f64) -> f64 {
        let error = |h: f64| (step(h) - (h.exp() - 1.0)).abs();
        (error(0.2) / error(0.1)).log2() - 1.0
    }

    #[test]
    fn runge_kutta_is_of_order_4_and_dormand_prince_of_order_5() {
        let growth = |_: f64, d: &[f64], rate: &mut [f64]| rate[0] = 1.0 + d[0];
        let rk = order(|h| RungeKutta4::new(1).step(h, growth)[0]);
        let dp = order(|h| {
            let mut pair = DormandPrince::new(1);
            pair.step(h, growth);
            pair.displacement()[0]
        });
        assert!((rk - 4.0).abs() < 0.1, "{rk}");
        assert!((dp - 5.0).abs() < 0.2, "{dp}");
    }

    /// 0.07/0.01 is 7.000000000000001 in floating point.
    #[test]
    fn a_period_of_seven_steps_has_seven_steps() {
        assert_eq!(equal_steps(0.07, 0.01), (7.0, 0.07 / 7.0));
        assert_eq!(equal_steps(0.07, 0.011), (7.0, 0.07 / 7.0));
        assert_eq!(equal_steps(0.01, 1.0), (1.0, 0.01));
    }
}

//! How sure a pass rate is.

use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

/// Confidence of the interval of a pass rate.
pub const CONFIDENCE: f64 = 0.95;

/// How many samples passed, and between which bounds the true share lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PassRate {
    /// Samples that passed.
    pub passed: usize,
    /// Samples.
    pub of: usize,
    /// Lower and upper bound of the true share (–); absent where nothing varies: samples that are all the
    /// same flight say no more than one of them.
    pub interval: Option<[f64; 2]>,
    /// The share that is sure (–): the interval's lower end; the share itself where nothing is drawn.
    pub sure: f64,
}

impl PassRate {
    /// The interval of Clopper and Pearson, two-sided, of confidence [`CONFIDENCE`]: whatever the true
    /// share is, it holds it at least that often.
    ///
    /// # Source
    /// C. J. Clopper, E. S. Pearson, *The use of confidence or fiducial limits illustrated in the case of
    /// the binomial*, Biometrika 26 (1934); by quantiles of the beta distribution.
    pub fn of(passed: usize, of: usize) -> Self {
        let (k, n, tail) = (passed as f64, of as f64, 0.5 * (1.0 - CONFIDENCE));
        let quantile = |a: f64, b: f64, p: f64| Beta::new(a, b).map(|beta| beta.inverse_cdf(p));
        let low = if passed == 0 { Ok(0.0) } else { quantile(k, n - k + 1.0, tail) };
        let high = if passed >= of { Ok(1.0) } else { quantile(k + 1.0, n - k, 1.0 - tail) };
        // Both parameters are one or more: there is such a distribution.
        let (low, high) = (low.unwrap_or(0.0), high.unwrap_or(1.0));
        Self { passed, of, interval: Some([low, high]), sure: low }
    }
    /// Of samples that draw something, and of which no two came out differently: a rare one might.
    pub fn of_the_same(passed: usize, of: usize) -> Self {
        Self { interval: None, ..Self::of(passed, of) }
    }
    /// Of samples that draw nothing.
    pub fn of_one_flight(passed: usize, of: usize) -> Self {
        Self { passed, of, interval: None, sure: passed as f64 / of as f64 }
    }
    /// Share of the samples that passed (–); NaN of none.
    pub fn share(&self) -> f64 {
        self.passed as f64 / self.of as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_testing::larger;

    /// Probability that of `n` samples at least `k` pass, each with probability `p`.
    fn at_least(k: usize, n: usize, p: f64) -> f64 {
        if p > 0.5 {
            // From the other end, where the first term is not too small to be told from nothing.
            return 1.0 - at_least(n + 1 - k, n, 1.0 - p);
        }
        let mut term = (1.0 - p).powi(i32::try_from(n).expect("a few"));
        let mut sum = 0.0;
        for i in 0..=n {
            if i >= k {
                sum += term;
            }
            term *= (n - i) as f64 / (i + 1) as f64 * p / (1.0 - p);
        }
        sum
    }

    /// That is how the bounds are defined. Measured within 2e-14.
    #[test]
    fn at_the_bounds_what_was_seen_has_the_probability_of_a_tail() {
        let mut worst: f64 = 0.0;
        for (k, n) in [(1, 2), (8, 10), (3, 50), (49, 50), (490, 500), (10, 700)] {
            let rate = PassRate::of(k, n);
            let [low, high] = rate.interval.expect("it varies");
            worst = larger(worst, (at_least(k, n, low) - 0.025).abs());
            worst = larger(worst, (1.0 - at_least(k + 1, n, high) - 0.025).abs());
        }
        assert!(worst < 1e-12, "{worst:e}");
    }

    #[test]
    fn none_and_all_bound_one_side_only() {
        let bounds = |k, n| PassRate::of(k, n).interval.expect("it varies");
        let ([none_low, none_high], [all_low, all_high]) = (bounds(0, 100), bounds(100, 100));
        assert_eq!((none_low, all_high), (0.0, 1.0));
        // (1 - p)^100 = 0.025. Measured 9e-16 off.
        let bound = 1.0 - 0.025_f64.powf(0.01);
        let off = [none_high - bound, all_low - 1.0 + bound].map(f64::abs);
        assert!(off.iter().all(|x| *x < 1e-13), "{off:?}");
        assert_eq!(bounds(0, 0), [0.0, 1.0]);
    }

    #[test]
    fn samples_that_are_all_the_same_flight_have_no_interval() {
        let (same, one) = (PassRate::of_the_same(300, 300), PassRate::of_one_flight(300, 300));
        assert_eq!((same.interval, one.interval, one.sure), (None, None, 1.0));
        // (1 - p)^300 = 0.025. Measured 2e-15 off.
        assert!((same.sure - 0.025_f64.powf(1.0 / 300.0)).abs() < 1e-12, "{}", same.sure);
    }
}

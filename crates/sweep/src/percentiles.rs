//! Percentiles of a required quantity.

use serde::Serialize;

/// Where the values of a quantity lie, in its unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Percentiles {
    /// The least.
    pub min: f64,
    /// One in a hundred is below this.
    pub p1: f64,
    /// One in twenty is below this.
    pub p5: f64,
    /// Half of them are below this.
    pub p50: f64,
    /// One in twenty is above this.
    pub p95: f64,
    /// One in a hundred is above this.
    pub p99: f64,
    /// The largest.
    pub max: f64,
}

impl Percentiles {
    /// Of some values; `None` of none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let (&min, &max) = (sorted.first()?, sorted.last()?);
        let at = |p| quantile(&sorted, p);
        Some(Self {
            min,
            p1: at(0.01),
            p5: at(0.05),
            p50: at(0.5),
            p95: at(0.95),
            p99: at(0.99),
            max,
        })
    }
}

/// Quantile of sorted values, linear between them: type 7 of Hyndman and Fan, *Sample quantiles in
/// statistical packages*, The American Statistician 50 (1996).
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the list")]
fn quantile(sorted: &[f64], p: f64) -> f64 {
    let place = p * (sorted.len() - 1) as f64;
    let below = place as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_on_the_line_between_the_values_around_them() {
        let found = Percentiles::of((0..=100).rev().map(f64::from)).expect("there are values");
        let list = [found.min, found.p1, found.p5, found.p50, found.p95, found.p99, found.max];
        assert_eq!(list, [0.0, 1.0, 5.0, 50.0, 95.0, 99.0, 100.0]);
        let two = Percentiles::of([3.0, 1.0]).expect("there are values");
        assert_eq!([two.min, two.p50, two.max], [1.0, 2.0, 3.0]);
        assert!((two.p95 - 2.9).abs() < 1e-15);
        assert_eq!(Percentiles::of([7.0]).map(|one| one.p99), Some(7.0));
        assert_eq!(Percentiles::of([]), None);
    }
}

//! Pass rates and spreads of a sweep in words.

use wrasse_sweep::{PassRate, RequirementSweep};

use super::numbers::significant;

/// `483 of 500 (96.6 %; with 95 % confidence 94.6 % to 98.0 %)`; without an interval where nothing
/// varies.
pub(crate) fn pass_rate(rate: &PassRate) -> String {
    let percent = |share: f64| format!("{} %", significant((share * 1e5).round() * 1e-3));
    let share = format!("{} of {} ({}", rate.passed, rate.of, percent(rate.share()));
    match rate.interval {
        Some([low, high]) => format!(
            "{share}; with {} confidence {} to {})",
            percent(wrasse_sweep::CONFIDENCE),
            percent(low),
            percent(high)
        ),
        None => format!("{share}; nothing varies, so there is no confidence to state)"),
    }
}

/// Least value, percentiles, largest value.
pub(crate) fn figures(requirement: &RequirementSweep) -> [String; 7] {
    match &requirement.values {
        None => std::array::from_fn(|_| "-".to_owned()),
        Some(v) => [v.min, v.p1, v.p5, v.p50, v.p95, v.p99, v.max].map(significant),
    }
}

//! How findings are told: their form, and how many digits.

use crate::outcome::{Finding, TaskOutcome};

/// An error of the tool (mm) below which it says nothing: no arm is built or measured to it.
pub(super) const FINEST_MM: f64 = 0.001;

/// Two significant digits: what demands and vehicles are known to.
pub(super) fn rounded(value: f64) -> String {
    let short = format!("{value:.1e}");
    short.parse::<f64>().map_or(short, |value| value.to_string())
}

/// Two figures with two digits each, or one where they are the same, and `least` for what is less.
pub(super) fn span(low: f64, high: f64, least: f64) -> String {
    let told = |x: f64| if x < least { format!("less than {least}") } else { rounded(x) };
    let (low, high) = (told(low), told(high));
    if low == high { low } else { format!("{low} to {high}") }
}

/// A finding that rests on these tasks.
pub(super) fn finding(about: &str, text: String, tasks: &[&TaskOutcome]) -> Finding {
    Finding { about: about.into(), text, tasks: tasks.iter().map(|t| t.name.clone()).collect() }
}

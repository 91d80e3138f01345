//! Bisection: where a condition begins to hold.

/// Halvings of the interval.
const HALVINGS: usize = 40;

/// Where `holds` begins between `low`, where it is false, and `high`, where it is true.
pub(super) fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

//! Numbers as people read them: five significant digits, and no more.

/// `value` to five significant digits: plain from 0.001 to 100 000, else with an exponent.
pub(crate) fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    // Rounding first and reading the exponent afterwards: 9.99999 has the exponent of 10.
    let scientific = format!("{value:.4e}");
    let (mantissa, exponent) = scientific.split_once('e').expect("`e` formatting writes an `e`");
    let exponent: i32 = exponent.parse().expect("`e` formatting writes a whole exponent");
    match usize::try_from(4 - exponent) {
        Ok(decimals) if exponent >= -3 => trimmed(&format!("{value:.decimals$}")).to_owned(),
        _ => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// `value` beside its `limit`: with all its digits where five would make it look like the limit.
pub(crate) fn beside_limit(value: f64, limit: f64) -> String {
    let short = significant(value);
    if value != limit && short == significant(limit) { value.to_string() } else { short }
}

/// Two significant digits with an exponent, for bounds and ratios of which the power of ten is what
/// matters.
pub(crate) fn power(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

/// Three significant digits, for figures that are estimates.
pub(crate) fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return significant(value);
    }
    format!("{value:.2e}").parse().map_or_else(|_| significant(value), significant)
}

/// Least error that is told: of a tool in mm, of an attitude in deg.
pub(crate) const FINEST: f64 = 0.001;

/// An error of a flight that was simulated: three digits, and no smaller than `least`, below which
/// nothing is built or measured.
pub(crate) fn error(value: f64, least: f64) -> String {
    if value > 0.0 && value < least { format!("<{least}") } else { rounded(value) }
}

/// Zero for what is round-off beside the largest figure of its row.
pub(crate) fn beside_largest(value: f64, largest: f64) -> f64 {
    if value.abs() < 1e-9 * largest { 0.0 } else { value }
}

/// A factor by which something must be slower, rounded up so that it still suffices.
pub(crate) fn pace(factor: f64) -> String {
    format!("{:.1}", libm::ceil(10.0 * factor - 1e-6) / 10.0)
}

/// A count and what is counted: `1 task`, `2 tasks`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}

/// Without the zeros that end a decimal fraction.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_digits_are_kept_and_trailing_zeros_are_not() {
        let cases = [
            (0.0, "0"),
            (0.3, "0.3"),
            (-127.712_34, "-127.71"),
            (1500.0, "1500"),
            (12_345.678, "12346"),
            (99_999.9, "1e5"),
            (9.999_999, "10"),
            (0.001, "0.001"),
            (1.234_567e-4, "1.2346e-4"),
            (-2e-15, "-2e-15"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value), text);
        }
    }

    #[test]
    fn a_pace_is_rounded_to_the_slower_side() {
        assert_eq!([1.0, 1.01, 4.1, 9.96, 17.02].map(pace), ["1.0", "1.1", "4.1", "10.0", "17.1"]);
    }

    #[test]
    fn estimates_have_three_digits() {
        assert_eq!(
            [92.4567, 0.0, 12345.0, 0.000_123_45].map(rounded),
            ["92.5", "0", "12300", "1.23e-4"]
        );
    }

    #[test]
    fn an_error_below_what_can_be_measured_is_told_as_less() {
        let told = [0.0, 1.72e-4, 0.001, 26.71].map(|x| error(x, 0.001));
        assert_eq!(told, ["0", "<0.001", "0.001", "26.7"]);
    }

    #[test]
    fn round_off_beside_a_large_figure_is_nothing() {
        assert_eq!([1.77e-14, -1e-8, 0.1].map(|x| beside_largest(x, 350.0)), [0.0, 0.0, 0.1]);
        assert_eq!(beside_largest(1.77e-14, 0.0), 1.77e-14);
    }

    #[test]
    fn one_of_a_kind_is_counted_as_one() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "task")), ["0 tasks", "1 task", "2 tasks"]);
    }

    #[test]
    fn a_value_just_beyond_its_limit_does_not_look_like_it() {
        assert_eq!(beside_limit(0.300_000_1, 0.3), "0.3000001");
        assert_eq!(beside_limit(0.3, 0.3), "0.3");
        assert_eq!(beside_limit(0.312_345_6, 0.3), "0.31235");
    }
}

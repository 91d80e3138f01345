//! Numbers in sentences: as many figures as they are good for.

/// Four figures.
pub fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// Four figures, with an exponent where there would be a row of zeros.
pub fn shown(x: f64) -> String {
    let x = rounded(x);
    let is_plain = x == 0.0 || (1e-4..1e7).contains(&x.abs()) || !x.is_finite();
    if is_plain { format!("{x}") } else { format!("{x:e}") }
}

/// Two figures, not above.
pub fn rounded_down(x: f64) -> f64 {
    two_figures(x, f64::floor)
}

/// Two figures, not below.
pub fn rounded_up(x: f64) -> f64 {
    two_figures(x, f64::ceil)
}

fn two_figures(x: f64, whole: fn(f64) -> f64) -> f64 {
    let text = format!("{x:e}");
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    // Neither infinity nor NaN has one.
    let Some(exponent) = exponent else { return x };
    let step: f64 = format!("1e{}", exponent - 1).parse().unwrap_or(1.0);
    rounded(whole(x / step) * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_without_rows_of_zeros() {
        assert_eq!([1e154, 16.5685, 2e-7, 0.0].map(shown), ["1e154", "16.57", "2e-7", "0"]);
    }

    #[test]
    fn figures_of_advice_are_on_the_safe_side() {
        let (down, up) = (rounded_down, rounded_up);
        assert_eq!((down(28.98), up(28.98), down(0.0391), up(151.2)), (28.0, 29.0, 0.039, 160.0));
        assert!(down(f64::INFINITY).is_infinite());
    }
}

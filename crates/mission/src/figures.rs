//! Numbers in sentences: as many figures as they are good for.

/// Four figures.
pub(crate) fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// Two figures, not above.
pub(crate) fn rounded_down(x: f64) -> f64 {
    two_figures(x, f64::floor)
}

/// Two figures, not below.
pub(crate) fn rounded_up(x: f64) -> f64 {
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
    fn figures_of_advice_are_on_the_safe_side() {
        let (down, up) = (rounded_down, rounded_up);
        assert_eq!((down(28.98), up(28.98), down(0.0391), up(151.2)), (28.0, 29.0, 0.039, 160.0));
        assert!(down(f64::INFINITY).is_infinite());
    }
}

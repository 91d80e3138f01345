//! Numbers in complaints: four figures, as people write them.

/// A computed number with four significant figures.
pub(crate) fn figures(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::figures;

    #[test]
    fn computed_numbers_are_told_with_four_figures() {
        let told = [2.0 / 3.0, 1234.5678, 1.0e-9, -3.0e12, 0.0, f64::NAN].map(figures);
        assert_eq!(told, ["0.6667", "1235", "1e-9", "-3e12", "0", "NaN"]);
    }
}

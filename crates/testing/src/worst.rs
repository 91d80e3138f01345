//! The largest of many errors. `f64::max` drops a NaN, and with it the failure that it is the sign of: what
//! is here keeps it, so that no bound holds.

/// The larger of two numbers; NaN if one of them is.
#[must_use]
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The smaller of two numbers; NaN if one of them is.
#[must_use]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

/// The largest magnitude of some numbers, zero of none; NaN if one of them is. An error counts whatever
/// its sign.
pub fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |most, x| larger(most, x.abs()))
}

/// The largest error so far.
#[derive(Debug, Clone, Copy)]
pub struct Worst(f64);

impl Worst {
    /// Before the first.
    #[must_use]
    pub fn none() -> Self {
        Self(0.0)
    }
    /// One error more.
    pub fn see(&mut self, error: f64) {
        self.0 = larger(self.0, error);
    }
    /// The differences of two lists.
    pub fn see_all<const N: usize>(&mut self, a: [f64; N], b: [f64; N]) {
        for i in 0..N {
            self.see((a[i] - b[i]).abs());
        }
    }
    /// The largest; NaN if there was one.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.0
    }
    /// All errors were below a bound.
    #[track_caller]
    pub fn is_below(&self, bound: f64) {
        assert!(self.0 < bound, "{:e} is not below {bound:e}", self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First, in the middle, last.
    const WITH_NAN: [[f64; 3]; 3] =
        [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]];

    #[test]
    fn a_nan_is_worse_than_anything_wherever_it_stands() {
        for errors in WITH_NAN {
            assert!(largest(errors).is_nan());
            let mut worst = Worst::none();
            for error in errors {
                worst.see(error);
            }
            assert!(worst.largest().is_nan());
            // What it was written against.
            assert_eq!(errors.into_iter().fold(0.0, f64::max), 2.0);
        }
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
            assert!(larger(a, b).is_nan() && smaller(a, b).is_nan());
        }
        assert_eq!((larger(1.0, 2.0), smaller(1.0, 2.0), smaller(2.0, 1.0)), (2.0, 1.0, 1.0));
        assert_eq!((largest([]), largest([-1.0]), largest([1.0, -3.0, 2.0])), (0.0, 1.0, 3.0));
    }

    #[test]
    #[should_panic(expected = "NaN is not below 1e0")]
    fn a_bound_does_not_hold_for_a_nan() {
        let mut worst = Worst::none();
        worst.see_all([0.0, f64::NAN, 0.0], [0.0; 3]);
        worst.is_below(1.0);
    }
}

//! The largest error of many cases; a NaN is larger than anything.

/// Largest error so far.
pub(crate) struct Worst(f64);

impl Worst {
    pub(crate) fn none() -> Self {
        Self(0.0)
    }
    pub(crate) fn see(&mut self, error: f64) {
        if error.is_nan() || error > self.0 {
            self.0 = error;
        }
    }
    pub(crate) fn see_all<const N: usize>(&mut self, a: [f64; N], b: [f64; N]) {
        for i in 0..N {
            self.see((a[i] - b[i]).abs());
        }
    }
    pub(crate) fn largest(&self) -> f64 {
        self.0
    }
    #[track_caller]
    pub(crate) fn is_below(&self, bound: f64) {
        assert!(self.0 < bound, "{:e} is not below {bound:e}", self.0);
    }
}

#[test]
fn a_nan_is_worse_than_anything() {
    let mut worst = Worst::none();
    for error in [1.0, f64::NAN, 2.0] {
        worst.see(error);
    }
    assert!(worst.0.is_nan());
}

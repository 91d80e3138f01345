//! Numbers that look random and are the same on every processor.

/// A linear congruential generator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Random(u64);

impl Random {
    /// The numbers of this seed.
    pub(crate) fn new(seed: u32) -> Self {
        Self(u64::from(seed).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x2545_F491_4F6C_DD1D)
    }
    /// The next number between -`limit` and `limit`: 24 bits, exact in either precision.
    ///
    /// # Source
    /// Constants of Knuth's MMIX: D. E. Knuth, *The Art of Computer Programming*, vol. 2, 3.3.4.
    pub(crate) fn within(&mut self, limit: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let high = (self.0 >> 40) as u32;
        (f64::from(high) / f64::from(1_u32 << 23) - 1.0) * limit
    }
}

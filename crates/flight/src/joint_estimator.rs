//! Positions and rates of the joints from encoders that round: an alpha-beta filter, fed forward
//! with the acceleration that was asked for.

use wrasse_spatial::Scalar;

/// The filter, one and the same for each joint.
#[derive(Debug, Clone)]
pub struct JointEstimator<T, const J: usize> {
    /// Positions (rad or m).
    q: [T; J],
    /// Rates (rad/s or m/s).
    v: [T; J],
    /// Bandwidth (rad/s).
    bandwidth: T,
}

impl<T: Scalar, const J: usize> JointEstimator<T, J> {
    /// Starts at rest at positions (rad or m), with a bandwidth (rad/s) that is positive.
    pub fn new(q: [T; J], bandwidth: T) -> Self {
        Self { q, v: [T::zero(); J], bandwidth }
    }
    /// Positions and rates after a control period (s), from the encoders (rad or m) at its end and
    /// the mean acceleration (rad/s² or m/s²) that was asked for in it.
    ///
    /// A period of zero changes nothing. What the model gets wrong dies out with two equal poles at `exp(-bandwidth · period)`. An
    /// acceleration `a` that was not asked for leaves the rate behind by `2a/bandwidth`.
    pub fn step(&mut self, q_read: &[T; J], acceleration: &[T; J], period: T) -> ([T; J], [T; J]) {
        let pole = Scalar::exp(-self.bandwidth * period);
        let short = T::one() - pole;
        let alpha = T::one() - pole * pole;
        let beta_per_time = if period > T::zero() { short * short / period } else { T::zero() };
        for j in 0..J {
            let a = acceleration[j] * period;
            let foreseen = self.q[j] + (self.v[j] + a * T::from_f64(0.5)) * period;
            let innovation = q_read[j] - foreseen;
            self.q[j] = foreseen + innovation * alpha;
            self.v[j] += a + innovation * beta_per_time;
        }
        (self.q, self.v)
    }
}

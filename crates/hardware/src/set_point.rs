//! Set-points of a joint drive, and what the drive does between two of them.

use wrasse_spatial::Real;

/// Where a joint should be at an instant, and how it should move.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SetPoint<T> {
    /// Position (rad or m).
    pub position: T,
    /// Rate (rad/s or m/s).
    pub rate: T,
    /// Acceleration (rad/s² or m/s²).
    pub acceleration: T,
}

/// The quintic that joins two set-points: position, rate and acceleration are continuous.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SetPointMotion<T> {
    from: SetPoint<T>,
    /// Duration (s).
    duration: T,
    /// Coefficients of (t/duration)³, ⁴ and ⁵ (rad or m).
    high: [T; 3],
}

impl<T: Real> SetPointMotion<T> {
    /// Joint at rest in one place.
    #[inline(always)]
    pub fn still(position: T) -> Self {
        let at_rest = SetPoint { position, rate: T::zero(), acceleration: T::zero() };
        Self { from: at_rest, duration: T::one(), high: [T::zero(); 3] }
    }
    /// From one set-point to the next, `duration` (s) later.
    #[inline(always)]
    pub fn between(from: SetPoint<T>, to: SetPoint<T>, duration: T) -> Self {
        let c = T::from_f64;
        // In normalised time; what the start alone would lead to, taken off the end values.
        let (v0, a0) = (from.rate * duration, from.acceleration * duration * duration);
        let p = to.position - from.position - v0 - a0 * c(0.5);
        let v = to.rate * duration - v0 - a0;
        let a = to.acceleration * duration * duration - a0;
        let high = [
            p * c(10.0) - v * c(4.0) + a * c(0.5),
            p * c(-15.0) + v * c(7.0) - a,
            p * c(6.0) - v * c(3.0) + a * c(0.5),
        ];
        Self { from, duration, high }
    }
    /// The set-point `t` (s) after the start.
    #[inline(always)]
    pub fn at(&self, t: T) -> SetPoint<T> {
        let c = T::from_f64;
        let (s, per) = (t / self.duration, T::one() / self.duration);
        let [k3, k4, k5] = self.high;
        let s2 = s * s;
        let rise = s2 * s * (k3 + s * (k4 + s * k5));
        let slope = s2 * (k3 * c(3.0) + s * (k4 * c(4.0) + s * k5 * c(5.0)));
        let bend = s * (k3 * c(6.0) + s * (k4 * c(12.0) + s * k5 * c(20.0)));
        let SetPoint { position, rate, acceleration } = self.from;
        SetPoint {
            position: position + t * (rate + t * acceleration * c(0.5)) + rise,
            rate: rate + t * acceleration + slope * per,
            acceleration: acceleration + bend * per * per,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_motion_meets_both_set_points_in_position_rate_and_acceleration() {
        let from = SetPoint { position: 0.3, rate: -0.2, acceleration: 0.7 };
        let to = SetPoint { position: 0.9, rate: 0.4, acceleration: -1.1 };
        let motion = SetPointMotion::between(from, to, 0.8);
        for (at, want) in [(0.0, from), (0.8, to)] {
            let got = motion.at(at);
            let off = (got.position - want.position)
                .abs()
                .max((got.rate - want.rate).abs())
                .max((got.acceleration - want.acceleration).abs());
            assert!(off < 1e-13, "at {at} s off by {off}");
        }
    }

    #[test]
    fn rate_and_acceleration_are_the_derivatives_of_the_position() {
        let from = SetPoint { position: 0.3, rate: -0.2, acceleration: 0.7 };
        let to = SetPoint { position: 0.9, rate: 0.4, acceleration: -1.1 };
        let motion = SetPointMotion::between(from, to, 0.8);
        let (t, h) = (0.33, 1e-5);
        let (a, b, c) = (motion.at(t - h), motion.at(t), motion.at(t + h));
        assert!(((c.position - a.position) / (2.0 * h) - b.rate).abs() < 1e-8);
        assert!(((c.rate - a.rate) / (2.0 * h) - b.acceleration).abs() < 1e-8);
    }
}

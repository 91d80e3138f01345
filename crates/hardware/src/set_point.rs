//! Set-points of a joint drive, and what the drive does between two of them.

use wrasse_spatial::{Instructions, Lanes, Real, SideBySide};

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

impl<I: Instructions, const N: usize> SideBySide<N> for SetPoint<Lanes<N, I>> {
    type Alone = SetPoint<f64>;
    #[inline(always)]
    fn side_by_side(of: &impl Fn(usize) -> SetPoint<f64>) -> Self {
        Self {
            position: Lanes::from_fn(|i| of(i).position),
            rate: Lanes::from_fn(|i| of(i).rate),
            acceleration: Lanes::from_fn(|i| of(i).acceleration),
        }
    }
    #[inline(always)]
    fn lane(&self, i: usize) -> SetPoint<f64> {
        SetPoint {
            position: self.position.lane(i),
            rate: self.rate.lane(i),
            acceleration: self.acceleration.lane(i),
        }
    }
}

impl<I: Instructions, const N: usize> SideBySide<N> for SetPointMotion<Lanes<N, I>> {
    type Alone = SetPointMotion<f64>;
    #[inline(always)]
    fn side_by_side(of: &impl Fn(usize) -> SetPointMotion<f64>) -> Self {
        Self {
            from: SideBySide::side_by_side(&|i| of(i).from),
            duration: Lanes::from_fn(|i| of(i).duration),
            high: SideBySide::side_by_side(&|i| of(i).high),
        }
    }
    #[inline(always)]
    fn lane(&self, i: usize) -> SetPointMotion<f64> {
        SetPointMotion {
            from: self.from.lane(i),
            duration: self.duration.lane(i),
            high: self.high.lane(i),
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
            let off = [
                got.position - want.position,
                got.rate - want.rate,
                got.acceleration - want.acceleration,
            ];
            assert!(off.iter().all(|off| off.abs() < 1e-13), "at {at} s off by {off:?}");
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

    /// From rest to rest it is the quintic of every textbook: half way at half time, the largest
    /// rate 15/8 L/T there, the largest acceleration 10/√3 L/T². Measured off: 0, 0, 2e-16.
    #[test]
    fn from_rest_to_rest_the_peaks_are_those_of_the_minimum_jerk_quintic() {
        let (length, duration) = (0.7, 2.5);
        let rest = |position| SetPoint { position, rate: 0.0, acceleration: 0.0 };
        let motion = SetPointMotion::between(rest(0.2), rest(0.2 + length), duration);
        let middle = motion.at(0.5 * duration);
        let off = |found: f64, expected: f64| (found / expected - 1.0).abs();
        assert!(off(middle.position, 0.2 + 0.5 * length) < 1e-15);
        assert!(off(middle.rate, 1.875 * length / duration) < 1e-15);
        let steepest = (0.5 - Real::sqrt(3.0_f64) / 6.0) * duration;
        let peak = 10.0 / Real::sqrt(3.0_f64) * length / (duration * duration);
        assert!(off(motion.at(steepest).acceleration, peak) < 4e-15);
    }

    /// A drive that is given the set-points of a quintic follows that quintic. Measured:
    /// 4e-16 in position, 1.8e-15 in rate, 4.4e-15 in acceleration.
    #[test]
    fn between_set_points_of_a_quintic_lies_the_quintic() {
        let x = |t: f64| 0.3 + t * (0.2 + t * (-0.4 + t * (0.5 + t * (-0.7 + t * 0.1))));
        let v = |t: f64| 0.2 + t * (-0.8 + t * (1.5 + t * (-2.8 + t * 0.5)));
        let a = |t: f64| -0.8 + t * (3.0 + t * (-8.4 + t * 2.0));
        let on = |t: f64| SetPoint { position: x(t), rate: v(t), acceleration: a(t) };
        let motion = SetPointMotion::between(on(0.4), on(1.1), 0.7);
        for t in [0.1, 0.35, 0.6] {
            let (found, expected) = (motion.at(t), on(0.4 + t));
            assert!((found.position - expected.position).abs() < 1e-15);
            assert!((found.rate - expected.rate).abs() < 5e-15);
            assert!((found.acceleration - expected.acceleration).abs() < 2e-14);
        }
    }

    #[test]
    fn a_motion_begins_at_its_set_point_to_the_bit_and_a_still_joint_stays_there() {
        let from = SetPoint { position: 0.3, rate: -0.2, acceleration: 0.7 };
        let to = SetPoint { position: 0.9, rate: 0.4, acceleration: -1.1 };
        assert_eq!(SetPointMotion::between(from, to, 0.8).at(0.0), from);
        let still = SetPoint { position: 0.3, rate: 0.0, acceleration: 0.0 };
        for t in [0.0, 0.01, 7.0] {
            assert_eq!(SetPointMotion::still(0.3).at(t), still);
        }
    }

    /// A flight processor counts in single precision. Over 10 ms the rate is a hundred times as
    /// uncertain as the position. Measured: 0 and
    /// 5.3e-6 rad/s.
    #[test]
    fn in_single_precision_the_end_is_met_to_its_round_off() {
        let from = SetPoint { position: 0.3_f32, rate: -0.2, acceleration: 0.7 };
        let to = SetPoint { position: 0.9_f32, rate: 0.4, acceleration: -1.1 };
        let end = SetPointMotion::between(from, to, 0.01).at(0.01);
        assert!((end.position - to.position).abs() < 4.0 * f32::EPSILON);
        assert!((end.rate - to.rate).abs() < 400.0 * f32::EPSILON);
    }
}

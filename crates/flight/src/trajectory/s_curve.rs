//! Jerk-limited profiles: seven segments of constant jerk, or fewer where a limit is not reached.

use super::cube_root::cube_root;
use super::{BadNumber, BadNumbers, Motion, MotionLimits, Quantity};
use wrasse_spatial::{Real, Scalar};

/// From rest to rest in the shortest time under limits on speed, acceleration and jerk.
///
/// It speeds up in three segments (jerk up, constant acceleration, jerk down), cruises, and slows
/// down as it sped up, mirrored in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SCurve<T> {
    length: T,
    /// Jerk while it is not zero (per s³).
    jerk: T,
    /// Duration of a segment with jerk (s).
    jerk_time: T,
    /// Duration of a segment with constant acceleration (s).
    steady_time: T,
    /// Duration of the cruise (s).
    cruise_time: T,
}

impl<T: Scalar> SCurve<T> {
    /// Over `length` (m, rad or –) under the limits.
    ///
    /// # Errors
    /// If a limit is not positive and finite, the length negative or not finite, or the three do not
    /// give a finite duration.
    pub fn new(length: T, limits: &MotionLimits<T>) -> Result<Self, BadNumbers> {
        let [speed, acceleration, jerk] = limits.checked();
        let bad_length = BadNumber::unless_length(Quantity::Length, length);
        BadNumbers::none_of([bad_length, speed, acceleration, jerk])?;
        let (jerk_time, steady_time, cruise_time) = segments(length, limits);
        let curve = Self { length, jerk: limits.jerk, jerk_time, steady_time, cruise_time };
        // Limits far apart can overflow or underflow it.
        let bad_duration = BadNumber::unless_positive(Quantity::Duration, curve.duration());
        BadNumbers::none_of([bad_duration.filter(|_| length > T::zero())])?;
        Ok(curve)
    }
}

/// Durations of the segments with jerk, with constant acceleration, and of the cruise (s).
fn segments<T: Scalar>(length: T, limits: &MotionLimits<T>) -> (T, T, T) {
    let MotionLimits { speed, acceleration, jerk } = *limits;
    let (two, zero) = (T::from_f64(2.0), T::zero());
    let full = acceleration / jerk;
    // To the speed limit: with constant acceleration if the speed leaves room for it.
    let to_speed = speed / acceleration;
    let (jerk_time, steady_time) =
        if to_speed >= full { (full, to_speed - full) } else { ((speed / jerk).sqrt(), zero) };
    let rise = jerk_time + jerk_time + steady_time;
    let cruise_time = length / speed - rise;
    if cruise_time >= zero {
        return (jerk_time, steady_time, cruise_time);
    }
    // The way is too short for the speed limit: L = a Ta (Ta - Tj), Ta the time of the rise.
    let root = (full * full + T::from_f64(4.0) * length / acceleration).sqrt();
    let steady_time = (root - T::from_f64(3.0) * full) / two;
    if steady_time >= zero {
        return (full, steady_time, zero);
    }
    // … and for the acceleration limit: L = 2 j Tj³.
    (cube_root(length / (two * jerk)), zero, zero)
}

impl<T: Real> SCurve<T> {
    /// Progress at time `t` (s); at rest before the start and after the end.
    pub fn at(&self, t: T) -> Motion<T> {
        let (zero, half, sixth) = (T::zero(), T::from_f64(0.5), T::from_f64(1.0 / 6.0));
        let end = self.duration();
        let t = t.max(zero).min(end);
        // The second half is the first one seen from the end: so the end is met exactly.
        let late = (end * half).lt(t);
        let mut left = T::select(late, end - t, t);
        let (mut s, mut v, mut a) = (zero, zero, zero);
        for (duration, j) in [
            (self.jerk_time, self.jerk),
            (self.steady_time, zero),
            (self.jerk_time, -self.jerk),
            (self.cruise_time, zero),
        ] {
            let dt = left.min(duration);
            left -= dt;
            s += dt * (v + dt * (a * half + dt * j * sixth));
            v += dt * (a + dt * j * half);
            a += dt * j;
        }
        Motion {
            position: T::select(late, self.length - s, s),
            velocity: v,
            acceleration: T::select(late, -a, a),
        }
    }
    /// Time from rest to rest (s).
    pub fn duration(&self) -> T {
        let rise = self.jerk_time + self.jerk_time + self.steady_time;
        rise + rise + self.cruise_time
    }
    /// Length of the path (m, rad or –).
    pub fn length(&self) -> T {
        self.length
    }
    /// Times at which the jerk changes, start and end included (s).
    pub fn joins(&self) -> [T; 8] {
        let (j, a, c) = (self.jerk_time, self.steady_time, self.cruise_time);
        let mut at = [T::zero(); 8];
        for (k, duration) in [j, a, j, c, j, a, j].into_iter().enumerate() {
            at[k + 1] = at[k] + duration;
        }
        at
    }
}

//! Quintic profiles: the lowest polynomial from rest to rest.

use super::cube_root::cube_root;
use super::{BadNumber, BadNumbers, Motion, MotionLimits, Quantity};
use wrasse_spatial::{Real, Scalar};

/// From rest to rest: `s = L (10 u³ - 15 u⁴ + 6 u⁵)`, `u = t/T`.
///
/// Its peaks are 1.875 L/T (half way), (10/√3) L/T² (at u = ½ ± 1/√12) and 60 L/T³ (at the ends).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quintic<T> {
    length: T,
    duration: T,
}

/// Peak of `ds/du` for unit length (–).
const PEAK_SPEED: f64 = 1.875;
/// Peak of `d²s/du²` for unit length, 10/√3 (–).
const PEAK_ACCELERATION: f64 = 5.773_502_691_896_258;
/// Peak of `d³s/du³` for unit length (–).
const PEAK_JERK: f64 = 60.0;

impl<T: Scalar> Quintic<T> {
    /// Over `length` (m, rad or –) in `duration` (s).
    ///
    /// # Errors
    /// If the length is negative, the duration not positive (zero is fine for no length), or one of
    /// them not finite.
    pub fn new(length: T, duration: T) -> Result<Self, BadNumbers> {
        let nothing_to_do = length == T::zero() && duration == T::zero();
        let bad_duration = BadNumber::unless_positive(Quantity::Duration, duration);
        BadNumbers::none_of([
            BadNumber::unless_length(Quantity::Length, length),
            bad_duration.filter(|_| !nothing_to_do),
        ])?;
        Ok(Self { length, duration })
    }
    /// The shortest over `length` whose peaks keep the limits.
    ///
    /// # Errors
    /// If a limit is not positive and finite, or the length is negative or not finite.
    pub fn from_limits(length: T, limits: &MotionLimits<T>) -> Result<Self, BadNumbers> {
        let [speed, acceleration, jerk] = limits.checked();
        let bad_length = BadNumber::unless_length(Quantity::Length, length);
        BadNumbers::none_of([bad_length, speed, acceleration, jerk])?;
        let for_speed = length * T::from_f64(PEAK_SPEED) / limits.speed;
        let for_acceleration =
            (length * T::from_f64(PEAK_ACCELERATION) / limits.acceleration).sqrt();
        let for_jerk = cube_root(length * T::from_f64(PEAK_JERK) / limits.jerk);
        Self::new(length, for_speed.max(for_acceleration).max(for_jerk))
    }
}

impl<T: Real> Quintic<T> {
    /// Progress at time `t` (s); at rest before the start and after the end.
    pub fn at(&self, t: T) -> Motion<T> {
        let c = T::from_f64;
        let moves = T::zero().lt(self.duration);
        let T_ = T::select(moves, self.duration, T::one());
        let u = (t / T_).max(T::zero()).min(T::one());
        let v = T::one() - u;
        // s' = 30 u² (1-u)², s'' = 60 u (1-u)(1-2u): products, so that both ends are exactly zero.
        let (u2, v2) = (u * u, v * v);
        let speed = c(30.0) * u2 * v2;
        let acceleration = c(60.0) * u * v * (v - u);
        Motion {
            position: self.length * (u2 * u * (c(10.0) - c(15.0) * u + c(6.0) * u2)),
            velocity: self.length * speed / T_,
            acceleration: self.length * acceleration / (T_ * T_),
        }
    }
    /// Time from rest to rest (s).
    pub fn duration(&self) -> T {
        self.duration
    }
    /// Length of the path (m, rad or –).
    pub fn length(&self) -> T {
        self.length
    }
}

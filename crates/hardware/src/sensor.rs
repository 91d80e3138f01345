//! Sensors of attitude and joints.

use wrasse_spatial::{Quat, Real, Vec3};

/// A rate gyro of three axes, fixed to the base.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RateGyro<T> {
    /// Bias at the start, base axes (rad/s).
    pub bias_B: Vec3<T>,
    /// Random walk of the angle: density of the rate noise (rad/√s).
    pub angle_random_walk: T,
    /// Random walk of the bias (rad/s/√s).
    pub bias_random_walk: T,
    /// Rates are rounded to multiples of this (rad/s); zero: not rounded.
    pub rate_step: T,
}

/// A star tracker, fixed to the base.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StarTracker<T> {
    /// Unit direction in which it looks, base axes (–).
    pub boresight_B: Vec3<T>,
    /// Standard deviation about each axis across the boresight (rad).
    pub noise_across: T,
    /// Standard deviation about the boresight (rad).
    pub noise_about: T,
    /// Time from one reading to the next (s).
    pub interval: T,
    /// Age of a reading when it arrives (s).
    pub latency: T,
    /// Rate of the base above which it sees nothing (rad/s).
    pub rate_limit: T,
}

/// What a vehicle is felt with. `None`: perfect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sensors<T> {
    /// Attitude by gyro and star tracker.
    pub attitude: Option<(RateGyro<T>, StarTracker<T>)>,
    /// Joint positions are rounded to multiples of this (rad or m); zero: not rounded.
    pub encoder_step: T,
}

/// What a star tracker says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackerReading<T> {
    /// Attitude of the base, `quat_NB`.
    pub quat_NB: Quat<T>,
    /// How long ago it was so (s).
    pub age: T,
}

impl RateGyro<f64> {
    /// The same sensor over another scalar.
    pub fn cast<T: Real>(&self) -> RateGyro<T> {
        let c = T::from_f64;
        RateGyro {
            bias_B: self.bias_B.map(c),
            angle_random_walk: c(self.angle_random_walk),
            bias_random_walk: c(self.bias_random_walk),
            rate_step: c(self.rate_step),
        }
    }
}

impl StarTracker<f64> {
    /// The same sensor over another scalar.
    pub fn cast<T: Real>(&self) -> StarTracker<T> {
        let c = T::from_f64;
        StarTracker {
            boresight_B: self.boresight_B.map(c),
            noise_across: c(self.noise_across),
            noise_about: c(self.noise_about),
            interval: c(self.interval),
            latency: c(self.latency),
            rate_limit: c(self.rate_limit),
        }
    }
}

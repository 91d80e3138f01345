//! Thrusters, and the tank that feeds them.

use wrasse_spatial::{Real, Vec3};

/// Most thrusters of one vehicle.
pub const THRUSTERS: usize = 24;

/// Standard gravity (m/s²): what specific impulse is counted in.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// A thruster that is open or shut.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Thruster<T> {
    /// Where its force acts, in the base's frame (m).
    pub position_B: Vec3<T>,
    /// Unit direction of its force on the vehicle, base axes (–).
    pub direction_B: Vec3<T>,
    /// Force when fully open (N).
    pub force: T,
    /// Shortest time that it can be open (s).
    pub minimum_on_time: T,
    /// Time from shut to full force, which rises evenly (s).
    pub rise_time: T,
    /// Time from full force to none, which falls evenly (s).
    pub fall_time: T,
    /// Specific impulse (s).
    pub specific_impulse: T,
    /// Standard deviation of the impulse of a pulse, relative to it (–).
    pub impulse_noise: T,
}

/// Where the propellant is. Its mass comes on top of the bodies'.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tank<T> {
    /// Centre of the propellant, in the base's frame (m).
    pub position_B: Vec3<T>,
    /// Propellant at the start (kg).
    pub propellant: T,
}

impl Thruster<f64> {
    /// The same thruster over another scalar.
    pub fn cast<T: Real>(&self) -> Thruster<T> {
        let c = T::from_f64;
        Thruster {
            position_B: self.position_B.map(c),
            direction_B: self.direction_B.map(c),
            force: c(self.force),
            minimum_on_time: c(self.minimum_on_time),
            rise_time: c(self.rise_time),
            fall_time: c(self.fall_time),
            specific_impulse: c(self.specific_impulse),
            impulse_noise: c(self.impulse_noise),
        }
    }
}

impl Tank<f64> {
    /// The same tank over another scalar.
    pub fn cast<T: Real>(&self) -> Tank<T> {
        Tank {
            position_B: self.position_B.map(T::from_f64),
            propellant: T::from_f64(self.propellant),
        }
    }
}

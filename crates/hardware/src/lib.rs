//! What is bolted on, as plain data: joint drives, wheels, CMGs, thrusters, sensors, their limits. No
//! heap, no `std`: the flight code and the simulated world read the same numbers.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod actuators;
mod attitude_actuator;
mod cmg;
mod follower;
mod list;
mod sensor;
mod set_point;
mod slosh;
mod surface;
mod thruster;
mod wheel;

pub use actuators::{ActuatorCommand, ActuatorReadings, Actuators};
pub use attitude_actuator::{AttitudeActuator, AttitudeActuatorLimit};
pub use cmg::{CMGS, ControlMomentGyro};
pub use follower::{Follower, follow, follow_rates, through_gears};
pub use list::List;
pub use sensor::{RateGyro, Sensors, StarTracker, TrackerReading};
pub use set_point::{SetPoint, SetPointMotion};
pub use slosh::{Slosh, TankShape};
pub use surface::{Friction, Hardness, Surface};
pub use thruster::{STANDARD_GRAVITY, THRUSTERS, Tank, Thruster};
pub use wheel::{ReactionWheel, WHEELS};

/// What a joint and its drive can do. `None`: not limited, or not known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JointLimits<T> {
    /// Travel, lower and upper end (rad or m).
    pub travel: Option<(T, T)>,
    /// Largest rate (rad/s or m/s).
    pub rate: Option<T>,
    /// Largest torque or force of the drive (N·m or N).
    pub effort: Option<T>,
}

impl<T: wrasse_spatial::Real> JointLimits<T> {
    /// Zero, or the end of the travel that is nearest to it (rad or m).
    pub fn nearest_to_zero(&self) -> T {
        self.travel.map_or(T::zero(), |(lower, upper)| T::zero().max(lower).min(upper))
    }
}

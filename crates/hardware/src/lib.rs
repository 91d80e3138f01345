//! What is bolted on, as plain data: joint drives, attitude actuators, their limits. No heap, no
//! `std`: the flight code and the simulated world read the same numbers.
#![no_std]

mod set_point;

pub use set_point::{SetPoint, SetPointMotion};

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

/// An ideal attitude actuator: any torque up to a limit, at once, stored as momentum up to a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttitudeActuator<T> {
    /// Largest torque about each base axis (N·m).
    pub torque_limit: T,
    /// Largest stored momentum about each base axis (N·m·s).
    pub momentum_limit: T,
}

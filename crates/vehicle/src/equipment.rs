//! What is bolted on a base, read and checked, with the names of its units.

use crate::provenance::Provenance;
use wrasse_hardware::{Actuators, CMGS, Slosh, WHEELS};

/// Wheels, CMGs and thrusters, as the file describes them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Equipment {
    /// What the set is called in tables.
    pub name: String,
    /// What its units are and can do.
    pub actuators: Actuators<f64>,
    /// Names of the wheels, in order.
    pub wheel_names: Vec<String>,
    /// Names of the CMGs, in order.
    pub cmg_names: Vec<String>,
    /// Names of the thrusters, in order.
    pub thruster_names: Vec<String>,
    /// Speed of each wheel at the start (rad/s).
    pub wheel_speed: [f64; WHEELS],
    /// Angle of each gimbal at the start (rad).
    pub gimbal_angle: [f64; CMGS],
    /// How the propellant swings in the tank; `None`: it does not.
    pub slosh: Option<Slosh>,
    /// Mass of all units (kg), without propellant; `None` unless each says its own.
    pub mass: Option<f64>,
    /// Power of all units (W); `None` unless each says its own.
    pub power: Option<f64>,
    /// Where its numbers come from: those of the file, then those of the models that it names.
    pub provenance: Vec<Provenance>,
}

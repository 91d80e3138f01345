//! The tables `[actuators]` and `[sensors]` of vehicle and mission files, one file for each table in
//! them, and the catalogue of units.

mod actuators;
mod catalogue;
mod cmg;
mod cmg_array;
mod numbers;
mod rate_gyro;
mod sensors;
mod slosh;
mod star_tracker;
mod tank;
mod thruster;
mod thruster_set;
mod unit;
mod wheel;
mod wheel_array;

pub(crate) use actuators::equipment;
pub use actuators::{EquipmentFile, read_equipment};
pub use catalogue::{HardwareEntry, hardware, hardware_texts};
pub(crate) use sensors::sensors;
pub use sensors::{SensorsFile, read_sensors};

//! TOML vehicle files: one file for each table.

mod arm;
mod attitude_actuator;
mod body;
mod joint;
mod posture;
mod tool;
mod uniform;
mod vehicle;

pub(crate) use vehicle::read_toml;
pub use vehicle::vehicle_schema;

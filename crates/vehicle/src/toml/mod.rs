//! TOML vehicle files: one file for each table.

mod arm;
mod attitude_actuator;
mod body;
mod include;
mod joint;
mod posture;
mod tool;
mod uniform;
mod vehicle;

pub(crate) use include::{fix_joints, said_of_fix};
pub(crate) use posture::posture_of;
pub(crate) use vehicle::read_toml;
pub use vehicle::vehicle_schema;

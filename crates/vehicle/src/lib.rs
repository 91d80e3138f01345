//! Vehicle files (TOML, URDF, Denavit-Hartenberg rows) to checked vehicles.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod assemble;
mod assembly;
mod catalogue;
mod denavit_hartenberg;
mod figures;
mod findings;
mod format;
mod physical;
mod plausible;
mod provenance;
mod read_toml;
mod read_urdf;
mod read_vehicle;
mod roll_pitch_yaw;
mod rotation_in_degrees;
mod toml_body;
mod toml_joint;
mod toml_reading;
mod tree;
mod urdf_element;
mod urdf_joint;
mod urdf_link;
mod urdf_numbers;
mod vehicle;

pub use catalogue::{CatalogueEntry, NoVehicle, catalogue, find_vehicle};
pub use read_toml::vehicle_schema;
pub use read_vehicle::read_vehicle;
pub use vehicle::{
    Grade, JOINTS, NamedFrame, Posture, Provenance, Shape, ShapeKind, Vehicle, VehicleRobot,
};

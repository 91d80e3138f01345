//! Vehicle files (TOML, URDF, Denavit-Hartenberg rows) to checked vehicles.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod assemble;
mod assembly;
mod catalogue;
mod cmg_array;
mod denavit_hartenberg;
mod equipment;
mod equipment_format;
mod equipment_on_base;
mod figures;
mod findings;
mod format;
mod hardware_catalogue;
mod mounted_unit;
mod physical;
mod plausible;
mod provenance;
mod read_equipment;
mod read_sensors;
mod read_toml;
mod read_urdf;
mod read_vehicle;
mod roll_pitch_yaw;
mod rotation_in_degrees;
mod sensor_format;
mod spanning;
mod thruster_box;
mod toml_body;
mod toml_cmg;
mod toml_joint;
mod toml_reading;
mod toml_thruster;
mod toml_tool;
mod toml_wheel;
mod torque_cone;
mod tree;
mod unit_numbers;
mod urdf_element;
mod urdf_joint;
mod urdf_link;
mod urdf_numbers;
mod vehicle;

pub use catalogue::{CatalogueEntry, NoVehicle, catalogue, find_vehicle};
pub use equipment::Equipment;
pub use equipment_format::EquipmentFile;
pub use equipment_on_base::check_equipment;
pub use hardware_catalogue::{HardwareEntry, hardware};
pub use read_equipment::read_equipment;
pub use read_sensors::read_sensors;
pub use read_toml::vehicle_schema;
pub use read_vehicle::read_vehicle;
pub use rotation_in_degrees::from_rpy_deg;
pub use sensor_format::SensorsFile;
pub use vehicle::{
    Grade, GraspBounds, JOINTS, NamedFrame, Posture, Provenance, Shape, ShapeKind, Vehicle,
    VehicleRobot,
};

//! Vehicle files (TOML, URDF, MJCF, Denavit-Hartenberg rows) to checked vehicles.
//!
//! Rooms, each of which uses those before it: `table` (what all tables of a file share), `check`
//! (whether what a file says can be), `hardware` (the tables `[actuators]` and `[sensors]`, and the
//! catalogue of units), `xml` (what all readers of XML share), `toml`, `urdf` and `mjcf` (one file
//! for each table or element). `deep` takes a second look at the checked vehicle.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod assemble;
mod assembly;
mod catalogue;
mod check;
mod convert;
mod deep;
mod equipment;
mod figures;
mod findings;
mod followers;
mod hardware;
mod mjcf;
mod model;
mod provenance;
mod read_vehicle;
mod rotation;
mod table;
mod toml;
mod urdf;
mod vehicle;
mod xml;

pub use catalogue::{CatalogueEntry, NoVehicle, catalogue, find_vehicle};
pub use check::check_equipment;
pub use convert::{ConvertOptions, convert_to_toml};
pub use deep::{DeepCheck, Finding, FindingKind, FindingSeverity, Fine, Place};
pub use equipment::Equipment;
pub use hardware::{
    EquipmentFile, HardwareEntry, SensorsFile, hardware, hardware_texts, read_equipment,
    read_sensors,
};
pub use provenance::{Grade, Provenance};
pub use read_vehicle::read_vehicle;
pub use rotation::from_rpy_deg;
pub use table::{AttitudeFile, NotARotation, OrientationFile, QuaternionFile};
pub use toml::vehicle_schema;
pub use vehicle::{
    GraspBounds, JOINTS, LinkMatter, NamedFrame, Places, Posture, Shape, ShapeKind, Vehicle,
    VehicleRobot,
};
pub use wrasse_hardware::{Follower, follow, follow_rates};

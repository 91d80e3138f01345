//! Vehicle files (TOML, URDF, Denavit-Hartenberg rows) to checked vehicles.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod assembly;
mod vehicle;

pub use vehicle::{
    Grade, JOINTS, NamedFrame, Posture, Provenance, Shape, ShapeKind, Vehicle, VehicleRobot,
};

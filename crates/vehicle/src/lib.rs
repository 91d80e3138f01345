//! Vehicle files (TOML, URDF, Denavit-Hartenberg rows) to checked vehicles.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod assemble;
mod assembly;
mod figures;
mod findings;
mod physical;
mod plausible;
mod roll_pitch_yaw;
mod tree;
mod vehicle;

pub use vehicle::{
    Grade, JOINTS, NamedFrame, Posture, Provenance, Shape, ShapeKind, Vehicle, VehicleRobot,
};

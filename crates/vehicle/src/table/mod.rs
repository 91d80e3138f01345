//! What all tables of a TOML file share: a reading of them, orientations, sources.

mod orientation;
mod reading;
mod source;

pub use orientation::{AttitudeFile, NotARotation, OrientationFile, QuaternionFile};
pub(crate) use reading::{Reading, under};
pub(crate) use source::{ProvenanceFile, SourceFile, Sources, row};

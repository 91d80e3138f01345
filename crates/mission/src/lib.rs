//! A mission file, read and checked: the cases that it describes, to be rehearsed.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod as_flown;
mod check_loops;
mod dispersible;
mod fingerprint;
mod folder_name;
mod mission;
mod outcome;
mod read_mission;
mod reading;
mod replaced_settings;
mod run;
mod sampling;
mod toml;

pub use fingerprint::sha256;
pub use mission::{Mission, Study};
pub use outcome::{Outcome, ProvenanceRow, VehicleCard};
pub use read_mission::{mission_of, mission_schema, read_mission};
pub use run::{Progress, run};
pub use toml::study::ClaimIs;

//! `wrasse schema`: JSON Schemas for editors.

use crate::YES;
use crate::input::say;
use clap::{Args, ValueEnum};
use std::process::ExitCode;
use wrasse_mission::mission_schema;
use wrasse_vehicle::vehicle_schema;

/// Print the JSON Schema of a file format, for completion in an editor.
#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// Which format.
    format: Format,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// Vehicle files.
    Vehicle,
    /// Mission files.
    Mission,
}

impl Schema {
    pub(crate) fn go(&self) -> ExitCode {
        let schema = match self.format {
            Format::Vehicle => vehicle_schema(),
            Format::Mission => mission_schema(),
        };
        say(&format!("{schema:#}"));
        YES
    }
}

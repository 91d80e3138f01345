//! `wrasse schema`: JSON Schemas for editors, and every key with its meaning.

use crate::YES;
use crate::input::say;
use crate::keys::terminal;
use clap::{Args, ValueEnum};
use std::process::ExitCode;
use wrasse_mission::mission_schema;
use wrasse_vehicle::vehicle_schema;

/// Print the JSON Schema of a file format, for completion in an editor.
#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// Which format.
    format: Format,
    /// Print every key with meaning, unit, default and allowed values, for a reader.
    #[arg(long)]
    keys: bool,
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
        if self.keys {
            say(&terminal(&schema));
        } else {
            say(&format!("{schema:#}"));
        }
        YES
    }
}

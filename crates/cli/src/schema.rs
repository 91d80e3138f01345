//! `wrasse schema`: JSON Schemas for editors, and every key with its meaning.

use crate::YES;
use crate::input::say;
use crate::keys::terminal;
use clap::{Args, ValueEnum};
use std::process::ExitCode;
use wrasse_mission::mission_schema;
use wrasse_vehicle::vehicle_schema;

/// Print the keys of a file format: as JSON Schema for an editor, or in words.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  wrasse schema mission > mission.schema.json\n  wrasse schema vehicle --keys | less"
)]
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

//! `wrasse new`: a file to start from.

use crate::YES;
use crate::input::{Failure, file_of, say};
use crate::new_file::put_new;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_dynamics::BodyId;
use wrasse_mission::read_mission;
use wrasse_vehicle::{NoVehicle, Vehicle, find_vehicle, read_vehicle};

const VEHICLE: &str = include_str!("starts/vehicle.toml");
const MISSION: &str = include_str!("starts/mission.toml");

const EXAMPLES: &str = "Examples:
  wrasse new vehicle --out my-servicer.toml
  wrasse new mission --vehicle my-servicer.toml --out reach.toml
  wrasse run reach.toml";

/// Print a commented vehicle or mission file to start from. It runs as it stands.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct New {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// A servicer with one arm of three joints.
    #[command(after_help = "Example:\n  wrasse new vehicle chaser --out chaser.toml")]
    Vehicle {
        /// Its name, in place of my-servicer.
        name: Option<String>,
        #[command(flatten)]
        place: OutFile,
    },
    /// An arm reaches sideways while the attitude of its base is controlled.
    #[command(after_help = "Example:\n  wrasse new mission first --vehicle ssrms --out first.toml")]
    Mission {
        /// Its name, in place of my-mission.
        name: Option<String>,
        /// The vehicle: one of the catalogue, or a file. The mission starts in its first posture.
        #[arg(long, value_name = "VEHICLE", default_value = "atlas-class")]
        vehicle: String,
        #[command(flatten)]
        place: OutFile,
    },
}

/// Where the text goes.
#[derive(Debug, Args)]
struct OutFile {
    /// Write to this new file in place of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl OutFile {
    /// Where complaints about the text point.
    fn path(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| PathBuf::from("new.toml"))
    }
    fn take(&self, text: &str) -> Result<(), Failure> {
        match &self.out {
            None => say(text),
            Some(file) => {
                put_new(file, text)?;
                say(&format!("written: {}", file.display()));
            }
        }
        Ok(())
    }
}

impl New {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        match &self.what {
            What::Vehicle { name, place } => {
                let text = named(VEHICLE, name.as_deref());
                // A name that a file cannot have is complained of as in any file.
                read_vehicle(Path::new("new.toml"), &*text)?;
                place.take(&text)?;
            }
            What::Mission { name, vehicle, place } => {
                let text = named(MISSION, name.as_deref());
                let text = for_vehicle(&text, vehicle, place)?;
                read_mission(place.path(), &*text)?;
                place.take(&text)?;
            }
        }
        Ok(YES)
    }
}

fn named(text: &str, name: Option<&str>) -> String {
    name.map_or_else(|| text.to_owned(), |name| with_value(text, "name", name))
}

/// The mission for another vehicle: in its first posture, turned by an actuator that it has.
fn for_vehicle(text: &str, vehicle: &str, place: &OutFile) -> Result<String, Failure> {
    let path = Path::new(vehicle);
    let is_file = path.extension().is_some() || vehicle.contains(['/', '\\']);
    let (found, named) = if is_file {
        (read_vehicle(path, file_of(path)?.1)?, seen_from_folder_of(&place.path(), path)?)
    } else {
        (of_catalogue(vehicle)?, vehicle.to_owned())
    };
    let mut text = with_value(text, "vehicle", &named);
    text = match found.postures.first() {
        Some(first) => with_value(&text, "posture", &first.name),
        None => text.replacen("\nposture = ", "\n# posture = ", 1),
    };
    if found.attitude_actuator.is_none() {
        text = with_value(&text, "actuators", "unlimited");
    }
    // Of a vehicle without tools the frame at the tip, as its file has it, is guided.
    let tip = found.frames.iter().rev().find(|named| named.frame.body != BodyId::Base);
    if let Some(tip) = tip.filter(|_| found.tools.is_empty()) {
        text = with_value(&text.replacen("\n# tool = ", "\ntool = ", 1), "tool", &tip.name);
    }
    Ok(text)
}

fn of_catalogue(name: &str) -> Result<Vehicle, Failure> {
    find_vehicle(name, None).map_err(|why| match why {
        NoVehicle::NotFound { message, help, .. } => {
            Failure::Sentence(format!("{message}: {help}"))
        }
        NoVehicle::Faulty(complaints) => Failure::Complaints(complaints),
        _ => Failure::Sentence(format!("the vehicle {name:?} cannot be read")),
    })
}

/// The path of a file as another file names it. One that is not in that file's folder or below it is
/// named from the root.
fn seen_from_folder_of(other: &Path, file: &Path) -> Result<String, Failure> {
    let folder = other.parent().unwrap_or(Path::new(""));
    let seen = match file.strip_prefix(folder) {
        Ok(below) => below.to_owned(),
        Err(_) => std::path::absolute(file).map_err(|why| {
            Failure::Sentence(format!("{} cannot be named: {why}", file.display()))
        })?,
    };
    Ok(seen.display().to_string())
}

/// The text with another string as the value of the first key of this name. TOML takes the escapes of JSON.
fn with_value(text: &str, key: &str, value: &str) -> String {
    let begin = format!("{key} = ");
    let mut is_open = true;
    let lines = text.split_inclusive('\n').map(|line| {
        if is_open && line.starts_with(&begin) {
            is_open = false;
            return format!("{begin}{}\n", serde_json::Value::from(value));
        }
        line.to_owned()
    });
    lines.collect()
}

//! `wrasse vehicles`: the catalogue, and a vehicle of it.

use crate::YES;
use crate::input::{Failure, say, say_json};
use crate::vehicle_page::{VehicleFacts, page, wrapped};
use clap::Args;
use serde_json::json;
use std::process::ExitCode;
use wrasse_vehicle::{CatalogueEntry, NoVehicle, Vehicle, catalogue, find_vehicle};

/// List the vehicles that come with wrasse, or show one of them.
///
/// With NAME: what it is, its joints, tools and postures, where each number comes from, grouped by how
/// sure it is, and what is not public. `wrasse vehicles NAME --file > mine.toml` is a start for your own.
#[derive(Debug, Args)]
pub(crate) struct Vehicles {
    /// A vehicle of the catalogue, or a file.
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Print its file as it is.
    #[arg(long, requires = "name", conflicts_with = "json")]
    file: bool,
    /// Print the same facts as JSON.
    #[arg(long)]
    json: bool,
}

impl Vehicles {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let Some(name) = &self.name else { return list(self.json) };
        let vehicle = find_vehicle(name, None).map_err(no_vehicle)?;
        if self.file {
            say(&vehicle.text);
        } else if self.json {
            say_json(&json!(VehicleFacts::of(&vehicle)));
        } else {
            say(&page(&VehicleFacts::of(&vehicle)));
        }
        Ok(YES)
    }
}

fn no_vehicle(why: NoVehicle) -> Failure {
    match why {
        NoVehicle::Faulty(complaints) => Failure::Complaints(complaints),
        NoVehicle::NotFound { message, help, .. } => {
            Failure::Sentence(format!("{message}: {help}"))
        }
        other => Failure::Sentence(format!("{other:?}")),
    }
}

/// What a vehicle is for, as far as its joints and actuators tell.
pub(crate) fn kind(vehicle: &Vehicle) -> &'static str {
    let actuators = &vehicle.equipment.actuators;
    let units = actuators.wheels.len() + actuators.cmgs.len() + actuators.thrusters.len();
    if vehicle.robot.joint_count() > 0 {
        "servicer"
    } else if units > 0 || vehicle.attitude_actuator.is_some() {
        "free-flyer"
    } else {
        "client"
    }
}

/// The kinds in the order of the list, and its heads.
const KINDS: [(&str, &str); 3] =
    [("servicer", "servicers"), ("free-flyer", "free-flyers"), ("client", "clients")];

/// What tells the kinds apart.
const LEGEND: &str = "Servicers have joints; free-flyers have actuators and no joints; clients have \
                      neither. `wrasse vehicles NAME` shows one of them.";

/// Columns of a terminal.
const WIDTH: usize = 80;

fn list(as_json: bool) -> Result<ExitCode, Failure> {
    let vehicles: Vec<Vehicle> =
        catalogue().iter().map(CatalogueEntry::read).collect::<Result<_, _>>()?;
    if as_json {
        let entry = |vehicle: &Vehicle| {
            json!({
                "name": vehicle.name,
                "kind": kind(vehicle),
                "joints": vehicle.robot.joint_count(),
                "mass_kg": vehicle.robot.mass(),
                "summary": vehicle.summary,
            })
        };
        say_json(&json!(vehicles.iter().map(entry).collect::<Vec<_>>()));
        return Ok(YES);
    }
    let width = vehicles.iter().map(|vehicle| vehicle.name.len()).max().unwrap_or(0);
    for (of_kind, head) in KINDS {
        say(&format!("{head:width$}  {:>6}  {:>10}", "joints", "mass (kg)"));
        for vehicle in vehicles.iter().filter(|vehicle| kind(vehicle) == of_kind) {
            let (joints, mass) = (vehicle.robot.joint_count(), vehicle.robot.mass());
            say(&format!("{:width$}  {joints:>6}  {mass:>10.1}", vehicle.name));
            say(&wrapped(&vehicle.summary, 4, WIDTH));
        }
        say("");
    }
    say(&wrapped(LEGEND, 0, WIDTH));
    Ok(YES)
}

//! `wrasse vehicles`: the catalogue.

use crate::input::{complain, say};
use crate::{YES, bad};
use clap::Args;
use std::process::ExitCode;
use wrasse_vehicle::catalogue;

/// List the vehicles that come with wrasse.
#[derive(Debug, Args)]
pub(crate) struct Vehicles {
    /// Print the file of one of them, as a start for your own.
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

impl Vehicles {
    pub(crate) fn go(&self) -> ExitCode {
        if let Some(name) = &self.name {
            let Some(entry) = catalogue().iter().find(|entry| entry.name == name) else {
                let names: Vec<_> = catalogue().iter().map(|entry| entry.name).collect();
                crate::input::tell(&format!(
                    "error: no vehicle is called {name:?}: there are {}",
                    names.join(", ")
                ));
                return bad();
            };
            say(entry.text);
            return YES;
        }
        let width = catalogue().iter().map(|entry| entry.name.len()).max().unwrap_or(0);
        say(&format!("{:width$}  {:>6}  {:>10}  ", "name", "joints", "mass (kg)"));
        for entry in catalogue() {
            match entry.read() {
                Ok(vehicle) => say(&format!(
                    "{:width$}  {:>6}  {:>10.1}  {}",
                    entry.name,
                    vehicle.robot.joint_count(),
                    vehicle.robot.mass(),
                    vehicle.summary
                )),
                Err(complaints) => {
                    complain(&complaints);
                    return bad();
                }
            }
        }
        YES
    }
}

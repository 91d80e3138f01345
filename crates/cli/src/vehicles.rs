//! `wrasse vehicles`: the catalogue.

use crate::YES;
use crate::input::{Failure, say};
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
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let Some(name) = &self.name else { return list() };
        let Some(entry) = catalogue().iter().find(|entry| entry.name == name) else {
            let names: Vec<_> = catalogue().iter().map(|entry| entry.name).collect();
            let names = names.join(", ");
            let sentence = format!("no vehicle is called {name:?}: there are {names}");
            return Err(Failure::Sentence(sentence));
        };
        say(entry.text);
        Ok(YES)
    }
}

fn list() -> Result<ExitCode, Failure> {
    let width = catalogue().iter().map(|entry| entry.name.len()).max().unwrap_or(0);
    say(&format!("{:width$}  {:>6}  {:>10}  ", "name", "joints", "mass (kg)"));
    for entry in catalogue() {
        let vehicle = entry.read()?;
        let (joints, mass) = (vehicle.robot.joint_count(), vehicle.robot.mass());
        say(&format!("{:width$}  {joints:>6}  {mass:>10.1}  {}", entry.name, vehicle.summary));
    }
    Ok(YES)
}

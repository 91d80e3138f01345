//! The tables of a mission file, one file each: how a table is written, and its reader. A number's unit is in
//! its key.

pub(crate) mod actuators;
pub(crate) mod applied_wrench;
pub(crate) mod base_control;
pub(crate) mod compare;
pub(crate) mod control;
pub(crate) mod disperse;
pub(crate) mod estimation;
pub(crate) mod failure;
pub(crate) mod initial;
pub(crate) mod output;
pub(crate) mod payload;
pub(crate) mod phase;
pub(crate) mod pose;
pub(crate) mod requirement;
pub(crate) mod sensors;
pub(crate) mod steering;
pub(crate) mod study;
pub(crate) mod world;

use crate::toml::compare::AxisFile;
use crate::toml::control::ControlFile;
use crate::toml::disperse::DisperseFile;
use crate::toml::failure::FailureFile;
use crate::toml::initial::InitialFile;
use crate::toml::output::OutputFile;
use crate::toml::payload::PayloadFile;
use crate::toml::phase::PhaseFile;
use crate::toml::study::StudyFile;
use crate::toml::world::WorldFile;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_vehicle::{EquipmentFile, SensorsFile};

/// A mission: a vehicle, what it holds, what it shall do, under which laws, and what is required.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MissionFile {
    /// Name of the mission: letters, digits and dashes; the results go to out/NAME.
    pub(crate) name: String,
    /// What it is for, in a sentence or two.
    #[serde(default)]
    pub(crate) summary: String,
    /// A vehicle of the catalogue (`wrasse vehicles` lists them), or a file seen from this one.
    pub(crate) vehicle: String,
    /// Seed of everything random: noise of sensors and of thruster pulses.
    #[serde(default)]
    pub(crate) seed: u64,
    /// Where everything is at the start.
    #[serde(default)]
    pub(crate) initial: InitialFile,
    /// Rigid bodies that can be held, by name.
    #[serde(default)]
    pub(crate) payload: BTreeMap<String, PayloadFile>,
    /// Wheels, CMGs and thrusters; they replace the vehicle's.
    #[serde(default)]
    pub(crate) actuators: Option<EquipmentFile>,
    /// Sensors of attitude and joints; they replace the vehicle's.
    #[serde(default)]
    pub(crate) sensors: Option<SensorsFile>,
    /// Units that fail on the way.
    #[serde(default)]
    pub(crate) failure: Vec<FailureFile>,
    /// The simulated truth.
    #[serde(default)]
    pub(crate) world: WorldFile,
    /// The laws that fly.
    #[serde(default)]
    pub(crate) control: ControlFile,
    /// What happens, one after the other.
    #[serde(default)]
    pub(crate) phase: Vec<PhaseFile>,
    /// What must hold: `"tool.position_error.max <= 0.3 mm"`, with `during PHASE` for one phase only.
    #[serde(default)]
    pub(crate) requirements: Vec<String>,
    /// How much is recorded.
    #[serde(default)]
    pub(crate) output: OutputFile,
    /// What is not known exactly: `wrasse sweep` flies samples of it.
    #[serde(default)]
    pub(crate) disperse: Vec<DisperseFile>,
    /// Variants to compare: every combination of one row from each axis is run.
    #[serde(default)]
    pub(crate) compare: Vec<AxisFile>,
    /// What `wrasse size` makes of the variants.
    #[serde(default)]
    pub(crate) study: Option<StudyFile>,
}

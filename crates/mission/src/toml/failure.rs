//! `[[failure]]`: units that fail on the way.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::world::BaseFile;
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_flight::allocation::Unit;
use wrasse_rehearsal::FailureCase;
use wrasse_vehicle::Equipment;
use wrasse_world::Failure;

/// How a unit fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FailureKindFile {
    /// A wheel's motor gives no torque; the bearing rubs on.
    Dead,
    /// A gimbal stands still.
    Stuck,
    /// A thruster does not open.
    Shut,
    /// A thruster does not shut.
    Open,
}

/// A unit that fails.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FailureFile {
    /// Name of a wheel, CMG or thruster.
    pub(crate) unit: String,
    /// How it fails.
    pub(crate) kind: FailureKindFile,
    /// When.
    pub(crate) at_s: f64,
    /// How long after that it is reported to the flight computer, which disables the unit; never, if not
    /// given.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["told_after_s"]))]
    pub(crate) reported_after_s: Option<f64>,
}

/// Units that fail on the way.
pub(crate) fn failures(
    r: &mut Reading<'_>,
    file: &MissionFile,
    equipment: &Equipment,
) -> Vec<FailureCase> {
    let groups = [&equipment.wheel_names, &equipment.cmg_names, &equipment.thruster_names];
    let names: Vec<String> = groups.into_iter().flatten().cloned().collect();
    if file.world.base_attitude == BaseFile::Held && !file.failure.is_empty() {
        let message = "the base is held exactly: wheels, CMGs and thrusters do not act, and their \
                       failures change nothing"
            .into();
        r.warning(at!["failure"], message, "set world.base_attitude to \"controlled\"");
    }
    let mut all: Vec<FailureCase> = vec![];
    for (i, f) in file.failure.iter().enumerate() {
        let path = |key| [Step::Key("failure"), Step::Index(i), Step::Key(key)];
        let at = r.not_negative(&path("at_s"), f.at_s);
        let told_at =
            f.reported_after_s.map(|after| at + r.not_negative(&path("reported_after_s"), after));
        let there = names.contains(&f.unit);
        if !there && r.knows_actuators {
            r.find(&path("unit"), "wheel, CMG or thruster", &f.unit, &names);
        }
        if !there {
            continue;
        }
        let place = |group: &[String]| group.iter().position(|n| *n == f.unit);
        let (unit, breaks) = match (f.kind, groups.map(|g| place(g))) {
            (FailureKindFile::Dead, [Some(n), ..]) => (Unit::Wheel(n), Failure::Wheel(n)),
            (FailureKindFile::Stuck, [_, Some(n), _]) => (Unit::Cmg(n), Failure::Gimbal(n)),
            (FailureKindFile::Shut, [.., Some(n)]) => (Unit::Thruster(n), Failure::ThrusterShut(n)),
            (FailureKindFile::Open, [.., Some(n)]) => (Unit::Thruster(n), Failure::ThrusterOpen(n)),
            _ => {
                let message = format!("{} cannot fail in this way", f.unit);
                let help =
                    "a wheel can be \"dead\", a CMG \"stuck\", a thruster \"shut\" or \"open\"";
                r.error(&path("kind"), message, help);
                continue;
            }
        };
        let same =
            |other: &FailureCase| other.unit == unit && (other.breaks == breaks || other.at == at);
        if all.iter().any(same) {
            let message = format!("{} has already failed, in this way or at this time", f.unit);
            r.error(&path("unit"), message, "a unit fails in one way once: leave this failure out");
            continue;
        }
        let how = format!("{:?}", f.kind).to_lowercase();
        all.push(FailureCase { name: f.unit.clone(), how, unit, breaks, at, told_at });
    }
    all
}

//! `[actuators]`: wheels, CMGs and thrusters, in place of the vehicle's; and which of them turn the base.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::vector;
use crate::toml::world::BaseFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::{Severity, at};
use wrasse_flight::allocation::preferred_angles;
use wrasse_rehearsal::AttitudeActuation;
use wrasse_vehicle::{Equipment, check_equipment, read_equipment};

/// Which actuators turn the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ActuatorsFile {
    /// The vehicle's ideal `[attitude_actuator]`, with its limits.
    Ideal,
    /// An ideal one without limits: it shows what is asked for.
    Unlimited,
    /// The wheels, CMGs and thrusters of `[actuators]`.
    Fitted,
}

/// Wheels, CMGs and thrusters of this mission.
pub(crate) fn equipment(r: &mut Reading<'_>, file: &MissionFile) -> Equipment {
    let mut equipment = given_equipment(r, file);
    if let Some(direction) = file.control.steering.preferred_for {
        if let Some(angles) = preferred_angles(&equipment.actuators.cmgs, vector(direction)) {
            equipment.gimbal_angle = angles;
        } else {
            let message = "no gimbal angles can be searched for this direction".into();
            let help = "it takes CMGs whose rotors can cancel each other, and a direction that has a \
                        length";
            r.error(at!["control", "steering", "preferred_for"], message, help);
        }
    }
    equipment
}

fn given_equipment(r: &mut Reading<'_>, file: &MissionFile) -> Equipment {
    match &file.actuators {
        None => r.vehicle.equipment.clone(),
        Some(given) => {
            let path = at!["actuators"];
            let (equipment, found) = read_equipment(r.document, path, given);
            r.knows_actuators = found.iter().all(|c| c.severity != Severity::Error);
            r.complaints.extend(found);
            let robot = &r.vehicle.robot;
            r.complaints.extend(check_equipment(r.document, path, &equipment, robot));
            equipment
        }
    }
}

/// What turns the base of this mission.
pub(crate) fn actuation(
    r: &mut Reading<'_>,
    file: &MissionFile,
    equipment: &Equipment,
) -> AttitudeActuation {
    let ideal = r.vehicle.attitude_actuator;
    if file.world.base_attitude != BaseFile::Controlled {
        return AttitudeActuation::Ideal(ideal);
    }
    let none = r.knows_actuators && equipment.actuators.is_empty();
    let add = "add [actuators] to the mission or to the vehicle's file";
    match file.control.actuators {
        Some(ActuatorsFile::Unlimited) => return AttitudeActuation::Ideal(None),
        Some(ActuatorsFile::Ideal) if ideal.is_none() => {
            let message = format!("vehicle {} has no attitude actuator", file.vehicle);
            let help = "add [attitude_actuator] to its file, or choose \"unlimited\"";
            r.error(at!["control", "actuators"], message, help);
        }
        Some(ActuatorsFile::Fitted) if none => {
            let message = format!("vehicle {} has no wheels, CMGs or thrusters", file.vehicle);
            r.error(at!["control", "actuators"], message, add);
        }
        None if none && ideal.is_none() => {
            let message = format!("vehicle {} has no attitude actuator", file.vehicle);
            let help = format!(
                "{add}, set control.actuators = \"unlimited\", or choose \"held\" or \"free\""
            );
            r.error(at!["world", "base_attitude"], message, &help);
        }
        Some(ActuatorsFile::Fitted) => return AttitudeActuation::Fitted,
        None if !none => return AttitudeActuation::Fitted,
        Some(ActuatorsFile::Ideal) | None => {}
    }
    AttitudeActuation::Ideal(ideal)
}

/// Doubts units that are fitted and do nothing.
pub(crate) fn doubt_idle_units(
    r: &mut Reading<'_>,
    file: &MissionFile,
    actuation: AttitudeActuation,
    equipment: &Equipment,
) {
    let is_controlled = file.world.base_attitude == BaseFile::Controlled;
    // Of failing units on a held base it is said with their failures.
    if file.world.base_attitude == BaseFile::Held && !file.failure.is_empty() {
        return;
    }
    if equipment.actuators.is_empty() || (is_controlled && actuation == AttitudeActuation::Fitted) {
        return;
    }
    let (path, why, help) = if is_controlled {
        (
            at!["control", "actuators"],
            "an ideal actuator turns the base",
            "\"fitted\" flies with them",
        )
    } else {
        let why = match file.world.base_attitude {
            BaseFile::Held => "the base is held from outside",
            _ => "the base floats",
        };
        (at!["world", "base_attitude"], why, "\"controlled\" flies with them")
    };
    let by_default = if r.is_there(path) { "" } else { ", by default" };
    let message = format!(
        "wheels, CMGs and thrusters are fitted and do nothing: {why}{by_default}; their masses count"
    );
    r.warning(path, message, help);
}

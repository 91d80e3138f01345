//! `[sensors]`: sensors of attitude and joints, in place of the vehicle's.

use crate::reading::Reading;
use crate::toml::MissionFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::at;
use wrasse_hardware::Sensors;
use wrasse_vehicle::read_sensors;

/// What the laws know the state by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SensingFile {
    /// Perfect sensors.
    Perfect,
    /// The sensors of `[sensors]`, and estimates made of what they say.
    Fitted,
}

/// Sensors of this mission as they are fitted, and those that the laws use; `None`: perfect ones.
pub(crate) fn sensors(
    r: &mut Reading<'_>,
    file: &MissionFile,
) -> (Sensors<f64>, Option<Sensors<f64>>) {
    let mut sensors = r.vehicle.sensors;
    if let Some(given) = &file.sensors {
        let (read, found) = read_sensors(r.document, at!["sensors"], given);
        r.complaints.extend(found);
        sensors = read;
    }
    let there = sensors != Sensors::default();
    let used = match file.control.sensing {
        Some(SensingFile::Perfect) => None,
        Some(SensingFile::Fitted) if !there => {
            let message = format!("vehicle {} has no sensors", file.vehicle);
            let help = "add [sensors] to the mission or to the vehicle's file";
            r.error(at!["control", "sensing"], message, help);
            None
        }
        _ => there.then_some(sensors),
    };
    (sensors, used)
}

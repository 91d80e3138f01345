//! The table `[attitude_actuator]`: an ideal one.

use crate::table::{ProvenanceFile, Reading};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::at;
use wrasse_hardware::AttitudeActuator;

/// An ideal attitude actuator: any torque up to its limit, at once, stored as momentum.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ActuatorFile {
    /// Largest torque about each base axis (N·m).
    pub(crate) torque_limit_nm: f64,
    /// Largest stored momentum about each base axis (N·m·s).
    pub(crate) momentum_limit_nms: f64,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The ideal attitude actuator; complains of limits that are not positive.
pub(crate) fn attitude_actuator(
    reading: &mut Reading<'_>,
    file: &ActuatorFile,
) -> AttitudeActuator<f64> {
    for (key, limit, unit) in [
        ("torque_limit_nm", file.torque_limit_nm, "N·m"),
        ("momentum_limit_nms", file.momentum_limit_nms, "N·m·s"),
    ] {
        if limit <= 0.0 {
            let message =
                format!("`{key}` of the attitude actuator must be positive, found {limit} {unit}");
            let help = "a vehicle without attitude actuator has no [attitude_actuator]";
            reading.error(at!["attitude_actuator", key], message, "this limit", help);
        }
    }
    AttitudeActuator { torque_limit: file.torque_limit_nm, momentum_limit: file.momentum_limit_nms }
}

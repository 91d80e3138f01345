//! The table `[actuators.tank]`.

use super::slosh::SloshFile;
use crate::table::{ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::Tank;
use wrasse_spatial::Vec3;

/// The tank of the thrusters.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TankFile {
    /// Propellant at the start (kg), on top of the masses of the bodies.
    pub(crate) propellant_kg: f64,
    /// Centre of the propellant, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How the propellant swings; a point at rest if not given.
    pub(crate) slosh: Option<SloshFile>,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The tank.
pub(crate) fn tank(reading: &mut Reading<'_>, path: &[Step<'_>], file: &TankFile) -> Tank<f64> {
    let found = file.propellant_kg;
    if found < 0.0 {
        let message = format!("`propellant_kg` of the tank must be zero or more, found {found}");
        let help = "without a tank the thrusters never run dry: leave out [actuators.tank]";
        reading.error(&under(path, "propellant_kg"), message, "this mass", help);
    }
    Tank { position_B: Vec3::from_array(file.position_m), propellant: found }
}

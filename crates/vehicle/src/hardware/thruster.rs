//! The tables `[[actuators.thruster]]`.

use super::catalogue::ModelsUsed;
use super::numbers::{ThrusterNumbers, check_there};
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile, direction};
use crate::table::{ProvenanceFile, Reading};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::Thruster;
use wrasse_spatial::Vec3;

/// Where a force acts (m) and its unit direction (–).
pub(crate) type Push = (Vec3<f64>, Vec3<f64>);

/// A thruster: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrusterFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A thruster of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Where its force acts, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// Direction of the force on the vehicle, base axes (–); any length. The plume goes the other way.
    pub(crate) direction: [f64; 3],
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: ThrusterNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

impl UnitFile for ThrusterFile {
    const KEY: &'static str = "thruster";
    type Unit = Thruster<f64>;
    fn head(&self) -> Head<'_> {
        let model = self.model.as_deref();
        Head { name: &self.name, model, provenance: &self.provenance }
    }
    fn read(
        &self,
        reading: &mut Reading<'_>,
        models: &mut ModelsUsed,
        path: &[Step<'_>],
    ) -> Option<Vec<MountedUnit<Self::Unit>>> {
        let of = format!("thruster '{}'", self.name);
        let direction = direction(reading, path, &of, "direction", self.direction);
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let nozzle = nozzle(reading, path, &of, &numbers);
        let unit = mounted(nozzle?, (Vec3::from_array(self.position_m), direction?));
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "thruster", mass_power);
        Some(vec![MountedUnit { unit, start: 0.0, entry }])
    }
}

/// A thruster without mounting, on its mounting.
pub(crate) fn mounted(nozzle: Thruster<f64>, (position_B, direction_B): Push) -> Thruster<f64> {
    Thruster { position_B, direction_B, ..nozzle }
}

/// What a thruster can do, its mounting left open; complains of what is missing.
pub(crate) fn nozzle(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &ThrusterNumbers,
) -> Option<Thruster<f64>> {
    let due = [("force_n", numbers.force_n), ("specific_impulse_s", numbers.specific_impulse_s)];
    check_there(reading, path, of, &due);
    Some(Thruster {
        position_B: Vec3::zero(),
        direction_B: Vec3::zero(),
        force: numbers.force_n?,
        specific_impulse: numbers.specific_impulse_s?,
        minimum_on_time: numbers.minimum_on_time_s.unwrap_or(0.0),
        rise_time: numbers.rise_time_s.unwrap_or(0.0),
        fall_time: numbers.fall_time_s.unwrap_or(0.0),
        impulse_noise: numbers.impulse_noise_percent.unwrap_or(0.0) / 100.0,
    })
}

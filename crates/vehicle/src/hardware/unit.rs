//! A unit of `[actuators]`: the table that gives it, and what was read of it.

use super::catalogue::ModelsUsed;
use crate::figures::figures;
use crate::table::{ProvenanceFile, Reading, under};
use std::ops::Range;
use wrasse_document::Step;
use wrasse_spatial::Vec3;

/// A table that gives one unit, or several equal ones.
pub(crate) trait UnitFile {
    /// Its key in `[actuators]`.
    const KEY: &'static str;
    /// What it gives.
    type Unit: Copy;
    /// What it says of itself.
    fn head(&self) -> Head<'_>;
    /// Its units; none after a complaint if they cannot be.
    fn read(
        &self,
        reading: &mut Reading<'_>,
        models: &mut ModelsUsed,
        path: &[Step<'_>],
    ) -> Option<Vec<MountedUnit<Self::Unit>>>;
}

/// What the table of any unit says.
pub(crate) struct Head<'f> {
    pub(crate) name: &'f str,
    pub(crate) model: Option<&'f str>,
    pub(crate) provenance: &'f ProvenanceFile,
}

/// A unit that was read.
#[derive(Debug, Clone)]
pub(crate) struct MountedUnit<U> {
    pub(crate) unit: U,
    /// Speed of a wheel (rad/s) or angle of a gimbal (rad) at the start.
    pub(crate) start: f64,
    pub(crate) entry: UnitEntry,
}

/// What lists and complaints say of a unit of any kind.
#[derive(Debug, Clone)]
pub(crate) struct UnitEntry {
    /// What it is called, and where that stands.
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Its model, or what kind of unit it is.
    pub(crate) label: String,
    /// Mass (kg) and power (W), if it says them.
    pub(crate) mass: Option<f64>,
    pub(crate) power: Option<f64>,
}

impl UnitEntry {
    /// Of a table at a path; without a model it is of this `kind`.
    pub(crate) fn of(
        reading: &Reading<'_>,
        path: &[Step<'_>],
        file: &impl UnitFile,
        kind: &str,
        (mass, power): (Option<f64>, Option<f64>),
    ) -> Self {
        let Head { name, model, .. } = file.head();
        let label = model.unwrap_or(kind).to_owned();
        Self { name: name.to_owned(), at: reading.below(path, "name"), label, mass, power }
    }
    /// Of one of several equal units, counted from zero.
    pub(crate) fn numbered(&self, k: usize) -> Self {
        Self { name: format!("{}-{}", self.name, k + 1), ..self.clone() }
    }
}

/// The unit direction of a vector that the file gives at `key`; `None` and a complaint if it is zero.
pub(crate) fn direction(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    key: &str,
    given: [f64; 3],
) -> Option<Vec3<f64>> {
    // Scaled by the largest first: the square of a long vector may not be a number.
    let largest = given.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if largest > 0.0 && largest.is_finite() {
        let scaled = Vec3::from_array(given) * (1.0 / largest);
        let length = scaled.norm();
        // Components that are too small to divide by.
        if length.is_finite() {
            return Some(scaled * (1.0 / length));
        }
    }
    let [x, y, z] = given.map(figures);
    let message = format!("`{key}` of {of} has no direction, found [{x}, {y}, {z}]");
    let help = "a direction has any length but zero: [1, 0, 0]";
    reading.error(&under(path, key), message, "no direction", help);
    None
}

//! A unit on its mounting, as it is read: with its name, its place in the file and its start.

use crate::figures::figures;
use crate::toml_reading::{Reading, under};
use std::ops::Range;
use wrasse_document::Step;
use wrasse_spatial::Vec3;

/// A unit that was read.
#[derive(Debug, Clone)]
pub(crate) struct Mounted<U> {
    /// What it is called, and where that stands.
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Its model, or what kind of unit it is: for tables.
    pub(crate) label: String,
    pub(crate) unit: U,
    /// Speed of a wheel (rad/s) or angle of a gimbal (rad) at the start.
    pub(crate) start: f64,
    /// Mass (kg) and power (W), if it says them.
    pub(crate) mass: Option<f64>,
    pub(crate) power: Option<f64>,
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

//! The table `[sensors.gyro]`: a rate gyro of three axes.

use super::catalogue::ModelsUsed;
use super::numbers::{RateGyroNumbers, check_there};
use crate::table::{ProvenanceFile, Reading};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::RateGyro;
use wrasse_spatial::Vec3;

/// One degree in an hour (rad/s).
const DEG_PER_HOUR: f64 = core::f64::consts::PI / 180.0 / 3600.0;
/// The square root of an hour (√s).
const ROOT_HOUR: f64 = 60.0;

/// A rate gyro: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RateGyroFile {
    /// A rate gyro of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Bias at the start about each base axis (deg/h); zero if not given.
    pub(crate) bias_deg_h: Option<[f64; 3]>,
    /// How well it feels.
    #[serde(flatten)]
    pub(crate) numbers: RateGyroNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The rate gyro; `None` after a complaint if it is not one.
pub(crate) fn rate_gyro(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &RateGyroFile,
) -> Option<RateGyro<f64>> {
    let of = "the rate gyro";
    let numbers = models.numbers(reading, path, of, file.model.as_deref(), file.numbers)?;
    let due = [
        ("angle_random_walk_deg_sqrt_h", numbers.angle_random_walk_deg_sqrt_h),
        ("bias_random_walk_deg_h_sqrt_h", numbers.bias_random_walk_deg_h_sqrt_h),
    ];
    check_there(reading, path, of, &due);
    let bias = Vec3::from_array(file.bias_deg_h.unwrap_or_default());
    Some(RateGyro {
        bias_B: bias * DEG_PER_HOUR,
        angle_random_walk: numbers.angle_random_walk_deg_sqrt_h?.to_radians() / ROOT_HOUR,
        bias_random_walk: numbers.bias_random_walk_deg_h_sqrt_h? * DEG_PER_HOUR / ROOT_HOUR,
        rate_step: numbers.rate_step_deg_s.unwrap_or(0.0).to_radians(),
    })
}

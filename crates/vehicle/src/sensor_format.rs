//! The table `[sensors]` of vehicle and mission files.

use crate::format::SourceFile;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// What a vehicle is felt with. What is not there is perfect.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorsFile {
    /// Rate gyro of three axes; it comes together with a star tracker.
    pub(crate) gyro: Option<RateGyroFile>,
    /// Star tracker; it comes together with a rate gyro.
    pub(crate) star_tracker: Option<StarTrackerFile>,
    /// Joint positions are rounded to multiples of this (deg); those of joints that slide to as many
    /// metres as it has radians. Not rounded if not given.
    pub(crate) encoder_step_deg: Option<f64>,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

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
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// How well a rate gyro feels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
pub(crate) struct RateGyroNumbers {
    /// Random walk of the angle (deg/√h).
    pub(crate) angle_random_walk_deg_sqrt_h: Option<f64>,
    /// Random walk of the bias (deg/h for each √h).
    pub(crate) bias_random_walk_deg_h_sqrt_h: Option<f64>,
    /// Rates are rounded to multiples of this (deg/s); not rounded if not given.
    pub(crate) rate_step_deg_s: Option<f64>,
}

/// A star tracker: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StarTrackerFile {
    /// A star tracker of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Direction in which it looks, base axes (–); any length.
    pub(crate) boresight: [f64; 3],
    /// How well it sees.
    #[serde(flatten)]
    pub(crate) numbers: StarTrackerNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// How well a star tracker sees.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
pub(crate) struct StarTrackerNumbers {
    /// Standard deviation about each axis across the boresight (arcsec).
    pub(crate) noise_across_arcsec: Option<f64>,
    /// Standard deviation about the boresight (arcsec).
    pub(crate) noise_about_arcsec: Option<f64>,
    /// Readings in a second (Hz).
    pub(crate) rate_hz: Option<f64>,
    /// Age of a reading when it arrives (s); zero if not given.
    pub(crate) latency_s: Option<f64>,
    /// Rate of the base above which it sees nothing (deg/s).
    pub(crate) rate_limit_deg_s: Option<f64>,
}

//! The table `[sensors.star_tracker]`.

use super::catalogue::ModelsUsed;
use super::numbers::{StarTrackerNumbers, check_there};
use super::unit::direction;
use crate::table::{ProvenanceFile, Reading};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::StarTracker;

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
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The star tracker; `None` after a complaint if it is not one.
pub(crate) fn star_tracker(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &StarTrackerFile,
) -> Option<StarTracker<f64>> {
    let of = "the star tracker";
    let boresight = direction(reading, path, of, "boresight", file.boresight);
    let numbers = models.numbers(reading, path, of, file.model.as_deref(), file.numbers)?;
    let due = [
        ("noise_across_arcsec", numbers.noise_across_arcsec),
        ("noise_about_arcsec", numbers.noise_about_arcsec),
        ("rate_hz", numbers.rate_hz),
        ("rate_limit_deg_s", numbers.rate_limit_deg_s),
    ];
    check_there(reading, path, of, &due);
    let arcsec = |angle: f64| (angle / 3600.0).to_radians();
    Some(StarTracker {
        boresight_B: boresight?,
        noise_across: arcsec(numbers.noise_across_arcsec?),
        noise_about: arcsec(numbers.noise_about_arcsec?),
        interval: 1.0 / numbers.rate_hz?,
        latency: numbers.latency_s.unwrap_or(0.0),
        rate_limit: numbers.rate_limit_deg_s?.to_radians(),
    })
}

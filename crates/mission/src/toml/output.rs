//! `[output]`: how much is recorded.

use crate::reading::Reading;
use crate::toml::MissionFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::at;

/// How much is recorded.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct OutputFile {
    /// Samples per second in the telemetry; metrics always see every control period.
    pub(crate) rate_hz: f64,
    /// Instants in the drawing of the motion.
    pub(crate) snapshots: u32,
}

impl Default for OutputFile {
    fn default() -> Self {
        Self { rate_hz: 20.0, snapshots: 6 }
    }
}

/// Fewest and most instants in a drawing.
const SNAPSHOTS: (f64, f64) = (2.0, 40.0);

/// Samples per second in the telemetry.
pub(crate) fn output_rate(r: &mut Reading<'_>, file: &MissionFile) -> f64 {
    let why = "the first and the last instant are always drawn, and more do not fit in a picture";
    let count = f64::from(file.output.snapshots);
    r.within(at!["output", "snapshots"], count, SNAPSHOTS, why);
    r.positive(at!["output", "rate_hz"], file.output.rate_hz)
}

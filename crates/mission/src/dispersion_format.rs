//! What a mission file says of the things that are not known exactly.

use schemars::JsonSchema;
use serde::Deserialize;

/// Something that is not known exactly: each sample of a sweep draws how far it is from what the files
/// say.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DisperseFile {
    /// What it is, with its unit: `payload.module.mass_kg`, `initial.joints_deg.elbow`.
    pub(crate) quantity: String,
    /// Standard deviation of a normal deviation.
    #[serde(default)]
    pub(crate) sigma: Option<f64>,
    /// The farthest that a normal deviation goes: what is beyond is cut away.
    #[serde(default)]
    pub(crate) within: Option<f64>,
    /// Least and largest deviation, with all between them alike.
    #[serde(default)]
    pub(crate) between: Option<[f64; 2]>,
    /// Whether the flight computer knows what was drawn, of masses and sensors.
    #[serde(default)]
    pub(crate) known: bool,
}

//! `[[world.applied_wrench]]`: wrenches from outside.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::{AxesFile, axes, tool, vector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::Step;
use wrasse_rehearsal::AppliedWrench;
use wrasse_spatial::SpatialForce;

/// A wrench from outside on the vehicle.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrenchFile {
    /// The tool or frame at whose origin it acts.
    pub(crate) on: String,
    /// Force.
    #[serde(default)]
    pub(crate) force_n: [f64; 3],
    /// Torque.
    #[serde(default)]
    pub(crate) torque_nm: [f64; 3],
    /// Axes of force and torque.
    #[serde(default = "crate::toml::pose::inertial")]
    pub(crate) axes: AxesFile,
    /// When it begins.
    pub(crate) from_s: f64,
    /// How long it lasts, rise and fall included.
    pub(crate) duration_s: f64,
    /// Time in which it rises, and falls, as a raised cosine.
    #[serde(default)]
    pub(crate) ramp_s: f64,
}

/// Wrenches from outside.
pub(crate) fn applied_wrenches(r: &mut Reading<'_>, file: &MissionFile) -> Vec<AppliedWrench> {
    let mut all = vec![];
    for (i, w) in file.world.applied_wrench.iter().enumerate() {
        let path =
            |key| [Step::Key("world"), Step::Key("applied_wrench"), Step::Index(i), Step::Key(key)];
        let duration = r.positive(&path("duration_s"), w.duration_s);
        let ramp = r.not_negative(&path("ramp_s"), w.ramp_s);
        if ramp > 0.5 * duration {
            let message =
                format!("it rises in {ramp} s and falls in {ramp} s, and lasts {duration} s");
            r.error(&path("ramp_s"), message, "at most half of duration_s");
        }
        all.push(AppliedWrench {
            on: tool(r, &path("on"), &w.on),
            wrench: SpatialForce::new(vector(w.torque_nm), vector(w.force_n)),
            axes: axes(w.axes),
            from: r.not_negative(&path("from_s"), w.from_s),
            duration,
            ramp,
        });
    }
    all
}

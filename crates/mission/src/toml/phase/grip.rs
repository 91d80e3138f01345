//! `grasp` and `release`.

use crate::reading::Reading;
use crate::toml::phase::hold::KeepFile;
use crate::toml::pose::grasp_bounds;
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_vehicle::GraspBounds;
use wrasse_world::GripOffset;

/// A grasp: the tool takes the payload by its grip at the end of one control period, if distance and
/// angle are within the `grasp_bounds` of the tool in the vehicle file.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GraspFile {
    /// Name of the payload.
    pub(crate) payload: String,
    /// Largest relative speed of tool and payload; above it the grasp is refused.
    pub(crate) largest_speed_m_s: f64,
    /// Largest relative turning speed.
    pub(crate) largest_turn_speed_deg_s: f64,
    /// What stays meanwhile.
    #[serde(default)]
    pub(crate) keep: KeepFile,
}

/// A release: the tool lets go at the end of one control period.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReleaseFile {
    /// Name of the payload.
    pub(crate) payload: String,
    /// What stays meanwhile.
    #[serde(default)]
    pub(crate) keep: KeepFile,
}

/// What a grasp allows: places by the tool that is guided, speeds by the phase.
pub(super) fn bounds(
    r: &mut Reading<'_>,
    above: &[Step<'_>],
    grasp: &GraspFile,
    tool: Option<&str>,
) -> GripOffset {
    let path = |key| [above, at!["grasp", key]].concat();
    let turn = r.not_negative(&path("largest_turn_speed_deg_s"), grasp.largest_turn_speed_deg_s);
    let linear_speed = r.not_negative(&path("largest_speed_m_s"), grasp.largest_speed_m_s);
    let GraspBounds { distance, angle } = grasp_bounds(r.vehicle, tool);
    GripOffset { distance, angle, angular_speed: turn.to_radians(), linear_speed }
}

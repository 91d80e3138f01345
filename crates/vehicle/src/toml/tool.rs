//! The tables `[[tool]]`: where it is, and how well a grip must lie in it.

use crate::assembly::{AssemblyJoint, Link};
use crate::table::{OrientationFile, Reading, SourceFile, under};
use crate::vehicle::GraspBounds;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::{Step, at};
use wrasse_hardware::JointLimits;
use wrasse_spatial::vec3;

/// A named frame where a tool works or a payload is held.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// The body that carries it.
    #[schemars(length(min = 1))]
    pub(crate) on: String,
    /// Its origin, in the body's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How it is turned from the body's frame; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// How far the grip of a payload may be from the tool when it grasps it.
    #[serde(default)]
    pub(crate) grasp_bounds: GraspBoundsFile,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
}

/// How far the grip of a payload may be from a tool that grasps it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct GraspBoundsFile {
    /// Largest distance between the origins of tool and grip (m).
    pub(crate) distance_m: f64,
    /// Largest angle between their axes (deg).
    pub(crate) angle_deg: f64,
}

impl Default for GraspBoundsFile {
    fn default() -> Self {
        Self { distance_m: 0.005, angle_deg: 0.5 }
    }
}

impl Default for GraspBounds {
    /// Those of a file that says nothing: 5 mm and 0.5 deg.
    fn default() -> Self {
        let GraspBoundsFile { distance_m, angle_deg } = GraspBoundsFile::default();
        Self { distance: distance_m, angle: angle_deg.to_radians() }
    }
}

/// A tool is a massless link, fixed to its body.
pub(crate) fn tool(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &ToolFile,
) -> (Link, AssemblyJoint) {
    let at = reading.below(path, "name");
    let mount = AssemblyJoint {
        name: format!("mount of {}", file.name),
        at: at.clone(),
        parent: file.on.clone(),
        parent_at: reading.below(path, "on"),
        child: file.name.clone(),
        child_at: at.clone(),
        kind: None,
        X_PC: reading.pose(path, file.position_m, file.orientation.as_ref()),
        axis: vec3(0.0, 0.0, 1.0),
        axis_at: at.clone(),
        limits: JointLimits::default(),
        limits_at: at.clone(),
        rotor: 0.0,
        mimic: None,
    };
    (Link { name: file.name.clone(), at, matter: None }, mount)
}

/// How far a grip may be from each tool, in the order of the file.
pub(crate) fn grasp_bounds(reading: &mut Reading<'_>, tools: &[ToolFile]) -> Vec<GraspBounds> {
    let each = tools.iter().enumerate();
    each.map(|(i, tool)| {
        let path = under(at!["tool", i], "grasp_bounds");
        let mut within = |key: &str, value: f64, largest: f64, unit: &str| {
            if value > 0.0 && value <= largest {
                return value;
            }
            let message = format!(
                "{key} of tool '{}' must be above 0 and at most {largest} {unit}, found {value}",
                tool.name
            );
            let help = "leave it out for 5 mm and 0.5 deg";
            reading.error(&under(&path, key), message, "this bound", help);
            largest
        };
        let file = &tool.grasp_bounds;
        GraspBounds {
            distance: within("distance_m", file.distance_m, 10.0, "m"),
            angle: within("angle_deg", file.angle_deg, 180.0, "deg").to_radians(),
        }
    })
    .collect()
}

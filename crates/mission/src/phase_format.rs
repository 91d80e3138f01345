//! The phases of a mission file, as they are written.

use crate::format::AttitudeFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One phase: a name and exactly one thing to do.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PhaseFile {
    /// Its name.
    pub(crate) name: String,
    /// The tool goes on a straight line, turning on the shortest way.
    pub(crate) move_tool: Option<MoveToolFile>,
    /// All joints go to a posture, starting and ending together.
    pub(crate) move_joints: Option<MoveJointsFile>,
    /// Nothing new is asked for a while.
    pub(crate) hold: Option<HoldFile>,
    /// The arm moves so that what pushes at the tool asks the base to store less momentum, without
    /// turning it.
    #[schemars(extend("x-formerly" = ["relieve"]))]
    pub(crate) unload_by_posture: Option<UnloadByPostureFile>,
    /// The tool grasps a free payload.
    pub(crate) grasp: Option<GraspFile>,
    /// The tool lets go of a payload.
    pub(crate) release: Option<ReleaseFile>,
}

/// Axes that a target is fixed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AxesFile {
    /// Inertial space.
    Inertial,
    /// The base, wherever it goes.
    Base,
}

/// A straight line of the tool.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MoveToolFile {
    /// Displacement from where the tool is.
    pub(crate) by_m: Option<[f64; 3]>,
    /// Turn from how the tool is: rotation vector, of up to ten turns (3600 deg).
    pub(crate) turn_by_deg: Option<[f64; 3]>,
    /// Position to reach.
    pub(crate) to_position_m: Option<[f64; 3]>,
    /// Orientation to reach.
    pub(crate) to_attitude: Option<AttitudeFile>,
    /// Axes of the target, and of the line.
    #[serde(default = "inertial")]
    pub(crate) axes: AxesFile,
    /// Duration of a quintic from rest to rest.
    pub(crate) duration_s: Option<f64>,
    /// Instead of a duration: the shortest motion under limits.
    pub(crate) limits: Option<ToolLimitsFile>,
}

fn inertial() -> AxesFile {
    AxesFile::Inertial
}

/// Shape of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ShapeFile {
    /// Polynomial of degree five.
    Quintic,
    /// Bounded jerk, in seven segments.
    SCurve,
}

/// Limits of a tool's motion.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolLimitsFile {
    /// Shape of the motion.
    pub(crate) shape: ShapeFile,
    /// Largest speed.
    pub(crate) speed_m_s: f64,
    /// Largest acceleration.
    pub(crate) acceleration_m_s2: f64,
    /// Largest jerk.
    pub(crate) jerk_m_s3: f64,
    /// Largest turning speed.
    pub(crate) turn_speed_deg_s: f64,
    /// Largest turning acceleration.
    pub(crate) turn_acceleration_deg_s2: f64,
    /// Largest turning jerk.
    pub(crate) turn_jerk_deg_s3: f64,
}

/// A move of all joints.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MoveJointsFile {
    /// A posture that the vehicle file names.
    pub(crate) to_posture: Option<String>,
    /// Positions of turning joints by name; they replace the posture's, the others stay.
    #[serde(default)]
    pub(crate) to_deg: BTreeMap<String, f64>,
    /// Positions of sliding joints by name.
    #[serde(default)]
    pub(crate) to_m: BTreeMap<String, f64>,
    /// A pose of the tool, for which the inverse kinematics of the law finds the joints.
    pub(crate) to_tool: Option<ToolPoseFile>,
    /// Duration of a quintic from rest to rest.
    pub(crate) duration_s: Option<f64>,
    /// Instead of a duration: the shortest motion under limits.
    pub(crate) limits: Option<JointLimitsFile>,
}

/// A pose of the tool.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolPoseFile {
    /// Position.
    pub(crate) position_m: [f64; 3],
    /// Orientation.
    pub(crate) attitude: AttitudeFile,
    /// Axes of the pose.
    #[serde(default = "inertial")]
    pub(crate) axes: AxesFile,
}

/// Limits of the joints' motion: rates are those of the vehicle, the rest is given here.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointLimitsFile {
    /// Shape of the motion.
    pub(crate) shape: ShapeFile,
    /// Share of the vehicle's joint rates that is used (–).
    pub(crate) rate_share: f64,
    /// Largest acceleration of turning joints.
    pub(crate) acceleration_deg_s2: f64,
    /// Largest jerk of turning joints.
    pub(crate) jerk_deg_s3: f64,
    /// Largest acceleration of sliding joints.
    #[serde(default = "one")]
    pub(crate) acceleration_m_s2: f64,
    /// Largest jerk of sliding joints.
    #[serde(default = "one")]
    pub(crate) jerk_m_s3: f64,
}

fn one() -> f64 {
    1.0
}

/// What a hold or a grip keeps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum KeepFile {
    /// The joints stand still; joints that move come to rest within a second.
    #[default]
    Joints,
    /// The tool stays on its reference.
    Tool,
    /// Nothing: no actuator acts, the joints move on as they do.
    Nothing,
}

/// A hold.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HoldFile {
    /// For how long.
    pub(crate) duration_s: f64,
    /// What stays.
    #[serde(default)]
    pub(crate) keep: KeepFile,
}

/// What of the tool must stay while the posture unloads the base.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ToolTaskFile {
    /// Nothing: the force goes along with the tool.
    Nothing,
    /// How it is turned.
    #[default]
    Orientation,
    /// Where it is.
    Position,
    /// Both.
    Pose,
}

/// A posture that unloads the base.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnloadByPostureFile {
    /// For how long.
    pub(crate) duration_s: f64,
    /// What of the tool must stay.
    #[serde(default)]
    pub(crate) keep: ToolTaskFile,
    /// How fast what can be lowered fades.
    #[serde(default = "tenth")]
    pub(crate) gain_per_s: f64,
}

fn tenth() -> f64 {
    0.1
}

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

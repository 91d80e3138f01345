//! `move_tool`: a straight line of the tool.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::phase::{duration, no_timing};
use crate::toml::pose::{AxesFile, attitude, axes, radians, vector};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_flight::trajectory::{MotionLimits, ProfileShape};
use wrasse_flight::{Phase, Target, Timing};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::{AttitudeFile, JOINTS};

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
    #[serde(default = "crate::toml::pose::inertial")]
    pub(crate) axes: AxesFile,
    /// Duration of a quintic from rest to rest.
    pub(crate) duration_s: Option<f64>,
    /// Instead of a duration: the shortest motion under limits.
    pub(crate) limits: Option<ToolLimitsFile>,
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

pub(super) fn move_tool(
    r: &mut Reading<'_>,
    above: &[Step<'_>],
    m: &MoveToolFile,
    mission: &MissionFile,
) -> Option<Phase<f64, JOINTS>> {
    let here = [above, at!["move_tool"]].concat();
    let path = |key| [&here[..], at![key]].concat();
    let (by, to) =
        (m.by_m.is_some() || m.turn_by_deg.is_some(), m.to_position_m.zip(m.to_attitude));
    let target = match (by, to) {
        (true, None) if m.to_position_m.is_none() && m.to_attitude.is_none() => Target::By {
            displacement: m.by_m.map_or(Vec3::zero(), vector),
            turn: m
                .turn_by_deg
                .map_or(Vec3::zero(), |turn| radians(few_turns(r, &path("turn_by_deg"), turn))),
        },
        (false, Some((position, quat))) => {
            Target::To(Pose::new(attitude(r, &path("to_attitude"), Some(quat)), vector(position)))
        }
        _ => {
            let message = "a tool is moved either by something or to a pose".into();
            let help =
                "give by_m and turn_by_deg (or one of them), or to_position_m and to_attitude";
            r.error(&here, message, help);
            return None;
        }
    };
    let timing = match (m.duration_s, &m.limits) {
        (Some(given), None) => Timing::Duration(duration(r, &path("duration_s"), given, mission)),
        (None, Some(limits)) => tool_limits(r, &path("limits"), limits),
        (given, _) => return no_timing(r, &here, given),
    };
    Some(Phase::MoveTool { target, axes: axes(m.axes), timing })
}

/// Most turns that a tool is turned by in one move (deg): ten.
const MOST_TURN: f64 = 3600.0;

/// A rotation vector (deg) of at most ten turns.
fn few_turns(r: &mut Reading<'_>, path: &[Step<'_>], turn: [f64; 3]) -> [f64; 3] {
    let angle = vector(turn).norm();
    if angle <= MOST_TURN {
        return turn;
    }
    let message = format!("a turn of {angle} deg: one move turns a tool ten times at most");
    r.error(path, message, &format!("at most {MOST_TURN} deg; write a phase for each part"));
    [0.0; 3]
}

pub(super) fn shape(file: ShapeFile) -> ProfileShape {
    match file {
        ShapeFile::Quintic => ProfileShape::Quintic,
        ShapeFile::SCurve => ProfileShape::SCurve,
    }
}

fn tool_limits(r: &mut Reading<'_>, above: &[Step<'_>], file: &ToolLimitsFile) -> Timing<f64> {
    let mut number = |key: &str, x: f64| r.positive(&[above, at![key]].concat(), x);
    let linear = MotionLimits {
        speed: number("speed_m_s", file.speed_m_s),
        acceleration: number("acceleration_m_s2", file.acceleration_m_s2),
        jerk: number("jerk_m_s3", file.jerk_m_s3),
    };
    let angular = MotionLimits {
        speed: number("turn_speed_deg_s", file.turn_speed_deg_s).to_radians(),
        acceleration: number("turn_acceleration_deg_s2", file.turn_acceleration_deg_s2)
            .to_radians(),
        jerk: number("turn_jerk_deg_s3", file.turn_jerk_deg_s3).to_radians(),
    };
    Timing::Limits { shape: shape(file.shape), linear, angular }
}

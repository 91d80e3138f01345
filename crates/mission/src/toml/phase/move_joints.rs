//! `move_joints`: all joints to a posture, or by so much.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::control::ArmLawFile;
use crate::toml::phase::move_tool::{ShapeFile, shape};
use crate::toml::phase::{duration, no_timing};
use crate::toml::pose::{AxesFile, attitude, axes, by_joint, place_of_position, posture, vector};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::JointKind;
use wrasse_flight::trajectory::MotionLimits;
use wrasse_flight::{JointTarget, JointTiming, Phase};
use wrasse_spatial::Pose;
use wrasse_vehicle::{AttitudeFile, JOINTS, follow};

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
    /// Turns of turning joints by name, from where each is as the phase begins; the others stay.
    #[serde(default)]
    pub(crate) joints_by_deg: BTreeMap<String, f64>,
    /// Travels of sliding joints by name, from where each is as the phase begins.
    #[serde(default)]
    pub(crate) joints_by_m: BTreeMap<String, f64>,
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
    #[serde(default = "crate::toml::pose::inertial")]
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

pub(super) fn move_joints(
    r: &mut Reading<'_>,
    above: &[Step<'_>],
    m: &MoveJointsFile,
    mission: &MissionFile,
    law: ArmLawFile,
) -> Option<Phase<f64, JOINTS>> {
    let here = [above, at!["move_joints"]].concat();
    let path = |key| [&here[..], at![key]].concat();
    let to_places = m.to_posture.is_some() || !m.to_deg.is_empty() || !m.to_m.is_empty();
    let by_amounts = !m.joints_by_deg.is_empty() || !m.joints_by_m.is_empty();
    let to = match (&m.to_tool, to_places, by_amounts) {
        (Some(pose), false, false) => tool_target(r, &path("to_tool"), pose, law),
        (None, true, false) => JointTarget::Positions(positions(r, &here, m)),
        (None, false, true) => JointTarget::By(amounts(r, &here, m)),
        _ => {
            let message =
                "joints are moved to positions, by amounts or to a pose of the tool".into();
            let help = "give to_posture, to_deg or to_m; or joints_by_deg or joints_by_m; or \
                        to_tool = { … }";
            r.error(&here, message, help);
            return None;
        }
    };
    let timing = match (m.duration_s, &m.limits) {
        (Some(given), None) => {
            JointTiming::Duration(duration(r, &path("duration_s"), given, mission))
        }
        (None, Some(limits)) => joint_limits(r, &path("limits"), limits),
        (given, _) => return no_timing(r, &here, given),
    };
    Some(Phase::MoveJoints { to, timing })
}

fn tool_target(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    pose: &ToolPoseFile,
    law: ArmLawFile,
) -> JointTarget<f64, JOINTS> {
    if law == ArmLawFile::FreeFloating && pose.axes == AxesFile::Inertial {
        let message =
            "where a floating base ends depends on the way: no joint positions belong to an \
                       inertial pose"
                .into();
        r.error(path, message, "use move_tool, or axes = \"base\", or another arm_law");
    }
    let R = attitude(r, &[path, at!["attitude"]].concat(), Some(pose.attitude));
    JointTarget::Tool(Pose::new(R, vector(pose.position_m)), axes(pose.axes))
}

/// Where joints are sent (rad or m); one that follows another goes where that one has it.
fn positions(r: &mut Reading<'_>, here: &[Step<'_>], m: &MoveJointsFile) -> [Option<f64>; JOINTS] {
    let path = |key| [here, at![key]].concat();
    let mut to = [None; JOINTS];
    if let Some(name) = &m.to_posture {
        to = posture(r, &path("to_posture"), name).map_or(to, |q| q.map(Some));
    }
    by_joint(r, &path("to_deg"), &m.to_deg, JointKind::Revolute, |j, x| to[j] = Some(x));
    by_joint(r, &path("to_m"), &m.to_m, JointKind::Prismatic, |j, x| to[j] = Some(x));
    let mut q = to.map(Option::unwrap_or_default);
    follow(&r.vehicle.followers, &mut q);
    for follower in &r.vehicle.followers {
        to[follower.joint] = to[follower.leader].map(|_| q[follower.joint]);
    }
    check_travel(r, here, &to);
    to
}

fn check_travel(r: &mut Reading<'_>, above: &[Step<'_>], to: &[Option<f64>; JOINTS]) {
    for j in r.vehicle.robot.joints() {
        let (Some(q), Some((lower, upper))) = (to[j], r.vehicle.limits[j].travel) else { continue };
        if !(lower..=upper).contains(&q) {
            let name = &r.vehicle.joint_names[j];
            let [q, lower, upper] = [q, lower, upper].map(|x| r.shown(j, x));
            let message =
                format!("joint {name} shall go to {q}, outside its travel from {lower} to {upper}");
            let place = place_of_position(r, above, ["to_deg", "to_m", "to_posture"], j);
            let help = "choose a position within the travel";
            r.error(&place, message, help);
        }
    }
}

/// How far joints are moved (rad or m); one that follows another moves as that one makes it.
fn amounts(r: &mut Reading<'_>, here: &[Step<'_>], m: &MoveJointsFile) -> [Option<f64>; JOINTS] {
    let path = |key| [here, at![key]].concat();
    let mut by = [None; JOINTS];
    let (turning, sliding) = (JointKind::Revolute, JointKind::Prismatic);
    by_joint(r, &path("joints_by_deg"), &m.joints_by_deg, turning, |j, x| by[j] = Some(x));
    by_joint(r, &path("joints_by_m"), &m.joints_by_m, sliding, |j, x| by[j] = Some(x));
    for follower in &r.vehicle.followers {
        by[follower.joint] = by[follower.leader].map(|x| follower.ratio * x);
    }
    check_amounts(r, here, &by);
    by
}

/// No joint can move farther than from one end of its travel to the other. Where it is as the phase
/// begins is known to the planning, which looks at the ends themselves.
fn check_amounts(r: &mut Reading<'_>, above: &[Step<'_>], by: &[Option<f64>; JOINTS]) {
    for j in r.vehicle.robot.joints() {
        let (Some(x), Some((lower, upper))) = (by[j], r.vehicle.limits[j].travel) else { continue };
        // The ends were converted from degrees each: their distance has the round-off of both.
        if x.abs() > (upper - lower) * (1.0 + 1e-12) {
            let name = &r.vehicle.joint_names[j];
            let [x, lower, upper, whole] = [x, lower, upper, upper - lower].map(|x| r.shown(j, x));
            let message = format!(
                "joint {name} shall move by {x}, farther than its whole travel from {lower} to {upper}"
            );
            let keys = ["joints_by_deg", "joints_by_m", "joints_by_deg"];
            let place = place_of_position(r, above, keys, j);
            r.error(
                &place,
                message,
                &format!("at most {whole}, less where it does not start at an end"),
            );
        }
    }
}

fn joint_limits(
    r: &mut Reading<'_>,
    above: &[Step<'_>],
    file: &JointLimitsFile,
) -> JointTiming<f64, JOINTS> {
    let mut number = |key: &str, x: f64| r.positive(&[above, at![key]].concat(), x);
    let share = number("rate_share", file.rate_share);
    let turning = (
        number("acceleration_deg_s2", file.acceleration_deg_s2).to_radians(),
        number("jerk_deg_s3", file.jerk_deg_s3).to_radians(),
    );
    let sliding =
        (number("acceleration_m_s2", file.acceleration_m_s2), number("jerk_m_s3", file.jerk_m_s3));
    let mut limits = [MotionLimits { speed: 1.0, acceleration: 1.0, jerk: 1.0 }; JOINTS];
    for j in r.vehicle.robot.joints() {
        let (acceleration, jerk) = match r.vehicle.robot.joint(j).kind {
            JointKind::Revolute => turning,
            JointKind::Prismatic => sliding,
        };
        let Some(rate) = r.vehicle.limits[j].rate else {
            let name = r.vehicle.joint_names[j].clone();
            let message = format!("joint {name} has no rate limit in the vehicle file");
            r.error(above, message, "give duration_s instead");
            continue;
        };
        limits[j] = MotionLimits { speed: rate * share, acceleration, jerk };
    }
    JointTiming::Limits { shape: shape(file.shape), limits }
}

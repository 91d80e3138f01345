//! One phase out of a mission file.

use crate::format::{ArmLawFile, MissionFile};
use crate::mission::PhaseCase;
use crate::phase_format::{
    AxesFile, GraspFile, JointLimitsFile, KeepFile, MoveJointsFile, MoveToolFile, PhaseFile,
    ShapeFile, ToolLimitsFile, ToolPoseFile, ToolTaskFile, UnloadByPostureFile,
};
use crate::read_setup::{
    RATES, attitude, axes, by_joint, grasp_bounds, place_of_position, posture, radians, vector,
};
use crate::reading::Reading;
use wrasse_document::{Step, at};
use wrasse_dynamics::JointKind;
use wrasse_flight::allocation::ToolTask;
use wrasse_flight::trajectory::{MotionLimits, ProfileShape};
use wrasse_flight::{Grip, Held, JointTarget, JointTiming, LONGEST, Phase, Target, Timing};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::{GraspBounds, JOINTS};
use wrasse_world::GripOffset;

/// The phase of this number; errors if it does not say exactly one thing.
pub(crate) fn phase(
    r: &mut Reading<'_>,
    i: usize,
    file: &PhaseFile,
    payloads: &[String],
    mission: &MissionFile,
) -> Option<PhaseCase> {
    let mut grasp_bounds = None;
    let things = [
        (file.move_tool.is_some(), "move_tool"),
        (file.move_joints.is_some(), "move_joints"),
        (file.hold.is_some(), "hold"),
        (file.unload_by_posture.is_some(), "unload_by_posture"),
        (file.grasp.is_some(), "grasp"),
        (file.release.is_some(), "release"),
    ];
    let said: Vec<&str> = things.iter().filter(|t| t.0).map(|t| t.1).collect();
    if said.len() != 1 {
        let found = if said.is_empty() { "none".into() } else { said.join(" and ") };
        let message =
            format!("phase {:?} must say exactly one thing to do, found {found}", file.name);
        let help = "one of move_tool, move_joints, hold, unload_by_posture, grasp, release; write a \
                    phase for each";
        r.error(at!["phase", i], message, help);
        return None;
    }
    let phase = if let Some(m) = &file.move_tool {
        move_tool(r, i, m, mission)?
    } else if let Some(m) = &file.move_joints {
        move_joints(r, i, m, mission)?
    } else if let Some(hold) = &file.hold {
        let path = at!["phase", i, "hold", "duration_s"];
        let duration = duration(r, path, hold.duration_s, mission);
        Phase::Hold { what: held(hold.keep), duration }
    } else if let Some(given) = &file.unload_by_posture {
        unload_by_posture(r, i, given, mission)
    } else if let Some(grasp) = &file.grasp {
        grasp_bounds = Some(bounds(r, i, grasp, mission));
        let path = at!["phase", i, "grasp", "payload"];
        let told = Grip::Grasp(r.find(path, "payload", &grasp.payload, payloads)?);
        Phase::Grip { action: told, keep: held(grasp.keep) }
    } else {
        let release = file.release.as_ref()?;
        let path = at!["phase", i, "release", "payload"];
        let told = Grip::Release(r.find(path, "payload", &release.payload, payloads)?);
        Phase::Grip { action: told, keep: held(release.keep) }
    };
    Some(PhaseCase { name: file.name.clone(), phase, grasp_bounds })
}

fn unload_by_posture(
    r: &mut Reading<'_>,
    i: usize,
    file: &UnloadByPostureFile,
    mission: &MissionFile,
) -> Phase<f64, JOINTS> {
    let path =
        |key| [Step::Key("phase"), Step::Index(i), Step::Key("unload_by_posture"), Step::Key(key)];
    if !mission.control.measure_tool_wrench {
        let message = "nothing is known of what pushes at the tool".into();
        let help = "set control.measure_tool_wrench = true: a force-torque sensor at the tool";
        r.error(at!["phase", i, "unload_by_posture"], message, help);
    }
    Phase::UnloadByPosture {
        task: match file.keep {
            ToolTaskFile::Nothing => ToolTask::Free,
            ToolTaskFile::Orientation => ToolTask::Orientation,
            ToolTaskFile::Position => ToolTask::Position,
            ToolTaskFile::Pose => ToolTask::Pose,
        },
        gain: r.positive(&path("gain_per_s"), file.gain_per_s),
        duration: duration(r, &path("duration_s"), file.duration_s, mission),
    }
}

fn held(file: KeepFile) -> Held {
    match file {
        KeepFile::Joints => Held::Joints,
        KeepFile::Tool => Held::Tool,
        KeepFile::Nothing => Held::Nothing,
    }
}

/// What a grasp allows: places by the tool that is guided, speeds by the phase.
fn bounds(r: &mut Reading<'_>, i: usize, grasp: &GraspFile, mission: &MissionFile) -> GripOffset {
    let path = |key| [Step::Key("phase"), Step::Index(i), Step::Key("grasp"), Step::Key(key)];
    let turn = r.not_negative(&path("largest_turn_speed_deg_s"), grasp.largest_turn_speed_deg_s);
    let linear_speed = r.not_negative(&path("largest_speed_m_s"), grasp.largest_speed_m_s);
    let GraspBounds { distance, angle } = grasp_bounds(r.vehicle, mission.control.tool.as_deref());
    GripOffset { distance, angle, angular_speed: turn.to_radians(), linear_speed }
}

fn move_tool(
    r: &mut Reading<'_>,
    i: usize,
    m: &MoveToolFile,
    mission: &MissionFile,
) -> Option<Phase<f64, JOINTS>> {
    let path = |key| [Step::Key("phase"), Step::Index(i), Step::Key("move_tool"), Step::Key(key)];
    let (by, to) =
        (m.by_m.is_some() || m.turn_by_deg.is_some(), m.to_position_m.zip(m.to_attitude));
    let target = match (by, to) {
        (true, None) if m.to_position_m.is_none() && m.to_attitude.is_none() => Target::By {
            displacement: m.by_m.map_or(Vec3::zero(), vector),
            turn: m
                .turn_by_deg
                .map_or(Vec3::zero(), |turn| radians(few_turns(r, &path("turn_by_deg"), turn))),
        },
        (false, Some((position, quat))) => Target::To(Pose::from_quat(
            attitude(r, &path("to_attitude"), Some(quat)),
            vector(position),
        )),
        _ => {
            let message = "a tool is moved either by something or to a pose".into();
            let help =
                "give by_m and turn_by_deg (or one of them), or to_position_m and to_attitude";
            r.error(at!["phase", i, "move_tool"], message, help);
            return None;
        }
    };
    let timing = match (m.duration_s, &m.limits) {
        (Some(given), None) => Timing::Duration(duration(r, &path("duration_s"), given, mission)),
        (None, Some(limits)) => tool_limits(r, i, limits),
        (given, _) => return no_timing(r, at!["phase", i, "move_tool"], given),
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

/// A duration (s) that can be planned.
fn duration(r: &mut Reading<'_>, path: &[Step<'_>], given: f64, mission: &MissionFile) -> f64 {
    // A rate that cannot be is complained of where it stands.
    let (given, rate) = (r.positive(path, given), mission.control.rate_hz.min(RATES.1));
    if given * rate > f64::from(LONGEST) {
        let message =
            format!("{given} s at {rate} control periods per second: no phase is so long");
        let longest = f64::from(LONGEST) / rate;
        r.error(path, message, &format!("at most {longest} s at this control.rate_hz"));
        return 1.0;
    }
    given
}

fn no_timing(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    duration: Option<f64>,
) -> Option<Phase<f64, JOINTS>> {
    let found = if duration.is_some() { "both" } else { "neither" };
    let message = format!("a move takes either a duration or limits, found {found}");
    r.error(path, message, "give duration_s, or limits = { … }");
    None
}

fn shape(file: ShapeFile) -> ProfileShape {
    match file {
        ShapeFile::Quintic => ProfileShape::Quintic,
        ShapeFile::SCurve => ProfileShape::SCurve,
    }
}

fn tool_limits(r: &mut Reading<'_>, i: usize, file: &ToolLimitsFile) -> Timing<f64> {
    let mut number = |key: &str, x: f64| r.positive(at!["phase", i, "move_tool", "limits", key], x);
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

fn move_joints(
    r: &mut Reading<'_>,
    i: usize,
    m: &MoveJointsFile,
    mission: &MissionFile,
) -> Option<Phase<f64, JOINTS>> {
    let path = |key| [Step::Key("phase"), Step::Index(i), Step::Key("move_joints"), Step::Key(key)];
    let by_name = m.to_posture.is_some() || !m.to_deg.is_empty() || !m.to_m.is_empty();
    let to = match (&m.to_tool, by_name) {
        (Some(pose), false) => tool_target(r, i, pose, mission),
        (None, true) => {
            let mut to = [None; JOINTS];
            if let Some(name) = &m.to_posture {
                to = posture(r, &path("to_posture"), name).map_or(to, |q| q.map(Some));
            }
            by_joint(r, &path("to_deg"), &m.to_deg, JointKind::Revolute, |j, x| to[j] = Some(x));
            by_joint(r, &path("to_m"), &m.to_m, JointKind::Prismatic, |j, x| to[j] = Some(x));
            check_travel(r, i, &to);
            JointTarget::Positions(to)
        }
        _ => {
            let message = "joints are moved to positions or to a pose of the tool".into();
            let help = "give to_posture, to_deg or to_m; or to_tool = { … }";
            r.error(at!["phase", i, "move_joints"], message, help);
            return None;
        }
    };
    let timing = match (m.duration_s, &m.limits) {
        (Some(given), None) => {
            JointTiming::Duration(duration(r, &path("duration_s"), given, mission))
        }
        (None, Some(limits)) => joint_limits(r, i, limits),
        (given, _) => return no_timing(r, at!["phase", i, "move_joints"], given),
    };
    Some(Phase::MoveJoints { to, timing })
}

fn tool_target(
    r: &mut Reading<'_>,
    i: usize,
    pose: &ToolPoseFile,
    mission: &MissionFile,
) -> JointTarget<f64, JOINTS> {
    let path = at!["phase", i, "move_joints", "to_tool"];
    if mission.control.arm_law == ArmLawFile::FreeFloating && pose.axes == AxesFile::Inertial {
        let message =
            "where a floating base ends depends on the way: no joint positions belong to an \
                       inertial pose"
                .into();
        r.error(path, message, "use move_tool, or axes = \"base\", or another arm_law");
    }
    let quat =
        attitude(r, at!["phase", i, "move_joints", "to_tool", "attitude"], Some(pose.attitude));
    JointTarget::Tool(Pose::from_quat(quat, vector(pose.position_m)), axes(pose.axes))
}

fn check_travel(r: &mut Reading<'_>, i: usize, to: &[Option<f64>; JOINTS]) {
    for j in r.vehicle.robot.joints() {
        let (Some(q), Some((lower, upper))) = (to[j], r.vehicle.limits[j].travel) else { continue };
        if !(lower..=upper).contains(&q) {
            let name = &r.vehicle.joint_names[j];
            let [q, lower, upper] = [q, lower, upper].map(|x| r.shown(j, x));
            let message =
                format!("joint {name} shall go to {q}, outside its travel from {lower} to {upper}");
            let above = at!["phase", i, "move_joints"];
            let place = place_of_position(r, above, ["to_deg", "to_m", "to_posture"], name);
            let help = "choose a position within the travel";
            r.error(&place, message, help);
        }
    }
}

fn joint_limits(r: &mut Reading<'_>, i: usize, file: &JointLimitsFile) -> JointTiming<f64, JOINTS> {
    let mut number =
        |key: &str, x: f64| r.positive(at!["phase", i, "move_joints", "limits", key], x);
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
            r.error(at!["phase", i, "move_joints", "limits"], message, "give duration_s instead");
            continue;
        };
        limits[j] = MotionLimits { speed: rate * share, acceleration, jerk };
    }
    JointTiming::Limits { shape: shape(file.shape), limits }
}

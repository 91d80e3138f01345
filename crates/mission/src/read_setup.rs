//! The start, the world and the laws, out of a mission file.

use crate::format::{
    ArmLawFile, AttitudeFile, BaseFile, JointsFile, MeasurementFile, MissionFile, QuaternionFile,
    TaskFile,
};
use crate::phase_format::AxesFile;
use crate::reading::Reading;
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::{BodyId, Frame, JointKind, State};
use wrasse_flight::{
    ArmLaw, Assignment, Axes, BaseControlSetup, JointUse, Measurement, NavigationSetup, Setup,
    Task, Tuning,
};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3};
use wrasse_vehicle::{GraspBounds, JOINTS, Vehicle, from_rpy_deg};
use wrasse_world::{BaseAttitude, Stepper};

/// A unit quaternion; an error if it is not one.
pub(crate) fn attitude(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    file: Option<AttitudeFile>,
) -> Quat<f64> {
    let QuaternionFile { w, x, y, z } = match file {
        None => return Quat::identity(),
        Some(AttitudeFile::Angles(angles)) => {
            return Quat::from_matrix(&from_rpy_deg(angles.rpy_deg));
        }
        Some(AttitudeFile::Parts(parts)) => parts,
        Some(AttitudeFile::Quaternion(under)) => under.quaternion,
    };
    let quat = Quat { w, x, y, z };
    let norm = quat.norm();
    if (norm - 1.0).abs() > 1e-6 {
        let message = format!("an attitude is a unit quaternion, found one of length {norm}");
        let help = match norm {
            0.0 => "no rotation is { w = 1.0, x = 0.0, y = 0.0, z = 0.0 }",
            _ => "divide all four components by the length",
        };
        r.error(path, message, help);
        return Quat::identity();
    }
    quat.normalized()
}

/// A vector from an array.
pub(crate) fn vector(a: [f64; 3]) -> Vec3<f64> {
    Vec3::from_array(a)
}

/// A vector in radians from degrees.
pub(crate) fn radians(a: [f64; 3]) -> Vec3<f64> {
    vector(a.map(f64::to_radians))
}

pub(crate) fn axes(file: AxesFile) -> Axes {
    match file {
        AxesFile::Inertial => Axes::Inertial,
        AxesFile::Base => Axes::Base,
    }
}

/// Values by joint name into the robot's order; errors for names that are not there or of the other
/// kind.
pub(crate) fn by_joint(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    values: &BTreeMap<String, f64>,
    kind: JointKind,
    mut put: impl FnMut(usize, f64),
) {
    let names = r.vehicle.joint_names.clone();
    for (name, &value) in values {
        let at_name = [path, &[Step::Key(name)]].concat();
        let Some(j) = r.find(&at_name, "moving joint", name, &names) else { continue };
        if r.vehicle.robot.joint(j).kind == kind {
            put(j, if kind == JointKind::Revolute { value.to_radians() } else { value });
        } else {
            let key = path.last().map(ToString::to_string).unwrap_or_default();
            let (is, unit, other) = match kind {
                JointKind::Revolute => ("slides", "deg", key.replace("_deg", "_m")),
                JointKind::Prismatic => ("turns", "m", key.replace("_m", "_deg")),
            };
            let message = format!("joint {name} {is}, found a value in {unit}");
            r.error(&at_name, message, &format!("write it in `{other}`"));
        }
    }
}

/// Positions of a posture that the vehicle names.
pub(crate) fn posture(r: &mut Reading<'_>, path: &[Step<'_>], name: &str) -> Option<[f64; JOINTS]> {
    let names: Vec<String> = r.vehicle.postures.iter().map(|p| p.name.clone()).collect();
    let i = r.find(path, "posture", name, &names)?;
    let mut q = [0.0; JOINTS];
    q.iter_mut().zip(&r.vehicle.postures[i].q).for_each(|(to, from)| *to = *from);
    Some(q)
}

/// State at the start.
pub(crate) fn start(r: &mut Reading<'_>, file: &MissionFile) -> State<f64, JOINTS> {
    let i = &file.initial;
    let mut state = State::default();
    let mut known = [i.posture.is_none(); JOINTS];
    if let Some(q) = i.posture.as_ref().and_then(|p| posture(r, at!["initial", "posture"], p)) {
        (state.q, known) = (q, [true; JOINTS]);
    }
    let (turning, sliding) = (JointKind::Revolute, JointKind::Prismatic);
    let path = |key| [Step::Key("initial"), Step::Key(key)];
    let (q, v) = (&mut state.q, &mut state.v);
    let mut put = |j, x| (q[j], known[j]) = (x, true);
    by_joint(r, &path("joints_deg"), &i.joints_deg, turning, &mut put);
    by_joint(r, &path("joints_m"), &i.joints_m, sliding, &mut put);
    by_joint(r, &path("joint_rates_deg_s"), &i.joint_rates_deg_s, turning, |j, x| v[j] = x);
    by_joint(r, &path("joint_rates_m_s"), &i.joint_rates_m_s, sliding, |j, x| v[j] = x);
    let quat_NB = attitude(r, &path("attitude"), i.attitude);
    state.X_NB = Pose::from_quat(quat_NB, vector(i.position_m));
    state.V_NB_B = SpatialVelocity::new(radians(i.angular_velocity_deg_s), vector(i.velocity_m_s));
    // A joint whose posture is not known is not said to be anywhere.
    for j in r.vehicle.robot.joints().filter(|&j| known[j]) {
        check_start(r, j, state.q[j]);
    }
    state
}

/// A joint starts within its travel.
fn check_start(r: &mut Reading<'_>, j: usize, q: f64) {
    let Some((lower, upper)) = r.vehicle.limits[j].travel else { return };
    if (lower..=upper).contains(&q) {
        return;
    }
    let name = &r.vehicle.joint_names[j];
    let [q, lower, upper] = [q, lower, upper].map(|x| r.shown(j, x));
    let message = format!("joint {name} starts at {q}, outside its travel from {lower} to {upper}");
    let place = place_of_position(r, at!["initial"], ["joints_deg", "joints_m", "posture"], name);
    let help = "give it a position within the travel in initial.joints_deg or initial.joints_m";
    r.error(&place, message, help);
}

/// Where a joint's position is written: under its name in one of the first two tables, or else by the
/// posture.
pub(crate) fn place_of_position<'p>(
    r: &Reading<'_>,
    above: &[Step<'p>],
    keys: [&'p str; 3],
    name: &'p str,
) -> Vec<Step<'p>> {
    let [turning, sliding, posture] = keys;
    let by_name = [turning, sliding].map(|key| [above, at![key, name]].concat());
    let written = by_name.into_iter().find(|path| r.is_there(path));
    written.unwrap_or_else(|| [above, at![posture]].concat())
}

/// What becomes of the base's attitude.
pub(crate) fn base_attitude(
    r: &mut Reading<'_>,
    file: &MissionFile,
    start: &State<f64, JOINTS>,
) -> BaseAttitude {
    let path = at!["world", "base_attitude"];
    match file.world.base_attitude {
        BaseFile::Held => {
            if start.V_NB_B.angular.norm() > 0.0 {
                let message = "a base that turns at the start cannot be held".into();
                r.error(path, message, "set initial.angular_velocity_deg_s to zero");
            }
            BaseAttitude::Held
        }
        BaseFile::Controlled => BaseAttitude::Controlled,
        BaseFile::Free => BaseAttitude::Free,
    }
}

/// Shortest and longest step (s), least and most tolerance of the integrators.
const STEPS: (f64, f64) = (1e-6, 1e3);
const TOLERANCES: (f64, f64) = (1e-14, 1.0);

/// Step of the integrator where the mission gives none (s).
const STEP: f64 = 0.005;

pub(crate) fn stepper(r: &mut Reading<'_>, file: &MissionFile) -> Stepper {
    let given = file.world.step_s.unwrap_or(STEP);
    let step = r.within(at!["world", "step_s"], given, STEPS, "a usual step is 0.005");
    if file.world.step_s.is_some() && file.world.adaptive_tolerance.is_some() {
        let message = "a step and a tolerance: the integrator has one or the other".into();
        r.error(at!["world", "step_s"], message, "leave out step_s, or adaptive_tolerance");
    }
    match file.world.adaptive_tolerance {
        None => Stepper::Fixed { step },
        Some(tolerance) => {
            let path = at!["world", "adaptive_tolerance"];
            let why = "a usual tolerance is 1e-9; below 1e-14 there is only rounding";
            Stepper::Adaptive { tolerance: r.within(path, tolerance, TOLERANCES, why) }
        }
    }
}

/// Which joints are driven by torque.
pub(crate) fn torque_joints(r: &mut Reading<'_>, file: &MissionFile) -> [bool; JOINTS] {
    let mut torque = [file.world.joints == JointsFile::Torque; JOINTS];
    let names = r.vehicle.joint_names.clone();
    for (i, name) in file.world.torque_joints.iter().enumerate() {
        if let Some(j) = r.find(at!["world", "torque_joints", i], "moving joint", name, &names) {
            torque[j] = true;
        }
    }
    torque
}

/// Rate (rad/s or m/s) of a joint that has no limit.
const UNLIMITED: f64 = 1e3;

/// The laws.
pub(crate) fn setup(
    r: &mut Reading<'_>,
    file: &MissionFile,
    base: &BaseControlSetup<f64>,
    navigation: &NavigationSetup<f64>,
) -> Setup<f64, JOINTS> {
    let c = &file.control;
    let path = |key| [Step::Key("control"), Step::Key(key)];
    // Without a limit in the vehicle file: as fast as nothing moves.
    let mut joints = JointUse {
        gain: 0.0,
        gain_rate: 0.0,
        posture: [0.0; JOINTS],
        rate_limit: [UNLIMITED; JOINTS],
    };
    for (to, from) in joints.rate_limit.iter_mut().zip(&r.vehicle.limits) {
        *to = from.rate.unwrap_or(UNLIMITED);
    }
    if let Some(wanted) = &c.redundancy {
        let path = at!["control", "redundancy", "posture"];
        joints.posture = posture(r, path, &wanted.posture).unwrap_or([0.0; JOINTS]);
        joints.gain = r.positive(at!["control", "redundancy", "gain_per_s"], wanted.gain_per_s);
    }
    let mut limits = [JointLimits::default(); JOINTS];
    limits.iter_mut().zip(&r.vehicle.limits).for_each(|(to, from)| *to = *from);
    Setup {
        assignment: Assignment {
            tool: guided_tool(r, &path("tool"), c.tool.as_deref()),
            axes: Axes::Inertial,
            task: match c.task {
                TaskFile::Pose => Task::Pose,
                TaskFile::Position => Task::Position,
            },
            law: match c.arm_law {
                ArmLawFile::Terrestrial => ArmLaw::Terrestrial,
                ArmLawFile::AttitudeHeld => ArmLaw::AttitudeHeld,
                ArmLawFile::FreeFloating => ArmLaw::FreeFloating,
            },
            damped_below: r.positive(&path("damped_below"), c.damped_below),
        },
        joints,
        base: *base,
        navigation: *navigation,
        measurement: match c.measurement {
            MeasurementFile::None => Measurement::None,
            MeasurementFile::Base => Measurement::Base,
        },
        tuning: tuning(r, c),
        limits,
        position_driven: [false; JOINTS],
    }
}

/// Lowest and highest control rate (Hz).
pub(crate) const RATES: (f64, f64) = (0.01, 1e4);

fn tuning(r: &mut Reading<'_>, c: &crate::format::ControlFile) -> Tuning<f64> {
    let path = |key| [Step::Key("control"), Step::Key(key)];
    Tuning {
        period: 1.0 / r.within(&path("rate_hz"), c.rate_hz, RATES, "a usual rate is 100"),
        tool_gain: r.not_negative(&path("tool_gain_per_s"), c.tool_gain_per_s),
        joint_bandwidth: r.not_negative(&path("joint_bandwidth_rad_s"), c.joint_bandwidth_rad_s),
        joint_damping: r.not_negative(&path("joint_damping_ratio"), c.joint_damping_ratio),
        attitude_bandwidth: r
            .not_negative(&path("attitude_bandwidth_rad_s"), c.attitude_bandwidth_rad_s),
        attitude_damping: r.not_negative(&path("attitude_damping_ratio"), c.attitude_damping_ratio),
    }
}

/// The tool that is guided; an error if it was chosen and no joint moves it.
fn guided_tool(r: &mut Reading<'_>, path: &[Step<'_>], name: Option<&str>) -> Frame<f64> {
    let before = r.complaints.len();
    let guided = tool(r, path, name);
    if let Some(name) = name
        && r.complaints.len() == before
        && guided.body == BodyId::Base
    {
        let message = format!("{name} is fixed to the base: no joint moves it");
        let help = format!("choose a tool: {}", r.vehicle.tools.join(", "));
        r.error(path, message, &help);
    }
    guided
}

/// A tool or frame by its name; without one the vehicle's first tool, or the last link's frame.
pub(crate) fn tool(r: &mut Reading<'_>, path: &[Step<'_>], name: Option<&str>) -> Frame<f64> {
    let names: Vec<String> = r.vehicle.frames.iter().map(|f| f.name.clone()).collect();
    let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
    match name.or(r.vehicle.tools.first().map(String::as_str)) {
        Some(name) => {
            let name = name.to_owned();
            r.find(path, "tool or frame", &name, &names).map_or(base, |i| r.vehicle.frames[i].frame)
        }
        None => r.vehicle.frames.last().map_or(base, |f| f.frame),
    }
}

/// How far a grip may be from the tool of this name, or the one that is guided without a name.
pub(crate) fn grasp_bounds(vehicle: &Vehicle, name: Option<&str>) -> GraspBounds {
    let first = vehicle.tools.first().map(String::as_str);
    let last = vehicle.frames.last().map(|frame| frame.name.as_str());
    let named = vehicle.frames.iter().find(|f| Some(f.name.as_str()) == name.or(first).or(last));
    named.map_or(GraspBounds::default(), |frame| frame.grasp_bounds)
}

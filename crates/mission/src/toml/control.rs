//! `[control]`: the laws that fly.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::actuators::ActuatorsFile;
use crate::toml::base_control::PositionHoldFile;
use crate::toml::estimation::EstimationFile;
use crate::toml::pose::{base_frame, posture, tool};
use crate::toml::sensors::SensingFile;
use crate::toml::steering::SteeringFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::{Step, at};
use wrasse_dynamics::{BodyId, Frame};
use wrasse_flight::{
    ArmLaw, Assignment, Axes, BaseControlSetup, JointUse, Measurement, NavigationSetup, Setup,
    Task, Tuning,
};
use wrasse_hardware::{JointLimits, List};
use wrasse_vehicle::{JOINTS, Vehicle};

/// What the arm law takes the base for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ArmLawFile {
    /// Bolted to the ground.
    Terrestrial,
    /// Attitude held, translation free: the paper's law.
    AttitudeHeld,
    /// Free to turn and to translate.
    FreeFloating,
}

/// What the attitude control is told of the arm's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FeedforwardFile {
    /// The exact torque.
    Exact,
    /// Eq. (3) of the paper as printed, with the centre of mass of arm and payload.
    AsPrinted,
    /// Eq. (3) of the paper as printed, with the centre of mass of the whole system.
    AsPrintedSystemCm,
    /// Nothing.
    None,
}

/// What the guidance measures. The joint loops and the attitude law always use their own sensors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum MeasurementFile {
    /// Nothing after the start: each law integrates its own model.
    None,
    /// Pose and twist of the base, each period.
    Base,
}

/// Which part of the tool's motion counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum TaskFile {
    /// Position and orientation.
    Pose,
    /// Position only.
    Position,
}

/// A posture that the arm drifts to as far as the task leaves it free.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RedundancyFile {
    /// A posture that the vehicle file names.
    pub(crate) posture: String,
    /// How fast, on average over a phase: the drift fades in and out with it.
    pub(crate) gain_per_s: f64,
}

/// The laws that fly.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ControlFile {
    /// Control periods per second.
    pub(crate) rate_hz: f64,
    /// What the arm law takes the base for.
    pub(crate) arm_law: ArmLawFile,
    /// What the attitude control is told of the arm's motion.
    pub(crate) feedforward: FeedforwardFile,
    /// What the guidance measures.
    pub(crate) measurement: MeasurementFile,
    /// Which part of the tool's motion counts.
    pub(crate) task: TaskFile,
    /// The tool that is guided; the vehicle's first if there is none.
    pub(crate) tool: Option<String>,
    /// What to do with the freedom that the task leaves; joint rates of least norm if there is none.
    pub(crate) redundancy: Option<RedundancyFile>,
    /// How fast the guidance takes back a tool error.
    pub(crate) tool_gain_per_s: f64,
    /// Bandwidth of the joint loops; zero for feedforward only.
    pub(crate) joint_bandwidth_rad_s: f64,
    /// Damping ratio of the joint loops.
    pub(crate) joint_damping_ratio: f64,
    /// Bandwidth of the attitude loop; zero for feedforward only.
    pub(crate) attitude_bandwidth_rad_s: f64,
    /// Damping ratio of the attitude loop.
    pub(crate) attitude_damping_ratio: f64,
    /// Singular value (m, rad) of the law's Jacobian below which its inverse is damped.
    pub(crate) damped_below: f64,
    /// Which actuators turn a controlled base; the fitted ones if there are any.
    pub(crate) actuators: Option<ActuatorsFile>,
    /// What the laws know the state by; the fitted sensors if there are any.
    pub(crate) sensing: Option<SensingFile>,
    /// Whether a force-torque sensor at the tool measures the wrench there, so that the laws
    /// compensate it.
    #[schemars(extend("x-formerly" = ["feel_tool_wrench"]))]
    pub(crate) measure_tool_wrench: bool,
    /// From a wanted torque to what each actuator is told.
    pub(crate) steering: SteeringFile,
    /// Keep the centre of mass where it was at the start, by thrusters.
    pub(crate) position_hold: Option<PositionHoldFile>,
    /// What estimates start from.
    pub(crate) estimation: EstimationFile,
}

impl Default for ControlFile {
    fn default() -> Self {
        Self {
            rate_hz: 100.0,
            arm_law: ArmLawFile::FreeFloating,
            feedforward: FeedforwardFile::Exact,
            measurement: MeasurementFile::Base,
            task: TaskFile::Pose,
            tool: None,
            redundancy: None,
            tool_gain_per_s: 2.0,
            joint_bandwidth_rad_s: 10.0,
            joint_damping_ratio: 1.0,
            attitude_bandwidth_rad_s: 0.3,
            attitude_damping_ratio: 1.0,
            damped_below: 0.02,
            actuators: None,
            sensing: None,
            measure_tool_wrench: false,
            steering: SteeringFile::default(),
            position_hold: None,
            estimation: EstimationFile::default(),
        }
    }
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
            task: task(c.task),
            law: law(c.arm_law),
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
        followers: List::new(&r.vehicle.followers),
    }
}

pub(crate) fn task(file: TaskFile) -> Task {
    match file {
        TaskFile::Pose => Task::Pose,
        TaskFile::Position => Task::Position,
    }
}

pub(crate) fn law(file: ArmLawFile) -> ArmLaw {
    match file {
        ArmLawFile::Terrestrial => ArmLaw::Terrestrial,
        ArmLawFile::AttitudeHeld => ArmLaw::AttitudeHeld,
        ArmLawFile::FreeFloating => ArmLaw::FreeFloating,
    }
}

/// Lowest and highest control rate (Hz).
pub(crate) const RATES: (f64, f64) = (0.01, 1e4);

fn tuning(r: &mut Reading<'_>, c: &ControlFile) -> Tuning<f64> {
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

/// The tool that is guided: that of the name, or the vehicle's first. An error if no joint moves the one
/// that was chosen, or if none was and the vehicle has none.
pub(crate) fn guided_tool(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    name: Option<&str>,
) -> Frame<f64> {
    let first = r.vehicle.tools.first().map(String::as_str);
    let Some(guided) = name.or(first) else { return no_tool(r, path) };
    let before = r.complaints.len();
    let frame = tool(r, path, guided);
    if name.is_some() && r.complaints.len() == before && frame.body == BodyId::Base {
        let message = format!("{guided} is fixed to the base: no joint moves it");
        let help = match r.vehicle.tools.join(", ") {
            none if none.is_empty() => one_of_frames(r.vehicle),
            tools => format!("choose a tool: {tools}"),
        };
        r.error(path, message, &help);
    }
    frame
}

/// Of a vehicle without tools nothing says which frame is guided: its frames are listed. Where no joint
/// moves there is nothing to guide.
fn no_tool(r: &mut Reading<'_>, path: &[Step<'_>]) -> Frame<f64> {
    if r.vehicle.robot.joint_count() > 0 {
        let message = format!("vehicle {} has no tool, and the mission names none", r.vehicle.name);
        let place: &[Step<'_>] = if r.is_there(path) { path } else { at!["vehicle"] };
        r.error(place, message, &format!("{} in control.tool", one_of_frames(r.vehicle)));
    }
    base_frame()
}

/// Most frames that are listed.
const LISTED: usize = 12;

/// The frames that joints move.
fn one_of_frames(vehicle: &Vehicle) -> String {
    let moved = vehicle.frames.iter().filter(|named| named.frame.body != BodyId::Base);
    let names: Vec<&str> = moved.map(|named| named.name.as_str()).collect();
    let more = if names.len() > LISTED { ", …" } else { "" };
    let listed = names.iter().take(LISTED).copied().collect::<Vec<_>>().join(", ");
    format!("name one of the frames that joints move: {listed}{more}")
}

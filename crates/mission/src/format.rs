//! The mission file, as it is written. A number's unit is in its key.

use crate::base_format::{
    ActuatorsFile, EstimationFile, FailureFile, PositionHoldFile, SensingFile, SteeringFile,
    StudyFile, WrenchFile,
};
use crate::dispersion_format::DisperseFile;
use crate::phase_format::PhaseFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wrasse_vehicle::{EquipmentFile, SensorsFile};

/// A mission: a vehicle, what it holds, what it shall do, under which laws, and what is required.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MissionFile {
    /// Name of the mission: letters, digits and dashes; the results go to out/NAME.
    pub(crate) name: String,
    /// What it is for, in a sentence or two.
    #[serde(default)]
    pub(crate) summary: String,
    /// A vehicle of the catalogue (`wrasse vehicles` lists them), or a file seen from this one.
    pub(crate) vehicle: String,
    /// Seed of everything random: noise of sensors and of thruster pulses.
    #[serde(default)]
    pub(crate) seed: u64,
    /// Where everything is at the start.
    #[serde(default)]
    pub(crate) initial: InitialFile,
    /// Rigid bodies that can be held, by name.
    #[serde(default)]
    pub(crate) payload: BTreeMap<String, PayloadFile>,
    /// Wheels, CMGs and thrusters; they replace the vehicle's.
    #[serde(default)]
    pub(crate) actuators: Option<EquipmentFile>,
    /// Sensors of attitude and joints; they replace the vehicle's.
    #[serde(default)]
    pub(crate) sensors: Option<SensorsFile>,
    /// Units that fail on the way.
    #[serde(default)]
    pub(crate) failure: Vec<FailureFile>,
    /// The simulated truth.
    #[serde(default)]
    pub(crate) world: WorldFile,
    /// The laws that fly.
    #[serde(default)]
    pub(crate) control: ControlFile,
    /// What happens, one after the other.
    #[serde(default)]
    pub(crate) phase: Vec<PhaseFile>,
    /// What must hold: `"tool.position_error.max <= 0.3 mm"`, with `during PHASE` for one phase only.
    #[serde(default)]
    pub(crate) requirements: Vec<String>,
    /// How much is recorded.
    #[serde(default)]
    pub(crate) output: OutputFile,
    /// What is not known exactly: `wrasse sweep` flies samples of it.
    #[serde(default)]
    pub(crate) disperse: Vec<DisperseFile>,
    /// Variants to compare: every combination of one row from each axis is run.
    #[serde(default)]
    pub(crate) compare: Vec<AxisFile>,
    /// What `wrasse size` makes of the variants.
    #[serde(default)]
    pub(crate) study: Option<StudyFile>,
}

/// One axis of a comparison.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisFile {
    /// What varies: the heading of its column.
    pub(crate) axis: String,
    /// The variants.
    pub(crate) row: Vec<RowFile>,
}

/// One variant.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RowFile {
    /// Its name in tables.
    pub(crate) name: String,
    /// A part of a mission that replaces what stands above: `set.control.arm_law = "terrestrial"`.
    #[serde(default)]
    #[allow(dead_code, reason = "laid over the document, which is then read again")]
    pub(crate) set: BTreeMap<String, serde_json::Value>,
}

/// An attitude, from the axes of the thing to those it is measured in: `{ rpy_deg = [roll, pitch, yaw] }`
/// or a unit quaternion, `{ w = …, x = …, y = …, z = … }` or `{ quaternion = { … } }`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(untagged)]
pub(crate) enum AttitudeFile {
    /// Turns about the fixed axes of what it is measured in, roll first (deg).
    Angles(AnglesFile),
    /// A unit quaternion.
    Parts(QuaternionFile),
    /// A unit quaternion, written as in a vehicle file.
    Quaternion(UnderQuaternionFile),
}

/// Roll, pitch and yaw.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnglesFile {
    /// Roll, pitch, yaw (deg): turns about fixed axes, roll first.
    pub(crate) rpy_deg: [f64; 3],
}

/// A unit quaternion under its name.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnderQuaternionFile {
    /// The quaternion.
    pub(crate) quaternion: QuaternionFile,
}

/// A unit quaternion.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct QuaternionFile {
    /// Scalar part.
    pub(crate) w: f64,
    /// First component of the vector part.
    pub(crate) x: f64,
    /// Second component of the vector part.
    pub(crate) y: f64,
    /// Third component of the vector part.
    pub(crate) z: f64,
}

/// Where everything is at the start.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct InitialFile {
    /// A posture that the vehicle file names.
    pub(crate) posture: Option<String>,
    /// Positions of turning joints by name; they replace the posture's.
    pub(crate) joints_deg: BTreeMap<String, f64>,
    /// Positions of sliding joints by name.
    pub(crate) joints_m: BTreeMap<String, f64>,
    /// Rates of turning joints by name.
    pub(crate) joint_rates_deg_s: BTreeMap<String, f64>,
    /// Rates of sliding joints by name.
    pub(crate) joint_rates_m_s: BTreeMap<String, f64>,
    /// Origin of the base, inertial axes.
    pub(crate) position_m: [f64; 3],
    /// Attitude of the base.
    pub(crate) attitude: Option<AttitudeFile>,
    /// Rate of the base, base axes.
    pub(crate) angular_velocity_deg_s: [f64; 3],
    /// Velocity of the base's origin, base axes.
    pub(crate) velocity_m_s: [f64; 3],
}

/// A rigid body that can be held. Its frame is the grip: the frame that coincides with the tool's
/// while it is held from the start.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PayloadFile {
    /// Mass.
    pub(crate) mass_kg: f64,
    /// Centre of mass from the grip, payload axes.
    #[serde(default)]
    pub(crate) centre_of_mass_m: [f64; 3],
    /// Edges of a uniform box, from which the inertia follows.
    #[serde(default)]
    pub(crate) uniform_box_m: Option<[f64; 3]>,
    /// Inertia about the centre of mass: xx, yy, zz.
    #[serde(default)]
    pub(crate) inertia_kgm2: Option<[f64; 3]>,
    /// Products of inertia: xy, xz, yz (the off-diagonal elements of the matrix).
    #[serde(default)]
    pub(crate) products_kgm2: [f64; 3],
    /// Held by the tool of this name from the start.
    #[serde(default)]
    pub(crate) held_by: Option<String>,
    /// Floating freely at the start.
    #[serde(default)]
    pub(crate) free: Option<FreeFile>,
}

/// Where a free payload is at the start.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct FreeFile {
    /// Name of the frame that the pose is seen from; inertial space if there is none.
    pub(crate) seen_from: Option<String>,
    /// Origin of the grip.
    pub(crate) position_m: [f64; 3],
    /// Attitude of the grip.
    pub(crate) attitude: Option<AttitudeFile>,
    /// Velocity of the grip, inertial axes.
    pub(crate) velocity_m_s: [f64; 3],
    /// Angular velocity, inertial axes.
    pub(crate) angular_velocity_deg_s: [f64; 3],
}

/// What becomes of the base's attitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum BaseFile {
    /// Held exactly; the torque that this takes is recorded.
    Held,
    /// By the attitude law through the vehicle's actuators.
    Controlled,
    /// Nothing acts on it but the arm.
    Free,
}

/// How joints move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum JointsFile {
    /// They follow their set-points exactly, whatever it takes.
    Prescribed,
    /// Driven by the torque of the arm law, within their limits.
    Torque,
}

/// The simulated truth.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct WorldFile {
    /// What becomes of the base's attitude.
    pub(crate) base_attitude: BaseFile,
    /// How the joints move.
    pub(crate) joints: JointsFile,
    /// Joints that are driven by torque while the others are prescribed.
    pub(crate) torque_joints: Vec<String>,
    /// Step of the fixed-step integrator, 0.005 unless given; at most the control period is used.
    pub(crate) step_s: Option<f64>,
    /// Error allowed in each step of the adaptive integrator; it replaces the fixed step.
    pub(crate) adaptive_tolerance: Option<f64>,
    /// Wrenches from outside.
    pub(crate) applied_wrench: Vec<WrenchFile>,
}

impl Default for WorldFile {
    fn default() -> Self {
        Self {
            base_attitude: BaseFile::Free,
            joints: JointsFile::Prescribed,
            torque_joints: vec![],
            step_s: None,
            adaptive_tolerance: None,
            applied_wrench: vec![],
        }
    }
}

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

/// How much is recorded.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct OutputFile {
    /// Samples per second in the telemetry; metrics always see every control period.
    pub(crate) rate_hz: f64,
    /// Instants in the drawing of the motion.
    pub(crate) snapshots: u32,
}

impl Default for OutputFile {
    fn default() -> Self {
        Self { rate_hz: 20.0, snapshots: 6 }
    }
}

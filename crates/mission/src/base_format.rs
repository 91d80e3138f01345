//! How the base is controlled, what fails, what pushes and what is studied: parts of a mission file.

use crate::phase_format::AxesFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which actuators turn the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ActuatorsFile {
    /// The vehicle's ideal `[attitude_actuator]`, with its limits.
    Ideal,
    /// An ideal one without limits: it shows what is asked for.
    Unlimited,
    /// The wheels, CMGs and thrusters of `[actuators]`.
    Fitted,
}

/// What the laws know the state by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SensingFile {
    /// Perfect sensors.
    Perfect,
    /// The sensors of `[sensors]`, and estimates made of what they say.
    Fitted,
}

/// How the wheels share a torque.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum WheelLawFile {
    /// Least sum of squares of the motor torques.
    #[default]
    PseudoInverse,
    /// Least largest motor torque.
    MinimumPeak,
}

/// How the gimbals of the CMGs are turned.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum CmgLawFile {
    /// Least gimbal rates: exact, and lost at a singular setting.
    PseudoInverse,
    /// Damped near singular settings: finite rates, but stuck on the internal ones.
    SingularityRobust,
    /// Damped with off-diagonal terms that shake the gimbals out of internal singular settings.
    #[default]
    GeneralizedSingularityRobust,
}

/// From a wanted torque to what each actuator is told.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SteeringFile {
    /// How the wheels share a torque.
    pub(crate) wheels: WheelLawFile,
    /// How fast wheel speeds are evened out where that gives no torque.
    pub(crate) wheel_null_gain_per_s: f64,
    /// How the gimbals are turned.
    #[schemars(extend("x-formerly" = ["gyros"]))]
    pub(crate) cmgs: CmgLawFile,
    /// How fast gimbals move away from singular settings where that gives no torque (rad/s for a unit
    /// slope of the singularity measure).
    #[schemars(extend("x-formerly" = ["gyro_null_gain_rad_s"]))]
    pub(crate) cmg_null_gain_rad_s: f64,
    /// Direction of the momentum that the CMGs will have to take up, base axes, of any length: gimbals
    /// start at angles that are searched for it, from which plain steering goes farthest without
    /// coming near a singular setting. They replace the angles of `[actuators]`.
    pub(crate) preferred_for: Option<[f64; 3]>,
    /// How thrusters are pulsed.
    pub(crate) modulation: ModulationFile,
    /// When thrusters empty wheels and CMGs.
    pub(crate) unloading: Option<UnloadingFile>,
}

impl Default for SteeringFile {
    fn default() -> Self {
        Self {
            wheels: WheelLawFile::default(),
            wheel_null_gain_per_s: 0.02,
            cmgs: CmgLawFile::default(),
            cmg_null_gain_rad_s: 0.02,
            preferred_for: None,
            modulation: ModulationFile::default(),
            unloading: None,
        }
    }
}

/// Pulse-width pulse-frequency modulation: a lag and a switch with hysteresis for each thruster.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ModulationFile {
    /// Gain before the lag.
    pub(crate) gain: f64,
    /// Time constant of the lag.
    pub(crate) lag_s: f64,
    /// The lag's output at which the thruster opens, as a share of full force.
    pub(crate) opens_at: f64,
    /// The lag's output at which it shuts.
    pub(crate) shuts_at: f64,
}

impl Default for ModulationFile {
    fn default() -> Self {
        Self { gain: 4.0, lag_s: 0.4, opens_at: 0.25, shuts_at: 0.05 }
    }
}

/// Thrusters take over what wheels and CMGs have stored.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnloadingFile {
    /// Stored momentum at which it begins.
    pub(crate) begins_at_nms: f64,
    /// Stored momentum at which it ends.
    pub(crate) ends_at_nms: f64,
    /// How fast: torque of the thrusters for each N·m·s stored.
    pub(crate) gain_per_s: f64,
}

/// Keep the centre of mass where it was at the start, by thrusters.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PositionHoldFile {
    /// Bandwidth of the loop.
    pub(crate) bandwidth_rad_s: f64,
    /// Damping ratio of the loop.
    #[serde(default = "one")]
    pub(crate) damping_ratio: f64,
}

fn one() -> f64 {
    1.0
}

/// What estimates start from.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct EstimationFile {
    /// How well the attitude is known at the start (one sigma).
    pub(crate) attitude_sigma_deg: f64,
    /// How well the gyro's bias is known at the start (one sigma). The estimate starts at zero.
    pub(crate) bias_sigma_deg_h: f64,
    /// Bandwidth of the filters that make joint rates of encoder positions.
    pub(crate) joint_bandwidth_rad_s: f64,
}

impl Default for EstimationFile {
    fn default() -> Self {
        Self { attitude_sigma_deg: 0.01, bias_sigma_deg_h: 1.0, joint_bandwidth_rad_s: 60.0 }
    }
}

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
    #[serde(default = "inertial")]
    pub(crate) axes: AxesFile,
    /// When it begins.
    pub(crate) from_s: f64,
    /// How long it lasts, rise and fall included.
    pub(crate) duration_s: f64,
    /// Time in which it rises, and falls, as a raised cosine.
    #[serde(default)]
    pub(crate) ramp_s: f64,
}

fn inertial() -> AxesFile {
    AxesFile::Inertial
}

/// How a unit fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FailureKindFile {
    /// A wheel's motor gives no torque; the bearing rubs on.
    Dead,
    /// A gimbal stands still.
    Stuck,
    /// A thruster does not open.
    Shut,
    /// A thruster does not shut.
    Open,
}

/// A unit that fails.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FailureFile {
    /// Name of a wheel, CMG or thruster.
    pub(crate) unit: String,
    /// How it fails.
    pub(crate) kind: FailureKindFile,
    /// When.
    pub(crate) at_s: f64,
    /// How long after that it is reported to the flight computer, which disables the unit; never, if not
    /// given.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["told_after_s"]))]
    pub(crate) reported_after_s: Option<f64>,
}

/// What the claim of a study says, where verdicts can be held against it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ClaimIs {
    /// Wheels do not suffice, and CMGs do.
    #[schemars(extend("x-formerly" = ["gyros-needed"]))]
    CmgsNeeded,
}

/// What `wrasse size` makes of the cases.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StudyFile {
    /// The claim that is examined, in a sentence.
    #[serde(default)]
    pub(crate) claim: String,
    /// What it says, if findings are to be held against it.
    #[serde(default)]
    pub(crate) claim_is: Option<ClaimIs>,
    /// Name of the compared axis whose rows are tasks; the mission is the one task if there is none.
    #[serde(default)]
    pub(crate) tasks: Option<String>,
    /// Name of the compared axis whose rows are sets of actuators.
    pub(crate) sets: String,
    /// The row of that axis that is ideal: every task is flown with it.
    pub(crate) reference: String,
    /// Tasks that are flown with every set; the others are judged on what the reference was asked.
    #[serde(default)]
    pub(crate) closed_loop: Vec<String>,
    /// Most mass that a set may have.
    #[serde(default)]
    pub(crate) mass_limit_kg: Option<f64>,
    /// Most power that a set may take.
    #[serde(default)]
    pub(crate) power_limit_w: Option<f64>,
}

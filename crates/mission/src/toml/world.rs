//! `[world]`: the simulated truth.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::applied_wrench::WrenchFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::at;
use wrasse_dynamics::State;
use wrasse_rehearsal::figures::rounded;
use wrasse_spatial::Vec3;
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Environment, Stepper};

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
    /// Acceleration of what falls freely, inertial axes; free space if not given. The laws do not know of
    /// it.
    pub(crate) gravity_m_s2: Option<[f64; 3]>,
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
            gravity_m_s2: None,
            applied_wrench: vec![],
        }
    }
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

/// Strongest gravity that is believed (m/s²): Jupiter has 25.
const STRONG: f64 = 100.0;

/// What surrounds the vehicle.
pub(crate) fn environment(r: &mut Reading<'_>, file: &MissionFile) -> Environment {
    let acceleration_N = Vec3::from_array(file.world.gravity_m_s2.unwrap_or_default());
    let strength = acceleration_N.norm();
    if strength > STRONG {
        let message =
            format!("gravity of {} m/s² is stronger than any planet's", rounded(strength));
        r.warning(at!["world", "gravity_m_s2"], message, "the Earth has 9.8 m/s²");
    }
    if strength == 0.0 {
        return Environment::FreeSpace;
    }
    Environment::UniformGravity { acceleration_N }
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
    // A follower is driven by its leader.
    for follower in &r.vehicle.followers {
        torque[follower.joint] = torque[follower.leader];
    }
    torque
}

//! The table `[actuators]` of vehicle and mission files, and the numbers of a unit, which a file gives
//! itself or takes from the hardware catalogue.

use crate::format::{OrientationFile, SourceFile};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Wheels, CMGs and thrusters of the base, and the tank of the thrusters.
///
/// Units are matter of the base: its mass and inertia include theirs. Propellant comes on top.
/// Positions and directions are in the base's frame.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EquipmentFile {
    /// What the set is called in tables; made from its units if not given.
    #[schemars(length(min = 1))]
    pub(crate) name: Option<String>,
    /// Reaction wheels.
    #[serde(default)]
    pub(crate) wheel: Vec<WheelFile>,
    /// Control moment gyros, one by one.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["gyro"]))]
    pub(crate) cmg: Vec<CmgFile>,
    /// Arrays of equal control moment gyros; they come after those of `cmg`.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["gyro_array"]))]
    pub(crate) cmg_array: Vec<CmgArrayFile>,
    /// Thrusters, one by one.
    #[serde(default)]
    pub(crate) thruster: Vec<ThrusterFile>,
    /// Sets of equal thrusters; they come after those of `thruster`.
    #[serde(default)]
    pub(crate) thruster_set: Vec<ThrusterSetFile>,
    /// The tank of all thrusters; without one they never run dry and nothing grows lighter.
    pub(crate) tank: Option<TankFile>,
    /// Where the numbers of all units come from that have no source of their own.
    pub(crate) source: Option<SourceFile>,
}

/// A reaction wheel: of a model of the catalogue, or by its own numbers, or a model with some numbers
/// replaced.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A reaction wheel of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Direction of the spin axis, base axes (–); any length.
    pub(crate) axis: [f64; 3],
    /// Speed at the start (rpm); zero if not given.
    pub(crate) speed_rpm: Option<f64>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: WheelNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// What a reaction wheel can do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
pub(crate) struct WheelNumbers {
    /// Largest torque of the motor (N·m).
    pub(crate) torque_limit_nm: Option<f64>,
    /// Largest speed (rpm).
    pub(crate) speed_limit_rpm: Option<f64>,
    /// Inertia about the spin axis (kg·m²); follows from momentum and speed.
    pub(crate) inertia_kgm2: Option<f64>,
    /// Momentum at the largest speed (N·m·s); follows from inertia and speed.
    pub(crate) momentum_nms: Option<f64>,
    /// Coulomb friction of the bearing (N·m); none if not given.
    pub(crate) coulomb_friction_nm: Option<f64>,
    /// Viscous friction of the bearing (N·m for each rad/s); none if not given.
    pub(crate) viscous_friction_nms: Option<f64>,
    /// Torque commands are rounded to multiples of this (N·m); not rounded if not given.
    pub(crate) torque_step_nm: Option<f64>,
    /// Mass (kg), part of the base's; for tables.
    pub(crate) mass_kg: Option<f64>,
    /// Electric power (W); for tables.
    pub(crate) power_w: Option<f64>,
}

/// A single-gimbal control moment gyro: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CmgFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A control moment gyro of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Direction of the gimbal axis, base axes (–); any length.
    pub(crate) gimbal_axis: [f64; 3],
    /// Direction of the spin axis at zero gimbal angle, base axes (–); across the gimbal axis.
    pub(crate) spin_axis: [f64; 3],
    /// Gimbal angle at the start (deg); zero if not given.
    pub(crate) gimbal_angle_deg: Option<f64>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: CmgNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// What a control moment gyro can do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
pub(crate) struct CmgNumbers {
    /// Momentum of the rotor (N·m·s).
    pub(crate) momentum_nms: Option<f64>,
    /// Largest gimbal rate (deg/s); follows from torque and momentum.
    pub(crate) gimbal_rate_limit_deg_s: Option<f64>,
    /// Largest torque on the base (N·m): momentum times largest gimbal rate.
    pub(crate) torque_limit_nm: Option<f64>,
    /// Largest gimbal acceleration (deg/s²).
    pub(crate) gimbal_acceleration_limit_deg_s2: Option<f64>,
    /// Inertia of gimbal and rotor about the gimbal axis (kg·m²).
    pub(crate) gimbal_inertia_kgm2: Option<f64>,
    /// Largest torque of the gimbal motor (N·m).
    pub(crate) motor_torque_limit_nm: Option<f64>,
    /// Bandwidth of the servo that holds the gimbal's rate (rad/s).
    pub(crate) servo_bandwidth_rad_s: Option<f64>,
    /// Mass (kg), part of the base's; for tables.
    pub(crate) mass_kg: Option<f64>,
    /// Electric power (W); for tables.
    pub(crate) power_w: Option<f64>,
}

/// An array of equal CMGs in a frame of its own, its axis along z. They are called NAME-1, NAME-2, ….
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CmgArrayFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A control moment gyro of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// How the CMGs are mounted.
    pub(crate) arrangement: CmgArrangementFile,
    /// Angle between gimbal axes and z (deg), of a pyramid or a roof.
    pub(crate) skew_deg: Option<f64>,
    /// Number of CMGs of a roof: 4, 6 or 8.
    #[schemars(range(min = 4, max = 8))]
    pub(crate) count: Option<usize>,
    /// How the array is turned from the base's axes; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// Gimbal angle of each CMG at the start (deg). If not given: zero in a pyramid; evenly from -45 to
    /// 45 along each row of a roof; 45, -45, 45, -45 in a box. All of these add up to no momentum and
    /// can make torque about any axis.
    pub(crate) gimbal_angles_deg: Option<Vec<f64>>,
    /// What each CMG can do.
    #[serde(flatten)]
    pub(crate) numbers: CmgNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// A way of mounting several CMGs. s and c are sine and cosine of the skew.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum CmgArrangementFile {
    /// Four CMGs on the faces of a pyramid: gimbal axes stand on the faces, CMG 1 at (s, 0, c) with
    /// its spin axis at zero angle along y; each of the others is turned a further 90 deg about z.
    Pyramid,
    /// Two rows of CMGs on the slopes of a roof whose ridge is x: gimbal axes stand on the slopes, at
    /// (0, s, c) for the first half of the CMGs and (0, -s, c) for the second. Spin axes at zero angle
    /// lie along x in the first row and along -x in the second.
    Roof,
    /// Four CMGs in the four upright sides of a box, gimbal axes pointing out along x, y, -x, -y: a
    /// pyramid of 90 deg skew, two pairs of parallel gimbals.
    Box,
}

/// A thruster: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrusterFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A thruster of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Where its force acts, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// Direction of the force on the vehicle, base axes (–); any length. The plume goes the other way.
    pub(crate) direction: [f64; 3],
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: ThrusterNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// What a thruster can do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
pub(crate) struct ThrusterNumbers {
    /// Force when fully open (N).
    pub(crate) force_n: Option<f64>,
    /// Specific impulse (s).
    pub(crate) specific_impulse_s: Option<f64>,
    /// Shortest time that it can be open (s); zero if not given.
    pub(crate) minimum_on_time_s: Option<f64>,
    /// Time from shut to full force (s); zero if not given.
    pub(crate) rise_time_s: Option<f64>,
    /// Time from full force to none (s); zero if not given.
    pub(crate) fall_time_s: Option<f64>,
    /// Standard deviation of the impulse of a pulse (% of it); zero if not given.
    pub(crate) impulse_noise_percent: Option<f64>,
    /// Mass (kg), part of the base's; for tables.
    pub(crate) mass_kg: Option<f64>,
    /// Electric power while it is open (W); for tables.
    pub(crate) power_w: Option<f64>,
}

/// A set of equal thrusters that gives force and torque both ways about every axis. They are called
/// NAME-1, NAME-2, ….
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrusterSetFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A thruster of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// How the thrusters are mounted.
    pub(crate) arrangement: ThrusterArrangementFile,
    /// Number of thrusters: 12 (two in each face, side by side, pushing inward), 16 (four in the middle
    /// of each of the faces +y, +z, -y, -z: along x, -x and both ways along the face), or 24 (three in
    /// each corner, pushing inward along x, y and z).
    #[schemars(range(min = 12, max = 24))]
    pub(crate) count: usize,
    /// Edges of the box along its x, y, z (m).
    pub(crate) edges_m: [f64; 3],
    /// Middle of the box, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How the box is turned from the base's axes; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// What each thruster can do.
    #[serde(flatten)]
    pub(crate) numbers: ThrusterNumbers,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// A way of mounting several thrusters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ThrusterArrangementFile {
    /// On a box.
    Box,
}

/// The tank of the thrusters.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TankFile {
    /// Propellant at the start (kg), on top of the masses of the bodies.
    pub(crate) propellant_kg: f64,
    /// Centre of the propellant, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

//! The TOML format of vehicle files, as plain data. What these comments say is what an editor shows:
//! the JSON Schema is made from them.

use crate::equipment_format::EquipmentFile;
use crate::sensor_format::SensorsFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A vehicle: a free-flying base and what hangs on it.
///
/// Every number says its unit in its key. The base is the body that no joint carries, with everything
/// fixed to it; its frame is that body's frame.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VehicleFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// One line for lists and reports.
    pub(crate) summary: String,
    /// Where all those numbers come from that have no source of their own.
    pub(crate) source: Option<SourceFile>,
    /// Rigid bodies, each with a frame of its own.
    pub(crate) body: Vec<BodyFile>,
    /// Joints, each given by the pose of the child's frame on the parent.
    #[serde(default)]
    pub(crate) joint: Vec<JointFile>,
    /// Arms given by Denavit-Hartenberg rows; their joints come after those of `joint`.
    #[serde(default)]
    pub(crate) arm: Vec<ArmFile>,
    /// Named frames where a tool works or a payload is held.
    #[serde(default)]
    pub(crate) tool: Vec<ToolFile>,
    /// Named positions of the joints.
    #[serde(default)]
    pub(crate) posture: Vec<PostureFile>,
    /// What holds and turns the base, as an ideal.
    pub(crate) attitude_actuator: Option<ActuatorFile>,
    /// What holds, turns and moves the base, unit by unit.
    pub(crate) actuators: Option<EquipmentFile>,
    /// What attitude and joints are felt with.
    pub(crate) sensors: Option<SensorsFile>,
}

/// Where numbers come from.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum SourceFile {
    /// They stand in this document: title, year, page or table.
    Published(#[schemars(length(min = 1))] String),
    /// They were computed from published numbers, in this way.
    Derived(#[schemars(length(min = 1))] String),
    /// They were chosen, for this reason.
    Assumed(#[schemars(length(min = 1))] String),
}

/// A rigid body. Without `mass_kg` it is a mere frame.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// Mass (kg).
    pub(crate) mass_kg: Option<f64>,
    /// Centre of mass, in the body's frame (m).
    pub(crate) centre_of_mass_m: Option<[f64; 3]>,
    /// Rotational inertia about a named point in named axes (kg·m²).
    pub(crate) inertia_kgm2: Option<InertiaFile>,
    /// Why mass properties that no rigid body can have are to be used all the same.
    #[schemars(length(min = 1))]
    pub(crate) accept_nonphysical: Option<String>,
    /// What to draw. It has no effect on the motion; tool and loads must stay outside of the base's.
    #[serde(default)]
    pub(crate) shape: Vec<ShapeFile>,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// Elements of an inertia tensor (kg·m²): off its diagonal they are −∫xy dm and so on.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaFile {
    /// The point about which it is taken.
    pub(crate) about: AboutFile,
    /// The axes in which its elements are.
    pub(crate) axes: AxesFile,
    /// ∫(y² + z²) dm (kg·m²).
    pub(crate) xx: f64,
    /// ∫(x² + z²) dm (kg·m²).
    pub(crate) yy: f64,
    /// ∫(x² + y²) dm (kg·m²).
    pub(crate) zz: f64,
    /// −∫xy dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) xy: f64,
    /// −∫xz dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) xz: f64,
    /// −∫yz dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) yz: f64,
}

/// The point about which an inertia is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AboutFile {
    /// The centre of mass.
    CentreOfMass,
    /// The origin of the body's frame.
    Origin,
}

/// The axes in which an inertia is given.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum AxesFile {
    /// Those of the body's frame.
    Body,
    /// Those turned from the body's frame by roll, pitch and yaw (deg).
    RpyDeg([f64; 3]),
    /// Those turned from the body's frame by this quaternion (–).
    Quaternion(QuaternionFile),
}

/// How a frame is turned.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum OrientationFile {
    /// Roll, pitch and yaw (deg): turns about the fixed axes x, then y, then z of the frame it is
    /// turned from.
    RpyDeg([f64; 3]),
    /// Unit quaternion (–): turns components in this frame into components in the one it is turned
    /// from.
    Quaternion(QuaternionFile),
}

/// A unit quaternion by its named parts (–).
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct QuaternionFile {
    /// Scalar part (–).
    pub(crate) w: f64,
    /// Along x (–).
    pub(crate) x: f64,
    /// Along y (–).
    pub(crate) y: f64,
    /// Along z (–).
    pub(crate) z: f64,
}

/// An outline for drawings: one of box, cylinder, sphere.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShapeFile {
    /// Edge lengths along x, y, z (m).
    pub(crate) box_m: Option<[f64; 3]>,
    /// A cylinder along its z axis.
    pub(crate) cylinder: Option<CylinderFile>,
    /// Radius of a sphere (m).
    pub(crate) sphere_radius_m: Option<f64>,
    /// Its middle, in the body's frame (m); the centre of mass if not given.
    pub(crate) position_m: Option<[f64; 3]>,
    /// How it is turned from the body's frame.
    pub(crate) orientation: Option<OrientationFile>,
}

/// A cylinder along its z axis.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    /// Radius (m).
    pub(crate) radius_m: f64,
    /// Length (m).
    pub(crate) length_m: f64,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum KindFile {
    /// Turns about its axis, within its travel.
    Revolute,
    /// Turns about its axis without end.
    Continuous,
    /// Slides along its axis, within its travel.
    Prismatic,
    /// Does not move.
    Fixed,
}

/// A joint between two bodies.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// How it moves.
    pub(crate) kind: KindFile,
    /// The body that carries it.
    #[schemars(length(min = 1))]
    pub(crate) parent: String,
    /// The body that it carries.
    #[schemars(length(min = 1))]
    pub(crate) child: String,
    /// Origin of the child's frame at zero travel, in the parent's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How the child's frame is turned from the parent's at zero travel; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// Direction of the axis through the child's origin, in the child's frame (–); any length.
    pub(crate) axis: Option<[f64; 3]>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) limits: LimitsFile,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// What a joint can do; what is not given is not limited.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
pub(crate) struct LimitsFile {
    /// Lower and upper end of the travel of a revolute joint (deg).
    pub(crate) travel_deg: Option<[f64; 2]>,
    /// Lower and upper end of the travel of a prismatic joint (m).
    pub(crate) travel_m: Option<[f64; 2]>,
    /// Largest rate of a joint that turns (deg/s).
    pub(crate) rate_deg_s: Option<f64>,
    /// Largest rate of a joint that slides (m/s).
    pub(crate) rate_m_s: Option<f64>,
    /// Largest torque of the drive of a joint that turns (N·m).
    pub(crate) effort_nm: Option<f64>,
    /// Largest force of the drive of a joint that slides (N).
    pub(crate) effort_n: Option<f64>,
}

/// An arm by its Denavit-Hartenberg rows, base to tip.
///
/// In both conventions the mount is frame 0 and the bodies named by the rows are frames 1, 2, … of
/// the convention: mass properties and tools are given in them. What differs is where they sit:
///
/// `standard`: frame i is `Rz(theta) Tz(d) Tx(a) Rx(alpha)` from frame i−1. It sits at the far end of
/// link i, its z along the axis of joint i+1; joint i moves about or along the z of frame i−1.
///
/// `modified`: frame i is `Rx(alpha) Tx(a) Rz(theta) Tz(d)` from frame i−1, with the alpha and a that
/// stand in row i (those of link i−1 in Craig's numbering). It sits at the near end of link i; joint i
/// moves about or along its own z.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ArmFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// Which of the two ways of attaching frames to links the rows follow.
    pub(crate) convention: ConventionFile,
    /// Where frame 0 is.
    pub(crate) mount: MountFile,
    /// One row for each joint, base to tip.
    pub(crate) row: Vec<RowFile>,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// A way of attaching frames to links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ConventionFile {
    /// Denavit and Hartenberg 1955, Paul: each frame at the far end of its link.
    Standard,
    /// Khalil and Kleinfinger, Craig: each frame at the near end of its link.
    Modified,
}

/// A frame on a body.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MountFile {
    /// The body that carries it.
    #[schemars(length(min = 1))]
    pub(crate) on: String,
    /// Its origin, in the body's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How it is turned from the body's frame; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
}

/// One Denavit-Hartenberg row: a joint and the body that it carries.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RowFile {
    /// What the joint is called.
    #[schemars(length(min = 1))]
    pub(crate) joint: String,
    /// The body that it carries, one of `body`.
    #[schemars(length(min = 1))]
    pub(crate) body: String,
    /// How it moves: `revolute`, `continuous` or `prismatic`.
    pub(crate) kind: KindFile,
    /// Length along x (m).
    pub(crate) a_m: f64,
    /// Twist about x (deg).
    pub(crate) alpha_deg: f64,
    /// Offset along z (m); of a prismatic joint, at zero travel.
    pub(crate) d_m: f64,
    /// Angle about z (deg); of a joint that turns, at zero travel.
    pub(crate) theta_deg: f64,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) limits: LimitsFile,
}

/// A named frame where a tool works or a payload is held.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// The body that carries it.
    #[schemars(length(min = 1))]
    pub(crate) on: String,
    /// Its origin, in the body's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How it is turned from the body's frame; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// How far the grip of a payload may be from the tool when it grasps it.
    #[serde(default)]
    pub(crate) grasp_bounds: GraspBoundsFile,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
}

/// How far the grip of a payload may be from a tool that grasps it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct GraspBoundsFile {
    /// Largest distance between the origins of tool and grip (m).
    pub(crate) distance_m: f64,
    /// Largest angle between their axes (deg).
    pub(crate) angle_deg: f64,
}

impl Default for GraspBoundsFile {
    fn default() -> Self {
        Self { distance_m: 0.005, angle_deg: 0.5 }
    }
}

/// Named positions of the joints; a joint that is not named is at zero.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PostureFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// Positions of joints that turn, by name (deg).
    #[serde(default)]
    pub(crate) joints_deg: BTreeMap<String, f64>,
    /// Positions of joints that slide, by name (m).
    #[serde(default)]
    pub(crate) joints_m: BTreeMap<String, f64>,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
}

/// An ideal attitude actuator: any torque up to its limit, at once, stored as momentum.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ActuatorFile {
    /// Largest torque about each base axis (N·m).
    pub(crate) torque_limit_nm: f64,
    /// Largest stored momentum about each base axis (N·m·s).
    pub(crate) momentum_limit_nms: f64,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

//! A checked vehicle: everything that the rest of the program knows of it.

use crate::assembly::{Link, Matter};
use crate::equipment::Equipment;
use crate::provenance::Provenance;
use std::path::Path;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};
use wrasse_dynamics::{Frame, Robot};
use wrasse_hardware::{AttitudeActuator, JointLimits, Sensors};
use wrasse_spatial::{Pose, Sym3, Vec3};

/// Most moving joints a vehicle can have.
pub const JOINTS: usize = 56;

/// The robot of a vehicle file.
pub type VehicleRobot = Robot<f64, JOINTS>;

/// A servicer, checked: physically possible unless its file says otherwise, and a tree.
#[derive(Debug, Clone)]
pub struct Vehicle {
    /// Its name.
    pub name: String,
    /// One line for lists and reports.
    pub summary: String,
    /// The whole text of its file.
    pub text: String,
    /// The files that it includes, in the order in which they were read: path and text.
    pub included: Vec<Arc<Source>>,
    /// Its dynamics.
    pub robot: VehicleRobot,
    /// Names of the moving joints, in the robot's order.
    pub joint_names: Vec<String>,
    /// Limits of the moving joints, in the robot's order.
    pub limits: Vec<JointLimits<f64>>,
    /// Joints without a drive of their own: each moves as its leader does.
    pub followers: Vec<Follower>,
    /// The matter of each link that has any.
    pub matter: Vec<LinkMatter>,
    /// Every link, mount and tool by name: fixed links are frames of the body that carries them.
    pub frames: Vec<NamedFrame>,
    /// Names of the frames that are tools, in the order of the file (empty for a URDF).
    pub tools: Vec<String>,
    /// Named joint postures.
    pub postures: Vec<Posture>,
    /// The ideal attitude actuator, if the file has one.
    pub attitude_actuator: Option<AttitudeActuator<f64>>,
    /// Wheels, CMGs and thrusters; none if the file has none.
    pub equipment: Equipment,
    /// What attitude and joints are felt with; perfect if the file does not say.
    pub sensors: Sensors<f64>,
    /// What to draw.
    pub shapes: Vec<Shape>,
    /// Where its numbers come from, in the order of the file; those of the equipment say it themselves.
    pub provenance: Vec<Provenance>,
    /// What no document says of the real vehicle, as its file lists it.
    pub not_public: Vec<String>,
    /// Warnings and notes of the reading: implausible values, tags not used.
    pub remarks: Vec<Complaint>,
}

/// A joint that follows another one: `q = ratio × q of the leader + offset`.
///
/// A gear without play: what the follower takes is taken from the leader, `ratio` times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Follower {
    /// Its number.
    pub joint: usize,
    /// The number of the joint that it follows, which has a drive of its own.
    pub leader: usize,
    /// Travel per travel of the leader (–, rad/m or m/rad), not zero.
    pub ratio: f64,
    /// Travel when the leader is at zero (rad or m).
    pub offset: f64,
}

/// Puts each follower where its leader has it (rad or m).
pub fn follow(followers: &[Follower], q: &mut [f64]) {
    for &Follower { joint, leader, ratio, offset } in followers {
        if let Some(&at) = q.get(leader)
            && let Some(place) = q.get_mut(joint)
        {
            *place = ratio * at + offset;
        }
    }
}

/// Gives each follower the rate that its leader makes it have (rad/s or m/s).
pub fn follow_rates(followers: &[Follower], v: &mut [f64]) {
    for &Follower { joint, leader, ratio, .. } in followers {
        if let Some(&rate) = v.get(leader)
            && let Some(place) = v.get_mut(joint)
        {
            *place = ratio * rate;
        }
    }
}

/// What one link is made of, before it is merged with those fixed to it.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkMatter {
    /// Name of the link; its frame is that of [`Vehicle::frame`].
    pub link: String,
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass in link axes (m).
    pub p_cm: Vec3<f64>,
    /// Inertia about the centre of mass, in link axes (kg·m²).
    pub inertia: Sym3<f64>,
}

impl LinkMatter {
    pub(crate) fn of(link: &Link) -> Option<Self> {
        let matter = link.matter.as_ref()?;
        let &Matter { mass, p_cm, inertia, .. } = matter;
        Some(Self { link: link.name.clone(), mass, p_cm, inertia })
    }
}

/// A frame and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedFrame {
    /// Name of the link or tool.
    pub name: String,
    /// Where it is fixed.
    pub frame: Frame<f64>,
    /// How far the grip of a payload may be from it when it is grasped here.
    pub grasp_bounds: GraspBounds,
}

/// How far the grip of a payload may be from a tool that grasps it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GraspBounds {
    /// Largest distance between the origins of tool and grip (m).
    pub distance: f64,
    /// Largest angle between their axes (rad).
    pub angle: f64,
}

/// A named joint posture.
#[derive(Debug, Clone, PartialEq)]
pub struct Posture {
    /// Its name.
    pub name: String,
    /// Joint positions in the robot's order (rad or m); joints that it does not name are at zero.
    pub q: Vec<f64>,
}

/// A body's outline: for drawings, and for what must stay outside of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Name of the link.
    pub link: String,
    /// Where it is.
    pub frame: Frame<f64>,
    /// What it looks like, centred on the frame.
    pub kind: ShapeKind,
}

/// Simple outlines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShapeKind {
    /// A box with these edge lengths (m).
    Box(Vec3<f64>),
    /// A cylinder along z: radius and length (m).
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Length (m).
        length: f64,
    },
    /// A sphere of this radius (m).
    Sphere(f64),
}

impl ShapeKind {
    /// All lengths of which each must be positive (m).
    pub(crate) fn sizes(self) -> Vec<f64> {
        match self {
            Self::Box(edges) => edges.to_array().to_vec(),
            Self::Cylinder { radius, length } => vec![radius, length],
            Self::Sphere(radius) => vec![radius],
        }
    }
}

impl Vehicle {
    /// The frame of this name.
    pub fn frame(&self, name: &str) -> Option<Frame<f64>> {
        self.frames.iter().find(|f| f.name == name).map(|f| f.frame)
    }
    /// The texts that it was read from: its own file, of which it does not know the path, then those that
    /// this one includes.
    pub fn files(&self) -> impl Iterator<Item = (Option<&Path>, &str)> {
        let included = self.included.iter();
        let included = included.map(|source| (Some(source.path.as_path()), source.text.as_str()));
        std::iter::once((None, self.text.as_str())).chain(included)
    }
    /// The number of the joint of this name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joint_names.iter().position(|n| n == name)
    }
    /// The posture of this name.
    pub fn posture(&self, name: &str) -> Option<&Posture> {
        self.postures.iter().find(|p| p.name == name)
    }
    /// `X_BF` of a named frame on its body.
    pub fn pose_on_body(&self, name: &str) -> Option<Pose<f64>> {
        self.frame(name).map(|f| f.X_BF)
    }
}

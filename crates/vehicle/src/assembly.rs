//! What every reader hands over: named links and joints with the places they were read from. One
//! step behind all readers checks that they are a physically possible tree and builds the robot.

use std::ops::Range;
use wrasse_dynamics::JointKind;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Sym3, Vec3};

/// A link as its file gives it.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    /// Name, and where it stands in the file.
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Mass properties; `None` for a massless frame.
    pub(crate) matter: Option<Matter>,
}

/// Mass properties of one link.
#[derive(Debug, Clone)]
pub(crate) struct Matter {
    /// Mass (kg), and where it stands.
    pub(crate) mass: f64,
    pub(crate) mass_at: Range<usize>,
    /// Centre of mass in link axes (m).
    pub(crate) p_cm: Vec3<f64>,
    /// Inertia about the centre of mass, in link axes (kg·m²), and where it stands.
    pub(crate) inertia: Sym3<f64>,
    pub(crate) inertia_at: Range<usize>,
    /// The file's reason for mass properties that cannot be.
    pub(crate) accept_nonphysical: Option<String>,
}

/// A joint as its file gives it.
#[derive(Debug, Clone)]
pub(crate) struct AssemblyJoint {
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Names of parent and child link, and where they stand.
    pub(crate) parent: String,
    pub(crate) parent_at: Range<usize>,
    pub(crate) child: String,
    pub(crate) child_at: Range<usize>,
    /// `None` for a fixed joint.
    pub(crate) kind: Option<JointKind>,
    /// `X_PC` at zero travel.
    pub(crate) X_PC: Pose<f64>,
    /// Axis in child axes; any length but zero.
    pub(crate) axis: Vec3<f64>,
    pub(crate) axis_at: Range<usize>,
    pub(crate) limits: JointLimits<f64>,
    pub(crate) limits_at: Range<usize>,
}

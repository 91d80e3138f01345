//! The tables `[[arm]]`: Denavit-Hartenberg rows, standard and modified, to joints between bodies.
//!
//! A joint's axis must go through the origin of the frame that it carries. In the modified convention
//! frame i is such a frame. In the standard one it is not: there a massless frame, called after the
//! body with `/joint`, sits on the axis, and the body's own frame is fixed to it at the far end.

use super::joint::{KindFile, LimitsFile, limits, limits_key, moving, rotor};
use crate::assembly::{AssemblyJoint, Link};
use crate::rotation::{about_x, about_z};
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, vec3};

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
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
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

/// Joints of an arm, and the massless frames on its axes.
pub(crate) fn arm(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &ArmFile,
) -> (Vec<Link>, Vec<AssemblyJoint>) {
    let (mut links, mut joints) = (vec![], vec![]);
    let mount = under(path, "mount");
    let mut parent = (file.mount.on.clone(), reading.below(&mount, "on"));
    let mut X_PF = reading.pose(&mount, file.mount.position_m, file.mount.orientation.as_ref());
    if file.row.is_empty() {
        let message = format!("arm '{}' has no rows", file.name);
        reading.error(path, message, "no rows", "write an [[arm.row]] for each joint");
    }
    for (i, row) in file.row.iter().enumerate() {
        let path = [path, &[Step::Key("row"), Step::Index(i)]].concat();
        let (to_axis, to_frame) = steps(file.convention, row);
        let mut joint = joint(reading, &path, row, parent);
        joint.X_PC = X_PF * to_axis;
        parent = (row.body.clone(), joint.child_at.clone());
        X_PF = Pose::identity();
        if let Some(X_AF) = to_frame {
            let on_axis = format!("{}/joint", row.body);
            let fixed = at_far_end(&joint, &on_axis, X_AF);
            links.push(Link { name: on_axis.clone(), at: joint.child_at.clone(), matter: None });
            joint.child = on_axis;
            joints.extend([joint, fixed]);
        } else {
            joints.push(joint);
        }
    }
    (links, joints)
}

/// From the frame before to one whose z is the joint's axis; and from there to the frame of the row,
/// if that is another one.
fn steps(convention: ConventionFile, row: &RowFile) -> (Pose<f64>, Option<Pose<f64>>) {
    let along_x = Pose::new(about_x(row.alpha_deg), vec3(row.a_m, 0.0, 0.0));
    let along_z = Pose::new(about_z(row.theta_deg), vec3(0.0, 0.0, row.d_m));
    match convention {
        ConventionFile::Standard => (along_z, Some(along_x)),
        ConventionFile::Modified => (along_x * along_z, None),
    }
}

fn joint(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    row: &RowFile,
    (parent, parent_at): (String, std::ops::Range<usize>),
) -> AssemblyJoint {
    if row.kind == KindFile::Fixed {
        let message = format!("joint '{}' of a row is fixed", row.joint);
        let help = "a row is a joint that moves; fix bodies to each other with a [[joint]]";
        reading.error(&under(path, "kind"), message, "does not move", help);
    }
    AssemblyJoint {
        name: row.joint.clone(),
        at: reading.below(path, "joint"),
        parent,
        parent_at,
        child: row.body.clone(),
        child_at: reading.below(path, "body"),
        kind: moving(row.kind),
        X_PC: Pose::identity(),
        axis: vec3(0.0, 0.0, 1.0),
        axis_at: reading.at(path),
        limits: limits(reading, path, &row.joint, row.kind, &row.limits),
        limits_at: reading.below(path, limits_key(&row.limits)),
        rotor: rotor(reading, path, row.kind, &row.limits),
        mimic: None,
    }
}

/// The fixed joint from the frame on a joint's axis to the body's frame.
fn at_far_end(joint: &AssemblyJoint, on_axis: &str, X_AF: Pose<f64>) -> AssemblyJoint {
    AssemblyJoint {
        name: format!("{}/end", joint.name),
        parent: on_axis.to_owned(),
        parent_at: joint.child_at.clone(),
        kind: None,
        X_PC: X_AF,
        limits: JointLimits::default(),
        ..joint.clone()
    }
}

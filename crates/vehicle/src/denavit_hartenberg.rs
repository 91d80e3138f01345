//! Arms by Denavit-Hartenberg rows, standard and modified, to joints between bodies.
//!
//! A joint's axis must go through the origin of the frame that it carries. In the modified convention
//! frame i is such a frame. In the standard one it is not: there a massless frame, called after the
//! body with `/joint`, sits on the axis, and the body's own frame is fixed to it at the far end.

use crate::assembly::{AssemblyJoint, Link};
use crate::format::{ArmFile, ConventionFile, KindFile, RowFile};
use crate::rotation_in_degrees::{about_x, about_z};
use crate::toml_joint::{limits, limits_key, moving};
use crate::toml_reading::{Reading, under};
use wrasse_document::Step;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, vec3};

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

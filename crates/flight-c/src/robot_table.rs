//! A robot as a table of plain numbers, as C knows it.

use crate::complaint::{ONLY, Refused, WrasseStatus, each, finite, refused};
use core::ffi::CStr;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, Payload, Robot, RobotError};
use wrasse_spatial::{Mat3, Pose, Real, Scalar, Sym3, Vec3, vec3};

/// Most links that a robot can have.
pub const WRASSE_JOINTS: usize = 14;

/// What a body is made of.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseBody {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass, from the body's origin, body axes (m).
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, body axes: xx, yy, zz, xy, xz, yz (kg·m²).
    pub inertia: [f64; 6],
}

/// A joint and where it sits on its parent.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseJoint {
    /// Number of the link that it is mounted on, smaller than its own; -1 for the base.
    pub parent: i32,
    /// 0: it turns about its axis (rad). 1: it slides along its axis (m).
    pub sliding: i32,
    /// Origin of the link at zero travel, from the parent's origin, parent axes (m).
    pub position: [f64; 3],
    /// Turns link axes into parent axes at zero travel, by rows (–).
    pub rotation: [[f64; 3]; 3],
    /// Its axis, link axes; made a unit vector (–).
    pub axis: [f64; 3],
}

/// A joint and the body that it carries.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseLink {
    /// The joint.
    pub joint: WrasseJoint,
    /// The body; its origin is that of the joint.
    pub body: WrasseBody,
}

/// A frame fixed to a body: a tool.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseFrame {
    /// Number of the link that carries it; -1 for the base.
    pub link: i32,
    /// Its origin, from the body's origin, body axes (m).
    pub position: [f64; 3],
    /// Turns its axes into body axes, by rows (–).
    pub rotation: [[f64; 3]; 3],
}

pub(crate) fn vector<T: Real>([x, y, z]: [f64; 3]) -> Vec3<T> {
    vec3(T::from_f64(x), T::from_f64(y), T::from_f64(z))
}

fn pose<T: Real>(rotation: [[f64; 3]; 3], position: [f64; 3]) -> Pose<T> {
    let [x, y, z] = rotation.map(vector);
    Pose::new(Mat3::from_rows(x, y, z), vector(position))
}

/// The body of this number; the base for a negative one.
fn body_of(link: i32) -> BodyId {
    usize::try_from(link).map_or(BodyId::Base, BodyId::Link)
}

fn payload<T: Real>(body: &WrasseBody) -> Payload<T> {
    let centre = vector(body.centre_of_mass);
    let [xx, yy, zz, xy, xz, yz] = body.inertia.map(T::from_f64);
    Payload::from_central(T::from_f64(body.mass), centre, Sym3 { xx, xy, xz, yy, yz, zz })
}

fn joint<T: Real>(joint: &WrasseJoint) -> Joint<T> {
    let kind = if joint.sliding == 0 { JointKind::Revolute } else { JointKind::Prismatic };
    let X_PB_zero = pose(joint.rotation, joint.position);
    Joint::new(body_of(joint.parent), kind, X_PB_zero, vector(joint.axis))
}

/// A frame over another scalar.
pub fn frame_from_table<T: Real>(frame: &WrasseFrame) -> Frame<T> {
    Frame { body: body_of(frame.link), X_BF: pose(frame.rotation, frame.position) }
}

/// The robot of a base and its links, in their order.
///
/// # Errors
/// If there are more than `J` links, or a parent does not come before its child.
pub fn robot_from_tables<T: Scalar, const J: usize>(
    base: &WrasseBody,
    links: &[WrasseLink],
) -> Result<Robot<T, J>, RobotError> {
    if links.len() > J {
        return Err(RobotError::TooManyJoints { found: links.len(), capacity: J });
    }
    let idle = WrasseLink {
        joint: WrasseJoint { parent: -1, axis: [0.0, 0.0, 1.0], ..WrasseJoint::default() },
        ..WrasseLink::default()
    };
    let mut table = [(joint(&idle.joint), payload(&idle.body)); J];
    for (to, link) in table.iter_mut().zip(links) {
        *to = (joint(&link.joint), payload(&link.body));
    }
    Robot::new(payload(base), table.get(..links.len()).unwrap_or(&table))
}

/// A base, its links and its tool are a robot.
pub(crate) fn check(
    base: &WrasseBody,
    links: &[WrasseLink],
    tool: &WrasseFrame,
) -> Result<(), Refused> {
    each(c"WrasseBody.mass of the base", &[base.mass], c"a mass above zero", |m| m > 0.0)?;
    check_body(base, ONLY)?;
    for (index, link) in links.iter().enumerate() {
        check_joint(&link.joint, index)?;
        check_body(&link.body, index)?;
    }
    let found = f64::from(tool.link);
    if usize::try_from(tool.link).map_or(tool.link != -1, |link| link >= links.len()) {
        let (field, expected) = (c"WrasseFrame.link", c"-1 or the number of a link");
        return Err(refused(WrasseStatus::WRASSE_BAD_NUMBER, field, ONLY, found, expected));
    }
    finite(c"WrasseFrame.position", &tool.position)?;
    check_rotation(c"WrasseFrame.rotation", &tool.rotation, ONLY)
}

fn check_joint(joint: &WrasseJoint, index: usize) -> Result<(), Refused> {
    let parent = usize::try_from(joint.parent);
    if parent.map_or(joint.parent != -1, |parent| parent >= index) {
        let (status, found) = (WrasseStatus::WRASSE_PARENT_AFTER_CHILD, f64::from(joint.parent));
        let expected = c"-1 or a number below its own";
        return Err(refused(status, c"WrasseJoint.parent", index, found, expected));
    }
    if !(joint.sliding == 0 || joint.sliding == 1) {
        let (status, found) = (WrasseStatus::WRASSE_UNKNOWN_CHOICE, f64::from(joint.sliding));
        return Err(refused(status, c"WrasseJoint.sliding", index, found, c"0 or 1"));
    }
    let of_link = |r: Refused| r.of(index);
    finite(c"WrasseJoint.position", &joint.position).map_err(of_link)?;
    finite(c"WrasseJoint.axis", &joint.axis).map_err(of_link)?;
    let square: f64 = joint.axis.iter().map(|x| x * x).sum();
    each(c"WrasseJoint.axis, its square", &[square], c"a vector that is not zero", |s| s > 1e-12)
        .map_err(of_link)?;
    check_rotation(c"WrasseJoint.rotation", &joint.rotation, index)
}

/// Mass and moments of inertia that matter can have.
fn check_body(body: &WrasseBody, index: usize) -> Result<(), Refused> {
    let of_link = |r: Refused| r.of(index);
    each(c"WrasseBody.mass", &[body.mass], c"zero or more", |m| m >= 0.0).map_err(of_link)?;
    finite(c"WrasseBody.centre_of_mass", &body.centre_of_mass).map_err(of_link)?;
    finite(c"WrasseBody.inertia", &body.inertia).map_err(of_link)?;
    let [xx, yy, zz, ..] = body.inertia;
    let spare = [xx, yy, zz, yy + zz - xx, zz + xx - yy, xx + yy - zz];
    let size = xx + yy + zz;
    let expected = c"moments above zero, none above the sum of the other two";
    each(c"WrasseBody.inertia", &spare, expected, |s| s >= -1e-9 * size).map_err(of_link)
}

fn check_rotation(field: &'static CStr, rows: &[[f64; 3]; 3], index: usize) -> Result<(), Refused> {
    rows.iter().try_for_each(|row| finite(field, row)).map_err(|r| r.of(index))?;
    let [x, y, z] = rows.map(vector);
    let R: Mat3<f64> = Mat3::from_rows(x, y, z);
    let (error, turn) = (R.orthogonality_error(), x.cross(y).dot(z));
    let expected = c"rows of length 1 at right angles, right-handed; found is the error";
    let is_rotation = |error: f64| error < 1e-6 && turn > 0.0;
    each(field, &[error], expected, is_rotation).map_err(|r| r.of(index))
}

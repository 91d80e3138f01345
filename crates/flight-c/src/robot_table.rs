//! A robot as a table of plain numbers, as C knows it.

use crate::complaint::{ONLY, Refused, WrasseStatus, each, finite, refused};
use core::ffi::CStr;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, RobotError};
use wrasse_spatial::{Mat3, Pose, Real, Scalar, Sym3, Vec3, vec3};

/// Most links that a robot can have.
pub const WRASSE_JOINTS: usize = 14;

/// What a body is made of.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseBody {
    /// Mass (kg), at most 1e9; of the base at least 1e-6, of a link zero or more.
    pub mass: f64,
    /// Centre of mass, from the body's origin, body axes (m), between -1e4 and 1e4.
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, body axes: xx, yy, zz, xy, xz, yz (kg·m²), between -1e15 and
    /// 1e15: one that matter can have, and of the base one that resists turning about every axis.
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
    /// Origin of the link at zero travel, from the parent's origin, parent axes (m), between -1e4 and
    /// 1e4.
    pub position: [f64; 3],
    /// Turns link axes into parent axes at zero travel, by rows (–).
    pub rotation: [[f64; 3]; 3],
    /// Its axis, link axes, between -1e6 and 1e6; made a unit vector (–).
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
    /// Its origin, from the body's origin, body axes (m), between -1e4 and 1e4.
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

fn payload<T: Real>(body: &WrasseBody) -> MassProperties<T> {
    let centre = vector(body.centre_of_mass);
    let [xx, yy, zz, xy, xz, yz] = body.inertia.map(T::from_f64);
    MassProperties::from_central(T::from_f64(body.mass), centre, Sym3 { xx, xy, xz, yy, yz, zz })
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
    let mass = c"between 1e-6 and 1e9";
    each(c"WrasseBody.mass of the base", &[base.mass], mass, |m| m >= 1e-6)?;
    check_body(base, ONLY)?;
    check_base(base)?;
    for (index, link) in links.iter().enumerate() {
        check_joint(&link.joint, index)?;
        check_body(&link.body, index)?;
    }
    let found = f64::from(tool.link);
    if usize::try_from(tool.link).map_or(tool.link != -1, |link| link >= links.len()) {
        let (field, expected) = (c"WrasseFrame.link", c"-1 or the number of a link");
        return Err(refused(WrasseStatus::WRASSE_BAD_NUMBER, field, ONLY, found, expected));
    }
    length(c"WrasseFrame.position", &tool.position)?;
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
    length(c"WrasseJoint.position", &joint.position).map_err(of_link)?;
    each(c"WrasseJoint.axis", &joint.axis, c"between -1e6 and 1e6", |x| x.abs() <= 1e6)
        .map_err(of_link)?;
    let square: f64 = joint.axis.iter().map(|x| x * x).sum();
    each(c"WrasseJoint.axis, its square", &[square], c"a vector that is not zero", |s| s > 1e-12)
        .map_err(of_link)?;
    check_rotation(c"WrasseJoint.rotation", &joint.rotation, index)
}

/// A place on a robot (m).
fn length(field: &'static CStr, place: &[f64; 3]) -> Result<(), Refused> {
    each(field, place, c"between -1e4 and 1e4", |x| x.abs() <= 1e4)
}

/// Mass and moments of inertia that matter can have.
fn check_body(body: &WrasseBody, index: usize) -> Result<(), Refused> {
    let of_link = |r: Refused| r.of(index);
    let mass = c"between 0 and 1e9";
    each(c"WrasseBody.mass", &[body.mass], mass, |m| (0.0..=1e9).contains(&m)).map_err(of_link)?;
    length(c"WrasseBody.centre_of_mass", &body.centre_of_mass).map_err(of_link)?;
    let range = c"between -1e15 and 1e15";
    each(c"WrasseBody.inertia", &body.inertia, range, |x| x.abs() <= 1e15).map_err(of_link)?;
    let [xx, yy, zz, xy, xz, yz] = body.inertia;
    let spare = [yy + zz - xx, zz + xx - yy, xx + yy - zz, xx + yy + zz];
    let size = (xx + yy + zz).max(f64::MIN_POSITIVE);
    let expected = c"moments above zero, none above the sum of the other two";
    each(c"WrasseBody.inertia", &spare, expected, |s| s >= -1e-9 * size).map_err(of_link)?;
    // The same about every axis: twice the second moments of the mass are not negative.
    let part = |x: f64| x / size;
    let moments = [
        part(spare[0]),
        part(spare[1]),
        part(spare[2]),
        -2.0 * part(xy),
        -2.0 * part(xz),
        -2.0 * part(yz),
    ];
    let (minors, whole) = minors(moments);
    let expected = c"moments about its principal axes above zero, none above the sum of the others";
    let least = [minors[0], minors[1], minors[2], whole];
    each(c"WrasseBody.inertia, its products", &least, expected, |m| m >= -1e-9).map_err(of_link)
}

/// The determinants of a symmetric matrix (xx, yy, zz, xy, xz, yz): of its three pairs of axes, and of
/// all of it.
fn minors([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> ([f64; 3], f64) {
    let pairs = [xx * yy - xy * xy, xx * zz - xz * xz, yy * zz - yz * yz];
    (pairs, xx * pairs[2] - xy * (xy * zz - xz * yz) + xz * (xy * yz - xz * yy))
}

/// A base whose answer to a torque is finite.
fn check_base(base: &WrasseBody) -> Result<(), Refused> {
    let [xx, yy, zz, ..] = base.inertia;
    let size = xx + yy + zz;
    let field = c"WrasseBody.inertia of the base";
    each(field, &[size], c"moments that sum to at least 1e-12", |s| s >= 1e-12)?;
    let (_, share) = minors(base.inertia.map(|x| x / size));
    let expected =
        c"a determinant of at least 1e-9 of the cube of its trace: no axis without inertia";
    each(field, &[share], expected, |s| s >= 1e-9)
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

//! Poses, axes and names of frames and joints, as all tables write them.

use crate::reading::Reading;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::{BodyId, Frame, JointKind};
use wrasse_flight::Axes;
use wrasse_spatial::{Pose, Quat, Vec3};
use wrasse_vehicle::{GraspBounds, JOINTS, Vehicle, from_rpy_deg};

/// An attitude, from the axes of the thing to those it is measured in: `{ rpy_deg = [roll, pitch, yaw] }`
/// or a unit quaternion, `{ w = …, x = …, y = …, z = … }` or `{ quaternion = { … } }`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(untagged)]
pub(crate) enum AttitudeFile {
    /// Turns about the fixed axes of what it is measured in, roll first (deg).
    Angles(AnglesFile),
    /// A unit quaternion.
    Parts(QuaternionFile),
    /// A unit quaternion, written as in a vehicle file.
    Quaternion(UnderQuaternionFile),
}

/// Roll, pitch and yaw.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnglesFile {
    /// Roll, pitch, yaw (deg): turns about fixed axes, roll first.
    pub(crate) rpy_deg: [f64; 3],
}

/// A unit quaternion under its name.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnderQuaternionFile {
    /// The quaternion.
    pub(crate) quaternion: QuaternionFile,
}

/// A unit quaternion.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct QuaternionFile {
    /// Scalar part.
    pub(crate) w: f64,
    /// First component of the vector part.
    pub(crate) x: f64,
    /// Second component of the vector part.
    pub(crate) y: f64,
    /// Third component of the vector part.
    pub(crate) z: f64,
}

/// Axes that a target is fixed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AxesFile {
    /// Inertial space.
    Inertial,
    /// The base, wherever it goes.
    Base,
}

/// The default of most axes.
pub(crate) fn inertial() -> AxesFile {
    AxesFile::Inertial
}

/// A unit quaternion; an error if it is not one.
pub(crate) fn attitude(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    file: Option<AttitudeFile>,
) -> Quat<f64> {
    let QuaternionFile { w, x, y, z } = match file {
        None => return Quat::identity(),
        Some(AttitudeFile::Angles(angles)) => {
            return Quat::from_matrix(&from_rpy_deg(angles.rpy_deg));
        }
        Some(AttitudeFile::Parts(parts)) => parts,
        Some(AttitudeFile::Quaternion(under)) => under.quaternion,
    };
    let quat = Quat { w, x, y, z };
    let norm = quat.norm();
    if (norm - 1.0).abs() > 1e-6 {
        let message = format!("an attitude is a unit quaternion, found one of length {norm}");
        let help = match norm {
            0.0 => "no rotation is { w = 1.0, x = 0.0, y = 0.0, z = 0.0 }",
            _ => "divide all four components by the length",
        };
        r.error(path, message, help);
        return Quat::identity();
    }
    quat.normalized()
}

/// A vector from an array.
pub(crate) fn vector(a: [f64; 3]) -> Vec3<f64> {
    Vec3::from_array(a)
}

/// A vector in radians from degrees.
pub(crate) fn radians(a: [f64; 3]) -> Vec3<f64> {
    vector(a.map(f64::to_radians))
}

pub(crate) fn axes(file: AxesFile) -> Axes {
    match file {
        AxesFile::Inertial => Axes::Inertial,
        AxesFile::Base => Axes::Base,
    }
}

/// Values by joint name into the robot's order; errors for names that are not there or of the other
/// kind.
pub(crate) fn by_joint(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    values: &BTreeMap<String, f64>,
    kind: JointKind,
    mut put: impl FnMut(usize, f64),
) {
    let names = r.vehicle.joint_names.clone();
    for (name, &value) in values {
        let at_name = [path, &[Step::Key(name)]].concat();
        let Some(j) = r.find(&at_name, "moving joint", name, &names) else { continue };
        if r.vehicle.robot.joint(j).kind == kind {
            put(j, if kind == JointKind::Revolute { value.to_radians() } else { value });
        } else {
            let key = path.last().map(ToString::to_string).unwrap_or_default();
            let (is, unit, other) = match kind {
                JointKind::Revolute => ("slides", "deg", key.replace("_deg", "_m")),
                JointKind::Prismatic => ("turns", "m", key.replace("_m", "_deg")),
            };
            let message = format!("joint {name} {is}, found a value in {unit}");
            r.error(&at_name, message, &format!("write it in `{other}`"));
        }
    }
}

/// Positions of a posture that the vehicle names.
pub(crate) fn posture(r: &mut Reading<'_>, path: &[Step<'_>], name: &str) -> Option<[f64; JOINTS]> {
    let names: Vec<String> = r.vehicle.postures.iter().map(|p| p.name.clone()).collect();
    let i = r.find(path, "posture", name, &names)?;
    let mut q = [0.0; JOINTS];
    q.iter_mut().zip(&r.vehicle.postures[i].q).for_each(|(to, from)| *to = *from);
    Some(q)
}

/// Where a joint's position is written: under its name in one of the first two tables, or else by the
/// posture.
pub(crate) fn place_of_position<'p>(
    r: &Reading<'_>,
    above: &[Step<'p>],
    keys: [&'p str; 3],
    name: &'p str,
) -> Vec<Step<'p>> {
    let [turning, sliding, posture] = keys;
    let by_name = [turning, sliding].map(|key| [above, at![key, name]].concat());
    let written = by_name.into_iter().find(|path| r.is_there(path));
    written.unwrap_or_else(|| [above, at![posture]].concat())
}

/// A tool or frame by its name; without one the vehicle's first tool, or the last link's frame.
pub(crate) fn tool(r: &mut Reading<'_>, path: &[Step<'_>], name: Option<&str>) -> Frame<f64> {
    let names: Vec<String> = r.vehicle.frames.iter().map(|f| f.name.clone()).collect();
    let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
    match name.or(r.vehicle.tools.first().map(String::as_str)) {
        Some(name) => {
            let name = name.to_owned();
            r.find(path, "tool or frame", &name, &names).map_or(base, |i| r.vehicle.frames[i].frame)
        }
        None => r.vehicle.frames.last().map_or(base, |f| f.frame),
    }
}

/// How far a grip may be from the tool of this name, or the one that is guided without a name.
pub(crate) fn grasp_bounds(vehicle: &Vehicle, name: Option<&str>) -> GraspBounds {
    let first = vehicle.tools.first().map(String::as_str);
    let last = vehicle.frames.last().map(|frame| frame.name.as_str());
    let named = vehicle.frames.iter().find(|f| Some(f.name.as_str()) == name.or(first).or(last));
    named.map_or(GraspBounds::default(), |frame| frame.grasp_bounds)
}

//! Poses, axes and names of frames and joints, as all tables write them.

use crate::reading::Reading;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::{BodyId, Frame, JointKind};
use wrasse_flight::Axes;
use wrasse_spatial::{Mat3, Pose, Vec3};
use wrasse_vehicle::{AttitudeFile, GraspBounds, JOINTS, NotARotation, Vehicle};

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

/// `R_NB` of an attitude, which is that of its axes if there is none; an error if it is no rotation.
pub(crate) fn attitude(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    file: Option<AttitudeFile>,
) -> Mat3<f64> {
    let Some(file) = file else { return Mat3::identity() };
    file.rotation().unwrap_or_else(|NotARotation { message, help }| {
        r.error(path, message, &help);
        Mat3::identity()
    })
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

/// Values by joint name into the robot's order; errors for names that are not there, of the other kind,
/// or of a joint that follows another one.
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
        if let Some(leader) = leader(r.vehicle, j) {
            let leader = &names[leader];
            let message = format!("joint '{name}' follows '{leader}'");
            r.wrong_key(&at_name, message, &format!("name '{leader}' in its place"));
        } else if r.vehicle.robot.joint(j).kind == kind {
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

/// The joint that a joint follows, if it does.
pub(crate) fn leader(vehicle: &Vehicle, j: usize) -> Option<usize> {
    vehicle.followers.iter().find(|follower| follower.joint == j).map(|found| found.leader)
}

/// Positions of a posture that the vehicle names.
pub(crate) fn posture(r: &mut Reading<'_>, path: &[Step<'_>], name: &str) -> Option<[f64; JOINTS]> {
    let names: Vec<String> = r.vehicle.postures.iter().map(|p| p.name.clone()).collect();
    let i = r.find(path, "posture", name, &names)?;
    let mut q = [0.0; JOINTS];
    q.iter_mut().zip(&r.vehicle.postures[i].q).for_each(|(to, from)| *to = *from);
    Some(q)
}

/// Where a joint's position is written: under its name, or that of the joint that it follows, in one of
/// the first two tables, or else by the posture.
pub(crate) fn place_of_position<'p>(
    r: &Reading<'p>,
    above: &[Step<'p>],
    keys: [&'p str; 3],
    j: usize,
) -> Vec<Step<'p>> {
    let vehicle: &'p Vehicle = r.vehicle;
    let name: &'p str = &vehicle.joint_names[leader(vehicle, j).unwrap_or(j)];
    let [turning, sliding, posture] = keys;
    let by_name = [turning, sliding].map(|key| [above, at![key, name]].concat());
    let written = by_name.into_iter().find(|path| r.is_there(path));
    written.unwrap_or_else(|| [above, at![posture]].concat())
}

/// A tool or frame by its name; an error if it is not there.
pub(crate) fn tool(r: &mut Reading<'_>, path: &[Step<'_>], name: &str) -> Frame<f64> {
    let names: Vec<String> = r.vehicle.frames.iter().map(|f| f.name.clone()).collect();
    let found = r.find(path, "tool or frame", name, &names);
    found.map_or(base_frame(), |i| r.vehicle.frames[i].frame)
}

/// What stands in for a frame that is not known.
pub(crate) fn base_frame() -> Frame<f64> {
    Frame { body: BodyId::Base, X_BF: Pose::identity() }
}

/// How far a grip may be from the tool of this name, or from the vehicle's first.
pub(crate) fn grasp_bounds(vehicle: &Vehicle, name: Option<&str>) -> GraspBounds {
    let guided = name.or(vehicle.tools.first().map(String::as_str));
    let named = vehicle.frames.iter().find(|frame| Some(frame.name.as_str()) == guided);
    named.map_or(GraspBounds::default(), |frame| frame.grasp_bounds)
}

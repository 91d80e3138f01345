//! The tables `[[include]]`: the links and joints of another vehicle file, on a body of this one.

use crate::assembly::{Assembly, AssemblyJoint};
use crate::catalogue::vehicle_source;
use crate::model::{Model, any_error};
use crate::read_vehicle::{Nesting, read_model};
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use crate::urdf::NO_PROVENANCE;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use wildmatch::WildMatch;
use wrasse_document::Step;
use wrasse_hardware::JointLimits;
use wrasse_spatial::vec3;

/// Another vehicle, of which links, joints, tools and postures are taken.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IncludeFile {
    /// A vehicle of the catalogue, or a file (TOML or URDF) seen from the folder of this one.
    #[schemars(length(min = 1))]
    pub(crate) vehicle: String,
    /// The body that carries its base; without, its base is the base of this vehicle.
    #[schemars(length(min = 1))]
    pub(crate) on: Option<String>,
    /// Origin of its base's frame, in the frame of the body `on` (m); zero if not given.
    pub(crate) position_m: Option<[f64; 3]>,
    /// How its base's frame is turned from that of the body `on`; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// What is put before the name of each of its links, joints, tools and postures.
    pub(crate) prefix: Option<String>,
    /// Joints that do not move here, by their names in the other file: `*` stands for any characters, `?`
    /// for one. They are fixed at zero, or at the end of their travel that is nearest to it; joints that
    /// follow another one where it has them.
    #[serde(default)]
    pub(crate) fix: Vec<String>,
    /// Why mass properties that no rigid body can have are to be used all the same, in all its links.
    #[schemars(length(min = 1))]
    pub(crate) accept_nonphysical: Option<String>,
    /// Where its numbers come from, if its own file does not say.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The links and joints of another file, as this one takes them; nothing after a complaint.
pub(crate) fn include(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &IncludeFile,
    nesting: &mut Nesting,
) -> Option<Assembly> {
    let at = reading.below(path, "vehicle");
    let mut model = model(reading, &at, file, nesting)?;
    tell_of_equipment(reading, &at, &model);
    model.accept_nonphysical(file.accept_nonphysical.as_deref());
    let mut assembly = std::mem::take(&mut model.assembly);
    fix(reading, path, file, &mut assembly.joints);
    if let Some(prefix) = &file.prefix {
        assembly.put_before_names(prefix);
    }
    if file.provenance.source.is_some() {
        assembly.provenance.retain(|row| row.source != NO_PROVENANCE);
    }
    Some(assembly)
}

/// The joint that fixes the base of an included assembly to the body `on`; nothing if its base is that
/// of the vehicle.
pub(crate) fn mount(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &IncludeFile,
    included: &Assembly,
) -> Option<AssemblyJoint> {
    let Some(on) = &file.on else {
        for (key, there) in
            [("position_m", file.position_m.is_some()), ("orientation", file.orientation.is_some())]
        {
            if there {
                let message = format!(
                    "`{key}` says nothing without `on`: the base of '{}' is the base",
                    file.vehicle
                );
                let help = "say which body carries it: on = \"…\"";
                reading.wrong_key(&under(path, key), message, "of what?", help);
            }
        }
        return None;
    };
    let root = root_of(included)?;
    let at = reading.below(path, "on");
    Some(AssemblyJoint {
        name: format!("mount of {root}"),
        at: at.clone(),
        parent: on.clone(),
        parent_at: at.clone(),
        child: root,
        child_at: reading.below(path, "vehicle"),
        kind: None,
        X_PC: reading.pose(path, file.position_m.unwrap_or_default(), file.orientation.as_ref()),
        axis: vec3(0.0, 0.0, 1.0),
        axis_at: at.clone(),
        limits: JointLimits::default(),
        limits_at: at,
        rotor: 0.0,
        mimic: None,
    })
}

/// What the other file says; nothing after a complaint.
fn model(
    reading: &mut Reading<'_>,
    at: &Range<usize>,
    file: &IncludeFile,
    nesting: &mut Nesting,
) -> Option<Model> {
    let here = reading.document.source().path.clone();
    let source = match vehicle_source(&file.vehicle, here.parent()) {
        Ok(source) => source,
        Err((message, help)) => {
            reading.found.error(at, message, "not found", &help);
            return None;
        }
    };
    if let Err(why) = nesting.include(&source.path) {
        let message = format!("'{}' cannot be included: {why}", file.vehicle);
        reading.found.error(at, message, "not included", "");
        return None;
    }
    match read_model(&source, nesting) {
        Ok(mut model) => {
            let found = std::mem::take(&mut model.found);
            let told = if model.shape.is_empty() { found } else { model.beside_shape(found) };
            let faulty = any_error(&told);
            reading.found.take(told);
            (!faulty).then_some(model)
        }
        Err(complaints) => {
            reading.found.take(complaints);
            None
        }
    }
}

/// Says what of the other file is left out.
fn tell_of_equipment(reading: &mut Reading<'_>, at: &Range<usize>, model: &Model) {
    let tables = [
        ("[attitude_actuator]", model.attitude_actuator.is_some()),
        ("[actuators]", model.equipment.is_some()),
        ("[sensors]", model.has_sensors()),
    ];
    let left: Vec<_> = tables.iter().filter(|(_, there)| *there).map(|(name, _)| *name).collect();
    if !left.is_empty() {
        let message = format!("{} of '{}' not used", left.join(", "), model.name);
        let help = "they belong to a base; this vehicle says for itself what its base has";
        reading.found.note(at, message, "not used", help);
    }
}

/// Fixes the joints that are meant; complains of a pattern that means none.
fn fix(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &IncludeFile,
    joints: &mut [AssemblyJoint],
) {
    for pattern in fix_joints(&file.fix, joints) {
        let (message, help) = said_of_fix(joints, &pattern);
        let k = file.fix.iter().position(|given| *given == pattern).unwrap_or_default();
        let path = [path, &[Step::Key("fix"), Step::Index(k)]].concat();
        reading.error(&path, message, "no such joint", &help);
    }
}

/// Fixes the joints that are meant by the patterns. The patterns that mean no joint that moves.
pub(crate) fn fix_joints(patterns: &[String], joints: &mut [AssemblyJoint]) -> Vec<String> {
    let mut unmet = vec![];
    let mut meant = vec![false; joints.len()];
    for pattern in patterns {
        let matching = WildMatch::new(pattern);
        let mut met = false;
        for (joint, is_meant) in joints.iter().zip(&mut meant) {
            let matches = joint.kind.is_some() && matching.matches(&joint.name);
            *is_meant |= matches;
            met |= matches;
        }
        if !met {
            unmet.push(pattern.clone());
        }
    }
    fix_those(joints, &meant);
    unmet
}

/// Fixes the joints that are meant, leaders before those that follow them: what follows a joint that is
/// fixed away from zero is further on by that.
fn fix_those(joints: &mut [AssemblyJoint], meant: &[bool]) {
    let by_name: BTreeMap<String, usize> =
        joints.iter().enumerate().rev().map(|(k, joint)| (joint.name.clone(), k)).collect();
    let leader = |joint: &AssemblyJoint| by_name.get(&joint.mimic.as_ref()?.leader).copied();
    let mut following: Vec<Vec<usize>> = vec![vec![]; joints.len()];
    let mut ready = vec![];
    for (k, joint) in joints.iter().enumerate() {
        match leader(joint) {
            Some(leader) if leader != k => {
                following[leader].push(k);
                // A leader that is fixed too comes first.
                ready.extend((meant[k] && !meant[leader]).then_some(k));
            }
            _ => ready.extend(meant[k].then_some(k)),
        }
    }
    while let Some(k) = ready.pop() {
        let nearest = joints[k].limits.nearest_to_zero();
        let q = joints[k].mimic.as_ref().map_or(nearest, |mimic| mimic.offset);
        joints[k].fixed_at(q);
        for &follower in &following[k] {
            if let Some(mimic) = &mut joints[follower].mimic {
                mimic.offset += mimic.ratio * q;
            }
            ready.extend(meant[follower].then_some(follower));
        }
    }
}

/// The complaint about a pattern that means no joint, and which joints there are.
pub(crate) fn said_of_fix(joints: &[AssemblyJoint], pattern: &str) -> (String, String) {
    let moving: Vec<&str> =
        joints.iter().filter(|j| j.kind.is_some()).map(|joint| &*joint.name).collect();
    let shown = moving.iter().take(12).copied().collect::<Vec<_>>().join(", ");
    let more = if moving.len() > 12 { ", …" } else { "" };
    (
        format!("no joint that moves is called '{pattern}'"),
        format!("joints that move: {shown}{more}"),
    )
}

/// The link that no joint carries.
fn root_of(assembly: &Assembly) -> Option<String> {
    let carried: BTreeSet<&str> = assembly.joints.iter().map(|joint| &*joint.child).collect();
    let root = assembly.links.iter().find(|link| !carried.contains(&*link.name));
    root.or(assembly.links.first()).map(|link| link.name.clone())
}

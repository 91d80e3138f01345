//! An MJCF file to a vehicle.

use super::body::{Bodies, SITE};
use super::compiler::Compiler;
use super::contents::{Contents, Placed, WORLD};
use super::defaults::Classes;
use super::equality::{EQUALITY, couplings, follow};
use super::geom::GEOM;
use super::include::Whole;
use super::joint::JOINT;
use crate::assembly::{Assembly, Link};
use crate::findings::Findings;
use crate::model::Model;
use crate::provenance::{Grade, Provenance};
use crate::xml::{Element, Format, Kind, Reading, tag_at};
use roxmltree::{Document, Node};
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};

const IDEAL: &str = "joints are ideal: no friction, no damping, no springs";
const MJCF: Format = Format {
    name: "MJCF",
    why_unused: &[
        ("attribute `damping` of <joint>", IDEAL),
        ("attribute `frictionloss` of <joint>", IDEAL),
        ("attribute `stiffness` of <joint>", IDEAL),
        ("<actuator>", "each moving joint has its own drive"),
        ("<contact>", "links do not touch each other"),
        ("<option>", "the mission says which forces act and how time goes on"),
        ("<tendon>", "each moving joint has its own drive"),
    ],
};
const MUJOCO: Kind = Kind {
    tag: "mujoco",
    attributes: &["model"],
    children: &[
        "compiler",
        "default",
        "worldbody",
        "equality",
        "tendon",
        "actuator",
        "keyframe",
        "deformable",
    ],
    unused: &[
        "asset",
        "contact",
        "custom",
        "extension",
        "option",
        "sensor",
        "size",
        "statistic",
        "visual",
    ],
};

/// Whether a text is an MJCF, as far as its root says.
pub(crate) fn is_mjcf(text: &str) -> bool {
    match Document::parse(text) {
        Ok(document) => document.root_element().tag_name().name() == MUJOCO.tag,
        Err(_) => text.contains("<mujoco"),
    }
}

/// What an MJCF file says.
///
/// # Errors
/// All complaints at once, if it is no MJCF or has no base.
pub(crate) fn read_mjcf(source: &Arc<Source>) -> Result<Model, Vec<Complaint>> {
    let Whole { text, files } = Whole::of(source)?;
    let mut found = Findings::within(&files);
    let document = match Document::parse(&text) {
        Ok(document) => document,
        Err(why) => {
            let help = "included files must not end within an element";
            return Err(crate::xml::not_xml(&why, help, &text, found));
        }
    };
    let node = document.root_element();
    if node.tag_name().name() != MUJOCO.tag {
        refuse_other_formats(node, &text, &mut found);
        return Err(found.into_complaints());
    }
    let mut reading = Reading::new(&text, found, &MJCF);
    let root = reading.open(node, &MUJOCO);
    let assembly = Assembly { files, ..assembly(&root, &mut reading) };
    let found = reading.into_findings().into_complaints();
    // Without a base there is nothing to assemble, and it has been said why.
    if assembly.links.is_empty() {
        return Err(found);
    }
    let name = root.attribute("model").map_or("vehicle", |name| name.text).to_owned();
    let summary = format!("{name}, from an MJCF file");
    Ok(Model { found, ..Model::bare(name, summary, assembly) })
}

/// The links and joints of a model.
fn assembly<'d>(root: &Element<'d, '_>, reading: &mut Reading<'d>) -> Assembly {
    let mut compiler = Compiler::default();
    for node in root.children("compiler") {
        compiler.read(node, reading);
    }
    let sections = root.children("default");
    let classes = Classes::read(sections, &[&JOINT, &GEOM, &SITE, &EQUALITY], reading);
    refuse_deformables(root, reading);
    let couplings = couplings(root, &classes, reading);
    let base = base(root, &compiler, &classes, reading);
    let mut bodies = Bodies::new(compiler, &classes, reading);
    if let Some(base) = base {
        bodies.read(base);
    }
    let (mut links, mut joints, outlines) = (bodies.links, bodies.joints, bodies.outlines);
    let (is_free, armatures) = (bodies.is_free, bodies.armatures);
    follow(&couplings, &mut joints, &bodies.references, bodies.reading);
    if let Some(base) = links.first().filter(|_| bodies.stands) {
        let message = format!("'{}' is fixed to the world, but floats here", base.name);
        let help = "nothing holds a base in orbit; say so with <freejoint/>";
        reading.found.warning(&base.at, message, "not the ground", help);
    }
    scale(&mut links, compiler.total_mass);
    warn_of_armatures(&armatures, reading);
    for section in ["tendon", "actuator"] {
        for node in root.children(section) {
            unused_section(node, section, reading);
        }
    }
    let moving = joints.iter().filter(|joint| joint.kind.is_some());
    let moving: Vec<_> = moving.map(|joint| joint.name.as_str()).collect();
    let at_base = if is_free { 7 } else { 0 };
    let keyframes = root.children("keyframe");
    let postures = keyframes.flat_map(|node| reading.postures(node, &moving, at_base)).collect();
    let provenance = Provenance {
        of: "everything".into(),
        grade: Grade::Assumed,
        source: "MJCF without provenance".into(),
    };
    Assembly {
        links,
        joints,
        outlines,
        postures,
        provenance: vec![provenance],
        ..Assembly::default()
    }
}

/// The one body on the world; nothing after a complaint.
fn base<'d, 't>(
    root: &Element<'d, 't>,
    compiler: &Compiler,
    classes: &Classes<'d, 't>,
    reading: &mut Reading<'_>,
) -> Option<Placed<'d, 't>> {
    let mut bodies = Vec::new();
    for node in root.children("worldbody") {
        let world = reading.open(node, &WORLD);
        let Contents { bodies: more, .. } = compiler.contents(&world, node, None, classes, reading);
        bodies.extend(more);
    }
    leave_out_mocap(&mut bodies, compiler, reading);
    let named = |placed: &Placed<'_, '_>| placed.node.attribute("name").unwrap_or("?").to_owned();
    match bodies[..] {
        [] => {
            let message = "the world holds no <body>".to_owned();
            let help = "a vehicle is the <body> in <worldbody>, and what is in it";
            reading.found.error(&root.at, message, "no vehicle", help);
            None
        }
        [base] => Some(base),
        [_, second, ..] => {
            let names: Vec<_> = bodies.iter().map(named).collect();
            let message = format!("the world holds {} bodies: {}", names.len(), names.join(", "));
            let help = "a vehicle is one of them: leave out the others, or write the one into a file of \
                        its own";
            reading.found.error(&tag_at(second.node, reading.text), message, "the second", help);
            None
        }
    }
}

/// Leaves out bodies that a user moves by hand: marks of a scene, not part of a vehicle.
fn leave_out_mocap(
    bodies: &mut Vec<Placed<'_, '_>>,
    compiler: &Compiler,
    reading: &mut Reading<'_>,
) {
    let is_mocap = |placed: &Placed<'_, '_>| placed.node.attribute("mocap") == Some("true");
    if bodies.iter().all(&is_mocap) {
        return;
    }
    for mark in bodies.iter().filter(|placed| is_mocap(placed)) {
        let at = tag_at(mark.node, reading.text);
        if compiler.total_mass.is_some() {
            let message = "`settotalmass` counts a mocap body, which is left out here".to_owned();
            reading.found.error(&at, message, "a mocap body", "leave it out of the file");
        }
        reading.not_used("a mocap body on the world".to_owned(), at);
    }
    bodies.retain(|placed| !is_mocap(placed));
}

/// Refuses what adds bodies that are not rigid.
fn refuse_deformables(root: &Element<'_, '_>, reading: &mut Reading<'_>) {
    for node in root.children("deformable") {
        let message = "<deformable> is not supported: bodies are rigid".to_owned();
        let help = "leave it out, or put a rigid body in its place";
        reading.found.error(&tag_at(node, reading.text), message, "not supported", help);
    }
}

/// Scales all masses and inertias to the total that `settotalmass` asks for (kg).
fn scale(links: &mut [Link], total: Option<f64>) {
    let Some(total) = total else { return };
    let sum: f64 = links.iter().filter_map(|link| link.matter.as_ref()).map(|m| m.mass).sum();
    if sum <= 0.0 {
        return;
    }
    let factor = total / sum;
    for matter in links.iter_mut().filter_map(|link| link.matter.as_mut()) {
        let I = matter.inertia;
        matter.mass *= factor;
        let [xx, xy, xz] = [I.xx, I.xy, I.xz].map(|x| x * factor);
        let [yy, yz, zz] = [I.yy, I.yz, I.zz].map(|x| x * factor);
        matter.inertia = wrasse_spatial::Sym3 { xx, xy, xz, yy, yz, zz };
    }
}

/// MuJoCo adds a rotor's inertia to the diagonal of the mass matrix, which no rigid body does.
fn warn_of_armatures(armatures: &[(String, Range<usize>)], reading: &mut Reading<'_>) {
    let Some((_, first)) = armatures.first() else { return };
    let names: Vec<_> = armatures.iter().take(12).map(|(name, _)| name.as_str()).collect();
    let count = armatures.len();
    let what = if count == 1 { "joint" } else { "joints" };
    let message = format!(
        "the armature of {count} {what} is not modelled: the mass matrix is that of the bodies alone"
    );
    let more = if count > names.len() { ", …" } else { "" };
    let help = format!(
        "MuJoCo adds a rotor's inertia to the diagonal of its mass matrix; here it is left out of {}{more}",
        names.join(", ")
    );
    reading.found.warning(first, message, "and the others", &help);
}

/// Counts a section that is not used; says so aloud where it would change the mass matrix.
fn unused_section(section: Node<'_, '_>, name: &str, reading: &mut Reading<'_>) {
    reading.not_used(format!("<{name}>"), tag_at(section, reading.text));
    let armature = section.descendants().filter_map(|node| node.attribute_node("armature"));
    for written in armature.filter(|written| written.value().trim() != "0") {
        let message = format!(
            "the armature of <{name}> is not modelled: the mass matrix is that of the bodies alone"
        );
        let help = "MuJoCo adds it to its mass matrix";
        reading.found.warning(&written.range_value(), message, "not modelled", help);
    }
}

/// Refuses a file that is no MJCF, with what to do.
fn refuse_other_formats(root: Node<'_, '_>, text: &str, found: &mut Findings) {
    let name = root.tag_name().name();
    let help = match name {
        "robot" => "this looks like URDF: give the file the ending .urdf",
        "sdf" => "this looks like SDF; convert it to URDF or MJCF",
        _ => "an MJCF is one <mujoco> with a <worldbody>",
    };
    let message = format!("expected <mujoco>, found <{name}>");
    found.error(&tag_at(root, text), message, "not a model", help);
}

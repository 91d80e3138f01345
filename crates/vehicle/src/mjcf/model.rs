//! An MJCF file to a vehicle.

use super::body::{Bodies, SITE};
use super::compiler::Compiler;
use super::contents::{Contents, Placed, WORLD};
use super::defaults::Classes;
use super::geom::GEOM;
use super::include::Whole;
use super::joint::JOINT;
use crate::assemble::{AssembledRobot, assemble};
use crate::assembly::{AssemblyJoint, Link};
use crate::equipment::Equipment;
use crate::findings::Findings;
use crate::provenance::{Grade, Provenance};
use crate::vehicle::{Posture, Shape, ShapeKind, Vehicle};
use crate::xml::{Element, Format, Kind, Reading, tag_at};
use roxmltree::{Document, Node};
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};
use wrasse_dynamics::Frame;
use wrasse_hardware::Sensors;
use wrasse_spatial::Pose;

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
const EQUALITY: Kind = Kind {
    tag: "equality",
    attributes: &["active"],
    children: &[],
    unused: &["class", "solimp", "solref"],
};

/// Whether a text is an MJCF, as far as its root says.
pub(crate) fn is_mjcf(text: &str) -> bool {
    match Document::parse(text) {
        Ok(document) => document.root_element().tag_name().name() == MUJOCO.tag,
        Err(_) => text.contains("<mujoco"),
    }
}

/// The vehicle that an MJCF file describes.
///
/// # Errors
/// All complaints at once, if it cannot be read, is not physically possible, or says what would change
/// how it moves and is not modelled.
pub(crate) fn read_mjcf(source: &Arc<Source>) -> Result<Vehicle, Vec<Complaint>> {
    let whole = Whole::of(source)?;
    match read_whole(&whole.source) {
        Ok(vehicle) => Ok(Vehicle {
            text: whole.source.text.clone(),
            remarks: whole.traced(vehicle.remarks),
            ..vehicle
        }),
        Err(complaints) => Err(whole.traced(complaints)),
    }
}

fn read_whole(source: &Arc<Source>) -> Result<Vehicle, Vec<Complaint>> {
    let mut found = Findings::new(source);
    let document = match Document::parse(&source.text) {
        Ok(document) => document,
        Err(why) => {
            let help = "included files must not end within an element";
            return Err(crate::xml::not_xml(&why, help, &source.text, found));
        }
    };
    let node = document.root_element();
    if node.tag_name().name() != MUJOCO.tag {
        refuse_other_formats(node, source, &mut found);
        return Err(found.into_complaints());
    }
    let mut reading = Reading::new(&source.text, found, &MJCF);
    let root = reading.open(node, &MUJOCO);
    let parts = parts(&root, &mut reading);
    let mut found = reading.into_findings();
    let assembled = match assemble(source, &parts.links, &parts.joints) {
        Ok(mut assembled) => {
            found.take(std::mem::take(&mut assembled.warnings));
            assembled
        }
        // Without a base there is nothing to assemble, and it has been said why.
        Err(_) if parts.links.is_empty() => return Err(found.into_complaints()),
        Err(complaints) => {
            found.take(complaints);
            return Err(found.into_complaints());
        }
    };
    if !found.without_error() {
        return Err(found.into_complaints());
    }
    let name = root.attribute("model").map_or("vehicle", |name| name.text).to_owned();
    Ok(vehicle(name, assembled, parts, found))
}

/// What a file says, before it is assembled.
struct Parts {
    links: Vec<Link>,
    joints: Vec<AssemblyJoint>,
    outlines: Vec<(String, Pose<f64>, ShapeKind)>,
    postures: Vec<Posture>,
}

fn parts<'d>(root: &Element<'d, '_>, reading: &mut Reading<'d>) -> Parts {
    let mut compiler = Compiler::default();
    for node in root.children("compiler") {
        compiler.read(node, reading);
    }
    let sections = root.children("default");
    let classes = Classes::read(sections, &[&JOINT, &GEOM, &SITE, &EQUALITY], reading);
    refuse_couplings(root, &classes, reading);
    let base = base(root, &compiler, &classes, reading);
    let mut bodies = Bodies::new(compiler, &classes, reading);
    if let Some(base) = base {
        bodies.read(base);
    }
    let (mut links, joints, outlines) = (bodies.links, bodies.joints, bodies.outlines);
    let (is_free, armatures) = (bodies.is_free, bodies.armatures);
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
    let moving = joints.iter().filter(|joint| joint.kind.is_some()).count();
    let at_base = if is_free { 7 } else { 0 };
    let keyframes = root.children("keyframe");
    let postures = keyframes.flat_map(|node| reading.postures(node, moving, at_base)).collect();
    Parts { links, joints, outlines, postures }
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

/// Refuses what couples joints or closes loops, unless it is switched off, and what adds bodies.
fn refuse_couplings(root: &Element<'_, '_>, classes: &Classes<'_, '_>, reading: &mut Reading<'_>) {
    let sections = root.children("equality").flat_map(|node| node.children());
    for node in sections.filter(Node::is_element) {
        let own = node.attribute("active").map(str::trim);
        let active =
            own.map_or_else(|| classes.activity(node.attribute("class")), |a| a != "false");
        let tag = node.tag_name().name();
        if !active {
            reading.not_used(
                format!("<{tag}> of <equality>, switched off,"),
                tag_at(node, reading.text),
            );
            continue;
        }
        let message = format!("<{tag}> of <equality> couples what moves: not supported");
        let help = "each joint has its own drive, and a vehicle is a tree; write active=\"false\" to \
                    leave it out";
        reading.found.error(&tag_at(node, reading.text), message, "not supported", help);
    }
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
    let names: Vec<_> = armatures.iter().map(|(name, _)| name.as_str()).collect();
    let what = if names.len() == 1 { "joint" } else { "joints" };
    let message = format!(
        "the armature of {} {what} is not modelled: the mass matrix is that of the bodies alone",
        names.len()
    );
    let help = format!(
        "MuJoCo adds a rotor's inertia to the diagonal of its mass matrix; here it is left out of {}",
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

fn vehicle(name: String, from: AssembledRobot, parts: Parts, found: Findings) -> Vehicle {
    let on_body = |(link, X_LF, kind): &(String, Pose<f64>, ShapeKind)| {
        let on = from.frames.iter().find(|frame| frame.name == *link)?;
        let frame = Frame { body: on.frame.body, X_BF: on.frame.X_BF * *X_LF };
        Some(Shape { link: link.clone(), frame, kind: *kind })
    };
    Vehicle {
        text: String::new(),
        summary: format!("{name}, from an MJCF file"),
        name,
        shapes: parts.outlines.iter().filter_map(on_body).collect(),
        robot: from.robot,
        joint_names: from.joint_names,
        limits: from.limits,
        frames: from.frames,
        tools: Vec::new(),
        postures: parts.postures,
        attitude_actuator: None,
        equipment: Equipment::default(),
        sensors: Sensors::default(),
        provenance: vec![Provenance {
            of: "everything".into(),
            grade: Grade::Assumed,
            source: "MJCF without provenance".into(),
        }],
        remarks: found.into_complaints(),
    }
}

/// Refuses a file that is no MJCF, with what to do.
fn refuse_other_formats(root: Node<'_, '_>, source: &Arc<Source>, found: &mut Findings) {
    let name = root.tag_name().name();
    let help = match name {
        "robot" => "this looks like URDF: give the file the ending .urdf",
        "sdf" => "this looks like SDF; convert it to URDF or MJCF",
        _ => "an MJCF is one <mujoco> with a <worldbody>",
    };
    let message = format!("expected <mujoco>, found <{name}>");
    found.error(&tag_at(root, &source.text), message, "not a model", help);
}

//! A URDF file to a vehicle.

use super::element::{Element, Kind, Reading, tag_at};
use super::joint::{Type, UrdfJoint};
use super::link::Outline;
use crate::assemble::{AssembledRobot, assemble};
use crate::assembly::{AssemblyJoint, Link};
use crate::equipment::Equipment;
use crate::findings::Findings;
use crate::provenance::{Grade, Provenance};
use crate::vehicle::{Shape, Vehicle};
use roxmltree::Document;
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};
use wrasse_dynamics::Frame;
use wrasse_hardware::Sensors;

const ROBOT: Kind = Kind {
    tag: "robot",
    attributes: &["name"],
    children: &["link", "joint"],
    unused: &[
        "version",
        "material",
        "transmission",
        "gazebo",
        "sensor",
        "ros2_control",
        "disable_collisions",
        "group",
        "verbose",
    ],
};

/// What to do with a xacro file.
const EXPAND_XACRO: &str = "expand it first: `xacro FILE.xacro > vehicle.urdf`";

/// The vehicle that a URDF file describes.
///
/// # Errors
/// All complaints at once, if it cannot be read or is not physically possible.
pub(crate) fn read_urdf(source: &Arc<Source>) -> Result<Vehicle, Vec<Complaint>> {
    let found = Findings::new(source);
    let document = match Document::parse(&source.text) {
        Ok(document) => document,
        Err(why) => return Err(not_xml(&why, &source.text, found)),
    };
    refuse_other_formats(&document, source)?;
    let mut reading = Reading::new(&source.text, found);
    let robot = reading.open(document.root_element(), &ROBOT);
    let name = robot.required("name", &mut reading);
    let (mut links, outlines) = reading.links(&robot);
    let joints: Vec<_> = robot.children("joint").map(|joint| reading.joint(joint)).collect();
    let joints = reading.float_the_base(&mut links, joints);
    let mut found = reading.into_findings();
    let assembled = match assemble(source, &links, &joints) {
        Ok(mut assembled) => {
            found.take(std::mem::take(&mut assembled.warnings));
            assembled
        }
        Err(complaints) => {
            found.take(complaints);
            return Err(found.into_complaints());
        }
    };
    if !found.without_error() {
        return Err(found.into_complaints());
    }
    let name = name.map_or(String::new(), |name| name.text.to_owned());
    Ok(vehicle(name, assembled, &outlines, found))
}

fn vehicle(name: String, from: AssembledRobot, outlines: &[Outline], found: Findings) -> Vehicle {
    let on_body = |outline: &Outline| {
        let link = from.frames.iter().find(|f| f.name == outline.link)?;
        let frame = Frame { body: link.frame.body, X_BF: link.frame.X_BF * outline.X_LF };
        Some(Shape { link: outline.link.clone(), frame, kind: outline.kind })
    };
    Vehicle {
        text: String::new(),
        summary: format!("{name}, from a URDF file"),
        name,
        shapes: outlines.iter().filter_map(on_body).collect(),
        robot: from.robot,
        joint_names: from.joint_names,
        limits: from.limits,
        frames: from.frames,
        tools: Vec::new(),
        postures: Vec::new(),
        attitude_actuator: None,
        equipment: Equipment::default(),
        sensors: Sensors::default(),
        provenance: vec![Provenance {
            of: "everything".into(),
            grade: Grade::Assumed,
            source: "URDF without provenance".into(),
        }],
        not_public: Vec::new(),
        remarks: found.into_complaints(),
    }
}

impl Reading<'_> {
    fn links(&mut self, robot: &Element<'_, '_>) -> (Vec<Link>, Vec<Outline>) {
        let mut outlines = Vec::new();
        let mut links = Vec::new();
        for node in robot.children("link") {
            if let Some((link, shown)) = self.link(node) {
                links.push(link);
                outlines.extend(shown);
            }
        }
        (links, outlines)
    }

    /// Leaves out a root called `world` that carries the base by a floating joint: every base
    /// floats here. Complains of other floating joints.
    fn float_the_base(
        &mut self,
        links: &mut Vec<Link>,
        joints: Vec<UrdfJoint>,
    ) -> Vec<AssemblyJoint> {
        let world = world(links, &joints);
        let mut kept = Vec::with_capacity(joints.len());
        for (j, UrdfJoint { joint, kind, kind_at }) in joints.into_iter().enumerate() {
            match kind {
                Type::Floating if world == Some(j) => {
                    links.retain(|link| link.name != joint.parent);
                    if joint.X_PC != wrasse_spatial::Pose::identity() {
                        let message = "the origin of the floating joint is not used".to_owned();
                        let help = "the mission says where the vehicle starts";
                        self.found.note(&joint.at, message, "not used", help);
                    }
                    continue;
                }
                Type::Floating => self.refuse_floating(&joint, &kind_at),
                Type::Fixed if joint.parent == "world" => {
                    let message = format!("'{}' is fixed to 'world', but floats here", joint.child);
                    let help = "nothing holds a base in orbit; leave out 'world', or let its joint \
                                be floating";
                    self.found.warning(&joint.parent_at, message, "not the ground", help);
                }
                _ => {}
            }
            kept.push(joint);
        }
        kept
    }

    fn refuse_floating(&mut self, joint: &AssemblyJoint, at: &Range<usize>) {
        let message = format!(
            "joint '{}' is floating: only the base floats, and only a massless root called 'world' \
             may carry it so, as its one child",
            joint.name
        );
        let help = "leave out the joint and what it is mounted on, or describe two vehicles";
        self.found.error(at, message, "not supported", help);
    }
}

/// The floating joint, if the root is a frame called `world` that has this one child.
fn world(links: &[Link], joints: &[UrdfJoint]) -> Option<usize> {
    let touches_world = |j: &UrdfJoint| j.joint.parent == "world" || j.joint.child == "world";
    let mut at_world = joints.iter().enumerate().filter(|(_, j)| touches_world(j));
    let (place, only) = at_world.next()?;
    let is_frame = links.iter().any(|l| l.name == "world" && l.matter.is_none());
    let floats = only.kind == Type::Floating && only.joint.parent == "world";
    (at_world.next().is_none() && is_frame && floats).then_some(place)
}

/// The complaint about a file that is not XML.
fn not_xml(why: &roxmltree::Error, text: &str, mut found: Findings) -> Vec<Complaint> {
    let position = why.pos();
    let at = byte_at(text, position.row, position.col);
    let told = why.to_string();
    let message = told.strip_suffix(&format!(" at {position}")).unwrap_or(&told);
    let help = match why {
        roxmltree::Error::UnknownNamespace(prefix, _) if prefix == "xacro" => EXPAND_XACRO,
        _ => "the file must be well-formed XML with one <robot>",
    };
    found.error(&at, format!("not XML: {message}"), "here", help);
    found.into_complaints()
}

/// The character at a row and column, both from 1.
fn byte_at(text: &str, row: u32, column: u32) -> Range<usize> {
    let before: usize =
        text.split_inclusive('\n').take(row.saturating_sub(1) as usize).map(str::len).sum();
    let line = text.get(before..).unwrap_or_default();
    let within: usize =
        line.chars().take(column.saturating_sub(1) as usize).map(char::len_utf8).sum();
    let start = before + within;
    let length = text.get(start..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    start..start + length
}

/// Refuses xacro and files that are no URDF, with what to do.
fn refuse_other_formats(
    document: &Document<'_>,
    source: &Arc<Source>,
) -> Result<(), Vec<Complaint>> {
    let (mut found, text) = (Findings::new(source), &source.text);
    let root = document.root_element();
    let is_xacro = |uri: Option<&str>| uri.is_some_and(|uri| uri.contains("xacro"));
    let mut xacro = root.descendants().filter(|node| is_xacro(node.tag_name().namespace()));
    if let Some(first) = xacro.next() {
        let at = tag_at(first, text);
        found.error(
            &at,
            "this is a xacro file, not yet a URDF".into(),
            "a xacro tag",
            EXPAND_XACRO,
        );
    } else if root.tag_name().name() != "robot" {
        let name = root.tag_name().name();
        let help = match name {
            "sdf" => "this looks like SDF; convert it to URDF",
            "mujoco" => "this looks like MJCF; convert it to URDF",
            _ => "a URDF is one <robot name=\"…\"> with links and joints",
        };
        let message = format!("expected <robot>, found <{name}>");
        found.error(&tag_at(root, text), message, "not a robot", help);
    }
    if found.without_error() { Ok(()) } else { Err(found.into_complaints()) }
}

//! A URDF file to a vehicle.

use super::joint::{Type, UrdfJoint};
use crate::assembly::{Assembly, AssemblyJoint, Link, Outline};
use crate::findings::{Findings, SourceFiles};
use crate::model::Model;
use crate::provenance::{Grade, Provenance};
use crate::xml::{Element, Format, Kind, Reading, not_xml, tag_at};
use roxmltree::Document;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};

const URDF: Format = Format {
    name: "URDF",
    why_unused: &[
        ("<dynamics>", "joints are ideal: no friction, no damping"),
        ("<collision>", "links do not touch each other"),
    ],
};
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
pub(crate) const EXPAND_XACRO: &str = "expand it first: `xacro FILE.xacro > vehicle.urdf`";

/// The source of all numbers of a URDF, which has no place for one.
pub(crate) const NO_PROVENANCE: &str = "URDF without provenance";

/// What a URDF file says.
///
/// # Errors
/// All complaints at once, if it is no URDF.
pub(crate) fn read_urdf(source: &Arc<Source>) -> Result<Model, Vec<Complaint>> {
    let found = Findings::new(source);
    let document = match Document::parse(&source.text) {
        Ok(document) => document,
        Err(why) => {
            let help = match why {
                roxmltree::Error::UnknownNamespace(ref prefix, _) if prefix == "xacro" => {
                    EXPAND_XACRO
                }
                _ => "the file must be well-formed XML with one <robot>",
            };
            return Err(not_xml(&why, help, &source.text, found));
        }
    };
    refuse_other_formats(&document, source)?;
    let mut reading = Reading::new(&source.text, found, &URDF);
    let robot = reading.open(document.root_element(), &ROBOT);
    let name = robot.required("name", &mut reading);
    let (mut links, outlines, partly_drawn) = reading.links(&robot);
    let joints: Vec<_> = robot.children("joint").map(|joint| reading.joint(joint)).collect();
    let joints = reading.float_the_base(&mut links, joints);
    let name = name.map_or(String::new(), |name| name.text.to_owned());
    let provenance =
        Provenance { of: "everything".into(), grade: Grade::Assumed, source: NO_PROVENANCE.into() };
    let assembly = Assembly {
        files: SourceFiles::of(source),
        links,
        joints,
        outlines,
        partly_drawn,
        provenance: vec![provenance],
        ..Assembly::default()
    };
    let found = reading.into_findings().into_complaints();
    let summary = format!("{name}, from a URDF file");
    Ok(Model { found, ..Model::bare(name, summary, assembly) })
}

impl Reading<'_> {
    fn links(&mut self, robot: &Element<'_, '_>) -> (Vec<Link>, Vec<Outline>, BTreeSet<String>) {
        let mut outlines = Vec::new();
        let mut partly_drawn = BTreeSet::new();
        let mut links = Vec::new();
        for node in robot.children("link") {
            if let Some((link, shown, is_partly_drawn)) = self.link(node) {
                partly_drawn.extend(is_partly_drawn.then(|| link.name.clone()));
                links.push(link);
                outlines.extend(shown);
            }
        }
        (links, outlines, partly_drawn)
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
            "sdf" => "this looks like SDF; convert it to URDF or MJCF",
            "mujoco" => "this looks like MJCF: give the file the ending .mjcf",
            _ => "a URDF is one <robot name=\"…\"> with links and joints",
        };
        let message = format!("expected <robot>, found <{name}>");
        found.error(&tag_at(root, text), message, "not a robot", help);
    }
    if found.without_error() { Ok(()) } else { Err(found.into_complaints()) }
}

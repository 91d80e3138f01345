//! What a body holds, frames within it resolved.

use super::compiler::Compiler;
use super::defaults::{Classes, Styled};
use crate::xml::{Element, Kind, Reading};
use roxmltree::Node;
use wrasse_spatial::Pose;

/// Children of bodies and frames that add bodies which are not written out: what they would be is for
/// MuJoCo to say.
const GENERATORS: [&str; 4] = ["composite", "flexcomp", "replicate", "attach"];

const CHILDREN: [&str; 12] = [
    "inertial",
    "joint",
    "freejoint",
    "geom",
    "site",
    "body",
    "frame",
    "composite",
    "flexcomp",
    "replicate",
    "attach",
    "include",
];
const UNUSED: [&str; 3] = ["camera", "light", "plugin"];

pub(super) const BODY: Kind = Kind {
    tag: "body",
    attributes: &["name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"],
    children: &CHILDREN,
    unused: &[
        "fuse", "gravcomp", "mocap", "simple", "sleep", "user", UNUSED[0], UNUSED[1], UNUSED[2],
    ],
};
pub(super) const WORLD: Kind = Kind {
    tag: "worldbody",
    attributes: &["childclass"],
    children: &["body", "frame", "composite", "flexcomp", "replicate", "attach"],
    unused: &["name", "geom", "site", "camera", "light", "plugin", "fuse", "gravcomp", "user"],
};
const FRAME: Kind = Kind {
    tag: "frame",
    attributes: &["name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"],
    children: &CHILDREN,
    unused: &UNUSED,
};

/// An element, the frame that it is in, and the class that holds there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed<'d, 't> {
    pub(super) node: Node<'d, 't>,
    pub(super) X_BF: Pose<f64>,
    pub(super) class: Option<usize>,
}

/// What a body holds, in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Contents<'d, 't> {
    pub(super) inertial: Option<Node<'d, 't>>,
    pub(super) joints: Vec<Placed<'d, 't>>,
    pub(super) geoms: Vec<Placed<'d, 't>>,
    pub(super) sites: Vec<Placed<'d, 't>>,
    pub(super) bodies: Vec<Placed<'d, 't>>,
}

impl Compiler {
    /// What an open body or world holds.
    pub(super) fn contents<'d, 't>(
        &self,
        element: &Element<'d, 't>,
        node: Node<'d, 't>,
        class: Option<usize>,
        classes: &Classes<'d, 't>,
        reading: &mut Reading<'_>,
    ) -> Contents<'d, 't> {
        let mut contents =
            Contents { inertial: element.only("inertial", reading), ..Contents::default() };
        refuse_generators(element, reading);
        let class = child_class(element, class, classes, reading);
        let mut waiting = children(node, Pose::identity(), class);
        // Depth first, so that all come in the order of the file, whatever frame they are in.
        while let Some(child) = waiting.pop() {
            match child.node.tag_name().name() {
                "joint" | "freejoint" => contents.joints.push(child),
                "geom" => contents.geoms.push(child),
                "site" => contents.sites.push(child),
                "body" => contents.bodies.push(child),
                "frame" => {
                    let frame = reading.open(child.node, &FRAME);
                    refuse_generators(&frame, reading);
                    let class = child_class(&frame, child.class, classes, reading);
                    let X_FG = self.pose(&Styled::plain(frame), reading);
                    waiting.extend(children(child.node, child.X_BF * X_FG, class));
                }
                _ => {}
            }
        }
        contents
    }
}

/// The children of an element, the last first.
fn children<'d, 't>(
    node: Node<'d, 't>,
    X_BF: Pose<f64>,
    class: Option<usize>,
) -> Vec<Placed<'d, 't>> {
    let elements = node.children().filter(Node::is_element);
    let mut placed: Vec<_> = elements.map(|node| Placed { node, X_BF, class }).collect();
    placed.reverse();
    placed
}

/// The class that holds for what an element holds.
fn child_class(
    element: &Element<'_, '_>,
    around: Option<usize>,
    classes: &Classes<'_, '_>,
    reading: &mut Reading<'_>,
) -> Option<usize> {
    let named = element.attribute("childclass");
    named.and_then(|named| classes.find(named, reading)).or(around)
}

/// Complains of children that stand for bodies which are not written out.
fn refuse_generators(element: &Element<'_, '_>, reading: &mut Reading<'_>) {
    for name in GENERATORS {
        for node in element.children(name) {
            let message =
                format!("<{name}> is not supported: the bodies it makes are not written out");
            let help =
                "let MuJoCo write them out: mj_saveLastXML saves the model as it is compiled";
            let at = crate::xml::tag_at(node, reading.text);
            reading.found.error(&at, message, "not supported", help);
        }
    }
}

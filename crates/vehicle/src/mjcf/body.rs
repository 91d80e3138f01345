//! Bodies to links and joints: one link for each body, one more for each joint whose axis does not go
//! through the body's origin, or that is not the last of its body.

use super::compiler::Compiler;
use super::contents::{BODY, Placed};
use super::defaults::{Classes, Styled};
use super::geom::GEOM;
use super::joint::{FREE_JOINT, JOINT, MjcfJoint, Motion, name_of};
use crate::assembly::{AssemblyJoint, Link, Matter, Outline};
use crate::xml::{Element, Kind, Reading};
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Mat3, Pose, Vec3, vec3};

pub(super) const SITE: Kind = Kind {
    tag: "site",
    attributes: &["name", "class", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"],
    children: &[],
    unused: &["fromto", "group", "material", "mesh", "rgba", "size", "type", "user"],
};

/// The tree in the making.
#[derive(Debug)]
pub(super) struct Bodies<'c, 'd, 't, 'r> {
    pub(super) compiler: Compiler,
    pub(super) classes: &'c Classes<'d, 't>,
    pub(super) reading: &'r mut Reading<'d>,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<AssemblyJoint>,
    pub(super) outlines: Vec<Outline>,
    /// Names of the links that are drawn by more than outlines.
    pub(super) partly_drawn: BTreeSet<String>,
    /// Whether the file says that the base floats, or that nothing lets it move.
    pub(super) is_free: bool,
    pub(super) stands: bool,
    /// Joints with a rotor's inertia, and where the first says so.
    /// Positions at which joints are where the file puts them, where they are not zero (rad or m).
    pub(super) references: BTreeMap<String, f64>,
    /// Where the names of bodies stand.
    names: BTreeMap<String, Range<usize>>,
    sites: Vec<(Link, AssemblyJoint)>,
    /// Bodies and joints so far, as MuJoCo numbers them; body 0 is the world.
    bodies: usize,
    joint_count: usize,
}

/// A body that is still to be read, and the link that carries it.
type Waiting<'d, 't> = (Placed<'d, 't>, Option<(String, Range<usize>)>);

impl<'c, 'd, 't, 'r> Bodies<'c, 'd, 't, 'r> {
    /// No bodies yet.
    pub(super) fn new(
        compiler: Compiler,
        classes: &'c Classes<'d, 't>,
        reading: &'r mut Reading<'d>,
    ) -> Self {
        Self {
            compiler,
            classes,
            reading,
            links: Vec::new(),
            joints: Vec::new(),
            outlines: Vec::new(),
            partly_drawn: BTreeSet::new(),
            is_free: false,
            stands: false,
            references: BTreeMap::new(),
            names: BTreeMap::new(),
            sites: Vec::new(),
            bodies: 0,
            joint_count: 0,
        }
    }

    /// The base and all that it carries, parents before children.
    pub(super) fn read(&mut self, base: Placed<'d, 't>) {
        let mut waiting: Vec<Waiting<'d, 't>> = vec![(base, None)];
        while let Some((placed, parent)) = waiting.pop() {
            let (name, at, mut bodies) = self.body(placed, parent);
            bodies.reverse();
            let carried = |body| (body, Some((name.clone(), at.clone())));
            waiting.extend(bodies.into_iter().map(carried));
        }
        self.add_sites();
    }

    /// One body: its name, where that stands, and the bodies in it.
    fn body(
        &mut self,
        placed: Placed<'d, 't>,
        parent: Option<(String, Range<usize>)>,
    ) -> (String, Range<usize>, Vec<Placed<'d, 't>>) {
        let element = self.reading.open(placed.node, &BODY);
        self.bodies += 1;
        let (name, at) = self.name(&element);
        let contents =
            self.compiler.contents(&element, placed.node, placed.class, self.classes, self.reading);
        let matter = {
            let mut geoms = Vec::with_capacity(contents.geoms.len());
            for geom in &contents.geoms {
                let styled = self.styled(geom, &GEOM);
                geoms.push(self.compiler.geom(geom.node, &styled, &geom.X_BF, self.reading));
            }
            let drawn = geoms.iter().flat_map(|geom| &geom.outlines);
            let of_body = |&(X_LF, kind): &_| Outline { link: name.clone(), X_LF, kind };
            self.outlines.extend(drawn.map(of_body));
            let is_partly_drawn = geoms.iter().any(|geom| geom.is_undrawn);
            self.partly_drawn.extend(is_partly_drawn.then(|| name.clone()));
            self.compiler.matter((&name, &at), contents.inertial, &geoms, self.reading)
        };
        let joints: Vec<_> = contents.joints.iter().map(|joint| self.joint(joint)).collect();
        let X_PB = placed.X_BF * self.compiler.pose(&Styled::plain(element), self.reading);
        match parent {
            None => self.base(&name, &at, matter, &joints),
            Some(parent) => self.mounted((&name, &at), parent, X_PB, matter, joints),
        }
        for site in &contents.sites {
            self.site(site, &name, &at);
        }
        (name, at, contents.bodies)
    }

    /// The name of a body and where it stands; MuJoCo's number where there is none, or after a complaint
    /// about one that is there already.
    fn name(&mut self, element: &Element<'_, '_>) -> (String, Range<usize>) {
        let numbered = format!("body{}", self.bodies);
        let Some(written) = element.name() else { return (numbered, element.at.clone()) };
        if let Some(other) = self.names.get(written.text) {
            let line = self.reading.found.line(other.start, &written.at);
            let message =
                format!("two bodies are called '{}'; the other is on {line}", written.text);
            let help = "give one of them another name";
            self.reading.found.error(&written.at, message, "the second", help);
            return (numbered, written.at.clone());
        }
        self.names.insert(written.text.to_owned(), written.at.clone());
        (written.text.to_owned(), written.at.clone())
    }

    fn styled(&mut self, placed: &Placed<'d, 't>, kind: &Kind) -> Styled<'c, 'd, 't> {
        let own = self.reading.open(placed.node, kind);
        self.classes.styled(own, placed.class, self.reading)
    }

    fn joint(&mut self, placed: &Placed<'d, 't>) -> MjcfJoint {
        let number = self.joint_count;
        self.joint_count += 1;
        if placed.node.tag_name().name() == FREE_JOINT.tag {
            let own: Element<'d, 't> = self.reading.open(placed.node, &FREE_JOINT);
            self.refuse_alignment(&own, placed.node);
            return free(&Styled::plain(own), number);
        }
        let styled = self.styled(placed, &JOINT);
        let joint = self.compiler.joint(&styled, number, &placed.X_BF, self.reading);
        if joint.reference != 0.0 {
            self.references.insert(joint.name.clone(), joint.reference);
        }
        joint
    }

    /// MuJoCo moves the frame of a body that floats and carries none, if it is told to. Here a frame stays
    /// where the file puts it: poses and mass matrix would be those of another one.
    fn refuse_alignment(&mut self, own: &Element<'_, '_>, node: Node<'_, '_>) {
        let body = node.parent_element();
        let is_body = |node: &Node<'_, '_>| node.has_tag_name(BODY.tag);
        if body.is_some_and(|body| body.children().any(|node| is_body(&node))) {
            return;
        }
        if self.reading.truth(own, "align").unwrap_or(self.compiler.align_free) {
            let at = own.attribute("align").map_or(&own.at, |written| &written.at).clone();
            let message = "the frame of the base is moved to its principal axes".to_owned();
            let help =
                "write align=\"false\" in the <freejoint>, and give poses in the frame of the file";
            self.reading.found.error(&at, message, "not supported", help);
        }
    }

    /// The base floats; whatever else holds it to the world would change how it moves.
    fn base(
        &mut self,
        name: &str,
        at: &Range<usize>,
        matter: Option<Matter>,
        joints: &[MjcfJoint],
    ) {
        self.links.push(Link { name: name.to_owned(), at: at.clone(), matter });
        self.stands = joints.is_empty();
        for joint in joints {
            if joint.motion == Motion::Free {
                self.is_free = true;
                continue;
            }
            let message = format!("joint '{}' holds the base '{name}' to the world", joint.name);
            let help = "a base floats here: write <freejoint/> in place of its joints, or leave them \
                        out";
            self.reading.found.error(&joint.at, message, "not a free joint", help);
        }
    }

    /// A body on another: fixed, or moving on its joints one after the other.
    fn mounted(
        &mut self,
        (name, at): (&str, &Range<usize>),
        parent: (String, Range<usize>),
        X_PB: Pose<f64>,
        matter: Option<Matter>,
        joints: Vec<MjcfJoint>,
    ) {
        let (mut on, mut X_PF) = (parent, X_PB);
        let (mut anchor, count) = (Vec3::default(), joints.len());
        for (k, joint) in joints.into_iter().enumerate() {
            let Some(kind) = self.kind(&joint) else { continue };
            // Frame of the joint: the body's axes, on the joint's axis.
            let X_PC = X_PF * shift(joint.anchor - anchor) * joint.at_zero();
            let is_body = k + 1 == count && joint.anchor == Vec3::default();
            let child = if is_body { name.to_owned() } else { format!("{name}@{}", joint.name) };
            if !is_body {
                self.links.push(Link { name: child.clone(), at: joint.at.clone(), matter: None });
            }
            let child_at = if is_body { at.clone() } else { joint.at.clone() };
            anchor = joint.anchor;
            let carrier = std::mem::replace(&mut on, (child.clone(), child_at.clone()));
            X_PF = Pose::identity();
            self.joints.push(AssemblyJoint {
                name: joint.name,
                at: joint.at,
                parent: carrier.0,
                parent_at: carrier.1,
                child,
                child_at,
                kind: Some(kind),
                X_PC,
                axis: joint.axis,
                axis_at: joint.axis_at,
                limits: joint.limits,
                limits_at: joint.limits_at,
                rotor: joint.rotor,
                mimic: None,
            });
        }
        self.links.push(Link { name: name.to_owned(), at: at.clone(), matter });
        if on.0 != name {
            let X = X_PF * shift(Vec3::default() - anchor);
            self.joints.push(fixed((name, at), on, X));
        }
    }

    /// How a joint below the base moves; nothing after a complaint.
    fn kind(&mut self, joint: &MjcfJoint) -> Option<wrasse_dynamics::JointKind> {
        let (message, help) = match joint.motion {
            Motion::Moves(kind) => return Some(kind),
            Motion::Ball => (
                format!("joint '{}' is a ball joint: ball joints are not supported", joint.name),
                "write three hinges in the same body; they meet a singularity where two of their \
                 axes are parallel",
            ),
            Motion::Free => (
                format!("joint '{}' is free: only the base floats", joint.name),
                "describe what floats by itself in a file of its own",
            ),
        };
        self.reading.found.error(&joint.motion_at, message, "not supported", help);
        None
    }

    /// A site is a frame, if it has a name.
    fn site(&mut self, placed: &Placed<'d, 't>, body: &str, body_at: &Range<usize>) {
        let styled = self.styled(placed, &SITE);
        let X_BS = placed.X_BF * self.compiler.pose(&styled, self.reading);
        let Some(name) = styled.own.name() else { return };
        let link = Link { name: name.text.to_owned(), at: name.at.clone(), matter: None };
        let joint = fixed((name.text, &name.at), (body.to_owned(), body_at.clone()), X_BS);
        self.sites.push((link, joint));
    }

    /// Sites and bodies may share names in MJCF; here a frame is found by its name.
    fn add_sites(&mut self) {
        let mut taken: BTreeSet<_> = self.links.iter().map(|link| link.name.clone()).collect();
        for (link, mut joint) in std::mem::take(&mut self.sites) {
            if !taken.insert(link.name.clone()) {
                let what = "a site with the name of a body or of another site";
                self.reading.not_used(what.to_owned(), link.at);
                continue;
            }
            joint.name = format!("{} (site)", link.name);
            self.links.push(link);
            self.joints.push(joint);
        }
    }
}

fn shift(p: Vec3<f64>) -> Pose<f64> {
    Pose::new(Mat3::identity(), p)
}

fn free(joint: &Styled<'_, '_, '_>, number: usize) -> MjcfJoint {
    let at = joint.own.at.clone();
    MjcfJoint {
        name: name_of(joint, number),
        at: at.clone(),
        motion: Motion::Free,
        motion_at: at.clone(),
        anchor: Vec3::default(),
        axis: vec3(0.0, 0.0, 1.0),
        axis_at: at.clone(),
        reference: 0.0,
        limits: JointLimits::default(),
        limits_at: at,
        rotor: 0.0,
    }
}

/// A joint that does not move, called after what it carries.
fn fixed(
    (child, child_at): (&str, &Range<usize>),
    (parent, parent_at): (String, Range<usize>),
    X_PC: Pose<f64>,
) -> AssemblyJoint {
    AssemblyJoint {
        name: format!("{child} (fixed)"),
        at: child_at.clone(),
        parent,
        parent_at,
        child: child.to_owned(),
        child_at: child_at.clone(),
        kind: None,
        X_PC,
        axis: vec3(0.0, 0.0, 1.0),
        axis_at: child_at.clone(),
        limits: JointLimits::default(),
        limits_at: child_at.clone(),
        rotor: 0.0,
        mimic: None,
    }
}

//! A `<joint>`: how it moves, what it connects, what limits it.

use crate::assembly::{AssemblyJoint, Mimic};
use crate::xml::{Element, Kind, Reading, Text};
use roxmltree::Node;
use std::ops::Range;
use wrasse_document::closest;
use wrasse_dynamics::JointKind;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Vec3, vec3};

const JOINT: Kind = Kind {
    tag: "joint",
    attributes: &["name", "type"],
    children: &["origin", "parent", "child", "axis", "limit", "mimic"],
    unused: &["dynamics", "calibration", "safety_controller", "hardwareInterface"],
};
const PARENT: Kind = Kind { tag: "parent", attributes: &["link"], children: &[], unused: &[] };
const CHILD: Kind = Kind { tag: "child", attributes: &["link"], children: &[], unused: &[] };
const AXIS: Kind = Kind { tag: "axis", attributes: &["xyz"], children: &[], unused: &[] };
const MIMIC: Kind = Kind {
    tag: "mimic",
    attributes: &["joint", "multiplier", "offset"],
    children: &[],
    unused: &[],
};
const LIMIT: Kind = Kind {
    tag: "limit",
    attributes: &["lower", "upper", "effort", "velocity"],
    children: &[],
    unused: &["acceleration", "deceleration", "jerk"],
};

/// Joint types of URDF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
}

const TYPES: [(&str, Type); 6] = [
    ("revolute", Type::Revolute),
    ("continuous", Type::Continuous),
    ("prismatic", Type::Prismatic),
    ("fixed", Type::Fixed),
    ("floating", Type::Floating),
    ("planar", Type::Planar),
];

/// A joint, and what its file calls it.
#[derive(Debug)]
pub(crate) struct UrdfJoint {
    pub(crate) joint: AssemblyJoint,
    /// Its type, and where that stands.
    pub(crate) kind: Type,
    pub(crate) kind_at: Range<usize>,
}

impl Reading<'_> {
    /// A joint. After a complaint about a missing name, the empty one stands in.
    pub(crate) fn joint(&mut self, node: Node<'_, '_>) -> UrdfJoint {
        let element = self.open(node, &JOINT);
        let name = element.required("name", self).unwrap_or_else(|| element.no_text());
        let called = name.text;
        let (kind, kind_at) = self.joint_type(&element);
        let origin = element.only("origin", self);
        let X_PC = self.pose(origin);
        let parent = self.end_of_joint(&element, &PARENT);
        let child = self.end_of_joint(&element, &CHILD);
        let (axis, axis_at) = self.axis(&element);
        let (limits, limits_at) = self.limits(&element, called, kind);
        let mimic = element.only("mimic", self).and_then(|node| self.mimic(node));
        let joint = AssemblyJoint {
            name: name.text.to_owned(),
            at: name.at,
            parent: parent.text.to_owned(),
            parent_at: parent.at,
            child: child.text.to_owned(),
            child_at: child.at,
            kind: match kind {
                Type::Revolute | Type::Continuous => Some(JointKind::Revolute),
                Type::Prismatic => Some(JointKind::Prismatic),
                Type::Fixed | Type::Floating | Type::Planar => None,
            },
            X_PC,
            axis,
            axis_at,
            limits,
            limits_at,
            rotor: 0.0,
            mimic,
        };
        UrdfJoint { joint, kind, kind_at }
    }

    /// The joint that is followed: travel `multiplier × q + offset`.
    fn mimic(&mut self, node: Node<'_, '_>) -> Option<Mimic> {
        let element = self.open(node, &MIMIC);
        let leader = element.required("joint", self)?;
        let ratio = self.number(&element, "multiplier").unwrap_or(1.0);
        let offset = self.number(&element, "offset").unwrap_or(0.0);
        Some(Mimic { leader: leader.text.to_owned(), at: leader.at, ratio, offset })
    }

    /// The type; after a complaint the joint stands in as a fixed one.
    fn joint_type(&mut self, element: &Element<'_, '_>) -> (Type, Range<usize>) {
        let Some(written) = element.required("type", self) else {
            return (Type::Fixed, element.at.clone());
        };
        let known = TYPES.iter().find(|(name, _)| *name == written.text);
        if let Some((_, Type::Planar)) = known {
            let message = "planar joints are not supported".to_owned();
            let help = "use two prismatic joints and a revolute one";
            self.found.error(&written.at, message, "not supported", help);
        }
        if let Some(&(_, kind)) = known {
            return (kind, written.at);
        }
        let names = TYPES.map(|(name, _)| name);
        let meant = closest(written.text, names);
        let help = match meant {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("types are {}", names.join(", ")),
        };
        let message = format!("there is no joint type '{}'", written.text);
        self.found.error(&written.at, message, "unknown type", &help);
        let kind = TYPES.iter().find(|(name, _)| Some(*name) == meant);
        (kind.map_or(Type::Fixed, |(_, kind)| *kind), written.at)
    }

    /// The name of the link that `<parent>` or `<child>` gives.
    fn end_of_joint<'a>(&mut self, joint: &Element<'a, '_>, kind: &Kind) -> Text<'a> {
        let Some(node) = joint.only(kind.tag, self) else {
            let message = format!("<joint> has no <{}>", kind.tag);
            let help = format!("write <{} link=\"…\"/>", kind.tag);
            self.found.error(&joint.at, message, "here", &help);
            return joint.no_text();
        };
        let end = self.open(node, kind);
        end.required("link", self).unwrap_or_else(|| end.no_text())
    }

    /// The axis in child axes: x unless the file says otherwise.
    fn axis(&mut self, joint: &Element<'_, '_>) -> (Vec3<f64>, Range<usize>) {
        let x = vec3(1.0, 0.0, 0.0);
        let Some(node) = joint.only("axis", self) else { return (x, joint.at.clone()) };
        let element = self.open(node, &AXIS);
        let at = element.required("xyz", self).map_or(element.at.clone(), |written| written.at);
        (self.vector(&element, "xyz").unwrap_or(x), at)
    }

    fn limits(
        &mut self,
        joint: &Element<'_, '_>,
        name: &str,
        kind: Type,
    ) -> (JointLimits<f64>, Range<usize>) {
        let has_travel = matches!(kind, Type::Revolute | Type::Prismatic);
        let Some(node) = joint.only("limit", self) else {
            if has_travel {
                let message = format!("joint '{name}' has no <limit>: read as not limited");
                let help = "URDF asks for limits of revolute and prismatic joints";
                self.found.warning(&joint.at, message, "no limits", help);
            }
            return (JointLimits::default(), joint.at.clone());
        };
        let element = self.open(node, &LIMIT);
        let travel = if has_travel {
            self.travel(&element, name)
        } else {
            for end in ["lower", "upper"].into_iter().filter_map(|n| element.attribute(n)) {
                let what = "travel limit of a continuous or fixed joint";
                self.not_used(what.to_owned(), end.at.clone());
            }
            None
        };
        for capacity in ["velocity", "effort"] {
            if kind != Type::Fixed && element.attribute(capacity).is_none() {
                let message =
                    format!("<limit> of joint '{name}' has no {capacity}: read as not limited");
                self.found.warning(
                    &element.at,
                    message,
                    "here",
                    "URDF asks for it in each <limit>",
                );
            }
        }
        let (rate, effort) = (self.number(&element, "velocity"), self.number(&element, "effort"));
        (JointLimits { travel, rate, effort }, element.at)
    }

    /// Both ends of the travel. URDF takes an end that is not written as zero.
    fn travel(&mut self, element: &Element<'_, '_>, name: &str) -> Option<(f64, f64)> {
        let (lower, upper) = (element.attribute("lower"), element.attribute("upper"));
        if lower.is_none() && upper.is_none() {
            let message =
                format!("<limit> of joint '{name}' has no lower and no upper: read as not limited");
            let help = "write both ends, or make the joint continuous";
            self.found.warning(&element.at, message, "no travel limits", help);
            return None;
        }
        let mut end = |name: &str, written: Option<&Text<'_>>| match written {
            Some(_) => self.number(element, name),
            None => Some(0.0),
        };
        let (lower, upper) = (end("lower", lower), end("upper", upper));
        lower.zip(upper)
    }
}

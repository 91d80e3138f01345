//! A `<joint>`: how it moves, about which axis through which point, what limits it.

use super::compiler::Compiler;
use super::defaults::Styled;
use crate::xml::{Kind, Reading, Text};
use std::ops::Range;
use wrasse_dynamics::JointKind;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Quat, Vec3, vec3};

pub(super) const JOINT: Kind = Kind {
    tag: "joint",
    attributes: &[
        "name",
        "class",
        "type",
        "pos",
        "axis",
        "range",
        "limited",
        "ref",
        "armature",
        "actuatorfrcrange",
        "actuatorfrclimited",
    ],
    children: &[],
    unused: &[
        "actuatorgravcomp",
        "damping",
        "frictionloss",
        "group",
        "margin",
        "solimpfriction",
        "solimplimit",
        "solreffriction",
        "solreflimit",
        "springdamper",
        "springref",
        "springyield",
        "stiffness",
        "user",
        "plugin",
    ],
};
pub(super) const FREE_JOINT: Kind =
    Kind { tag: "freejoint", attributes: &["name", "align"], children: &[], unused: &["group"] };

/// How a joint lets its body move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    Free,
    Moves(JointKind),
    /// Three turns at once, which no joint of a vehicle has.
    Ball,
}

/// A joint in the axes of its body.
#[derive(Debug)]
pub(super) struct MjcfJoint {
    pub(super) name: String,
    pub(super) at: Range<usize>,
    pub(super) motion: Motion,
    pub(super) motion_at: Range<usize>,
    /// A point on its axis (m); zero of a joint that slides.
    pub(super) anchor: Vec3<f64>,
    pub(super) axis: Vec3<f64>,
    pub(super) axis_at: Range<usize>,
    /// Position at which the body is where the file puts it (rad or m).
    pub(super) reference: f64,
    pub(super) limits: JointLimits<f64>,
    pub(super) limits_at: Range<usize>,
    /// Inertia of the rotor, seen from the joint (kg·m² or kg).
    pub(super) rotor: f64,
}

impl MjcfJoint {
    /// The pose of the body, seen from its axes at zero displacement, when the position is zero.
    pub(super) fn at_zero(&self) -> Pose<f64> {
        let length = self.axis.norm();
        if self.reference == 0.0 || length <= 0.0 {
            return Pose::identity();
        }
        let back = self.axis * (-self.reference / length);
        match self.motion {
            Motion::Moves(JointKind::Revolute) => Pose::from_quat(Quat::exp(back), Vec3::default()),
            Motion::Moves(JointKind::Prismatic) => Pose { translation: back, ..Pose::identity() },
            Motion::Free | Motion::Ball => Pose::identity(),
        }
    }
}

impl Compiler {
    /// A joint in a frame of its body; `number` makes its name if it has none.
    pub(super) fn joint(
        &self,
        joint: &Styled<'_, '_, '_>,
        number: usize,
        X_BF: &Pose<f64>,
        reading: &mut Reading<'_>,
    ) -> MjcfJoint {
        let at = joint.own.name().map_or(&joint.own.at, |name| &name.at).clone();
        let of_type =
            reading.word(joint.giver("type"), "type", &["hinge", "slide", "ball", "free"]);
        let motion = match of_type {
            Some("free") => Motion::Free,
            Some("ball") => Motion::Ball,
            Some("slide") => Motion::Moves(JointKind::Prismatic),
            _ => Motion::Moves(JointKind::Revolute),
        };
        let turns = motion == Motion::Moves(JointKind::Revolute);
        let angle = |x: f64| if turns { self.radians(x) } else { x };
        let point = reading.vector(joint.giver("pos"), "pos").unwrap_or_default();
        let axis = reading.vector(joint.giver("axis"), "axis").unwrap_or(vec3(0.0, 0.0, 1.0));
        let place =
            |of: &str| joint.attribute(of).map_or(&joint.own.at, |text: &Text<'_>| &text.at);
        let (axis_at, limits_at) = (place("axis").clone(), place("range").clone());
        let range = self.range(joint, "range", "limited", reading);
        let rotor = reading.number(joint.giver("armature"), "armature").unwrap_or(0.0);
        let moves = matches!(motion, Motion::Moves(_));
        if rotor < 0.0 || (rotor != 0.0 && !moves) {
            let message = format!("an armature of {rotor} on a joint like this is not supported");
            let help = "an armature is positive, and of a hinge or a slide; leave it out";
            reading.found.error(place("armature"), message, "not supported", help);
        }
        MjcfJoint {
            name: name_of(joint, number),
            at,
            motion,
            motion_at: place("type").clone(),
            anchor: if turns { X_BF.point(point) } else { Vec3::default() },
            axis: X_BF.rotation * axis,
            axis_at,
            reference: angle(reading.number(joint.giver("ref"), "ref").unwrap_or(0.0)),
            limits: JointLimits {
                travel: range.map(|(lower, upper)| (angle(lower), angle(upper))),
                rate: None,
                effort: self.effort(joint, reading),
            },
            limits_at,
            rotor,
        }
    }

    /// A range that limits; nothing where it does not, or after a complaint.
    fn range(
        &self,
        joint: &Styled<'_, '_, '_>,
        name: &str,
        switch: &str,
        reading: &mut Reading<'_>,
    ) -> Option<(f64, f64)> {
        let limited = reading.truth(joint.giver(switch), switch);
        let range = reading.numbers(joint.giver(name), name, 2);
        let range = match range.as_deref() {
            // MuJoCo's value for a range that is not there.
            Some([0.0, 0.0]) | None => None,
            Some([lower, upper]) => Some((*lower, *upper)),
            Some(_) => None,
        };
        if limited == Some(true) && range.is_none() && joint.attribute(name).is_none() {
            let message = format!("the joint has {switch}=\"true\" and no `{name}`");
            let help = format!("write {name}=\"lower upper\"");
            reading.found.error(&joint.own.at, message, "no range", &help);
        }
        range.filter(|_| limited.unwrap_or(self.autolimits))
    }

    /// The effort that `actuatorfrcrange` allows both ways: the lesser of its ends.
    fn effort(&self, joint: &Styled<'_, '_, '_>, reading: &mut Reading<'_>) -> Option<f64> {
        let name = "actuatorfrcrange";
        let (lower, upper) = self.range(joint, name, "actuatorfrclimited", reading)?;
        let effort = lower.abs().min(upper.abs());
        if lower != -upper {
            let message = format!("`{name}` is not the same both ways: read as {effort}");
            let at = joint.attribute(name).map_or(&joint.own.at, |written| &written.at);
            reading.found.warning(at, message, "this range", "a limit of effort is one number");
        }
        Some(effort)
    }
}

/// Its name, or MuJoCo's number of a joint without one.
pub(super) fn name_of(joint: &Styled<'_, '_, '_>, number: usize) -> String {
    let written = joint.own.name().map(|name| name.text.to_owned());
    written.unwrap_or_else(|| format!("joint{number}"))
}

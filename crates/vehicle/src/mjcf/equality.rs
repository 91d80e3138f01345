//! `<equality>`: joints that follow another one; what else couples what moves is refused.

use super::defaults::Classes;
use crate::assembly::{AssemblyJoint, Mimic};
use crate::xml::{Element, Kind, Reading, tag_at};
use roxmltree::Node;
use std::collections::BTreeMap;
use std::ops::Range;

/// What a class says of equality constraints.
pub(super) const EQUALITY: Kind = Kind {
    tag: "equality",
    attributes: &["active"],
    children: &[],
    unused: &["class", "solimp", "solref"],
};
const JOINT: Kind = Kind {
    tag: "joint",
    attributes: &["joint1", "joint2", "polycoef", "active"],
    children: &[],
    unused: &["class", "name", "solimp", "solref"],
};

/// A joint that follows another one: `q - q0 = offset + ratio (p - p0)`, from the positions q0 and p0
/// at which the file puts both.
#[derive(Debug)]
pub(super) struct Coupling {
    follower: String,
    at: Range<usize>,
    leader: String,
    leader_at: Range<usize>,
    offset: f64,
    ratio: f64,
}

/// The joints that follow others. Complains of all else that couples what moves and is not switched off.
pub(super) fn couplings(
    root: &Element<'_, '_>,
    classes: &Classes<'_, '_>,
    reading: &mut Reading<'_>,
) -> Vec<Coupling> {
    let sections = root.children("equality").flat_map(|node| node.children());
    let mut couplings = vec![];
    for node in sections.filter(Node::is_element) {
        let own = node.attribute("active").map(str::trim);
        let active =
            own.map_or_else(|| classes.activity(node.attribute("class")), |a| a != "false");
        let (tag, at) = (node.tag_name().name(), tag_at(node, reading.text));
        if !active {
            reading.not_used(format!("<{tag}> of <equality>, switched off,"), at);
        } else if tag == JOINT.tag {
            couplings.extend(coupling(node, reading));
        } else {
            let message = format!("<{tag}> of <equality> couples what moves: not supported");
            let help = "a vehicle is a tree; write active=\"false\" to leave it out";
            reading.found.error(&at, message, "not supported", help);
        }
    }
    couplings
}

/// One joint that follows another; nothing after a complaint.
fn coupling(node: Node<'_, '_>, reading: &mut Reading<'_>) -> Option<Coupling> {
    let element = reading.open(node, &JOINT);
    let follower = element.required("joint1", reading)?;
    let given = reading.numbers_up_to(&element, "polycoef", 5);
    let mut polynomial = [0.0, 1.0, 0.0, 0.0, 0.0];
    polynomial.iter_mut().zip(given.unwrap_or_default()).for_each(|(to, from)| *to = from);
    let [offset, ratio, higher @ ..] = polynomial;
    let leader = element.attribute("joint2");
    let curved = leader.is_some() && higher.iter().any(|x| *x != 0.0);
    if curved || leader.is_none() {
        let what = if curved { "a curve" } else { "no other joint" };
        let message = format!("joint '{}' follows {what}: not supported", follower.text);
        let help = "a joint follows another one in proportion: polycoef=\"offset ratio 0 0 0\"; write \
                    active=\"false\" to leave it out";
        reading.found.error(&element.at, message, "not supported", help);
        return None;
    }
    let leader = leader?;
    Some(Coupling {
        follower: follower.text.to_owned(),
        at: follower.at,
        leader: leader.text.to_owned(),
        leader_at: leader.at.clone(),
        offset,
        ratio,
    })
}

/// Has the joints follow; complains of those that are not there.
pub(super) fn follow(
    couplings: &[Coupling],
    joints: &mut [AssemblyJoint],
    references: &BTreeMap<String, f64>,
    reading: &mut Reading<'_>,
) {
    let reference = |name: &str| references.get(name).copied().unwrap_or(0.0);
    let mut by_name: BTreeMap<String, &mut AssemblyJoint> =
        joints.iter_mut().rev().map(|joint| (joint.name.clone(), joint)).collect();
    for coupling in couplings {
        let offset = reference(&coupling.follower) + coupling.offset
            - coupling.ratio * reference(&coupling.leader);
        if let Some(joint) = by_name.get_mut(&coupling.follower) {
            joint.mimic = Some(Mimic {
                leader: coupling.leader.clone(),
                at: coupling.leader_at.clone(),
                ratio: coupling.ratio,
                offset,
            });
        } else {
            let message = format!("no joint is called '{}'", coupling.follower);
            reading.found.error(&coupling.at, message, "no such joint", "");
        }
    }
}

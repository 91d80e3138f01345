//! Joints that follow another one: who leads whom, in the end.

use crate::assembly::AssemblyJoint;
use crate::figures::figures;
use crate::findings::Findings;
use std::collections::BTreeMap;
use wrasse_document::closest;
use wrasse_hardware::Follower;

/// The joints, each follower with a leader that has a drive of its own: who follows a follower follows
/// its leader, and who follows a joint that is fixed is fixed. Complains of leaders that are not there,
/// and of rings.
pub(crate) fn settle_followers(
    mut joints: Vec<AssemblyJoint>,
    found: &mut Findings,
) -> Vec<AssemblyJoint> {
    let by_name: BTreeMap<String, usize> =
        joints.iter().enumerate().rev().map(|(place, joint)| (joint.name.clone(), place)).collect();
    for follower in 0..joints.len() {
        if joints[follower].mimic.is_none() {
            continue;
        }
        match lead(follower, &joints, &by_name, found) {
            Some(Lead::Joint { leader, ratio, offset }) => {
                warn_of_travel(&joints[follower], &joints[leader], (ratio, offset), found);
                let name = joints[leader].name.clone();
                if let Some(mimic) = &mut joints[follower].mimic {
                    (mimic.leader, mimic.ratio, mimic.offset) = (name, ratio, offset);
                }
            }
            Some(Lead::Fixed(q)) => joints[follower].fixed_at(q),
            None => joints[follower].mimic = None,
        }
    }
    joints
}

/// What a joint follows in the end.
enum Lead {
    /// A joint with a drive: `q = ratio × q of it + offset`.
    Joint { leader: usize, ratio: f64, offset: f64 },
    /// Nothing that moves: it stands at this travel (rad or m).
    Fixed(f64),
}

/// Nothing after a complaint.
fn lead(
    follower: usize,
    joints: &[AssemblyJoint],
    by_name: &BTreeMap<String, usize>,
    found: &mut Findings,
) -> Option<Lead> {
    let (mut at, mut ratio, mut offset) = (follower, 1.0, 0.0);
    // A way that is longer than there are joints goes in a ring.
    for _ in 0..=joints.len() {
        let joint = &joints[at];
        if joint.kind.is_none() {
            return Some(Lead::Fixed(offset));
        }
        let Some(mimic) = &joint.mimic else {
            let moves = ratio != 0.0 && at != follower;
            let to_joint = Lead::Joint { leader: at, ratio, offset };
            return Some(if moves { to_joint } else { Lead::Fixed(offset) });
        };
        let Some(&next) = by_name.get(&mimic.leader) else {
            let message =
                format!("joint '{}' follows '{}', which is no joint", joint.name, mimic.leader);
            let help = match closest(&mimic.leader, by_name.keys().map(String::as_str)) {
                Some(close) => format!("did you mean '{close}'?"),
                None => "name a joint of this vehicle".into(),
            };
            // Told once, of the joint that names it.
            if at == follower {
                found.error(&mimic.at, message, "no such joint", &help);
            }
            return None;
        };
        // q = ratio × (m q' + o) + offset.
        offset += ratio * mimic.offset;
        ratio *= mimic.ratio;
        at = next;
    }
    let mimic_at = joints[follower].mimic.as_ref().map_or(0..0, |mimic| mimic.at.clone());
    let message =
        format!("joint '{}' follows itself, over others or at once", joints[follower].name);
    found.error(&mimic_at, message, "a ring", "one joint of the ring must have its own drive");
    None
}

/// Warns of a follower that its leader takes beyond its travel.
fn warn_of_travel(
    follower: &AssemblyJoint,
    leader: &AssemblyJoint,
    (ratio, offset): (f64, f64),
    found: &mut Findings,
) {
    let (Some((lower, upper)), Some((from, to))) = (follower.limits.travel, leader.limits.travel)
    else {
        return;
    };
    let ends = [ratio * from + offset, ratio * to + offset];
    let (least, most) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    // The limits of both are rounded.
    let slack = 1e-3 * (upper - lower).abs().max(most - least);
    let Some(mimic) = &follower.mimic else { return };
    if least < lower - slack || most > upper + slack {
        let message = format!(
            "joint '{}' follows '{}' from {} to {}, beyond its own travel from {} to {}",
            follower.name,
            leader.name,
            figures(least),
            figures(most),
            figures(lower),
            figures(upper)
        );
        found.warning(&mimic.at, message, "beyond its travel", "in rad or m");
    }
}

/// The followers among the moving joints of a robot, in its order.
pub(crate) fn followers(moving: &[&AssemblyJoint]) -> Vec<Follower<f64>> {
    let place = |name: &str| moving.iter().position(|joint| joint.name == name);
    let each = moving.iter().enumerate().filter_map(|(joint, of)| {
        let mimic = of.mimic.as_ref()?;
        let leader = place(&mimic.leader)?;
        Some(Follower { joint, leader, ratio: mimic.ratio, offset: mimic.offset })
    });
    each.collect()
}

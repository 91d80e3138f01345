//! Joints that follow another one: who leads whom, in the end.

use crate::assembly::AssemblyJoint;
use crate::figures::figures;
use crate::findings::Findings;
use std::collections::BTreeMap;
use wrasse_hardware::Follower;

/// The joints, each follower with a leader that has a drive of its own: who follows a follower follows
/// its leader, and who follows a joint that is fixed is fixed. Complains of leaders that are not there,
/// and of rings.
pub(crate) fn settle_followers(
    mut joints: Vec<AssemblyJoint>,
    found: &mut Findings,
) -> Vec<AssemblyJoint> {
    if joints.iter().all(|joint| joint.mimic.is_none()) {
        return joints;
    }
    for (follower, lead) in leads(&joints, found).into_iter().enumerate() {
        if joints[follower].mimic.is_none() {
            continue;
        }
        match lead {
            Lead::Joint { leader, ratio, offset } => {
                warn_of_travel(&joints[follower], &joints[leader], (ratio, offset), found);
                let name = joints[leader].name.clone();
                if let Some(mimic) = &mut joints[follower].mimic {
                    (mimic.leader, mimic.ratio, mimic.offset) = (name, ratio, offset);
                }
            }
            Lead::Fixed(q) => joints[follower].fixed_at(q),
            Lead::Nothing => joints[follower].mimic = None,
        }
    }
    joints
}

/// What a joint follows in the end.
#[derive(Debug, Clone, Copy)]
enum Lead {
    /// A joint with a drive, which may be itself: `q = ratio × q of it + offset`.
    Joint { leader: usize, ratio: f64, offset: f64 },
    /// Nothing that moves: it stands at this travel (rad or m).
    Fixed(f64),
    /// Nothing: there was a complaint.
    Nothing,
}

/// What each joint follows in the end. Every joint is looked at once, however long the chains are.
fn leads(joints: &[AssemblyJoint], found: &mut Findings) -> Vec<Lead> {
    let by_name: BTreeMap<&str, usize> =
        joints.iter().enumerate().rev().map(|(place, joint)| (&*joint.name, place)).collect();
    let mut settled: Vec<Option<Lead>> = vec![None; joints.len()];
    let mut asked_from: Vec<Option<usize>> = vec![None; joints.len()];
    for start in 0..joints.len() {
        // Up to a joint that is settled, then back.
        let (mut way, mut at) = (vec![], start);
        let mut lead = loop {
            if let Some(lead) = settled[at] {
                break lead;
            }
            if asked_from[at] == Some(start) {
                tell_of_ring(&joints[at], found);
                break Lead::Nothing;
            }
            asked_from[at] = Some(start);
            let lead = match next(&joints[at], &by_name, found) {
                Next::Leader(leader) => {
                    way.push(at);
                    at = leader;
                    continue;
                }
                Next::Drive => Lead::Joint { leader: at, ratio: 1.0, offset: 0.0 },
                Next::End(lead) => lead,
            };
            settled[at] = Some(lead);
            break lead;
        };
        while let Some(follower) = way.pop() {
            lead = followed(&joints[follower], lead);
            settled[follower] = Some(lead);
        }
    }
    settled.into_iter().map(|lead| lead.unwrap_or(Lead::Nothing)).collect()
}

/// Where the way from a follower to its leader goes on.
enum Next {
    Leader(usize),
    /// Nowhere: the joint moves by itself.
    Drive,
    /// Nowhere.
    End(Lead),
}

fn next(joint: &AssemblyJoint, by_name: &BTreeMap<&str, usize>, found: &mut Findings) -> Next {
    if joint.kind.is_none() {
        return Next::End(Lead::Fixed(0.0));
    }
    let Some(mimic) = &joint.mimic else { return Next::Drive };
    if let Some(&leader) = by_name.get(&*mimic.leader) {
        return Next::Leader(leader);
    }
    let message = format!("joint '{}' follows '{}', which is no joint", joint.name, mimic.leader);
    let help = match found.meant(&mimic.leader, by_name.keys().copied()) {
        Some(close) => format!("did you mean '{close}'?"),
        None => "name a joint of this vehicle".into(),
    };
    found.error(&mimic.at, message, "no such joint", &help);
    Next::End(Lead::Nothing)
}

/// Told once of each ring, and not of what follows a joint of it.
fn tell_of_ring(joint: &AssemblyJoint, found: &mut Findings) {
    let mimic_at = joint.mimic.as_ref().map_or(0..0, |mimic| mimic.at.clone());
    let message = format!("joint '{}' follows itself, over others or at once", joint.name);
    found.error(&mimic_at, message, "a ring", "one joint of the ring must have its own drive");
}

/// What a follower follows, from what its leader follows: q = m (ratio × q' + offset) + o.
fn followed(follower: &AssemblyJoint, lead: Lead) -> Lead {
    let Some(mimic) = &follower.mimic else { return lead };
    let moved = |offset: f64| mimic.ratio * offset + mimic.offset;
    match lead {
        Lead::Joint { leader, ratio, offset } if mimic.ratio * ratio != 0.0 => {
            Lead::Joint { leader, ratio: mimic.ratio * ratio, offset: moved(offset) }
        }
        // What is turned by nothing stands still.
        Lead::Joint { offset, .. } => Lead::Fixed(moved(offset)),
        Lead::Fixed(q) => Lead::Fixed(moved(q)),
        Lead::Nothing => Lead::Nothing,
    }
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

//! The tables `[[posture]]`: named positions of the joints.

use crate::assemble::AssembledRobot;
use crate::assembly::AssemblyJoint;
use crate::table::{Reading, SourceFile};
use crate::vehicle::Posture;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_document::{Step, at, closest};
use wrasse_dynamics::JointKind;
use wrasse_hardware::follow;

/// Named positions of the joints; a joint that is not named is at zero, or at the end of its travel that
/// is nearest to it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PostureFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// Positions of joints that turn, by name (deg).
    #[serde(default)]
    pub(crate) joints_deg: BTreeMap<String, f64>,
    /// Positions of joints that slide, by name (m).
    #[serde(default)]
    pub(crate) joints_m: BTreeMap<String, f64>,
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
}

/// Postures name joints that move, in the unit of their motion, within their travel.
pub(crate) fn check_postures(
    reading: &mut Reading<'_>,
    postures: &[PostureFile],
    joints: &[AssemblyJoint],
) {
    let moving = joints.iter().filter_map(|joint| {
        let leader = joint.mimic.as_ref().map(|mimic| &*mimic.leader);
        Some((&*joint.name, (joint.kind?, joint.limits.travel, leader)))
    });
    let moving: BTreeMap<_, _> = moving.collect();
    for (i, posture) in postures.iter().enumerate() {
        if let Some(first) = postures[..i].iter().position(|p| p.name == posture.name) {
            let [there, here] = [first, i].map(|i| reading.at(at!["posture", i, "name"]));
            let line = reading.found.line(there.start, &here);
            let message =
                format!("two postures are called '{}'; the other is on {line}", posture.name);
            let help = "give one of them another name";
            reading.error(at!["posture", i, "name"], message, "the second", help);
        }
        remark_on_ends(reading, i, posture, joints);
        for (key, kind, positions) in [
            ("joints_deg", JointKind::Revolute, &posture.joints_deg),
            ("joints_m", JointKind::Prismatic, &posture.joints_m),
        ] {
            for (name, position) in positions {
                let path = at!["posture", i, key, name];
                check_position(reading, path, kind, *position, &moving);
            }
        }
    }
}

/// Joints that a posture does not name, and that cannot be at zero.
fn remark_on_ends(
    reading: &mut Reading<'_>,
    i: usize,
    posture: &PostureFile,
    joints: &[AssemblyJoint],
) {
    let is_named = |name: &String| {
        posture.joints_deg.contains_key(name) || posture.joints_m.contains_key(name)
    };
    let own = joints.iter().filter(|joint| joint.mimic.is_none() && !is_named(&joint.name));
    let at_end = own.filter_map(|joint| {
        let nearest = joint.limits.nearest_to_zero();
        let (in_file, unit) = match joint.kind? {
            JointKind::Revolute => (nearest.to_degrees(), "deg"),
            JointKind::Prismatic => (nearest, "m"),
        };
        // Six decimals: what degrees lose on the way through radians is not shown.
        let shown = (in_file * 1e6).round() / 1e6;
        (nearest != 0.0).then(|| format!("'{}' at {shown} {unit}", joint.name))
    });
    let told: Vec<String> = at_end.collect();
    if told.is_empty() {
        return;
    }
    let message = format!(
        "zero is outside the travel of joints that posture '{}' does not name: it has them at the \
         nearest end, {}",
        posture.name,
        told.join(", ")
    );
    let help = "name them to have them elsewhere";
    reading.warning(at!["posture", i, "name"], message, "leaves joints out", help);
}

/// Joints that move, by name: how, from where to where (rad or m), and which joint they follow.
type Moving<'a> = BTreeMap<&'a str, (JointKind, Option<(f64, f64)>, Option<&'a str>)>;

fn check_position(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    kind: JointKind,
    position: f64,
    moving: &Moving<'_>,
) {
    let name = path.last().map(ToString::to_string).unwrap_or_default();
    let Some((moves, travel, leader)) = moving.get(name.as_str()) else {
        // A joint whose name is left out may be meant.
        if moving.contains_key("") {
            return;
        }
        let message = format!("no joint that moves is called '{name}'");
        let help = match closest(&name, moving.keys().copied()) {
            Some(meant) => format!("did you mean '{meant}'?"),
            None => format!(
                "joints that move: {}",
                moving.keys().copied().collect::<Vec<_>>().join(", ")
            ),
        };
        return reading.wrong_key(path, message, "no such joint", &help);
    };
    if let Some(leader) = leader {
        let message = format!("joint '{name}' follows '{leader}'");
        let help = format!("name '{leader}' in its place");
        return reading.wrong_key(path, message, "no drive of its own", &help);
    }
    if *moves != kind {
        let (does, write) = match moves {
            JointKind::Revolute => ("turns", "joints_deg"),
            JointKind::Prismatic => ("slides", "joints_m"),
        };
        let message = format!("joint '{name}' {does}");
        return reading.wrong_key(path, message, "wrong unit", &format!("write it in `{write}`"));
    }
    let (in_si, unit) = match kind {
        JointKind::Revolute => (position.to_radians(), "deg"),
        JointKind::Prismatic => (position, "m"),
    };
    // The ends of the travel are converted as the position is: equal stays equal.
    if let Some((lower, upper)) = travel.filter(|(lower, upper)| in_si < *lower || in_si > *upper) {
        let in_file = |end: f64| if kind == JointKind::Revolute { end.to_degrees() } else { end };
        let (lower, upper) = (in_file(lower), in_file(upper));
        let message = format!(
            "joint '{name}' is at {position} {unit}, beyond its travel from {lower} to {upper} {unit}"
        );
        reading.warning(path, message, "beyond its travel", "");
    }
}

/// The positions that a posture gives, by joint (rad or m).
pub(crate) fn given_posture(file: &PostureFile) -> (String, BTreeMap<String, f64>) {
    let turned = file.joints_deg.iter().map(|(joint, deg)| (joint.clone(), deg.to_radians()));
    let slid = file.joints_m.iter().map(|(joint, m)| (joint.clone(), *m));
    (file.name.clone(), turned.chain(slid).collect())
}

/// A posture in the order of the robot's joints: a joint that is not named is at zero, or at the end of
/// its travel that is nearest to it; one that follows another is where that one has it.
pub(crate) fn posture_of(
    (name, positions): &(String, BTreeMap<String, f64>),
    assembled: &AssembledRobot,
) -> Posture {
    let each = assembled.joint_names.iter().zip(&assembled.limits);
    let mut q: Vec<f64> = each
        .map(|(joint, limits)| positions.get(joint).copied().unwrap_or(limits.nearest_to_zero()))
        .collect();
    follow(&assembled.followers, &mut q);
    Posture { name: name.clone(), q }
}

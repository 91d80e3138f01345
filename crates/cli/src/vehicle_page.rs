//! What `wrasse vehicles NAME` shows of a vehicle: the facts, which are also its JSON, and their page.

use crate::vehicles::kind;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use wrasse_dynamics::{BodyId, JointKind};
use wrasse_vehicle::{Grade, Provenance, Vehicle};

/// A vehicle as a reader of its numbers wants it. Angles are in degrees, as in its file.
#[derive(Debug, Serialize)]
pub(crate) struct VehicleFacts<'v> {
    name: &'v str,
    kind: &'static str,
    summary: &'v str,
    /// Of all bodies, without propellant.
    mass_kg: f64,
    /// Of the base with all that is fixed to it.
    base_mass_kg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    propellant_kg: Option<f64>,
    joints: Vec<JointFacts<'v>>,
    tools: Vec<ToolFacts<'v>>,
    postures: Vec<PostureFacts<'v>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    attitude_actuator: Option<AttitudeFacts>,
    /// Wheels, CMGs and thrusters.
    #[serde(skip_serializing_if = "Option::is_none")]
    actuators: Option<&'v str>,
    /// Sources by grade: those that say the same are one.
    provenance: [GradeFacts<'v>; 3],
    not_public: &'v [String],
    /// Warnings and notes of the reading.
    remarks: Vec<&'v str>,
}

#[derive(Debug, Serialize)]
struct JointFacts<'v> {
    name: &'v str,
    /// `turns` or `slides`.
    motion: &'static str,
    /// deg or m.
    unit: &'static str,
    /// Lower and upper end; none if it has none.
    travel: Option<[f64; 2]>,
    /// deg/s or m/s.
    rate: Option<f64>,
    /// N·m or N.
    effort: Option<f64>,
}

#[derive(Debug, Serialize)]
struct ToolFacts<'v> {
    name: &'v str,
    /// The joint that moves it; none if it is fixed to the base.
    moved_by: Option<&'v str>,
}

#[derive(Debug, Serialize)]
struct PostureFacts<'v> {
    name: &'v str,
    /// Positions by joint (deg or m).
    joints: BTreeMap<&'v str, f64>,
}

#[derive(Debug, Serialize)]
struct AttitudeFacts {
    torque_limit_nm: f64,
    momentum_limit_nms: f64,
}

#[derive(Debug, Serialize)]
struct GradeFacts<'v> {
    grade: &'static str,
    sources: Vec<SourceFacts<'v>>,
}

#[derive(Debug, Serialize)]
struct SourceFacts<'v> {
    of: Vec<&'v str>,
    source: &'v str,
}

impl<'v> VehicleFacts<'v> {
    pub(crate) fn of(vehicle: &'v Vehicle) -> Self {
        let equipment = &vehicle.equipment;
        let rows: Vec<_> = vehicle.provenance.iter().chain(&equipment.provenance).collect();
        let joints: Vec<_> = vehicle.robot.joints().map(|j| joint(vehicle, j)).collect();
        let posture = |p: &'v wrasse_vehicle::Posture| PostureFacts {
            name: &p.name,
            joints: joints.iter().zip(&p.q).map(|(j, q)| (j.name, in_file(*q, j.unit))).collect(),
        };
        let postures = vehicle.postures.iter().map(posture).collect();
        Self {
            name: &vehicle.name,
            kind: kind(vehicle),
            summary: &vehicle.summary,
            mass_kg: vehicle.robot.mass(),
            base_mass_kg: vehicle.robot.inertia(BodyId::Base).mass,
            propellant_kg: equipment.actuators.tank.map(|tank| tank.propellant),
            tools: vehicle.tools.iter().map(|name| tool(vehicle, name)).collect(),
            postures,
            joints,
            attitude_actuator: vehicle.attitude_actuator.map(|ideal| AttitudeFacts {
                torque_limit_nm: ideal.torque_limit,
                momentum_limit_nms: ideal.momentum_limit,
            }),
            actuators: has_units(vehicle).then_some(equipment.name.as_str()),
            provenance: [
                (Grade::Published, "published"),
                (Grade::Derived, "derived"),
                (Grade::Assumed, "assumed"),
            ]
            .map(|(grade, word)| GradeFacts { grade: word, sources: sources(&rows, grade) }),
            not_public: &vehicle.not_public,
            remarks: vehicle.remarks.iter().map(|remark| remark.message.as_str()).collect(),
        }
    }
}

fn has_units(vehicle: &Vehicle) -> bool {
    let equipment = &vehicle.equipment;
    [&equipment.wheel_names, &equipment.cmg_names, &equipment.thruster_names]
        .iter()
        .any(|names| !names.is_empty())
}

/// Degrees of a joint that turns; twelve digits, which are those of a file that says degrees.
fn in_file(position: f64, unit: &str) -> f64 {
    let value = if unit == "deg" { position.to_degrees() } else { position };
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn joint(vehicle: &Vehicle, j: usize) -> JointFacts<'_> {
    let (motion, unit) = match vehicle.robot.joint(j).kind {
        JointKind::Revolute => ("turns", "deg"),
        JointKind::Prismatic => ("slides", "m"),
    };
    let limits = vehicle.limits[j];
    JointFacts {
        name: &vehicle.joint_names[j],
        motion,
        unit,
        travel: limits.travel.map(|(a, b)| [a, b].map(|end| in_file(end, unit))),
        rate: limits.rate.map(|rate| in_file(rate, unit)),
        effort: limits.effort,
    }
}

fn tool<'v>(vehicle: &'v Vehicle, name: &'v str) -> ToolFacts<'v> {
    let moved_by = match vehicle.frame(name).map(|frame| frame.body) {
        Some(BodyId::Link(j)) => vehicle.joint_names.get(j).map(String::as_str),
        _ => None,
    };
    ToolFacts { name, moved_by }
}

/// The sources of a grade in the order of the file, each once with all that it is about.
fn sources<'v>(rows: &[&'v Provenance], grade: Grade) -> Vec<SourceFacts<'v>> {
    let mut all: Vec<SourceFacts<'v>> = vec![];
    for row in rows.iter().filter(|row| row.grade == grade) {
        match all.iter_mut().find(|known| known.source == row.source) {
            Some(known) => known.of.push(&row.of),
            None => all.push(SourceFacts { of: vec![&row.of], source: &row.source }),
        }
    }
    all
}

/// Columns of a terminal.
const WIDTH: usize = 80;

/// The page of a vehicle, for a terminal of 80 columns.
pub(crate) fn page(facts: &VehicleFacts<'_>) -> String {
    let mut page = format!("{}: {}\n", facts.name, facts.kind);
    page += &wrapped(facts.summary, 2, WIDTH);
    page += "\n\n";
    page += &masses(facts);
    page += &joints(&facts.joints);
    let tools = facts.tools.iter().map(|tool| match tool.moved_by {
        Some(joint) => format!("{}, moved by {joint}", tool.name),
        None => format!("{}, fixed to the base", tool.name),
    });
    page += &section("tools", tools);
    page += &section("postures", facts.postures.iter().map(|p| p.name.to_owned()));
    page += &section("attitude and position", attitude(facts).into_iter());
    for GradeFacts { grade, sources } in &facts.provenance {
        let told = sources.iter().map(|s| format!("{}: {}", s.of.join(", "), s.source));
        page += &section(grade, told);
    }
    page += &section("not public", facts.not_public.iter().cloned());
    page += &section("remarks of the reading", facts.remarks.iter().map(ToString::to_string));
    page
}

fn masses(facts: &VehicleFacts<'_>) -> String {
    let mut told = format!("mass: {} kg", rounded(facts.mass_kg));
    if !facts.joints.is_empty() {
        let _ = write!(told, ", {} kg of it the base", rounded(facts.base_mass_kg));
    }
    if let Some(propellant) = facts.propellant_kg {
        let _ = write!(told, "; {} kg of propellant on top", rounded(propellant));
    }
    told + "\n"
}

fn attitude(facts: &VehicleFacts<'_>) -> Vec<String> {
    let ideal = facts.attitude_actuator.as_ref().map(|ideal| {
        let AttitudeFacts { torque_limit_nm, momentum_limit_nms } = ideal;
        format!("ideal: {torque_limit_nm} N·m and {momentum_limit_nms} N·m·s about each axis")
    });
    facts.actuators.map(str::to_owned).into_iter().chain(ideal).collect()
}

/// A table of the joints; nothing if there are none.
fn joints(joints: &[JointFacts<'_>]) -> String {
    if joints.is_empty() {
        return String::new();
    }
    let width = joints.iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0).max(6);
    let mut table =
        format!("\n{:width$}  {:>18}  {:>12}  {:>12}\n", "joints", "travel", "rate", "effort");
    for joint in joints {
        let unit = joint.unit;
        let travel = joint.travel.map_or("no end".into(), |[lower, upper]| {
            format!("{} to {} {unit}", rounded(lower), rounded(upper))
        });
        let of_effort = if unit == "deg" { "N·m" } else { "N" };
        let limit = |value: Option<f64>, unit: &str| {
            value.map_or("-".into(), |value| format!("{} {unit}", rounded(value)))
        };
        let (rate, effort) =
            (limit(joint.rate, &format!("{unit}/s")), limit(joint.effort, of_effort));
        let _ = writeln!(table, "{:width$}  {travel:>18}  {rate:>12}  {effort:>12}", joint.name);
    }
    table
}

/// A head and its items, each wrapped with its first line hanging out; nothing without items.
fn section(head: &str, items: impl Iterator<Item = String>) -> String {
    let told: Vec<_> =
        items.map(|item| format!("  {}\n", wrapped(&item, 4, WIDTH).trim_start())).collect();
    if told.is_empty() { String::new() } else { format!("\n{head}\n{}", told.concat()) }
}

/// A number to a thousandth.
fn rounded(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

/// A text in lines of at most `width` characters, each indented; a word that is longer stays whole.
pub(crate) fn wrapped(text: &str, indent: usize, width: usize) -> String {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{:indent$}{word}", "")),
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn lines_are_wrapped_between_words_and_keep_to_the_width() {
        assert_eq!(wrapped("a bc def", 2, 6), "  a bc\n  def");
        assert_eq!(wrapped("N·m N·m", 0, 7), "N·m N·m");
        assert_eq!(wrapped("unbreakable", 1, 5), " unbreakable");
    }
}

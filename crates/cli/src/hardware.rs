//! `wrasse hardware`: the catalogue of wheels, CMGs, thrusters and sensors.

use crate::YES;
use crate::input::{Failure, say};
use clap::Args;
use std::process::ExitCode;
use wrasse_document::closest;
use wrasse_vehicle::{Grade, HardwareEntry, Provenance, hardware};

/// List the wheels, CMGs, thrusters and sensors that come with wrasse.
///
/// A vehicle or mission file takes one by its name, and says where it is bolted on:
///
///   [[actuators.wheel]]
///   name = "wheel-x"
///   model = "honeywell-hr16-100"
///   axis = [1, 0, 0]
///
/// A number that stands beside `model` replaces that of the catalogue.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment, after_help = "Example:\n  wrasse hardware honeywell-hr16-100")]
pub(crate) struct Hardware {
    /// Show all numbers of one of them, and where each comes from.
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

impl Hardware {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let all = hardware();
        match &self.name {
            None => list(&all),
            Some(name) => match all.iter().find(|entry| entry.name == *name) {
                Some(entry) => show(entry),
                None => return Err(Failure::Sentence(no_such(name, &all))),
            },
        }
        Ok(YES)
    }
}

/// What to say to a name that nothing has.
fn no_such(name: &str, all: &[HardwareEntry]) -> String {
    let names = || all.iter().map(|entry| entry.name.as_str());
    let begun: Vec<&str> = names().filter(|known| known.starts_with(name)).collect();
    let help = match closest(name, names()) {
        Some(near) => format!("did you mean {near:?}?"),
        None if name.is_empty() || begun.is_empty() => {
            "`wrasse hardware` lists what there is".to_owned()
        }
        None => format!("did you mean one of {}?", begun.join(", ")),
    };
    format!("no hardware is called {name:?}: {help}")
}

/// One table for each kind; what is not published at first hand is marked.
fn list(all: &[HardwareEntry]) {
    let width = all.iter().map(|entry| entry.name.len()).max().unwrap_or(0);
    let mut kind = "";
    for entry in all {
        let columns = columns(entry.kind);
        if entry.kind != kind {
            if !kind.is_empty() {
                say("");
            }
            kind = entry.kind;
            let heads: Vec<_> = columns.iter().map(|(_, head)| format!("{head:>12}")).collect();
            say(&format!("{kind:width$}  {}", heads.join("")));
        }
        let cells: Vec<_> =
            columns.iter().map(|(key, _)| format!("{:>12}", cell(entry, key))).collect();
        say(&format!("{:width$}  {}  {}", entry.name, cells.join(""), entry.summary));
    }
    say("\n* assumed or derived: `wrasse hardware NAME` says how\n\
         ~ published, but second-hand or not verified against the data sheet");
}

/// The numbers that tell units of a kind apart: key and head.
fn columns(kind: &str) -> &'static [(&'static str, &'static str)] {
    match kind {
        "reaction wheel" | "control moment gyro" => &[
            ("torque_limit_nm", "N·m"),
            ("momentum_nms", "N·m·s"),
            ("mass_kg", "kg"),
            ("power_w", "W"),
        ],
        "thruster" => &[
            ("force_n", "N"),
            ("specific_impulse_s", "Isp s"),
            ("minimum_on_time_s", "on s"),
            ("mass_kg", "kg"),
        ],
        "rate gyro" => &[
            ("angle_random_walk_deg_sqrt_h", "deg/√h"),
            ("bias_random_walk_deg_h_sqrt_h", "deg/h/√h"),
            ("rate_step_deg_s", "step deg/s"),
        ],
        _ => &[
            ("noise_across_arcsec", "across \""),
            ("noise_about_arcsec", "about \""),
            ("rate_hz", "Hz"),
            ("rate_limit_deg_s", "to deg/s"),
        ],
    }
}

/// A number of a unit, with its mark; a dash if it has none.
fn cell(entry: &HardwareEntry, key: &str) -> String {
    match number(entry, key) {
        Some(number) => format!("{number}{}", mark(entry, key)),
        None => derived_momentum(entry, key).map_or("-".into(), |momentum| format!("{momentum}*")),
    }
}

fn number(entry: &HardwareEntry, key: &str) -> Option<f64> {
    entry.numbers.iter().find(|(known, _)| *known == key).map(|(_, number)| *number)
}

/// Momentum of a wheel that gives its inertia and speed instead (N·m·s), to three digits.
fn derived_momentum(entry: &HardwareEntry, key: &str) -> Option<f64> {
    if key != "momentum_nms" || number(entry, key).is_some() {
        return None;
    }
    let inertia = number(entry, "inertia_kgm2")?;
    let speed = number(entry, "speed_limit_rpm")? * std::f64::consts::TAU / 60.0;
    format!("{:.2e}", inertia * speed).parse().ok()
}

/// What is not published is marked, and what is published at second hand.
fn mark(entry: &HardwareEntry, key: &str) -> char {
    let second_hand = |source: &str| {
        ["second-hand", "second hand", "not verified"].iter().any(|word| source.contains(word))
    };
    match source(entry, key) {
        Some(row) if row.grade == Grade::Published && second_hand(&row.source) => '~',
        Some(row) if row.grade == Grade::Published => ' ',
        _ => '*',
    }
}

/// Where a number of a unit comes from: its own source, or that of the unit.
fn source<'a>(entry: &'a HardwareEntry, key: &str) -> Option<&'a Provenance> {
    let of = format!("model.{}.{key}", entry.name);
    entry.provenance.iter().find(|row| row.of == of).or(entry.provenance.first())
}

/// All numbers of a unit, and their sources.
fn show(entry: &HardwareEntry) {
    say(&format!("{}: {}, {}\n", entry.name, entry.kind, entry.summary));
    let width = entry.numbers.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
    for (key, number) in &entry.numbers {
        say(&format!("{key:width$} = {number}"));
    }
    if let Some(momentum) = derived_momentum(entry, "momentum_nms") {
        say(&format!("momentum: {momentum} N·m·s, derived: inertia times largest speed"));
    }
    say("");
    for row in &entry.provenance {
        let word = match row.grade {
            Grade::Published => "published",
            Grade::Derived => "derived",
            Grade::Assumed => "assumed",
        };
        let of = row.of.strip_prefix(&format!("model.{}.", entry.name)).unwrap_or("all else");
        say(&format!("{of}: {word}: {}", row.source));
    }
}

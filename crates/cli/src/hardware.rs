//! `wrasse hardware`: the catalogue of wheels, gyros, thrusters and sensors.

use crate::input::{say, tell};
use crate::{YES, bad};
use clap::Args;
use std::process::ExitCode;
use wrasse_vehicle::{Grade, HardwareEntry, hardware};

/// List the wheels, gyros, thrusters and sensors that come with wrasse.
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
#[command(verbatim_doc_comment)]
pub(crate) struct Hardware {
    /// Show all numbers of one of them, and where each comes from.
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

impl Hardware {
    pub(crate) fn go(&self) -> ExitCode {
        let all = hardware();
        let Some(name) = &self.name else {
            list(&all);
            return YES;
        };
        let Some(entry) = all.iter().find(|entry| entry.name == *name) else {
            tell(&format!(
                "error: no hardware is called {name:?}: `wrasse hardware` lists what there is"
            ));
            return bad();
        };
        show(entry);
        YES
    }
}

/// One table for each kind; what is not published is marked.
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
    say("\n* assumed or derived: `wrasse hardware NAME` says how");
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

/// A number of a unit, marked if it is not published; a dash if it has none.
fn cell(entry: &HardwareEntry, key: &str) -> String {
    let Some((_, number)) = entry.numbers.iter().find(|(known, _)| *known == key) else {
        return "-".into();
    };
    let mark = if grade(entry, key) == Some(Grade::Published) { " " } else { "*" };
    format!("{number}{mark}")
}

/// How sure a number of a unit is: its own source, or that of the unit.
fn grade(entry: &HardwareEntry, key: &str) -> Option<Grade> {
    let of = format!("model.{}.{key}", entry.name);
    let own = entry.provenance.iter().find(|row| row.of == of);
    own.or(entry.provenance.first()).map(|row| row.grade)
}

/// All numbers of a unit, and their sources.
fn show(entry: &HardwareEntry) {
    say(&format!("{}: {}, {}\n", entry.name, entry.kind, entry.summary));
    let width = entry.numbers.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
    for (key, number) in &entry.numbers {
        say(&format!("{key:width$} = {number}"));
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

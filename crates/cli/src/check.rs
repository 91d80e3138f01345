//! `wrasse check`: everything that is wrong with a file, and everything worth a second look.

use crate::check_json::{file_json, unreadable_json};
use crate::deep_report::{deep_check, deep_report};
use crate::input::{Failure, STDIN, complain, file_of, say, say_json, tell};
use crate::settings::Settings;
use crate::{YES, bad};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_document::{Complaint, Document, Source, visible};
use wrasse_mission::mission_of;
use wrasse_rehearsal::{Case, sampled_loops};
use wrasse_study::study_complaints;
use wrasse_vehicle::{Vehicle, read_vehicle};

/// Check vehicle and mission files: every complaint at once, with its place.
///
/// A TOML file with a `vehicle` key or phases is a mission, any other a vehicle; .urdf, .mjcf and
/// .xml are vehicles. Lists of hardware and of sets of actuators are told from these, and read as
/// TOML only.
/// `--deep` takes a second look at vehicles: units, inertia against shape and size, density, left
/// against right, the mass matrix, a coast. What it finds does not change the exit code.
/// Exit code 0: usable (warnings may be printed); 2: not usable.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  wrasse check my-servicer.toml reach.toml\n  wrasse new vehicle | wrasse check -\n  wrasse check arm.urdf --deep --json"
)]
pub(crate) struct Check {
    /// The files; `-` is standard input.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Look also for what is possible and hardly ever so; of vehicles only.
    #[arg(long)]
    deep: bool,
    /// Print one JSON object for each file, on a line of its own.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: Settings,
}

impl Check {
    pub(crate) fn go(&self) -> ExitCode {
        if self.files.iter().filter(|file| *file == Path::new(STDIN)).count() > 1 {
            tell("error: standard input can be read once: `-` is given more than once");
            return bad();
        }
        let mut all_usable = true;
        for file in &self.files {
            all_usable &= self.check(file);
        }
        if all_usable { YES } else { bad() }
    }

    /// Tells what is found of a file; whether it can be used.
    fn check(&self, file: &Path) -> bool {
        let (file, text) = match file_of(file) {
            Ok(read) => read,
            Err(Failure::Sentence(message)) if self.json => {
                say_json(&unreadable_json(file, &message));
                return false;
            }
            Err(failure) => {
                failure.tell();
                return false;
            }
        };
        let found = self.findings(&file, text);
        let deep = found.vehicle.as_ref().filter(|_| self.deep).map(|vehicle| deep_check(vehicle));
        let (complaints, what) = (&found.complaints, found.what.as_deref());
        if self.json {
            say_json(&file_json(&file, complaints, what, deep.as_ref()));
            return what.is_some();
        }
        if !complaints.is_empty() {
            complain(complaints);
        }
        if let Some(what) = what {
            say(&format!("{}: {what}", visible(&file.to_string_lossy())));
        }
        match deep {
            Some(deep) => say(&deep_report(&deep)),
            None if self.deep && what.is_some() => say("deep check: only of vehicle files"),
            None => {}
        }
        what.is_some()
    }

    /// What is found of a file.
    fn findings(&self, file: &Path, text: String) -> Found {
        if is_mission(file, &text) {
            let document = Document::parse(file, text).and_then(|read| self.settings.over(read));
            return document.map_or_else(Found::faulty, |document| of_mission(&document));
        }
        if !self.settings.is_empty() {
            let message = "a value can be set of a mission only, and this is none";
            return Found::faulty(vec![Complaint::error(&Source::new(file, text), message)]);
        }
        of_other(file, text)
    }
}

/// What is found of a file.
struct Found {
    complaints: Vec<Complaint>,
    /// What it is, if it can be used.
    what: Option<String>,
    /// The vehicle that it is, if it is one.
    vehicle: Option<Box<Vehicle>>,
}

impl Found {
    /// Of a file that cannot be used.
    fn faulty(complaints: Vec<Complaint>) -> Self {
        Self { complaints, what: None, vehicle: None }
    }
    /// Of a file that can be used and is no vehicle.
    fn usable(complaints: Vec<Complaint>, what: String) -> Self {
        Self { complaints, what: Some(what), vehicle: None }
    }
}

fn of_mission(document: &Document) -> Found {
    let of_study = study_complaints(document);
    match mission_of(document) {
        Ok(mission) if of_study.is_empty() => {
            let loops = sampled_loops(&mission.cases[0]);
            let loops: Vec<_> = loops.iter().map(|l| format!("\n  {}", l.text())).collect();
            let loops = loops.concat();
            let what = format!("a mission of {} case(s)", mission.cases.len());
            let tool = guided_tool(&mission.cases[0]);
            Found::usable(mission.remarks, format!("{what}{tool}; closed once a period:{loops}"))
        }
        Ok(mission) => Found::faulty([of_study, mission.remarks].concat()),
        Err(complaints) => Found::faulty([complaints, of_study].concat()),
    }
}

/// The tool that phases without their own guide, and whence it is.
fn guided_tool(case: &Case) -> String {
    let of_tool = case.as_flown.iter().find(|s| s.key == "control.tool" && s.value != "none");
    of_tool.map_or(String::new(), |s| format!("; guided tool {} ({})", visible(&s.value), s.origin))
}

/// The same of a list of hardware or of sets, or of a vehicle.
fn of_other(file: &Path, text: String) -> Found {
    if let Some(what) = list(file, &text) {
        return match Document::parse(file, text) {
            Ok(_) => Found::usable(vec![], what),
            Err(complaints) => Found::faulty(complaints),
        };
    }
    match read_vehicle(file, text) {
        Ok(vehicle) => {
            let joints = vehicle.robot.joint_count();
            let mass = vehicle.robot.mass();
            let name = visible(&vehicle.name);
            let what = format!("vehicle {name}, {joints} moving joints, {mass:.2} kg");
            let complaints = vehicle.remarks.clone();
            Found { complaints, what: Some(what), vehicle: Some(Box::new(vehicle)) }
        }
        Err(complaints) => Found::faulty(complaints),
    }
}

/// What a file is that has neither a name nor a body at its top level: tables of models, or sets of
/// actuators; nothing for any other file.
fn list(file: &Path, text: &str) -> Option<String> {
    const MODELS: [&str; 5] =
        ["[[wheel]]", "[[cmg]]", "[[thruster]]", "[[rate_gyro]]", "[[star_tracker]]"];
    let lines =
        || text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    if !is_toml(file) || !lines().next()?.starts_with('[') {
        return None;
    }
    let models = lines().filter(|line| MODELS.contains(line)).count();
    let rows = lines().filter(|line| *line == "[[compare.row]]").count();
    if models > 0 && lines().filter(|line| line.starts_with('[')).all(|line| MODELS.contains(&line))
    {
        return Some(format!(
            "a list of {models} model(s) of hardware, read as TOML only: files name models of the \
             program's own lists (`wrasse hardware`)"
        ));
    }
    (rows > 0 && lines().any(|line| line == "[study]")).then(|| {
        format!(
            "a study's list of {rows} set(s) without a vehicle or phases, read as TOML only: \
             `wrasse size MISSION` weighs a mission against such sets"
        )
    })
}

fn is_toml(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}

/// A mission names its vehicle, at the top level of a TOML file.
fn is_mission(file: &Path, text: &str) -> bool {
    let top = text.lines().map(str::trim_start).take_while(|line| !line.starts_with('['));
    let names_vehicle = |line: &str| {
        line.strip_prefix("vehicle").is_some_and(|rest| rest.trim_start().starts_with('='))
    };
    is_toml(file) && (top.into_iter().any(names_vehicle) || text.contains("\n[[phase]]"))
}

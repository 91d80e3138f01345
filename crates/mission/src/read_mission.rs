//! A mission file to a checked mission, with all complaints at once.

use crate::format::{MissionFile, PhaseFile};
use crate::mission::{Case, Mission};
use crate::quantity::quantities;
use crate::read_payload::payloads;
use crate::read_phase::phase;
use crate::read_setup::{base_attitude, setup, start, stepper, torque_joints};
use crate::requirement::Requirement;
use std::path::PathBuf;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Severity, Step, at, closest, schema_of};
use wrasse_dynamics::JointKind;
use wrasse_flight::PHASES;
use wrasse_vehicle::{NoVehicle, Vehicle, find_vehicle};

/// The JSON Schema of mission files, for editors.
pub fn mission_schema() -> serde_json::Value {
    schema_of::<MissionFile>()
}

/// A reader's view of one case: the document, what it found wrong, the vehicle.
pub(crate) struct Reading<'a> {
    pub(crate) document: &'a Document,
    pub(crate) complaints: Vec<Complaint>,
    pub(crate) vehicle: &'a Vehicle,
}

impl Reading<'_> {
    /// Note an error at a path.
    pub(crate) fn error(&mut self, path: &[Step<'_>], message: String, help: &str) {
        let complaint = self.document.error(path, message, "here");
        self.complaints.push(if help.is_empty() { complaint } else { complaint.with_help(help) });
    }
    /// The place of a name in a list; an error with a suggestion if it is not there.
    pub(crate) fn find(
        &mut self,
        path: &[Step<'_>],
        what: &str,
        name: &str,
        among: &[String],
    ) -> Option<usize> {
        let found = among.iter().position(|n| n == name);
        if found.is_none() {
            let help = match closest(name, among.iter().map(String::as_str)) {
                Some(close) => format!("did you mean {close:?}?"),
                None if among.is_empty() => format!("there is no {what} at all"),
                None => format!("one of {}", among.join(", ")),
            };
            self.error(path, format!("there is no {what} called {name:?}"), &help);
        }
        found
    }
    /// A number that must be above zero.
    pub(crate) fn positive(&mut self, path: &[Step<'_>], x: f64) -> f64 {
        if x > 0.0 {
            return x;
        }
        self.error(path, format!("must be above zero, found {x}"), "");
        1.0
    }
    /// A number that must not be below zero.
    pub(crate) fn not_negative(&mut self, path: &[Step<'_>], x: f64) -> f64 {
        if x >= 0.0 {
            return x;
        }
        self.error(path, format!("must not be below zero, found {x}"), "");
        0.0
    }
}

/// Most cases that one mission may compare.
const CASES: usize = 1000;

/// The mission that a file describes. Vehicles given as a file are seen from its folder.
///
/// # Errors
/// All complaints at once.
pub fn read_mission(
    path: impl Into<PathBuf>,
    text: impl Into<String>,
) -> Result<Mission, Vec<Complaint>> {
    let document = Document::parse(path, text)?;
    let file: MissionFile = document.read()?;
    let mut complaints = vec![];
    let mut cases = vec![];
    let combinations = combinations(&file, &document, &mut complaints);
    for rows in &combinations {
        let mut varied = document.clone();
        for (axis, &row) in rows.iter().enumerate() {
            varied = varied.overlaid(at!["compare", axis, "row", row, "set"], &[]);
        }
        let labels = rows.iter().enumerate().map(|(axis, &row)| {
            (file.compare[axis].axis.clone(), file.compare[axis].row[row].name.clone())
        });
        match read_case(&varied, labels.collect()) {
            Ok(case) => cases.push(case),
            Err(found) => complaints.extend(found),
        }
    }
    if complaints.iter().any(|c| c.severity == Severity::Error) {
        // What is wrong with the common part is wrong in every case: say it once.
        let mut once: Vec<Complaint> = vec![];
        for complaint in complaints {
            if !once.contains(&complaint) {
                once.push(complaint);
            }
        }
        return Err(once);
    }
    let source = document.source();
    Ok(Mission {
        name: file.name,
        summary: file.summary,
        file: source.path.display().to_string(),
        text: source.text.clone(),
        seed: file.seed,
        cases,
    })
}

/// Every combination of one row from each axis, the last axis fastest.
fn combinations(
    file: &MissionFile,
    document: &Document,
    complaints: &mut Vec<Complaint>,
) -> Vec<Vec<usize>> {
    let fits = file.name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
    if file.name.is_empty() || !fits {
        let message = format!("the name becomes a folder: found {:?}", file.name);
        let help = "use letters, digits, dashes and underscores";
        complaints.push(document.error(at!["name"], message, "here").with_help(help));
    }
    let mut all = vec![vec![]];
    for (i, axis) in file.compare.iter().enumerate() {
        if axis.row.is_empty() {
            complaints.push(document.error(at!["compare", i], "an axis without rows", "here"));
        }
        let rows = 0..axis.row.len();
        all = all
            .into_iter()
            .flat_map(|before: Vec<usize>| {
                rows.clone().map(move |row| [before.clone(), vec![row]].concat())
            })
            .collect();
        if all.len() > CASES {
            let message = format!("{} cases, at most {CASES} can be compared", all.len());
            complaints.push(document.error(at!["compare", i], message, "here"));
            return vec![];
        }
    }
    all
}

fn read_case(document: &Document, labels: Vec<(String, String)>) -> Result<Case, Vec<Complaint>> {
    let file: MissionFile = document.read()?;
    let vehicle = vehicle_of(&file, document)?;
    let mut reading = Reading { document, complaints: vec![], vehicle: &vehicle };
    let r = &mut reading;
    let (setup, start) = (setup(r, &file), start(r, &file));
    let payloads = payloads(r, &file, &start);
    let base = base_attitude(r, &file, &start);
    let names: Vec<String> = file.phase.iter().map(|p| p.name.clone()).collect();
    check_phase_list(r, &file.phase);
    let payload_names: Vec<String> = payloads.iter().map(|p| p.name.clone()).collect();
    let phases = file.phase.iter().enumerate();
    let phases = phases.filter_map(|(i, p)| phase(r, i, p, &payload_names, &file)).collect();
    let joints: Vec<(String, bool)> = vehicle
        .joint_names
        .iter()
        .enumerate()
        .map(|(j, name)| (name.clone(), vehicle.robot.joint(j).kind == JointKind::Revolute))
        .collect();
    let quantities = quantities(&joints);
    let mut requirements = vec![];
    for (i, text) in file.requirements.iter().enumerate() {
        match Requirement::parse(text, &quantities, &names) {
            Ok(requirement) => requirements.push(requirement),
            Err(bad) => r.complaints.push(complaint_within(document, i, bad)),
        }
    }
    let torque = torque_joints(r, &file);
    let output_rate = r.positive(at!["output", "rate_hz"], file.output.rate_hz);
    let stepper = stepper(r, &file);
    let complaints = reading.complaints;
    if complaints.iter().any(|c| c.severity == Severity::Error) {
        return Err(complaints);
    }
    Ok(Case {
        labels,
        vehicle_name: file.vehicle.clone(),
        vehicle: Arc::new(vehicle),
        start,
        payloads,
        base,
        stepper,
        torque,
        setup,
        phases,
        requirements,
        quantities,
        output_rate,
        snapshots: file.output.snapshots.clamp(2, 40),
    })
}

fn vehicle_of(file: &MissionFile, document: &Document) -> Result<Vehicle, Vec<Complaint>> {
    let folder = document.source().path.parent();
    find_vehicle(&file.vehicle, folder).map_err(|none| match none {
        NoVehicle::NotFound { message, help } => {
            vec![document.error(at!["vehicle"], message, "this vehicle").with_help(help)]
        }
        NoVehicle::Faulty(complaints) => complaints,
        _ => vec![document.error(at!["vehicle"], "this vehicle cannot be read", "here")],
    })
}

fn check_phase_list(r: &mut Reading<'_>, phases: &[PhaseFile]) {
    if phases.is_empty() {
        r.error(at!["phase"], "a mission without phases".into(), "add a [[phase]]");
    }
    if phases.len() > PHASES {
        let message = format!("{} phases, at most {PHASES} fit", phases.len());
        r.error(at!["phase", PHASES], message, "");
    }
    for (i, phase) in phases.iter().enumerate() {
        if phases[..i].iter().any(|p| p.name == phase.name) {
            let message = format!("a second phase called {:?}", phase.name);
            r.error(at!["phase", i, "name"], message, "phases are told apart by their names");
        }
    }
}

/// A complaint about a part of a requirement's text.
fn complaint_within(
    document: &Document,
    i: usize,
    bad: crate::requirement::BadRequirement,
) -> Complaint {
    let whole = document.error(at!["requirements", i], bad.message, "here").with_help(bad.help);
    // Inside the quotes, if the text stands there as it is.
    let Some(span) = whole.span.clone() else { return whole };
    let text = &whole.source.text;
    let inside = span.start + 1 + bad.at.start..span.start + 1 + bad.at.end;
    let fits = inside.end < span.end
        && text.is_char_boundary(inside.start)
        && text.is_char_boundary(inside.end)
        && !bad.at.is_empty();
    if fits { whole.at(inside, "here") } else { whole }
}

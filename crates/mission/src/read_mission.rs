//! A mission file to a checked mission, with all complaints at once.

use crate::as_flown::as_flown;
use crate::dispersible::Nominal;
use crate::folder_name::wrong_with_folder_name;
use crate::format::MissionFile;
use crate::mission::{Case, Mission, PayloadCase, PhaseCase, Study};
use crate::phase_format::PhaseFile;
use crate::quantity::Quantity;
use crate::read_base::{
    Turning, applied_wrenches, base_control, doubt_idle_units, equipment, failures, navigation,
    sensors, turning,
};
use crate::read_dispersions::dispersions;
use crate::read_payload::payloads;
use crate::read_phase::phase;
use crate::read_setup::{base_attitude, setup, start, stepper, torque_joints};
use crate::reading::Reading;
use crate::requirement::Requirement;
use crate::sampled_loops::check_loops;
use crate::sampling::{Sampling, check_sampling};
use crate::signals::quantities;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Severity, Step, at, schema_of};
use wrasse_dynamics::JointKind;
use wrasse_flight::PHASES;
use wrasse_vehicle::{CatalogueEntry, NoVehicle, Vehicle, find_vehicle};

/// The JSON Schema of mission files, for editors.
pub fn mission_schema() -> serde_json::Value {
    schema_of::<MissionFile>()
}

/// Fewest and most instants in a drawing.
const SNAPSHOTS: (f64, f64) = (2.0, 40.0);

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
    mission_of(&Document::parse(path, text)?)
}

/// The same of a document: apart from what is generic, so that the callers do not compile it again.
fn mission_of(document: &Document) -> Result<Mission, Vec<Complaint>> {
    let part = document.read_in_part::<MissionFile>();
    let Some(file) = part.value else { return Err(part.complaints) };
    let mut complaints = vec![];
    let mut cases = vec![];
    let combinations = combinations(&file, &part.document, &mut complaints);
    for rows in &combinations {
        let mut varied = part.document.clone();
        for &(axis, row) in rows {
            varied = varied.overlaid(at!["compare", axis, "row", row, "set"], &[]);
        }
        let labels = rows.iter().map(|&(axis, row)| {
            (file.compare[axis].axis.clone(), file.compare[axis].row[row].name.clone())
        });
        match read_case(&varied, labels.collect()) {
            Ok((case, doubts)) => {
                cases.push(case);
                complaints.extend(doubts);
            }
            Err(found) => complaints.extend(found),
        }
    }
    // What is wrong with the common part is wrong in every case: say it once.
    let mut said = BTreeSet::new();
    let mut once = document.beside(part.complaints, complaints);
    once.retain(|c| {
        let place = c.span.as_ref().map(|span| (span.start, span.end));
        said.insert((c.source.path.clone(), place, c.message.clone(), c.help.clone()))
    });
    if once.iter().any(|c| c.severity == Severity::Error) {
        return Err(once);
    }
    let source = document.source();
    Ok(Mission {
        name: file.name,
        summary: file.summary,
        file: source.path.display().to_string(),
        text: source.text.clone(),
        seed: file.seed,
        study: file.study.as_ref().map(Study::of),
        remarks: once,
        cases,
    })
}

/// Every combination of one row from each axis, the last axis fastest: pairs of axis and row.
fn combinations(
    file: &MissionFile,
    document: &Document,
    complaints: &mut Vec<Complaint>,
) -> Vec<Vec<(usize, usize)>> {
    if let Some((problem, help)) = wrong_with_folder_name(&file.name) {
        let message = format!("the name becomes a folder: {problem}");
        complaints.push(document.error(at!["name"], message, "here").with_help(help));
    }
    let mut all = vec![vec![]];
    for (i, axis) in file.compare.iter().enumerate() {
        check_axis(file, i, document, complaints);
        if axis.row.is_empty() {
            continue;
        }
        let rows = 0..axis.row.len();
        all = all
            .into_iter()
            .flat_map(|before: Vec<(usize, usize)>| {
                rows.clone().map(move |row| [before.clone(), vec![(i, row)]].concat())
            })
            .collect();
        if all.len() > CASES {
            let message = format!("{} cases, at most {CASES} can be compared", all.len());
            let help = "split the comparison over several missions";
            complaints.push(document.error(at!["compare", i], message, "here").with_help(help));
            return vec![];
        }
    }
    all
}

/// An axis has rows, and names tell axes and rows apart.
fn check_axis(file: &MissionFile, i: usize, document: &Document, complaints: &mut Vec<Complaint>) {
    let axis = &file.compare[i];
    let mut error = |path: &[Step<'_>], message: String, help: &str| {
        complaints.push(document.error(path, message, "here").with_help(help));
    };
    if axis.row.is_empty() {
        let message = format!("axis {:?} has no rows: nothing is compared", axis.axis);
        error(at!["compare", i], message, "add a [[compare.row]] for each variant");
    }
    if file.compare[..i].iter().any(|other| other.axis == axis.axis) {
        let message = format!("a second axis called {:?}", axis.axis);
        error(at!["compare", i, "axis"], message, "axes are told apart by their names");
    }
    for (k, row) in axis.row.iter().enumerate() {
        if axis.row[..k].iter().any(|other| other.name == row.name) {
            let message = format!("a second row called {:?}", row.name);
            error(
                at!["compare", i, "row", k, "name"],
                message,
                "rows are told apart by their names",
            );
        }
    }
}

/// A case, and what is worth a second look in it.
fn read_case(
    document: &Document,
    labels: Vec<(String, String)>,
) -> Result<(Case, Vec<Complaint>), Vec<Complaint>> {
    let file: MissionFile = document.read()?;
    let (vehicle, complaints) = vehicle_of(&file, document)?;
    let mut reading = Reading { document, complaints, vehicle: &vehicle, knows_actuators: true };
    let r = &mut reading;
    let start = start(r, &file);
    let equipment = equipment(r, &file);
    let turning = turning(r, &file, &equipment);
    doubt_idle_units(r, &file, turning, &equipment);
    let (fitted_sensors, sensors) = sensors(r, &file);
    let fitted = (turning == Turning::Fitted).then_some(&equipment);
    let (base_control, navigation) =
        (base_control(r, &file, turning, fitted), navigation(r, &file, sensors.as_ref()));
    let mut setup = setup(r, &file, &base_control, &navigation);
    let (failures, wrenches) = (failures(r, &file, &equipment), applied_wrenches(r, &file));
    let payloads = payloads(r, &file, &start);
    let base = base_attitude(r, &file, &start);
    let phases = phases(r, &file, &payloads);
    let (quantities, requirements) = requirements(r, &file);
    let torque = torque_joints(r, &file);
    setup.position_driven = torque.map(|torque| !torque);
    let output_rate = output_rate(r, &file);
    let stepper = stepper(r, &file);
    let (modulation, period) =
        (base_control.actuation.allocation().map(|s| s.modulation), setup.tuning.period);
    let sampling = Sampling { equipment: &equipment, base, turning, stepper, period, modulation };
    check_sampling(r, &file, &sampling);
    let nominal = Nominal::of(&vehicle, (&start, base), &payloads, &fitted_sensors);
    let dispersions = dispersions(r, &file.disperse, &nominal);
    let complaints = reading.complaints;
    let case = Case {
        labels,
        vehicle_name: file.vehicle.clone(),
        vehicle: Arc::new(vehicle),
        start,
        payloads,
        base,
        turning,
        equipment,
        sensors,
        measures_wrench: file.control.measure_tool_wrench,
        failures,
        wrenches,
        seed: file.seed,
        stepper,
        torque,
        setup,
        phases,
        dispersions,
        believed: None,
        requirements,
        quantities,
        output_rate,
        snapshots: file.output.snapshots,
        as_flown: vec![],
    };
    checked_as_a_whole(document, &file, case, complaints)
}

/// What is only known of a whole case: its loops against their rate, and what is flown in the end.
fn checked_as_a_whole(
    document: &Document,
    file: &MissionFile,
    mut case: Case,
    mut complaints: Vec<Complaint>,
) -> Result<(Case, Vec<Complaint>), Vec<Complaint>> {
    let is_faulty = |all: &[Complaint]| all.iter().any(|c| c.severity == Severity::Error);
    // Where a number had to be made up, what follows from it is not said.
    if !is_faulty(&complaints) {
        complaints.extend(check_loops(document, &case));
    }
    if is_faulty(&complaints) {
        return Err(complaints);
    }
    case.as_flown = as_flown(document, file, &case);
    Ok((case, complaints))
}

/// Samples per second in the telemetry.
fn output_rate(r: &mut Reading<'_>, file: &MissionFile) -> f64 {
    let why = "the first and the last instant are always drawn, and more do not fit in a picture";
    let count = f64::from(file.output.snapshots);
    r.within(at!["output", "snapshots"], count, SNAPSHOTS, why);
    r.positive(at!["output", "rate_hz"], file.output.rate_hz)
}

/// The quantities that are watched, and what is required of them.
fn requirements(r: &mut Reading<'_>, file: &MissionFile) -> (Vec<Quantity>, Vec<Requirement>) {
    let vehicle = r.vehicle;
    let phases: Vec<String> = file.phase.iter().map(|p| p.name.clone()).collect();
    let joints: Vec<(String, bool)> = vehicle
        .joint_names
        .iter()
        .enumerate()
        .map(|(j, name)| (name.clone(), vehicle.robot.joint(j).kind == JointKind::Revolute))
        .collect();
    let quantities = quantities(&joints);
    let mut requirements = vec![];
    for (i, text) in file.requirements.iter().enumerate() {
        match Requirement::parse(text, &quantities, &phases) {
            Ok(requirement) => requirements.push(requirement),
            Err(bad) => r.complaints.push(complaint_within(r.document, i, text, bad)),
        }
    }
    (quantities, requirements)
}

/// The vehicle, or the one that is meant, with a complaint: the rest is checked with it.
fn vehicle_of(
    file: &MissionFile,
    document: &Document,
) -> Result<(Vehicle, Vec<Complaint>), Vec<Complaint>> {
    let folder = document.source().path.parent();
    match find_vehicle(&file.vehicle, folder) {
        Ok(vehicle) => Ok((vehicle, vec![])),
        Err(NoVehicle::NotFound { message, help, meant }) => {
            let said =
                vec![document.error(at!["vehicle"], message, "this vehicle").with_help(help)];
            match meant.map(CatalogueEntry::read) {
                Some(Ok(vehicle)) => Ok((vehicle, said)),
                _ => Err(said),
            }
        }
        Err(NoVehicle::Faulty(complaints)) => Err(complaints),
        Err(_) => Err(vec![document.error(at!["vehicle"], "this vehicle cannot be read", "here")]),
    }
}

/// What happens, one after the other.
fn phases(r: &mut Reading<'_>, file: &MissionFile, payloads: &[PayloadCase]) -> Vec<PhaseCase> {
    check_phase_list(r, &file.phase);
    let names: Vec<String> = payloads.iter().map(|p| p.name.clone()).collect();
    let phases = file.phase.iter().enumerate();
    phases.filter_map(|(i, p)| phase(r, i, p, &names, file)).collect()
}

fn check_phase_list(r: &mut Reading<'_>, phases: &[PhaseFile]) {
    if phases.is_empty() {
        r.error(at!["phase"], "a mission without phases".into(), "add a [[phase]]");
    }
    if phases.len() > PHASES {
        let message = format!("{} phases, at most {PHASES} fit", phases.len());
        r.error(at!["phase", PHASES], message, "split the mission in two");
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
    requirement: &str,
    bad: crate::requirement::BadRequirement,
) -> Complaint {
    let whole = document.error(at!["requirements", i], bad.message, "here").with_help(bad.help);
    // Inside the quotes, if the text stands there as it is.
    let Some(span) = whole.span.clone() else { return whole };
    let text = &whole.source.text;
    let first = span.start + 1;
    let as_it_is = text.get(first..first + requirement.len()) == Some(requirement);
    let inside = first + bad.at.start..first + bad.at.end;
    if as_it_is && !bad.at.is_empty() { whole.at(inside, "here") } else { whole }
}

//! A mission file to a checked mission, with all complaints at once.

use crate::as_flown::as_flown;
use crate::check_loops::check_loops;
use crate::dispersible::Nominal;
use crate::fingerprint::WORDS;
use crate::mission::{Mission, Study};
use crate::reading::Reading;
use crate::replaced_settings::replaced_settings;
use crate::sampling::{Sampling, check_sampling};
use crate::toml::MissionFile;
use crate::toml::actuators::{actuation, doubt_idle_units, equipment};
use crate::toml::applied_wrench::applied_wrenches;
use crate::toml::base_control::base_control;
use crate::toml::compare::combinations;
use crate::toml::control::setup;
use crate::toml::disperse::dispersions;
use crate::toml::estimation::navigation;
use crate::toml::failure::failures;
use crate::toml::initial::start;
use crate::toml::output::output_rate;
use crate::toml::payload::payloads;
use crate::toml::phase::{phases, refuse_paths_over_gears};
use crate::toml::requirement::requirements;
use crate::toml::sensors::sensors;
use crate::toml::world::{base_attitude, environment, stepper, torque_joints};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Severity, at, schema_of};
use wrasse_rehearsal::{AttitudeActuation, Case};
use wrasse_vehicle::{CatalogueEntry, NoVehicle, Vehicle, find_vehicle};

/// The JSON Schema of mission files, for editors.
pub fn mission_schema() -> serde_json::Value {
    schema_of::<MissionFile>()
}

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

/// The mission that a document describes: that of a file, or one that something was laid over.
///
/// # Errors
/// All complaints at once.
pub fn mission_of(document: &Document) -> Result<Mission, Vec<Complaint>> {
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
    complaints.extend(replaced_settings(document));
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
        settings: document.settings(),
        canonical: document.canonical(&WORDS),
        seed: file.seed,
        study: file.study.as_ref().map(Study::of),
        remarks: once,
        cases,
    })
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
    let actuation = actuation(r, &file, &equipment);
    doubt_idle_units(r, &file, actuation, &equipment);
    let (fitted_sensors, sensors) = sensors(r, &file);
    let fitted = (actuation == AttitudeActuation::Fitted).then_some(&equipment);
    let (base_control, navigation) =
        (base_control(r, &file, actuation, fitted), navigation(r, &file, sensors.as_ref()));
    let mut setup = setup(r, &file, &base_control, &navigation);
    let (failures, wrenches) = (failures(r, &file, &equipment), applied_wrenches(r, &file));
    let payloads = payloads(r, &file, &start);
    let base = base_attitude(r, &file, &start);
    let environment = environment(r, &file);
    let phases = phases(r, &file, &payloads);
    refuse_paths_over_gears(r, &phases, &setup.assignment);
    let (quantities, requirements) = requirements(r, &file);
    let torque = torque_joints(r, &file);
    setup.position_driven = torque.map(|torque| !torque);
    let output_rate = output_rate(r, &file);
    let stepper = stepper(r, &file);
    let (modulation, period) =
        (base_control.actuation.allocation().map(|s| s.modulation), setup.tuning.period);
    let sampling = Sampling { equipment: &equipment, base, actuation, stepper, period, modulation };
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
        actuation,
        equipment,
        sensors,
        measures_wrench: file.control.measure_tool_wrench,
        failures,
        environment,
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

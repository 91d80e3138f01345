//! A study: a mission file whose cases are tasks and sets of actuators.

use crate::own_units::without_own_units;
use crate::sets::{Catalogue, SetRow, as_fitted, fed, of_catalogue, shipped, with_sets};
use crate::study_table::study_complaints;
use std::path::PathBuf;
use toml::Table;
use wrasse_document::{Complaint, Document, at};
use wrasse_mission::{Mission, mission_of};

/// A mission file, checked, with its cases told apart by task and set.
#[derive(Debug)]
pub struct Study {
    pub(crate) mission: Mission,
    /// Names of the sets, in the order of the file.
    pub(crate) sets: Vec<String>,
    /// Number of the reference among them.
    pub(crate) reference: usize,
    pub(crate) tasks: Vec<Task>,
    /// Sets that this vehicle cannot be flown with, and why.
    pub(crate) left_out: Vec<(String, String)>,
}

/// A task, and its case with each set.
#[derive(Debug, Clone)]
pub(crate) struct Task {
    /// (axis, row) of all axes but that of the sets.
    pub(crate) labels: Vec<(String, String)>,
    /// Whether it is flown with every set.
    pub(crate) closed_loop: bool,
    /// Number of the case with each set.
    pub(crate) cases: Vec<usize>,
}

/// The study that a file describes: a mission with a table `[study]`, or any mission, which is weighed
/// with its own units and with the sets of `studies/sets.toml`.
///
/// # Errors
/// All complaints at once.
pub fn read_study(path: impl Into<PathBuf>, text: &str) -> Result<Study, Vec<Complaint>> {
    study_in(&Document::parse(path, text)?, &[])
}

/// The same of a document: that of a file, or one that something was laid over. A mission without its own
/// sets is weighed against all units of these kinds, if there are any.
///
/// # Errors
/// All complaints at once.
pub fn study_in(document: &Document, catalogue: &[Catalogue]) -> Result<Study, Vec<Complaint>> {
    let wrong = study_complaints(document);
    let mission = match mission_of(document) {
        Ok(mission) if wrong.is_empty() => mission,
        Ok(_) => return Err(wrong),
        Err(found) => return Err([found, wrong].concat()),
    };
    if mission.study.is_none() {
        return laid_over(document, &mission, catalogue);
    }
    if !catalogue.is_empty() {
        let message = "the study brings its own sets".to_owned();
        let help = "leave out --catalogue, or the table [study] and the axis of its sets";
        return Err(vec![document.error(at!["study"], message, "here").with_help(help)]);
    }
    Ok(beside_own_units(mission, document))
}

/// A mission with sets that it does not bring itself. Those that its vehicle cannot be flown with are
/// left out.
fn laid_over(
    document: &Document,
    mission: &Mission,
    catalogue: &[Catalogue],
) -> Result<Study, Vec<Complaint>> {
    let (plain, own) = without_own_units(document);
    let (reference, mut sets) = shipped();
    if !catalogue.is_empty() {
        let of_kind = |kind: &Catalogue| of_catalogue(*kind, &mission.cases[0].vehicle);
        sets = catalogue.iter().flat_map(of_kind).collect();
    }
    let mut sets = fed(sets, mission.cases[0].equipment.actuators.tank);
    sets.insert(0, as_fitted(mission, 0, &own));
    // What is wrong with the reference is wrong with the mission.
    mission_of(&with_sets(&plain, &[&reference]))?;
    let all: Vec<&SetRow> = core::iter::once(&reference).chain(&sets).collect();
    if let Ok(whole) = mission_of(&with_sets(&plain, &all)) {
        return Ok(study_of(whole));
    }
    let (mut kept, mut left_out) = (vec![&reference], vec![]);
    for set in &sets {
        match mission_of(&with_sets(&plain, &[&reference, set])) {
            Ok(_) => kept.push(set),
            Err(found) => left_out.push((set.name.clone(), reason(&found))),
        }
    }
    Ok(Study { left_out, ..study_of(mission_of(&with_sets(&plain, &kept))?) })
}

/// The first of what is complained of, in a line.
fn reason(found: &[Complaint]) -> String {
    found.first().map_or(String::new(), |complaint| complaint.message.clone())
}

/// A study with its own sets, and with the vehicle's own units if none of them are these.
fn beside_own_units(mission: Mission, document: &Document) -> Study {
    let Some(row) = own_units_missing(&mission) else { return study_of(mission) };
    let Some(more) = with_row(document, &mission, &row) else { return study_of(mission) };
    match mission_of(&more) {
        Ok(more) => study_of(more),
        Err(found) => {
            let left_out = vec![(row.name, reason(&found))];
            Study { left_out, ..study_of(mission) }
        }
    }
}

/// The units of the vehicle as a set, where it has some and no set of the study is these.
fn own_units_missing(mission: &Mission) -> Option<SetRow> {
    let table = mission.study.as_ref()?;
    let is_reference = |case: &usize| {
        mission.cases[*case].labels.contains(&(table.sets.clone(), table.reference.clone()))
    };
    let cases = || 0..mission.cases.len();
    let reference = cases().find(is_reference)?;
    let own = &mission.cases[reference].equipment.actuators;
    let mut others = cases().filter(|case| !is_reference(case));
    let missing =
        !own.is_empty() && others.all(|case| mission.cases[case].equipment.actuators != *own);
    missing.then(|| as_fitted(mission, reference, &Table::new()))
}

/// A study with one more set.
fn with_row(document: &Document, mission: &Mission, row: &SetRow) -> Option<Document> {
    let sets = &mission.study.as_ref()?.sets;
    let named =
        |i: &usize| document.value(at!["compare", *i, "axis"]) == Some(sets.as_str().into());
    let axis = (0..document.len(at!["compare"])).find(named)?;
    let rows = document.len(at!["compare", axis, "row"]);
    Some(document.with(at!["compare", axis, "row", rows], &row.value()))
}

/// The cases of a mission told apart by task and set.
fn study_of(mission: Mission) -> Study {
    let table = mission.study.clone().expect("whoever calls has seen it");
    let labels_of = |case: usize| mission.cases[case].labels.iter();
    let mut sets: Vec<String> = vec![];
    let mut tasks: Vec<Task> = vec![];
    for case in 0..mission.cases.len() {
        let set = labels_of(case).find(|(axis, _)| *axis == table.sets).map(|(_, row)| row.clone());
        let set = set.unwrap_or_default();
        if !sets.contains(&set) {
            sets.push(set);
        }
        let labels: Vec<_> =
            labels_of(case).filter(|(axis, _)| *axis != table.sets).cloned().collect();
        if let Some(task) = tasks.iter_mut().find(|task| task.labels == labels) {
            task.cases.push(case);
            continue;
        }
        // A file that names no axis of tasks has one task, which is flown with every set.
        let row = labels.iter().find(|(axis, _)| Some(axis) == table.tasks.as_ref());
        let closed_loop = row.is_none_or(|(_, row)| table.closed_loop.contains(row));
        tasks.push(Task { labels, closed_loop, cases: vec![case] });
    }
    let reference = sets.iter().position(|set| *set == table.reference).unwrap_or(0);
    Study { mission, sets, reference, tasks, left_out: vec![] }
}

impl Study {
    /// Name of the study: results go to `out/NAME`.
    pub fn name(&self) -> &str {
        &self.mission.name
    }
    /// The mission, with what was laid over it.
    pub fn mission(&self) -> &Mission {
        &self.mission
    }
    /// Number of cases that are flown.
    pub fn flights(&self) -> usize {
        self.cases().len()
    }
    /// Numbers of the cases that are flown, task by task: with the reference, then with the other sets
    /// if the task is flown in closed loop.
    pub(crate) fn cases(&self) -> Vec<usize> {
        let mut cases = vec![];
        for task in &self.tasks {
            cases.push(task.cases[self.reference]);
            if task.closed_loop {
                let others = (0..task.cases.len()).filter(|k| *k != self.reference);
                cases.extend(others.map(|k| task.cases[k]));
            }
        }
        cases
    }
}

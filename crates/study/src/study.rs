//! A study: a mission file whose cases are tasks and sets of actuators.

use crate::hand_check::TaskFile;
use crate::own_units::without_own_units;
use crate::sets::{Catalogue, SetRow, as_fitted, fed, of_catalogue, shipped, with_sets};
use crate::study_table::{Axes, complaints};
use std::path::{Path, PathBuf};
use toml::{Table, Value};
use wrasse_document::{Complaint, Document, at};
use wrasse_mission::{Mission, read_mission};

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
    /// What the file says of it that a hand can reckon with.
    pub(crate) file: TaskFile,
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
    read_study_with(path, text, &[])
}

/// The same, but that a mission without its own sets is weighed against all units of these kinds.
///
/// # Errors
/// All complaints at once.
pub fn read_study_with(
    path: impl Into<PathBuf>,
    text: &str,
    catalogue: &[Catalogue],
) -> Result<Study, Vec<Complaint>> {
    read_at(&path.into(), text, catalogue)
}

/// The same, apart from what is generic, so that the callers do not compile it again.
fn read_at(path: &Path, text: &str, catalogue: &[Catalogue]) -> Result<Study, Vec<Complaint>> {
    let document = Document::parse(path, text)?;
    let wrong = complaints(&document);
    let mission = match read_mission(path, text) {
        Ok(mission) if wrong.is_empty() => mission,
        Ok(_) => return Err(wrong),
        Err(found) => return Err([found, wrong].concat()),
    };
    if mission.study.is_none() {
        return laid_over(path, text, &mission, catalogue);
    }
    if !catalogue.is_empty() {
        let message = "the study brings its own sets".to_owned();
        let help = "leave out --catalogue, or the table [study] and the axis of its sets";
        return Err(vec![document.error(at!["study"], message, "here").with_help(help)]);
    }
    beside_own_units(path, text, mission, &document)
}

/// A mission with sets that it does not bring itself. Those that its vehicle cannot be flown with are
/// left out.
fn laid_over(
    path: &Path,
    text: &str,
    mission: &Mission,
    catalogue: &[Catalogue],
) -> Result<Study, Vec<Complaint>> {
    let (plain, own) = without_own_units(text);
    let (reference, mut sets) = shipped();
    if !catalogue.is_empty() {
        let of_kind = |kind: &Catalogue| of_catalogue(*kind, &mission.cases[0].vehicle);
        sets = catalogue.iter().flat_map(of_kind).collect();
    }
    let mut sets = fed(sets, mission.cases[0].equipment.actuators.tank);
    sets.insert(0, as_fitted(mission, 0, &own));
    // What is wrong with the reference is wrong with the mission.
    read_mission(path, with_sets(&plain, &[&reference]))?;
    let all: Vec<&SetRow> = core::iter::once(&reference).chain(&sets).collect();
    let mut whole = with_sets(&plain, &all);
    let mut read = read_mission(path, whole.as_str());
    let mut left_out = vec![];
    if read.is_err() {
        let mut is_flown =
            |set: &SetRow| match read_mission(path, with_sets(&plain, &[&reference, set])) {
                Ok(_) => true,
                Err(found) => {
                    left_out.push((set.name.clone(), reason(&found)));
                    false
                }
            };
        let mut kept = vec![&reference];
        kept.extend(sets.iter().filter(|set| is_flown(set)));
        whole = with_sets(&plain, &kept);
        read = read_mission(path, whole.as_str());
    }
    let mut mission = read?;
    text.clone_into(&mut mission.text);
    let document = Document::parse(path, whole)?;
    Ok(Study { left_out, ..study_of(mission, &document) })
}

/// The first of what is complained of, in a line.
fn reason(found: &[Complaint]) -> String {
    found.first().map_or(String::new(), |complaint| complaint.message.clone())
}

/// A study with its own sets, and with the vehicle's own units if none of them are these.
fn beside_own_units(
    path: &Path,
    text: &str,
    mission: Mission,
    document: &Document,
) -> Result<Study, Vec<Complaint>> {
    let Some(row) = own_units_missing(&mission) else { return Ok(study_of(mission, document)) };
    let Some(whole) = with_row(text, &mission, &row) else {
        return Ok(study_of(mission, document));
    };
    match read_mission(path, whole.as_str()) {
        Ok(mut more) => {
            text.clone_into(&mut more.text);
            Ok(study_of(more, &Document::parse(path, whole)?))
        }
        Err(found) => {
            let left_out = vec![(row.name, reason(&found))];
            Ok(Study { left_out, ..study_of(mission, document) })
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

/// The text of a study with one more set.
fn with_row(text: &str, mission: &Mission, row: &SetRow) -> Option<String> {
    let sets = &mission.study.as_ref()?.sets;
    let mut file = text.parse::<Table>().ok()?;
    let axes = file.get_mut("compare")?.as_array_mut()?;
    let named = |axis: &&mut Value| axis.get("axis").and_then(Value::as_str) == Some(sets);
    axes.iter_mut().find(named)?.get_mut("row")?.as_array_mut()?.push(row.value());
    Some(file.to_string())
}

/// The cases of a mission told apart by task and set.
fn study_of(mission: Mission, document: &Document) -> Study {
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
        let file = task_file(document, &labels);
        tasks.push(Task { labels, file, closed_loop, cases: vec![case] });
    }
    let reference = sets.iter().position(|set| *set == table.reference).unwrap_or(0);
    Study { mission, sets, reference, tasks, left_out: vec![] }
}

/// The document with the rows of a task laid over it, as far as a hand reads it.
fn task_file(document: &Document, labels: &[(String, String)]) -> TaskFile {
    let mut varied = document.clone();
    let axes = document.read_in_part::<Axes>().value.unwrap_or_default();
    for (i, axis) in axes.compare.iter().enumerate() {
        let chosen = labels.iter().find(|(name, _)| *name == axis.axis);
        let place = chosen.and_then(|(_, row)| axis.row.iter().position(|r| r.name == *row));
        if let Some(k) = place {
            varied = varied.overlaid(at!["compare", i, "row", k, "set"], &[]);
        }
    }
    // The mission has been checked: what this does not know is not wrong.
    varied.read_in_part().value.unwrap_or_default()
}

impl Study {
    /// Name of the study: results go to `out/NAME`.
    pub fn name(&self) -> &str {
        &self.mission.name
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

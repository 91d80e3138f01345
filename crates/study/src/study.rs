//! A study: a mission file whose cases are tasks and sets of actuators.

use crate::hand_check::TaskFile;
use crate::own_units::without_own_units;
use std::path::PathBuf;
use wrasse_document::{Complaint, Document, Step, at, closest};
use wrasse_mission::{Mission, read_mission};

/// The sets that a mission without its own is weighed against.
const SETS: &str = include_str!("../../../studies/sets.toml");

/// A mission file, checked, with its cases told apart by task and set.
#[derive(Debug)]
pub struct Study {
    pub(crate) mission: Mission,
    /// Names of the sets, in the order of the file.
    pub(crate) sets: Vec<String>,
    /// Number of the reference among them.
    pub(crate) reference: usize,
    pub(crate) tasks: Vec<Task>,
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

/// The study that a file describes: a mission with a table `[study]`, or any mission, which gets the
/// sets of `studies/sets.toml`.
///
/// # Errors
/// All complaints at once.
pub fn read_study(path: impl Into<PathBuf>, text: &str) -> Result<Study, Vec<Complaint>> {
    let path = path.into();
    let mut mission = read_mission(path.clone(), text)?;
    let mut whole = text.to_owned();
    if mission.study.is_none() {
        whole = format!("{}\n{SETS}", without_own_units(text));
        mission = read_mission(path.clone(), whole.as_str())?;
        text.clone_into(&mut mission.text);
    }
    let document = Document::parse(path, whole)?;
    let Some(table) = mission.study.clone() else {
        let message = "a mission without a table [study]".to_owned();
        return Err(vec![document.error(&[], message, "here")]);
    };
    let axes = document.read_in_part::<Axes>().value.unwrap_or_default();
    let complaints = complaints(&table, &axes, &document);
    if complaints.is_empty() { Ok(study_of(mission, &table, &document)) } else { Err(complaints) }
}

/// What the table names must be there.
fn complaints(table: &wrasse_mission::Study, axes: &Axes, document: &Document) -> Vec<Complaint> {
    let mut complaints = vec![];
    let rows_of = |name: &str| axes.compare.iter().find(|a| a.axis == name).map(|a| &a.row);
    let names: Vec<&str> = axes.compare.iter().map(|a| a.axis.as_str()).collect();
    let mut missing = |path: &[Step<'_>], what: &str, name: &str, there: &[&str]| {
        let message = format!("there is no {what} {name:?}");
        let help = match closest(name, there.iter().copied()) {
            Some(near) => format!("did you mean {near:?}?"),
            None => format!("there are: {}", there.join(", ")),
        };
        complaints.push(document.error(path, message, "not there").with_help(help));
    };
    let all = |rows: &[Row]| rows.iter().map(|row| row.name.clone()).collect::<Vec<_>>();
    match rows_of(&table.sets).map(|rows| all(rows)) {
        None => missing(at!["study", "sets"], "compared axis", &table.sets, &names),
        Some(rows) if !rows.contains(&table.reference) => {
            let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
            missing(at!["study", "reference"], "set", &table.reference, &rows);
        }
        Some(_) => {}
    }
    let tasks = table.tasks.as_ref().map(|name| (name, rows_of(name).map(|rows| all(rows))));
    match tasks {
        Some((name, None)) => missing(at!["study", "tasks"], "compared axis", name, &names),
        Some((_, Some(rows))) => {
            let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
            for (i, task) in table.closed_loop.iter().enumerate() {
                if !rows.contains(&task.as_str()) {
                    missing(at!["study", "closed_loop", i], "task", task, &rows);
                }
            }
        }
        None => {}
    }
    complaints
}

fn study_of(mission: Mission, table: &wrasse_mission::Study, document: &Document) -> Study {
    let labels_of = |case: usize| mission.case_labels(case).iter();
    let mut sets: Vec<String> = vec![];
    let mut tasks: Vec<Task> = vec![];
    for case in 0..mission.case_count() {
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
    Study { mission, sets, reference, tasks }
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

/// The axes of a file, as far as their names go.
#[derive(Debug, Default, serde::Deserialize, schemars::JsonSchema)]
struct Axes {
    #[serde(default)]
    compare: Vec<Axis>,
}

#[derive(Debug, serde::Deserialize, schemars::JsonSchema)]
struct Axis {
    axis: String,
    row: Vec<Row>,
}

#[derive(Debug, serde::Deserialize, schemars::JsonSchema)]
struct Row {
    name: String,
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

//! What the table `[study]` of a mission file says, held against the axes of the file.

use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Complaint, Document, Step, at, closest};

/// The axes of a file, as far as their names go, and its table `[study]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
struct Axes {
    #[serde(default)]
    study: Option<TableFile>,
    #[serde(default)]
    compare: Vec<Axis>,
}

/// The table, as far as it can be read.
#[derive(Debug, Default, Deserialize, JsonSchema)]
struct TableFile {
    #[serde(default)]
    tasks: Option<String>,
    #[serde(default)]
    sets: Option<String>,
    #[serde(default)]
    reference: Option<String>,
    #[serde(default)]
    closed_loop: Vec<String>,
    #[serde(default)]
    mass_limit_kg: Option<f64>,
    #[serde(default)]
    power_limit_w: Option<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct Axis {
    axis: String,
    #[serde(default)]
    row: Vec<Row>,
}

#[derive(Debug, Deserialize, JsonSchema)]
struct Row {
    name: String,
}

/// Complaints about the table `[study]` of a document, if it has one: what it names must be there. What
/// is misshapen, whoever reads the mission complains of.
pub fn study_complaints(document: &Document) -> Vec<Complaint> {
    let Some(axes) = document.read_in_part::<Axes>().value else { return vec![] };
    let Some(table) = &axes.study else { return vec![] };
    let mut found = Found { document, axes: &axes, complaints: vec![] };
    found.sets(table);
    found.tasks(table);
    found.limit("mass_limit_kg", table.mass_limit_kg);
    found.limit("power_limit_w", table.power_limit_w);
    found.complaints
}

struct Found<'a> {
    document: &'a Document,
    axes: &'a Axes,
    complaints: Vec<Complaint>,
}

impl Found<'_> {
    fn error(&mut self, path: &[Step<'_>], message: String, label: &str, help: &str) {
        self.complaints.push(self.document.error(path, message, label).with_help(help));
    }

    fn rows(&self, axis: &str) -> Option<Vec<String>> {
        let found = self.axes.compare.iter().find(|a| a.axis == axis)?;
        Some(found.row.iter().map(|row| row.name.clone()).collect())
    }

    /// Complains of a name that is not there.
    fn missing(&mut self, path: &[Step<'_>], what: &str, name: &str, there: &[String]) {
        let help = match closest(name, there.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near:?}?"),
            None if there.is_empty() => "add it as [[compare]]".into(),
            None => format!("there are: {}", there.join(", ")),
        };
        self.error(path, format!("there is no {what} {name:?}"), "not there", &help);
    }

    fn names(&self) -> Vec<String> {
        self.axes.compare.iter().map(|axis| axis.axis.clone()).collect()
    }

    fn sets(&mut self, table: &TableFile) {
        let Some(sets) = &table.sets else { return };
        match self.rows(sets) {
            None => self.missing(at!["study", "sets"], "compared axis", sets, &self.names()),
            Some(rows) => {
                if let Some(name) = table.reference.as_ref().filter(|name| !rows.contains(name)) {
                    self.missing(at!["study", "reference"], "set", name, &rows);
                }
            }
        }
    }

    fn tasks(&mut self, table: &TableFile) {
        let Some(tasks) = &table.tasks else {
            if !table.closed_loop.is_empty() {
                let message = "tasks to be flown are named, and no axis of tasks is".into();
                let help = "name the compared axis in study.tasks; a mission that is the one task is \
                            always flown";
                self.error(at!["study", "closed_loop"], message, "of which axis?", help);
            }
            return;
        };
        if table.sets.as_ref() == Some(tasks) {
            let message = format!("axis {tasks:?} is that of the sets and of the tasks");
            let help = "a task is flown with every set: they are two axes";
            self.error(at!["study", "tasks"], message, "the same axis", help);
            return;
        }
        let Some(rows) = self.rows(tasks) else {
            self.missing(at!["study", "tasks"], "compared axis", tasks, &self.names());
            return;
        };
        for (i, task) in table.closed_loop.iter().enumerate() {
            if !rows.contains(task) {
                self.missing(at!["study", "closed_loop", i], "task", task, &rows);
            }
        }
    }

    fn limit(&mut self, key: &str, limit: Option<f64>) {
        let Some(found) = limit.filter(|x| !(x.is_finite() && *x > 0.0)) else { return };
        let message = format!("{key} must be positive and finite, found {found}");
        self.error(
            &[Step::Key("study"), Step::Key(key)],
            message,
            "this limit",
            "leave it out for none",
        );
    }
}

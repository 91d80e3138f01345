//! `[[compare]]`: variants, every combination of one row from each axis.

use crate::folder_name::wrong_with_folder_name;
use crate::toml::MissionFile;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_document::{Complaint, Document, Step, at};

/// One axis of a comparison.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisFile {
    /// What varies: the heading of its column.
    pub(crate) axis: String,
    /// The variants.
    pub(crate) row: Vec<RowFile>,
}

/// One variant.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RowFile {
    /// Its name in tables.
    pub(crate) name: String,
    /// A part of a mission that replaces what stands above: `set.control.arm_law = "terrestrial"`.
    #[serde(default)]
    #[allow(dead_code, reason = "laid over the document, which is then read again")]
    pub(crate) set: BTreeMap<String, serde_json::Value>,
}

/// Most cases that one mission may compare.
const CASES: usize = 1000;

/// Every combination of one row from each axis, the last axis fastest: pairs of axis and row.
pub(crate) fn combinations(
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

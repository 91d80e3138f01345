//! The files of a study, put in place together or not at all.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use wrasse_study::StudyOutcome;

use crate::place::put_files;
use crate::results::RecordError;
use crate::study_report::study_html;

/// Version of the summary's layout; it rises when a key changes its meaning or goes away.
const FORMAT: u32 = 1;

/// Where the results of a study are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudyWritten {
    /// The report, for a browser.
    pub report: PathBuf,
    /// Demands, verdicts and findings for programs.
    pub summary: PathBuf,
}

/// What `summary.json` holds and `--json` prints: keys in a fixed order, numbers that are not finite as
/// `null`, units in the keys.
pub fn study_json(outcome: &StudyOutcome) -> Value {
    let mut summary = json!({ "format": FORMAT });
    let told = serde_json::to_value(outcome).expect("an outcome has string keys only");
    if let (Value::Object(summary), Value::Object(told)) = (&mut summary, told) {
        summary.extend(told);
    }
    summary
}

/// Writes `report.html` and `summary.json` into `dir`, which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_study(outcome: &StudyOutcome, dir: &Path) -> Result<StudyWritten, RecordError> {
    let mut summary = format!("{:#}", study_json(outcome));
    summary.push('\n');
    let contents =
        [("report.html", study_html(outcome).into_bytes()), ("summary.json", summary.into_bytes())];
    put_files(&contents, dir)?;
    Ok(StudyWritten { report: dir.join("report.html"), summary: dir.join("summary.json") })
}

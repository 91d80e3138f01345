//! The folder of results, and how a command hands them over.

use crate::input::{Failure, say, say_json};
use serde_json::Value;
use std::path::{Path, PathBuf};
use wrasse_record::{RecordError, prepare_place};

/// The folder for results, ready to be written to: `out` if it is given, else out/`name`.
pub(crate) fn results_folder(out: Option<&Path>, name: &str) -> Result<PathBuf, Failure> {
    let folder = out.map_or_else(|| Path::new("out").join(name), Path::to_path_buf);
    prepare_place(&folder).map_err(|error| not_written(&error))?;
    Ok(folder)
}

/// Print what was asked for of results that are written: the summary as JSON, or the tables and where
/// the report is.
pub(crate) fn hand_over(
    report: Result<PathBuf, RecordError>,
    json: bool,
    summary: impl FnOnce() -> Value,
    tables: impl FnOnce() -> String,
) -> Result<(), Failure> {
    let report = report.map_err(|error| not_written(&error))?;
    if json {
        say_json(&summary());
    } else {
        say(&tables());
        say(&format!("report: {}", report.display()));
    }
    Ok(())
}

fn not_written(error: &RecordError) -> Failure {
    Failure::Sentence(format!("the results cannot be written: {error}"))
}

//! The files of a run, a study and a sweep, put in place together or not at all.
//!
//! All are encoded in memory and written beside their place before they take it; the summary comes
//! last: where it is, the others are complete and belong to it.

use std::path::{Path, PathBuf};

use serde_json::Value;
use wrasse_mission::Outcome;
use wrasse_study::StudyOutcome;
use wrasse_sweep::SweepOutcome;

use crate::error::RecordError;
use crate::html::run::report_html;
use crate::html::study::study_html;
use crate::html::sweep::sweep_html;
use crate::json::{study_json, summary_json, sweep_json};
use crate::parquet::run::telemetry_parquet;
use crate::parquet::sweep::samples_parquet;
use crate::place::put_files;

const REPORT: &str = "report.html";
const SUMMARY: &str = "summary.json";

/// Where the results of a run are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The report, for a browser.
    pub report: PathBuf,
    /// Every sample of every channel.
    pub telemetry: PathBuf,
    /// Verdicts, metrics and ledger for programs.
    pub summary: PathBuf,
}

/// Where the results of a study are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudyWritten {
    /// The report, for a browser.
    pub report: PathBuf,
    /// Demands, verdicts and findings for programs.
    pub summary: PathBuf,
}

/// Where the results of a sweep are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepWritten {
    /// The report, for a browser.
    pub report: PathBuf,
    /// A row for each sample.
    pub samples: PathBuf,
    /// Percentiles, pass rates and the worst samples, for programs.
    pub summary: PathBuf,
}

/// Writes `report.html`, `telemetry.parquet` and `summary.json` into `dir`, which is made if need
/// be; if that cannot be, the former result stays.
///
/// # Errors
/// A place that cannot be written, or telemetry whose channels do not fit together.
pub fn write_results(outcome: &Outcome, dir: &Path) -> Result<Written, RecordError> {
    let columns = ("telemetry.parquet", telemetry_parquet(outcome)?);
    let files = [(REPORT, report_html(outcome).into_bytes()), columns];
    let [report, telemetry, summary] = put(files, &summary_json(outcome), dir)?;
    Ok(Written { report, telemetry, summary })
}

/// Writes `report.html` and `summary.json` into `dir`, which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_study(outcome: &StudyOutcome, dir: &Path) -> Result<StudyWritten, RecordError> {
    let files = [(REPORT, study_html(outcome).into_bytes())];
    let [report, summary] = put(files, &study_json(outcome), dir)?;
    Ok(StudyWritten { report, summary })
}

/// Writes `report.html`, `samples.parquet` and `summary.json` into `dir`, which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_sweep(outcome: &SweepOutcome, dir: &Path) -> Result<SweepWritten, RecordError> {
    let columns = ("samples.parquet", samples_parquet(outcome)?);
    let files = [(REPORT, sweep_html(outcome).into_bytes()), columns];
    let [report, samples, summary] = put(files, &sweep_json(outcome), dir)?;
    Ok(SweepWritten { report, samples, summary })
}

/// Puts the files and the summary behind them into `dir`; gives their paths in that order.
fn put<const FILES: usize, const ALL: usize>(
    files: [(&str, Vec<u8>); FILES],
    summary: &Value,
    dir: &Path,
) -> Result<[PathBuf; ALL], RecordError> {
    const { assert!(ALL == FILES + 1) };
    let mut files = Vec::from(files);
    files.push((SUMMARY, format!("{summary:#}\n").into_bytes()));
    put_files(&files, dir)?;
    Ok(std::array::from_fn(|k| dir.join(files[k].0)))
}

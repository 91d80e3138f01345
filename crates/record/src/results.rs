//! The files of a run, a study and a sweep, put in place together or not at all.
//!
//! All are encoded in memory and written beside their place before they take it; the summary comes
//! last: where it is, the others are complete and belong to it.

use std::path::{Path, PathBuf};

use serde_json::Value;
use wrasse_mission::Outcome;
use wrasse_study::StudyOutcome;
use wrasse_sweep::SweepOutcome;

use crate::columns::run::{telemetry_csv, telemetry_parquet};
use crate::columns::sweep::{samples_csv, samples_parquet};
use crate::error::RecordError;
use crate::html::run::report_html;
use crate::html::study::study_html;
use crate::html::sweep::sweep_html;
use crate::json::{study_json, summary_json, sweep_json};
use crate::place::put_files;
use crate::provenance::Provenance;

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

/// Writes `report.html`, `telemetry.parquet` (and `telemetry.csv`, if `as_csv`) and `summary.json` into
/// `dir`, which is made if need be; if that cannot be, the former result stays.
///
/// # Errors
/// A place that cannot be written, or telemetry whose channels do not fit together.
pub fn write_results(
    outcome: &Outcome,
    provenance: &Provenance,
    dir: &Path,
    as_csv: bool,
) -> Result<Written, RecordError> {
    let columns = ("telemetry.parquet", telemetry_parquet(outcome)?);
    let mut files = vec![(REPORT, report_html(outcome).into_bytes()), columns];
    if as_csv {
        files.push(("telemetry.csv", telemetry_csv(outcome)?));
    }
    put(files, &summary_json(outcome, provenance), dir)?;
    let [report, telemetry, summary] = [REPORT, "telemetry.parquet", SUMMARY].map(|f| dir.join(f));
    Ok(Written { report, telemetry, summary })
}

/// Writes `report.html` and `summary.json` into `dir`, which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_study(
    outcome: &StudyOutcome,
    provenance: &Provenance,
    dir: &Path,
) -> Result<StudyWritten, RecordError> {
    put(vec![(REPORT, study_html(outcome).into_bytes())], &study_json(outcome, provenance), dir)?;
    let [report, summary] = [REPORT, SUMMARY].map(|file| dir.join(file));
    Ok(StudyWritten { report, summary })
}

/// Writes `report.html`, `samples.parquet` (and `samples.csv`, if `as_csv`) and `summary.json` into `dir`,
/// which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_sweep(
    outcome: &SweepOutcome,
    provenance: &Provenance,
    dir: &Path,
    as_csv: bool,
) -> Result<SweepWritten, RecordError> {
    let columns = ("samples.parquet", samples_parquet(outcome)?);
    let mut files = vec![(REPORT, sweep_html(outcome).into_bytes()), columns];
    if as_csv {
        files.push(("samples.csv", samples_csv(outcome)?));
    }
    put(files, &sweep_json(outcome, provenance), dir)?;
    let [report, samples, summary] = [REPORT, "samples.parquet", SUMMARY].map(|f| dir.join(f));
    Ok(SweepWritten { report, samples, summary })
}

/// Puts the files and the summary behind them into `dir`.
fn put(
    mut files: Vec<(&'static str, Vec<u8>)>,
    summary: &Value,
    dir: &Path,
) -> Result<(), RecordError> {
    files.push((SUMMARY, format!("{summary:#}\n").into_bytes()));
    put_files(&files, dir)
}

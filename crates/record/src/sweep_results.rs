//! The files of a sweep, put in place together or not at all.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use wrasse_sweep::SweepOutcome;

use crate::place::put_files;
use crate::results::RecordError;
use crate::sweep_parquet::samples_parquet;
use crate::sweep_report::sweep_html;

/// Version of the summary's layout; it rises when a key changes its meaning or goes away.
const FORMAT: u32 = 2;

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

/// What `summary.json` holds and `--json` prints: keys in a fixed order, numbers that are not finite as
/// `null`, units beside the values.
pub fn sweep_json(outcome: &SweepOutcome) -> Value {
    let mut summary = json!({ "format": FORMAT });
    let told = serde_json::to_value(outcome).expect("an outcome has string keys only");
    if let (Value::Object(summary), Value::Object(told)) = (&mut summary, told) {
        summary.extend(told);
    }
    summary
}

/// Writes `report.html`, `samples.parquet` and `summary.json` into `dir`, which is made if need be.
///
/// # Errors
/// A place that cannot be written.
pub fn write_sweep(outcome: &SweepOutcome, dir: &Path) -> Result<SweepWritten, RecordError> {
    let mut summary = format!("{:#}", sweep_json(outcome));
    summary.push('\n');
    let contents = [
        ("report.html", sweep_html(outcome).into_bytes()),
        ("samples.parquet", samples_parquet(outcome)?),
        ("summary.json", summary.into_bytes()),
    ];
    put_files(&contents, dir)?;
    let [report, samples, summary] = contents.map(|(name, _)| dir.join(name));
    Ok(SweepWritten { report, samples, summary })
}

//! The three files of a run, put in place together or not at all.

use std::io;
use std::path::{Path, PathBuf};

use wrasse_mission::Outcome;

use crate::place::put_files;
use crate::{report_html, summary_json, telemetry_parquet};

/// Why results could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The file system refused.
    #[error("cannot {doing} {path}: {source}; choose another place with --out", path = path.display())]
    File {
        /// What was tried: "write", "create the directory".
        doing: &'static str,
        /// Where.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A channel does not fit its time base.
    #[error(
        "channel {channel} of case \"{case}\" has {found} values, expected {expected}: one for each sample time"
    )]
    ChannelLength {
        /// The case.
        case: String,
        /// The channel.
        channel: String,
        /// Its number of values.
        found: usize,
        /// Number of sample times.
        expected: usize,
    },
    /// Two columns of the telemetry would have one name.
    #[error(
        "case \"{case}\" has two telemetry columns named {channel}; give each channel its own name"
    )]
    ChannelTwice {
        /// The case.
        case: String,
        /// The name.
        channel: String,
    },
    /// The Parquet writer refused.
    #[error("cannot encode the telemetry: {0}")]
    Parquet(#[from] parquet::errors::ParquetError),
}

/// Where the results are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The report, for a browser.
    pub report: PathBuf,
    /// Every sample of every channel.
    pub telemetry: PathBuf,
    /// Verdicts, metrics and ledger for programs.
    pub summary: PathBuf,
}

/// The summary comes last: where it is, the other two are complete and belong to it.
const NAMES: [&str; 3] = ["report.html", "telemetry.parquet", "summary.json"];

/// Writes `report.html`, `telemetry.parquet` and `summary.json` into `dir`, which is made if need be.
///
/// All are encoded in memory and written beside their place before they take it together; if that
/// cannot be, the former result stays.
///
/// # Errors
/// A place that cannot be written, or telemetry whose channels do not fit together.
pub fn write_results(outcome: &Outcome, dir: &Path) -> Result<Written, RecordError> {
    let mut summary = format!("{:#}", summary_json(outcome));
    summary.push('\n');
    let contents =
        [report_html(outcome).into_bytes(), telemetry_parquet(outcome)?, summary.into_bytes()];

    let files: Vec<_> = NAMES.into_iter().zip(contents).collect();
    put_files(&files, dir)?;
    let [report, telemetry, summary] = NAMES.map(|name| dir.join(name));
    Ok(Written { report, telemetry, summary })
}

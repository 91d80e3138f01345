//! The three files of a run, put in place together or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use wrasse_mission::Outcome;

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
/// All are encoded in memory and staged beside their places before the first is put there; if one
/// cannot be, the former result is put back.
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

/// Names and contents of files, put into `dir` together or not at all, the last one last.
pub(crate) fn put_files(files: &[(&str, Vec<u8>)], dir: &Path) -> Result<(), RecordError> {
    fs::create_dir_all(dir).map_err(|source| refused("create the directory", dir, source))?;
    let staging = tempfile::Builder::new()
        .prefix(".wrasse-")
        .tempdir_in(dir)
        .map_err(|source| refused("write into", dir, source))?;
    for (name, content) in files {
        let path = staging.path().join(name);
        write_durably(&path, content).map_err(|source| refused("write", &path, source))?;
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    put_in_place(&names, staging.path(), dir)
}

fn refused(doing: &'static str, path: &Path, source: io::Error) -> RecordError {
    RecordError::File { doing, path: path.to_owned(), source }
}

/// Writes a file and waits until the disk has it, so that a rename never outruns its contents.
fn write_durably(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(content)?;
    file.sync_all()
}

/// Sets the former files aside, last first, then puts the new ones in their places.
fn put_in_place(names: &[&str], staging: &Path, dir: &Path) -> Result<(), RecordError> {
    let mut aside = Vec::new();
    for name in names.iter().rev() {
        let place = dir.join(name);
        let Ok(former) = place.symlink_metadata() else {
            continue;
        };
        // A directory of this name is somebody's, not a former result.
        let moved = if former.is_dir() {
            Err(io::ErrorKind::IsADirectory.into())
        } else {
            fs::rename(&place, staging.join(format!("former-{name}")))
        };
        if let Err(source) = moved {
            put_back(&aside, staging, dir);
            return Err(refused("replace", &place, source));
        }
        aside.push(*name);
    }
    for name in names {
        if let Err(source) = fs::rename(staging.join(name), dir.join(name)) {
            // The new ones that are in place already are not to stay without the others.
            for new in names.iter().take_while(|new| *new != name) {
                let _ = fs::remove_file(dir.join(new));
            }
            put_back(&aside, staging, dir);
            return Err(refused("write", &dir.join(name), source));
        }
    }
    Ok(())
}

/// Best effort after a failure: what cannot be put back has no better place to go.
fn put_back(aside: &[&str], staging: &Path, dir: &Path) {
    for name in aside.iter().rev() {
        let _ = fs::rename(staging.join(format!("former-{name}")), dir.join(name));
    }
}

//! What is done of a sweep, on disk: a file for each few samples, whole or not there. A sweep that was
//! interrupted goes on from them, and a larger one begins with them.

use crate::row::Row;
use crate::sweep::Sweep;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Why a sweep cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The file system refused.
    #[error("cannot {doing} {path}: {source}; choose another place with --out", path = path.display())]
    File {
        /// What was tried.
        doing: &'static str,
        /// Where.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The folder holds samples of something else.
    #[error(
        "{folder} holds samples of another sweep: its {what} is {found}, here it is {wanted}; choose \
         another place with --out, or remove {folder}",
        folder = folder.display()
    )]
    OtherSweep {
        /// The folder.
        folder: PathBuf,
        /// What is different.
        what: &'static str,
        /// … there.
        found: String,
        /// … here.
        wanted: String,
    },
    /// A file in it is damaged.
    #[error("{path} is damaged: {why}; remove it, and what it held is flown again", path = path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
}

/// The samples that are done, in a folder.
#[derive(Debug)]
pub(crate) struct Parts {
    folder: PathBuf,
}

/// Version of the layout of the files.
const FORMAT: u64 = 1;

/// Says whose samples a folder holds.
const MANIFEST: &str = "manifest.json";

/// How the name of a part ends.
const ENDING: &str = ".jsonl";

impl Parts {
    /// The folder of a sweep, made if need be.
    ///
    /// # Errors
    /// A folder that cannot be used, or that holds samples of another sweep.
    pub(crate) fn open(folder: &Path, asked: &Sweep<'_>) -> Result<Self, SweepError> {
        let parts = Self { folder: folder.to_owned() };
        fs::create_dir_all(folder).map_err(|e| refused("make the folder", folder, e))?;
        let (path, wanted) = (folder.join(MANIFEST), manifest(asked));
        match fs::read_to_string(&path) {
            Ok(text) => parts.compare(&path, &text, &wanted)?,
            Err(e) if e.kind() == io::ErrorKind::NotFound => {
                parts.put(MANIFEST, &format!("{wanted:#}\n"))?;
            }
            Err(e) => return Err(refused("read", &path, e)),
        }
        Ok(parts)
    }

    fn compare(&self, path: &Path, text: &str, wanted: &Value) -> Result<(), SweepError> {
        let there: Value = serde_json::from_str(text).map_err(|e| damaged(path, e.to_string()))?;
        for what in ["format", "version", "mission", "fingerprint", "seed"] {
            if there[what] != wanted[what] {
                return Err(SweepError::OtherSweep {
                    folder: self.folder.clone(),
                    what,
                    found: there[what].to_string(),
                    wanted: wanted[what].to_string(),
                });
            }
        }
        Ok(())
    }

    /// All rows that are there, by case and sample.
    ///
    /// # Errors
    /// A part that cannot be read.
    pub(crate) fn rows(
        &self,
        asked: &Sweep<'_>,
    ) -> Result<BTreeMap<(usize, u64), Row>, SweepError> {
        let entries = fs::read_dir(&self.folder).map_err(|e| refused("read", &self.folder, e))?;
        let mut rows = BTreeMap::new();
        for entry in entries {
            let path = entry.map_err(|e| refused("read", &self.folder, e))?.path();
            let is_part = path.file_name().and_then(|n| n.to_str()).is_some_and(|name| {
                // What a killed writer left begins with a dot.
                name.ends_with(ENDING) && !name.starts_with('.')
            });
            if !is_part {
                continue;
            }
            let text = fs::read_to_string(&path).map_err(|e| refused("read", &path, e))?;
            for line in text.lines() {
                let row: Row =
                    serde_json::from_str(line).map_err(|e| damaged(&path, e.to_string()))?;
                if !row.fits(asked.mission) {
                    let why = format!("sample {} has other columns than this mission", row.sample);
                    return Err(damaged(&path, why));
                }
                rows.insert((row.case, row.sample), row);
            }
        }
        Ok(rows)
    }

    /// Keep some rows, all of them or none.
    ///
    /// # Errors
    /// A disk that does not take them.
    pub(crate) fn keep(&self, rows: &[Row]) -> Result<(), SweepError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Ok(()) };
        let mut text = String::new();
        for row in rows {
            text += &serde_json::to_string(row).expect("a row has string keys only");
            text.push('\n');
        }
        let name = format!("case-{}-{:09}-{:09}{ENDING}", first.case, first.sample, last.sample);
        self.put(&name, &text)
    }

    /// A file under its name once it is whole.
    fn put(&self, name: &str, text: &str) -> Result<(), SweepError> {
        let place = self.folder.join(name);
        let staged = self.folder.join(format!(".{name}.{}", std::process::id()));
        let write = || {
            let mut file = File::create(&staged)?;
            file.write_all(text.as_bytes())?;
            file.sync_all()?;
            fs::rename(&staged, &place)
        };
        write().map_err(|e| refused("write", &place, e))
    }
}

fn manifest(asked: &Sweep<'_>) -> Value {
    json!({
        "format": FORMAT,
        "version": env!("CARGO_PKG_VERSION"),
        "mission": asked.mission.name,
        "fingerprint": format!("{:016x}", asked.mission.fingerprint()),
        "seed": asked.seed,
    })
}

fn refused(doing: &'static str, path: &Path, source: io::Error) -> SweepError {
    SweepError::File { doing, path: path.to_owned(), source }
}

fn damaged(path: &Path, why: String) -> SweepError {
    SweepError::Damaged { path: path.to_owned(), why }
}

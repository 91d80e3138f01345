//! What is done of a sweep, on disk: a file for each few samples, whole or not there. A sweep that was
//! interrupted goes on from them, and a larger one begins with them.
//!
//! A part begins with a line that names its sweep, counts its rows and has their checksum, so each can
//! be judged by itself.

use crate::checksum::checksum;
use crate::folder::OwnedFolder;
use crate::row::Row;
use crate::sweep::Sweep;
use crate::sweep_error::SweepError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Largest part or manifest that is read (bytes): samples of a chunk take a few hundred each.
const LARGEST: u64 = 1 << 26;

/// The samples that are done, in a folder.
#[derive(Debug)]
pub(crate) struct Parts<'f> {
    folder: &'f OwnedFolder,
    label: Label,
}

/// Version of the layout of the files.
const FORMAT: u64 = 2;

/// Says which sweep is flown in a folder.
const MANIFEST: &str = "manifest.json";

/// How the name of a part ends.
const ENDING: &str = ".jsonl";

/// Which sweep a file belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Label {
    format: u64,
    version: String,
    mission: String,
    fingerprint: String,
    seed: u64,
}

/// The first line of a part.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    #[serde(flatten)]
    label: Label,
    /// Rows behind it.
    rows: usize,
    /// Checksum of all behind this line.
    checksum: String,
}

impl Label {
    fn of(asked: &Sweep<'_>) -> Self {
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").into(),
            mission: asked.mission.name.clone(),
            fingerprint: asked.mission.fingerprint(),
            seed: asked.seed,
        }
    }

    /// What is different in another one, there and here.
    fn difference(&self, there: &Self) -> Option<(&'static str, String, String)> {
        let each = |label: &Self| {
            let Self { format, version, mission, fingerprint, seed } = label.clone();
            [format.to_string(), version, mission, fingerprint, seed.to_string()]
        };
        let names = ["format", "version", "mission", "fingerprint", "seed"];
        let both = names.into_iter().zip(each(there).into_iter().zip(each(self)));
        both.map(|(name, (there, here))| (name, there, here)).find(|(_, there, here)| there != here)
    }
}

impl<'f> Parts<'f> {
    /// The samples in the folder of a sweep.
    ///
    /// # Errors
    /// A folder that cannot be used, or that holds samples of another sweep.
    pub(crate) fn open(folder: &'f OwnedFolder, asked: &Sweep<'_>) -> Result<Self, SweepError> {
        let parts = Self { folder, label: Label::of(asked) };
        let path = folder.path().join(MANIFEST);
        match read(&path) {
            Ok(text) => {
                let there: Label =
                    serde_json::from_str(&text).map_err(|e| SweepError::Damaged {
                        path: path.clone(),
                        why: e.to_string(),
                        then: "each part says itself which sweep it is of",
                    })?;
                parts.compare(&path, &there)?;
            }
            Err(e) if e.kind() == io::ErrorKind::NotFound => {
                let text = serde_json::to_string_pretty(&parts.label).expect("keys are strings");
                folder.put(MANIFEST, &(text + "\n"))?;
            }
            Err(e) => return Err(unreadable(&path, e)),
        }
        Ok(parts)
    }

    /// A file must be of this sweep.
    fn compare(&self, path: &Path, there: &Label) -> Result<(), SweepError> {
        let Some((what, found, wanted)) = self.label.difference(there) else { return Ok(()) };
        let (path, folder) = (path.to_owned(), self.folder.path().to_owned());
        Err(SweepError::OtherSweep { path, folder, what, found, wanted })
    }

    /// All rows that are there, by case and sample.
    ///
    /// # Errors
    /// A part that is damaged, or of another sweep.
    pub(crate) fn rows(
        &self,
        asked: &Sweep<'_>,
    ) -> Result<BTreeMap<(usize, u64), Row>, SweepError> {
        let folder = self.folder.path();
        let entries = fs::read_dir(folder).map_err(|e| unreadable(folder, e))?;
        let mut rows = BTreeMap::new();
        let mut paths: Vec<PathBuf> = vec![];
        for entry in entries {
            paths.push(entry.map_err(|e| unreadable(folder, e))?.path());
        }
        paths.retain(|path| {
            path.file_name().and_then(|n| n.to_str()).is_some_and(|name| {
                // What a killed writer left begins with a dot.
                name.ends_with(ENDING) && !name.starts_with('.')
            })
        });
        // Of several that are wrong the first is told, and it is always the same one.
        paths.sort();
        for path in paths {
            let text = read(&path).map_err(|e| unreadable(&path, e))?;
            for row in self.rows_of(&path, &text, asked)? {
                rows.insert((row.case, row.sample), row);
            }
        }
        Ok(rows)
    }

    /// The rows of one part.
    fn rows_of(&self, path: &Path, text: &str, asked: &Sweep<'_>) -> Result<Vec<Row>, SweepError> {
        let damaged = |why: String| SweepError::Damaged {
            path: path.to_owned(),
            why,
            then: "what it held is flown again",
        };
        let (first, behind) = text.split_once('\n').unwrap_or((text, ""));
        let head: Head = serde_json::from_str(first)
            .map_err(|e| damaged(format!("its first line does not say what it is ({e})")))?;
        self.compare(path, &head.label)?;
        if head.checksum != format!("{:016x}", checksum(behind)) {
            let lines = behind.lines().count();
            let why = format!(
                "its checksum is not that of its {lines} lines ({} were written)",
                head.rows
            );
            return Err(damaged(why));
        }
        let mut rows = vec![];
        for line in behind.lines() {
            let row: Row = serde_json::from_str(line).map_err(|e| damaged(e.to_string()))?;
            if !row.fits(asked.mission) {
                let why = format!("sample {} has other columns than this mission", row.sample);
                return Err(damaged(why));
            }
            rows.push(row);
        }
        Ok(rows)
    }

    /// Keep some rows, all of them or none.
    ///
    /// # Errors
    /// A disk that does not take them.
    pub(crate) fn keep(&self, rows: &[Row]) -> Result<(), SweepError> {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Ok(()) };
        let mut behind = String::new();
        for row in rows {
            behind += &serde_json::to_string(row).expect("a row has string keys only");
            behind.push('\n');
        }
        let checksum = format!("{:016x}", checksum(&behind));
        let head = Head { label: self.label.clone(), rows: rows.len(), checksum };
        let head = serde_json::to_string(&head).expect("a head has string keys only");
        let name = format!("case-{}-{:09}-{:09}{ENDING}", first.case, first.sample, last.sample);
        self.folder.put(&name, &format!("{head}\n{behind}"))
    }
}

/// The text of a file; what is no text counts as damaged, not as unreadable.
fn read(path: &Path) -> io::Result<String> {
    let found = fs::metadata(path)?;
    // A pipe or a device would be read for ever.
    if !found.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    if found.len() > LARGEST {
        return Err(io::Error::other(format!("it has more than {LARGEST} bytes")));
    }
    Ok(String::from_utf8_lossy(&fs::read(path)?).into_owned())
}

fn unreadable(path: &Path, source: io::Error) -> SweepError {
    SweepError::File { doing: "read", path: path.to_owned(), source }
}

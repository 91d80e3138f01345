//! Whence results come: the program, its command line, and the files it read.

use serde::Serialize;
use wrasse_mission::{Mission, sha256};

/// Whence results come. There is no clock in it: the same files and the same command give the same results.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// The program's version.
    pub version: String,
    /// The commit that it was built from, with `-dirty` if files were changed since; `unknown` outside of
    /// a repository.
    pub commit: String,
    /// The command line, word by word, as far as it decides the results.
    pub command_line: Vec<String>,
    /// The mission file.
    pub mission: FileRecord,
    /// Values that the command line laid over the mission file, as they were given.
    pub set: Vec<String>,
    /// The vehicle files of its cases, each once.
    pub vehicles: Vec<FileRecord>,
}

/// A file that was read.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct FileRecord {
    /// As it was named.
    pub file: String,
    /// SHA-256 of its bytes, as `sha256sum` says it.
    pub sha256: String,
    /// Its whole text.
    pub text: String,
}

impl FileRecord {
    fn of(file: &str, text: &str) -> Self {
        Self { file: file.into(), sha256: sha256(text), text: text.into() }
    }
}

impl Provenance {
    /// Of a mission that a program of this commit flies.
    pub fn of(mission: &Mission, commit: &str, command_line: Vec<String>) -> Self {
        let mut vehicles: Vec<FileRecord> = vec![];
        for case in &mission.cases {
            for (path, text) in case.vehicle.files() {
                if vehicles.iter().all(|known| known.text != text) {
                    let name = path.map_or(case.vehicle_name.clone(), |p| p.display().to_string());
                    vehicles.push(FileRecord::of(&name, text));
                }
            }
        }
        Self {
            version: env!("CARGO_PKG_VERSION").into(),
            commit: commit.into(),
            command_line,
            mission: FileRecord::of(&mission.file, &mission.text),
            set: mission.settings.clone(),
            vehicles,
        }
    }
}

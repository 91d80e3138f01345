//! The text of a user's file, where it is a file and not too large.

use crate::decode::decoded;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Largest vehicle or mission file (bytes): a thousand times the longest that comes with the program.
pub const MOST_BYTES: u64 = 16 << 20;

/// Why a file has no text that can be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum Unreadable {
    /// The system refused.
    System(io::Error),
    /// It is a folder.
    Folder,
    /// It is a device, a pipe or a socket: it may never end.
    NoFile,
    /// It is larger than it may be.
    Large {
        /// Most bytes.
        most: u64,
    },
    /// Its bytes are not text.
    NotText {
        /// Bytes before the first that is none.
        valid_up_to: usize,
    },
}

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::System(error) => write!(f, "{error}"),
            Self::Folder => write!(f, "it is a folder"),
            Self::NoFile => write!(f, "it is a device, a pipe or a socket, not a file"),
            Self::Large { most } => {
                write!(f, "it is larger than {} MiB, the most that is read", most >> 20)
            }
            Self::NotText { valid_up_to } => {
                write!(f, "it is not UTF-8 text: byte {} does not belong to any", valid_up_to + 1)
            }
        }
    }
}

impl std::error::Error for Unreadable {}

/// The text of a file of at most `most` bytes. What kind of thing it is is looked at before it is
/// opened, for a pipe that nobody writes to is waited for.
///
/// # Errors
/// What is no file, is too large, or is not text.
pub fn read_text(path: &Path, most: u64) -> Result<String, Unreadable> {
    let kind = fs::metadata(path).map_err(Unreadable::System)?;
    if kind.is_dir() {
        return Err(Unreadable::Folder);
    }
    if !kind.is_file() {
        return Err(Unreadable::NoFile);
    }
    if kind.len() > most {
        return Err(Unreadable::Large { most });
    }
    let file = File::open(path).map_err(Unreadable::System)?;
    // A file may grow while it is read, and some say nothing of their length.
    read_stream(file, most)
}

/// The text of a stream of at most `most` bytes, read to its end.
///
/// # Errors
/// What is too large, or is not text.
pub fn read_stream(stream: impl Read, most: u64) -> Result<String, Unreadable> {
    let mut bytes = vec![];
    stream.take(most + 1).read_to_end(&mut bytes).map_err(Unreadable::System)?;
    if bytes.len() as u64 > most {
        return Err(Unreadable::Large { most });
    }
    decoded(bytes).map_err(|valid_up_to| Unreadable::NotText { valid_up_to })
}

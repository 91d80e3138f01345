//! Why a sweep cannot go on, and what to do about it.

use std::io;
use std::path::PathBuf;

/// Why a sweep cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// All samples would be the same flight.
    #[error(
        "{file} draws nothing: all {samples} samples would be the same flight, and a pass rate of them says \
         nothing; add a table [[disperse]] for what is not known exactly (masses, starts, sensors), or fly it \
         once with `wrasse run`"
    )]
    NothingDrawn {
        /// The mission file.
        file: String,
        /// Samples that were asked for.
        samples: u64,
    },
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
    /// Another process flies a sweep there.
    #[error(
        "another sweep is being flown in {folder}; wait until it is done, or choose another place with --out",
        folder = folder.display()
    )]
    InUse {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder holds samples of something else.
    #[error(
        "{path} is of another sweep: its {what} is {found}, here it is {wanted}; choose another place with \
         --out, or remove {folder}",
        path = path.display(), folder = folder.display()
    )]
    OtherSweep {
        /// The file that says so.
        path: PathBuf,
        /// The folder that it is in.
        folder: PathBuf,
        /// What is different.
        what: &'static str,
        /// … there.
        found: String,
        /// … here.
        wanted: String,
    },
    /// A file in it is damaged.
    #[error("{path} is damaged: {why}; remove it: {then}", path = path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
        /// What comes of removing it.
        then: &'static str,
    },
}

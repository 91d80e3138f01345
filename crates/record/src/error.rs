//! What can go wrong between an outcome and its files.

use std::io;
use std::path::PathBuf;

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
    /// The CSV writer refused.
    #[error("cannot encode the table as CSV: {0}")]
    Csv(#[from] csv::Error),
}

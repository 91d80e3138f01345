//! What is wrong, where, and how to mend it.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

/// A file's text and where it came from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Path as the user gave it.
    pub path: PathBuf,
    /// The whole text.
    pub text: String,
}

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// The file cannot be used.
    Error,
    /// Possible, but worth a second look.
    Warning,
    /// Read, and not used: named so that nothing is ignored in silence.
    Note,
}

/// One complaint about one place in one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong: found and expected, with units, lower case, no full stop.
    pub message: String,
    /// The file.
    pub source: Arc<Source>,
    /// Byte range in its text; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
    /// Two or three words under the caret.
    pub label: String,
    /// How to mend it, if there is something to say.
    pub help: Option<String>,
}

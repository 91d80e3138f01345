//! What is wrong, where, and how to mend it.

use crate::excerpt::Lines;
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
    /// Texts that were given beside the file and laid over it. A byte range behind the text lies in one of
    /// them; [`Complaint::placed`] finds which.
    pub(crate) beside: Vec<Arc<Self>>,
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

impl Source {
    /// A file's text, to be shared by all complaints about it.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self { path: path.into(), text: text.into(), beside: vec![] })
    }
    /// Where a text beside the file begins, behind the file's own: one byte lies between any two.
    pub(crate) fn begin_beside(&self, number: usize) -> usize {
        let before = self.beside.iter().take(number).map(|source| source.text.len() + 1);
        self.text.len() + 1 + before.sum::<usize>()
    }
}

impl Complaint {
    /// A complaint about the file as a whole, until it is told the place.
    pub fn new(severity: Severity, source: &Arc<Source>, message: impl Into<String>) -> Self {
        Self {
            severity,
            message: message.into(),
            source: Arc::clone(source),
            span: None,
            label: String::new(),
            help: None,
        }
    }
    /// An error about the file as a whole, until it is told the place.
    pub fn error(source: &Arc<Source>, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, source, message)
    }
    /// A warning about the file as a whole, until it is told the place.
    pub fn warning(source: &Arc<Source>, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, source, message)
    }
    /// A note about the file as a whole, until it is told the place.
    pub fn note(source: &Arc<Source>, message: impl Into<String>) -> Self {
        Self::new(Severity::Note, source, message)
    }
    /// The same, at a byte range of the text, with two or three words under the caret.
    #[must_use]
    pub fn at(mut self, span: Range<usize>, label: impl Into<String>) -> Self {
        self.span = Some(span);
        self.label = label.into();
        self
    }
    /// The same, about the text in which its place lies: that of the file, or one that was laid over it.
    #[must_use]
    pub fn placed(&self) -> Self {
        let source = &self.source;
        let Some(span) = &self.span else { return self.clone() };
        let within = (0..source.beside.len()).rev().find(|k| span.start >= source.begin_beside(*k));
        let Some(number) = within else { return self.clone() };
        let begin = source.begin_beside(number);
        Self {
            source: Arc::clone(&source.beside[number]),
            span: Some(span.start - begin..span.end.max(begin) - begin),
            ..self.clone()
        }
    }
    /// Line, and place in it in characters, both from 1, of where it points; `None` for the file as a whole.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        let text = &self.source.text;
        let excerpt = Lines::of(text).excerpt(text, self.span.as_ref()?);
        Some((excerpt.line, excerpt.column))
    }
    /// The same, with how to mend it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

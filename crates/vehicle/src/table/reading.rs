//! A TOML file that is being read: the document, and what was found wrong with it so far.

use crate::findings::Findings;
use std::ops::Range;
use wrasse_document::{Document, Step};

/// The document and the complaints.
#[derive(Debug)]
pub(crate) struct Reading<'d> {
    pub(crate) document: &'d Document,
    pub(crate) found: Findings,
}

/// The path one step further.
pub(crate) fn under<'p>(path: &[Step<'p>], key: &'p str) -> Vec<Step<'p>> {
    [path, &[Step::Key(key)]].concat()
}

impl<'d> Reading<'d> {
    pub(crate) fn new(document: &'d Document) -> Self {
        Self { document, found: Findings::new(document.source()) }
    }
    /// Where the value at a path stands.
    pub(crate) fn at(&self, path: &[Step<'_>]) -> Range<usize> {
        self.document.span(path).unwrap_or(0..0)
    }
    /// Where the value at a key below a path stands.
    pub(crate) fn below(&self, path: &[Step<'_>], key: &str) -> Range<usize> {
        self.at(&under(path, key))
    }
    pub(crate) fn error(&mut self, path: &[Step<'_>], message: String, label: &str, help: &str) {
        let at = self.at(path);
        self.found.error(&at, message, label, help);
    }
    pub(crate) fn warning(&mut self, path: &[Step<'_>], message: String, label: &str, help: &str) {
        let at = self.at(path);
        self.found.warning(&at, message, label, help);
    }
    /// An error about a key rather than its value.
    pub(crate) fn wrong_key(
        &mut self,
        path: &[Step<'_>],
        message: String,
        label: &str,
        help: &str,
    ) {
        let at = self.document.key_span(path).unwrap_or(0..0);
        self.found.error(&at, message, label, help);
    }
}

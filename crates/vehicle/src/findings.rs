//! The complaints of one reading, gathered so that all of them are told at once.

use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Severity, Source};

/// Complaints that are shown of a file, and as many again for those that others come before.
const MANY: usize = 200;

/// Complaints about one file, in the order they were found.
#[derive(Debug)]
pub(crate) struct Findings {
    source: Arc<Source>,
    /// Where the lines of the file begin.
    lines: Vec<usize>,
    list: Vec<Complaint>,
}

impl Findings {
    /// None yet.
    pub(crate) fn new(source: &Arc<Source>) -> Self {
        let ends = source.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        Self { source: Arc::clone(source), lines, list: Vec::new() }
    }
    /// The file cannot be used.
    pub(crate) fn error(&mut self, at: &Range<usize>, message: String, label: &str, help: &str) {
        self.add(Severity::Error, at, message, label, help);
    }
    /// Possible, but worth a second look.
    pub(crate) fn warning(&mut self, at: &Range<usize>, message: String, label: &str, help: &str) {
        self.add(Severity::Warning, at, message, label, help);
    }
    /// Read, and not used.
    pub(crate) fn note(&mut self, at: &Range<usize>, message: String, label: &str, help: &str) {
        self.add(Severity::Note, at, message, label, help);
    }
    /// A complaint of the severity given; an empty help is none.
    pub(crate) fn add(
        &mut self,
        severity: Severity,
        at: &Range<usize>,
        message: String,
        label: &str,
        help: &str,
    ) {
        self.list.push(Complaint {
            severity,
            message,
            source: Arc::clone(&self.source),
            span: Some(at.clone()),
            label: label.to_owned(),
            help: (!help.is_empty()).then(|| help.to_owned()),
        });
    }
    /// Those of another reading of the same file.
    pub(crate) fn take(&mut self, complaints: Vec<Complaint>) {
        self.list.extend(complaints);
    }
    /// Number of the line (from 1) on which a byte of the file stands.
    pub(crate) fn line(&self, byte: usize) -> usize {
        self.lines.partition_point(|begin| *begin <= byte).max(1)
    }
    /// Whether there are more than anybody reads: to look for what was meant by each takes the time of
    /// all names, and is not worth it any more.
    pub(crate) fn are_many(&self) -> bool {
        self.list.len() > MANY
    }
    /// Whether the file can still be used.
    pub(crate) fn without_error(&self) -> bool {
        self.list.iter().all(|c| c.severity != Severity::Error)
    }
    /// All of them, in the order of the file.
    pub(crate) fn into_complaints(mut self) -> Vec<Complaint> {
        self.list.sort_by_key(|c| c.span.as_ref().map_or(0, |span| span.start));
        self.list
    }
}

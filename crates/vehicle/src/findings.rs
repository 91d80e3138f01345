//! The complaints of one reading, gathered so that all of them are told at once.

use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Severity, Source};

/// Complaints that are shown of a file, and as many again for those that others come before.
const MANY: usize = 200;

/// The files of one reading, end to end: a byte range among them tells file and place.
///
/// A vehicle may include others; what one file says of another's links is then told at the right place
/// without each link carrying its file.
#[derive(Debug, Clone, Default)]
pub(crate) struct SourceFiles {
    files: Vec<File>,
}

/// One file among several.
#[derive(Debug, Clone)]
struct File {
    source: Arc<Source>,
    /// Where it begins among all files.
    begin: usize,
    /// Where its lines begin, among all files.
    lines: Vec<usize>,
}

impl SourceFiles {
    /// One file.
    pub(crate) fn of(source: &Arc<Source>) -> Self {
        let mut sources = Self::default();
        sources.push(source);
        sources
    }
    /// One byte more than all files have: the next file begins there.
    fn end(&self) -> usize {
        self.files.last().map_or(0, |file| file.begin + file.source.text.len() + 1)
    }
    fn push(&mut self, source: &Arc<Source>) {
        let begin = self.end();
        let ends = source.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(begin).chain(ends.map(|(at, _)| begin + at + 1)).collect();
        self.files.push(File { source: Arc::clone(source), begin, lines });
    }
    /// Puts the files of another reading behind these. By how much its places move.
    pub(crate) fn append(&mut self, others: &Self) -> usize {
        let moved = self.end();
        others.files.iter().for_each(|file| self.push(&file.source));
        moved
    }
    /// All files, in the order in which they were read.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Arc<Source>> {
        self.files.iter().map(|file| &file.source)
    }
    fn file(&self, byte: usize) -> Option<&File> {
        let after = self.files.partition_point(|file| file.begin <= byte);
        self.files.get(after.saturating_sub(1))
    }
    /// Number of the line (from 1) on which a byte stands, in its own file.
    fn line(&self, byte: usize) -> usize {
        self.file(byte).map_or(1, |file| file.lines.partition_point(|begin| *begin <= byte).max(1))
    }
    /// Place of a source among the files.
    fn rank(&self, source: &Arc<Source>) -> usize {
        let same = |file: &File| Arc::ptr_eq(&file.source, source) || file.source == *source;
        self.files.iter().position(same).unwrap_or(usize::MAX)
    }
}

/// Complaints about the files of one reading, in the order they were found.
#[derive(Debug)]
pub(crate) struct Findings {
    sources: SourceFiles,
    list: Vec<Complaint>,
}

impl Findings {
    /// None yet, of one file.
    pub(crate) fn new(source: &Arc<Source>) -> Self {
        Self::within(&SourceFiles::of(source))
    }
    /// None yet, of several files.
    pub(crate) fn within(sources: &SourceFiles) -> Self {
        Self { sources: sources.clone(), list: Vec::new() }
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
        let Some(file) = self.sources.file(at.start) else { return };
        let (begin, end) = (at.start - file.begin, at.end.saturating_sub(file.begin));
        self.list.push(Complaint {
            severity,
            message,
            source: Arc::clone(&file.source),
            span: Some(begin..end.min(file.source.text.len()).max(begin)),
            label: label.to_owned(),
            help: (!help.is_empty()).then(|| help.to_owned()),
        });
    }
    /// Those of another reading.
    pub(crate) fn take(&mut self, complaints: Vec<Complaint>) {
        self.list.extend(complaints);
    }
    /// The line on which a byte stands, for a complaint at `here`: `line 12`, and of which file, if it
    /// is another one.
    pub(crate) fn line(&self, byte: usize, here: &Range<usize>) -> String {
        let line = self.sources.line(byte);
        match (self.sources.file(byte), self.sources.file(here.start)) {
            (Some(there), Some(here)) if there.begin != here.begin => {
                format!("line {line} of {}", there.source.path.display())
            }
            _ => format!("line {line}"),
        }
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
    /// All of them, file by file, each in its order.
    pub(crate) fn into_complaints(mut self) -> Vec<Complaint> {
        let sources = &self.sources;
        let rank =
            |c: &Complaint| (sources.rank(&c.source), c.span.as_ref().map_or(0, |s| s.start));
        self.list.sort_by_cached_key(rank);
        self.list
    }
}

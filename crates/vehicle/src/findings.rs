//! The complaints of one reading, gathered so that all of them are told at once.

use crate::deep::Place;
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Severity, Source, closest};

/// Names that are compared in one reading to guess what was meant by others: more take longer than
/// anybody waits, and a file that needs more has one mistake many times.
const MOST_GUESSES: usize = 50_000;

/// The files of one reading, end to end: a byte range among them tells file and place.
///
/// A vehicle may include others; what one file says of another's links is then told at the right place
/// without each link carrying its file.
#[derive(Debug, Clone, Default)]
pub(crate) struct SourceFiles {
    pieces: Vec<Piece>,
}

/// A file, or a part of one where the text of another stands within it.
#[derive(Debug, Clone)]
struct Piece {
    source: Arc<Source>,
    /// The part of the file.
    at: Range<usize>,
    /// Where it begins among all files.
    begin: usize,
    /// Where the lines of the whole file begin.
    lines: Arc<Vec<usize>>,
}

impl SourceFiles {
    /// One file.
    pub(crate) fn of(source: &Arc<Source>) -> Self {
        Self::spliced([(Arc::clone(source), 0..source.text.len())])
    }
    /// Parts of files, whose text stands one behind the other.
    pub(crate) fn spliced(parts: impl IntoIterator<Item = (Arc<Source>, Range<usize>)>) -> Self {
        let mut files = Self::default();
        let mut begin = 0;
        for (source, at) in parts {
            let ends = source.text.match_indices('\n');
            let lines = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
            let length = at.len();
            files.pieces.push(Piece { source, at, begin, lines: Arc::new(lines) });
            begin += length;
        }
        files
    }
    /// One byte more than all files have: the next file begins there.
    fn end(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.begin + piece.at.len() + 1)
    }
    /// Puts the files of another reading behind these. By how much its places move.
    pub(crate) fn append(&mut self, others: &Self) -> usize {
        let moved = self.end();
        let after = others.pieces.iter().cloned();
        self.pieces.extend(after.map(|piece| Piece { begin: piece.begin + moved, ..piece }));
        moved
    }
    /// All files, in the order in which they were read.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Arc<Source>> {
        let sources = || self.pieces.iter().map(|piece| &piece.source);
        let first = move |k: usize, source: &Arc<Source>| {
            sources().take(k).all(|earlier| !Arc::ptr_eq(earlier, source))
        };
        sources().enumerate().filter(move |(k, source)| first(*k, source)).map(|(_, source)| source)
    }
    /// The file in which a byte stands, and its place there.
    fn place(&self, byte: usize) -> Option<(&Piece, usize)> {
        let after = self.pieces.partition_point(|piece| piece.begin <= byte);
        let piece = self.pieces.get(after.checked_sub(1)?)?;
        Some((piece, (byte - piece.begin + piece.at.start).min(piece.at.end)))
    }
    /// The place of a byte range in its file.
    pub(crate) fn place_of(&self, at: &Range<usize>) -> Option<Place> {
        let (piece, begin) = self.place(at.start)?;
        let end = (begin + at.len()).min(piece.at.end).max(begin);
        Some(Place { source: Arc::clone(&piece.source), span: begin..end })
    }
    /// Place of a source among the files.
    fn rank(&self, source: &Arc<Source>) -> usize {
        let same = |piece: &Piece| Arc::ptr_eq(&piece.source, source) || piece.source == *source;
        self.pieces.iter().position(same).unwrap_or(usize::MAX)
    }
}

/// Complaints about the files of one reading, in the order they were found.
#[derive(Debug)]
pub(crate) struct Findings {
    sources: SourceFiles,
    list: Vec<Complaint>,
    /// Names that were compared so far.
    guesses: usize,
}

impl Findings {
    /// None yet, of one file.
    pub(crate) fn new(source: &Arc<Source>) -> Self {
        Self::within(&SourceFiles::of(source))
    }
    /// None yet, of several files.
    pub(crate) fn within(sources: &SourceFiles) -> Self {
        Self { sources: sources.clone(), list: Vec::new(), guesses: 0 }
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
        let Some(Place { source, span }) = self.sources.place_of(at) else { return };
        self.list.push(Complaint {
            severity,
            message,
            source,
            span: Some(span),
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
        let Some((piece, place)) = self.sources.place(byte) else { return "line 1".into() };
        let line = piece.lines.partition_point(|begin| *begin <= place).max(1);
        let elsewhere = self.sources.place(here.start);
        match elsewhere.filter(|(other, _)| !Arc::ptr_eq(&other.source, &piece.source)) {
            Some(_) => format!("line {line} of {}", piece.source.path.display()),
            None => format!("line {line}"),
        }
    }
    /// The name that was meant by a word, if one is near enough and not too many were compared before.
    pub(crate) fn meant<'a>(
        &mut self,
        word: &str,
        among: impl ExactSizeIterator<Item = &'a str>,
    ) -> Option<&'a str> {
        self.guesses = self.guesses.saturating_add(among.len());
        if self.guesses > MOST_GUESSES { None } else { closest(word, among) }
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

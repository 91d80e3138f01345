//! Complaints as a compiler prints them.

use crate::{Complaint, Severity, Source};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::fmt::Write as _;
use std::ops::Range;
use std::sync::Arc;

/// All complaints as text, errors first, each file in its order, and a last line that counts them.
///
/// With `colour`, the text carries terminal colours.
pub fn render(complaints: &[Complaint], colour: bool) -> String {
    if complaints.is_empty() {
        return String::new();
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut text = String::new();
    for complaint in in_order(complaints) {
        text.push_str(&renderer.render(&[group(complaint)]));
        text.push_str("\n\n");
    }
    text.push_str(&count(complaints));
    text
}

/// Errors, warnings, notes; within each the files as they first appear, and the places in them.
fn in_order(complaints: &[Complaint]) -> Vec<&Complaint> {
    let mut files: Vec<&Arc<Source>> = Vec::new();
    for complaint in complaints {
        if !files.iter().any(|file| same(file, &complaint.source)) {
            files.push(&complaint.source);
        }
    }
    let rank = |severity| match severity {
        Severity::Error => 0,
        Severity::Warning => 1,
        Severity::Note => 2,
    };
    let mut sorted: Vec<_> = complaints.iter().collect();
    sorted.sort_by_key(|c| {
        let file = files.iter().position(|file| same(file, &c.source));
        (rank(c.severity), file, c.span.as_ref().map_or(0, |s| s.start))
    });
    sorted
}

fn same(a: &Arc<Source>, b: &Arc<Source>) -> bool {
    Arc::ptr_eq(a, b) || a.path == b.path
}

fn group(complaint: &Complaint) -> Group<'_> {
    let level = match complaint.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let path = complaint.source.path.to_string_lossy();
    let title = level.primary_title(&*complaint.message);
    let group = match &complaint.span {
        Some(span) => title.element(
            Snippet::source(&*complaint.source.text).path(path).annotation(
                AnnotationKind::Primary
                    .span(printable(&complaint.source.text, span))
                    .label(&*complaint.label),
            ),
        ),
        None => title.element(Origin::path(path)),
    };
    match &complaint.help {
        Some(help) => group.element(Level::HELP.message(&**help)),
        None => group,
    }
}

/// The span within the text, on whole characters, and no longer than its first line.
fn printable(text: &str, span: &Range<usize>) -> Range<usize> {
    let whole = |at: &usize| text.is_char_boundary(*at);
    let start = (0..=span.start.min(text.len())).rev().find(whole).unwrap_or(0);
    let end = (span.end.clamp(start, text.len())..=text.len()).find(whole).unwrap_or(start);
    let line = text[start..end].find(['\n', '\r']).unwrap_or(end - start);
    start..start + line
}

/// "2 errors, 1 warning".
fn count(complaints: &[Complaint]) -> String {
    let mut text = String::new();
    for (severity, word) in
        [(Severity::Error, "error"), (Severity::Warning, "warning"), (Severity::Note, "note")]
    {
        let n = complaints.iter().filter(|c| c.severity == severity).count();
        if n > 0 {
            let comma = if text.is_empty() { "" } else { ", " };
            let plural = if n == 1 { "" } else { "s" };
            // Writing to a string cannot fail.
            let _ = write!(text, "{comma}{n} {word}{plural}");
        }
    }
    text.push('\n');
    text
}

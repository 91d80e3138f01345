//! Complaints as a compiler prints them.

use crate::excerpt::{Excerpt, Lines};
use crate::visible::visible;
use crate::{Complaint, Severity, Source};
use annotate_snippets::{AnnotationKind, Level, Origin, Renderer, Snippet};
use std::fmt::Write as _;
use std::sync::Arc;

/// Complaints that are shown one by one: whoever has mended so many reads the file again.
const MOST: usize = 100;

/// Complaints as text, errors first, each file in its order, and a last line that counts them; of more
/// than a hundred the first hundred. No character of a file is obeyed by a terminal.
///
/// With `colour`, the text carries terminal colours.
pub fn render(complaints: &[Complaint], colour: bool) -> String {
    if complaints.is_empty() {
        return String::new();
    }
    let complaints: Vec<Complaint> = complaints.iter().map(Complaint::placed).collect();
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut files: Vec<(&Arc<Source>, Lines)> = vec![];
    let mut text = String::new();
    for complaint in in_order(&complaints).into_iter().take(MOST) {
        let known = files.iter().position(|(file, _)| same(file, &complaint.source));
        let file = known.unwrap_or_else(|| {
            files.push((&complaint.source, Lines::of(&complaint.source.text)));
            files.len() - 1
        });
        text.push_str(&rendered(complaint, &files[file].1, &renderer));
        text.push_str("\n\n");
    }
    if complaints.len() > MOST {
        let rest = complaints.len() - MOST;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "the first {MOST} are shown, {rest} more are not");
    }
    text.push_str(&count(&complaints));
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
    Arc::ptr_eq(a, b) || (a.path == b.path && a.text == b.text)
}

fn rendered(complaint: &Complaint, lines: &Lines, renderer: &Renderer) -> String {
    let level = match complaint.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let path = complaint.source.path.to_string_lossy();
    let path = visible(&path);
    let title = level.primary_title(visible(&complaint.message));
    let excerpt = complaint.span.as_ref().map(|s| lines.excerpt(&complaint.source.text, s));
    let group = match &excerpt {
        Some(Excerpt { line, text, span, .. }) => {
            let place = AnnotationKind::Primary.span(span.clone()).label(visible(&complaint.label));
            title.element(Snippet::source(text).path(&*path).line_start(*line).annotation(place))
        }
        None => title.element(Origin::path(&*path)),
    };
    let group = match &complaint.help {
        Some(help) => group.element(Level::HELP.message(visible(help))),
        None => group,
    };
    let drawn = renderer.render(&[group]);
    let Some(Excerpt { line, column, text, span }) = excerpt else { return drawn };
    // Escapes before the place move it in what is drawn, not in the file.
    let shown = text[..span.start].chars().count() + 1;
    let [drawn_at, stands_at] = [shown, column].map(|column| format!("{path}:{line}:{column}"));
    if shown == column { drawn } else { drawn.replacen(&drawn_at, &stands_at, 1) }
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

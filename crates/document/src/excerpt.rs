//! The line of a text that a complaint is about, as it can be shown.

use crate::visible::{is_hidden, push_escape};
use std::ops::Range;

/// Where the lines of a text begin.
#[derive(Debug)]
pub(crate) struct Lines {
    starts: Vec<usize>,
}

/// A part of one line, without characters that a terminal would obey.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Excerpt {
    /// Number of the line, from 1.
    pub(crate) line: usize,
    /// Place in the line of the file, in characters, from 1.
    pub(crate) column: usize,
    pub(crate) text: String,
    /// Bytes of `text` that are meant.
    pub(crate) span: Range<usize>,
}

/// Bytes of a line that are shown before, of and behind a place: a file may be one long line.
const SHOWN: usize = 400;

impl Lines {
    pub(crate) fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self { starts: std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect() }
    }
    /// Number of the line, from zero, in which a byte stands.
    pub(crate) fn number(&self, byte: usize) -> usize {
        self.starts.partition_point(|start| *start <= byte).saturating_sub(1)
    }
    /// The line of a place, which is cut to whole characters and to its first line.
    pub(crate) fn excerpt(&self, text: &str, place: &Range<usize>) -> Excerpt {
        let meant = within(text, place);
        let number = self.number(meant.start);
        let begin = self.starts[number];
        let rest = &text[begin..];
        let end = begin + rest.find(['\n', '\r']).unwrap_or(rest.len()).max(meant.end - begin);
        let from = before(text, meant.start.saturating_sub(SHOWN).max(begin));
        let last = before(text, meant.end.min(meant.start + SHOWN)).max(meant.start);
        let to = before(text, end.min(last + SHOWN)).max(last);
        let mut shown = Shown::default();
        shown.cut(from > begin);
        shown.add(&text[from..meant.start]);
        let start = shown.0.len();
        shown.add(&text[meant.start..last]);
        let span = start..shown.0.len();
        shown.add(&text[last..to]);
        shown.cut(to < end);
        let column = text[begin..meant.start].chars().count() + 1;
        Excerpt { line: number + 1, column, text: shown.0, span }
    }
}

/// A line in the making.
#[derive(Default)]
struct Shown(String);

impl Shown {
    fn cut(&mut self, is_cut: bool) {
        if is_cut {
            self.0.push('…');
        }
    }
    fn add(&mut self, part: &str) {
        for c in part.chars() {
            if c != '\t' && is_hidden(c) { push_escape(&mut self.0, c) } else { self.0.push(c) }
        }
    }
}

/// The place within the text, on whole characters, and no longer than its first line.
fn within(text: &str, place: &Range<usize>) -> Range<usize> {
    let start = before(text, place.start);
    let whole = |at: &usize| text.is_char_boundary(*at);
    let end = (place.end.clamp(start, text.len())..=text.len()).find(whole).unwrap_or(start);
    let line = text[start..end].find(['\n', '\r']).unwrap_or(end - start);
    start..start + line
}

/// The last beginning of a character that is not behind a byte.
fn before(text: &str, at: usize) -> usize {
    let whole = |at: &usize| text.is_char_boundary(*at);
    (0..=at.min(text.len())).rev().find(whole).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excerpt(text: &str, place: Range<usize>) -> Excerpt {
        Lines::of(text).excerpt(text, &place)
    }

    #[test]
    fn an_escape_before_a_place_moves_what_is_shown_and_not_where_it_stands() {
        let text = "a = 1\nb\u{9b} = 'x\u{202e}'\n";
        let value = text.find('\'').unwrap();
        let found = excerpt(text, value..text.len() - 1);
        assert_eq!((found.line, found.column), (2, 6));
        assert_eq!(found.text, "b\\u{9b} = 'x\\u{202e}'");
        assert_eq!(&found.text[found.span], "'x\\u{202e}'");
    }

    #[test]
    fn of_a_long_line_the_part_around_the_place_is_shown() {
        let text = format!("{}!{}", "ä".repeat(3000), "ö".repeat(3000));
        let found = excerpt(&text, 6000..6001);
        assert_eq!((found.line, found.column), (1, 3001));
        assert_eq!(&found.text[found.span.clone()], "!");
        assert!(found.text.len() < 2 * SHOWN + 10, "{}", found.text.len());
        assert!(found.text.starts_with("…ä") && found.text.ends_with("ö…"));
        let whole = excerpt(&text, 0..text.len());
        assert!(whole.span == (0..SHOWN) && whole.text.len() < 2 * SHOWN + 10);
    }
}

//! A file that is not XML.

use crate::findings::Findings;
use std::ops::Range;
use wrasse_document::Complaint;

/// The complaint about a file that is not XML.
pub(crate) fn not_xml(
    why: &roxmltree::Error,
    help: &str,
    text: &str,
    mut found: Findings,
) -> Vec<Complaint> {
    let position = why.pos();
    let at = byte_at(text, position.row, position.col);
    let told = why.to_string();
    let message = told.strip_suffix(&format!(" at {position}")).unwrap_or(&told);
    found.error(&at, format!("not XML: {message}"), "here", help);
    found.into_complaints()
}

/// The character at a row and column, both from 1.
fn byte_at(text: &str, row: u32, column: u32) -> Range<usize> {
    let before: usize =
        text.split_inclusive('\n').take(row.saturating_sub(1) as usize).map(str::len).sum();
    let line = text.get(before..).unwrap_or_default();
    let within: usize =
        line.chars().take(column.saturating_sub(1) as usize).map(char::len_utf8).sum();
    let start = before + within;
    let length = text.get(start..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    start..start + length
}

//! A file that is not XML, or that no parser should be given.

use crate::findings::Findings;
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};

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

/// Attributes of one element: the parser compares each with all others.
const MOST_ATTRIBUTES: usize = 500;

/// The complaint about an element with more attributes than any model has, if there is one.
pub(crate) fn check_attributes(source: &Arc<Source>) -> Result<(), Vec<Complaint>> {
    let text = &source.text;
    // No attribute holds a pointed bracket that opens.
    let tags = text.split('<').filter(|tag| tag.len() > 4 * MOST_ATTRIBUTES);
    let is_comment = |tag: &&str| tag.starts_with("!--") || tag.starts_with("![CDATA[");
    let mut crowded = tags.filter(|tag| tag.matches('=').count() > MOST_ATTRIBUTES);
    let Some(tag) = crowded.find(|tag| !is_comment(tag)) else { return Ok(()) };
    let begin = tag.as_ptr().addr() - text.as_ptr().addr();
    let mut found = Findings::new(source);
    let message = format!("an element with more than {MOST_ATTRIBUTES} attributes");
    found.error(&(begin..begin + 1), message, "this element", "no model has so many");
    Err(found.into_complaints())
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

//! Text as a terminal may show it: what would move its cursor, colour it, turn its direction or not
//! be seen at all is written as an escape.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::ops::RangeInclusive;

/// Characters without a glyph of their own, beside the controls (C0, DEL, C1): they are not seen, or
/// change how others are seen.
const UNSEEN: [RangeInclusive<char>; 19] = [
    // Soft hyphen, grapheme joiner, Arabic letter mark, Hangul fillers, Khmer vowels, Mongolian marks.
    '\u{ad}'..='\u{ad}',
    '\u{34f}'..='\u{34f}',
    '\u{61c}'..='\u{61c}',
    '\u{115f}'..='\u{1160}',
    '\u{17b4}'..='\u{17b5}',
    '\u{180b}'..='\u{180f}',
    // Zero widths and marks of direction.
    '\u{200b}'..='\u{200f}',
    // Line and paragraph separators, embeddings and overrides of direction.
    '\u{2028}'..='\u{202e}',
    // Word joiner, invisible operators, isolates of direction.
    '\u{2060}'..='\u{206f}',
    '\u{3164}'..='\u{3164}',
    // Variation selectors, byte order mark, Hangul filler, annotation marks, shorthand controls.
    '\u{fe00}'..='\u{fe0f}',
    '\u{feff}'..='\u{feff}',
    '\u{ffa0}'..='\u{ffa0}',
    '\u{fff0}'..='\u{fffb}',
    '\u{13430}'..='\u{1343f}',
    '\u{1bca0}'..='\u{1bca3}',
    // Controls of musical notation, tags, more variation selectors.
    '\u{1d173}'..='\u{1d17a}',
    '\u{e0000}'..='\u{e007f}',
    '\u{e0100}'..='\u{e01ef}',
];

/// Whether a character does something else than to show itself.
pub(crate) fn is_hidden(c: char) -> bool {
    if c < '\u{ad}' { c.is_control() } else { UNSEEN.iter().any(|range| range.contains(&c)) }
}

/// A text on one line, with every character that is not seen written as an escape such as `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// A text of several lines: the same, but its lines stay.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c != '\n' && is_hidden(c))
}

/// JSON that means the same, with every character that is not seen as an escape of JSON.
pub fn visible_json(json: &str) -> Cow<'_, str> {
    // Outside its strings JSON has no such character but line ends and tabs, and inside none of these.
    let hidden = |c: char| !matches!(c, '\n' | '\r' | '\t') && is_hidden(c);
    if !json.contains(hidden) {
        return Cow::Borrowed(json);
    }
    let mut shown = String::with_capacity(json.len());
    for c in json.chars() {
        if hidden(c) {
            let mut units = [0; 2];
            for unit in c.encode_utf16(&mut units) {
                // Writing to a string cannot fail.
                let _ = write!(shown, "\\u{unit:04x}");
            }
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

fn escaped(text: &str, hidden: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if hidden(c) { push_escape(&mut shown, c) } else { shown.push(c) }
    }
    Cow::Owned(shown)
}

/// The escape that a literal of Rust would have: `\n`, `\t`, `\r`, else the number of the character.
pub(crate) fn push_escape(shown: &mut String, c: char) {
    match c {
        '\n' | '\r' | '\t' => shown.extend(c.escape_default()),
        _ => shown.extend(c.escape_unicode()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_or_hide_is_written_as_its_number() {
        for (hidden, shown) in [
            ("\u{1b}[31m", r"\u{1b}[31m"),
            ("\u{7}\u{7f}", r"\u{7}\u{7f}"),
            ("\u{9b}31m", r"\u{9b}31m"),
            ("a\u{202e}b\u{2066}c\u{2069}", r"a\u{202e}b\u{2066}c\u{2069}"),
            ("\u{200b}\u{feff}\u{ad}", r"\u{200b}\u{feff}\u{ad}"),
            ("\u{e0041}", r"\u{e0041}"),
            ("a\r\n\tb", r"a\r\n\tb"),
        ] {
            assert_eq!(visible(hidden), shown);
        }
        assert_eq!(visible_lines("a\r\nb"), "a\\r\nb");
    }

    #[test]
    fn letters_of_any_script_stay_as_they_are() {
        let text = "Müller 漢字 עברית العربية e\u{301} N·m 😀 \\u{1b}";
        assert!(matches!(visible(text), Cow::Borrowed(same) if same == text));
    }

    #[test]
    fn json_keeps_its_meaning() {
        let value = serde_json::json!({ "a\u{9b}": "\u{202e}\u{e0041}\u{1b}", "b": 1 });
        for json in [value.to_string(), format!("{value:#}")] {
            let shown = visible_json(&json);
            assert!(!shown.contains(|c| c != '\n' && is_hidden(c)), "{shown}");
            assert_eq!(serde_json::from_str::<serde_json::Value>(&shown).unwrap(), value);
        }
    }
}

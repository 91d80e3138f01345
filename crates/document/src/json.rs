//! A JSON text as the same positioned tree that a TOML file gives, so that one walk reads both.

use crate::positioned::{Entry, Positioned, Table, Value};
use crate::{Complaint, Source};
use serde::de::IgnoredAny;
use std::collections::btree_map::Entry as Slot;
use std::ops::Range;
use std::sync::Arc;

/// The tree of a text, or all that keeps it from being one object of JSON.
pub(crate) fn parse(source: &Arc<Source>) -> Result<Table, Vec<Complaint>> {
    // The grammar is serde's; behind it only the places are looked for.
    if let Err(error) = serde_json::from_str::<IgnoredAny>(&source.text) {
        return Err(vec![not_json(source, &error)]);
    }
    let mut reading = Reading { source, at: 0, depth: 0, complaints: vec![] };
    let root = reading.value();
    let Reading { mut complaints, .. } = reading;
    match root {
        Some(Positioned { value: Value::Table(table), .. }) if complaints.is_empty() => Ok(table),
        Some(other) if !matches!(other.value, Value::Table(_)) => {
            let message = format!("the file must be an object, found {}", other.value.kind());
            let help = "an object names its values: {\"name\": value, …}";
            complaints.push(
                Complaint::error(source, message).at(other.span, "no object").with_help(help),
            );
            Err(complaints)
        }
        _ if complaints.is_empty() => Err(vec![Complaint::error(source, "not JSON")]),
        _ => Err(complaints),
    }
}

/// A text of sound JSON, and how far it is read.
struct Reading<'s> {
    source: &'s Arc<Source>,
    at: usize,
    /// Values around this one.
    depth: usize,
    complaints: Vec<Complaint>,
}

/// How deep values may lie in each other: each level takes a piece of the stack.
const DEEPEST: usize = 100;

impl Reading<'_> {
    fn peek(&self) -> Option<u8> {
        self.source.text.as_bytes().get(self.at).copied()
    }
    /// Past spaces and the marks between values.
    fn skip(&mut self) {
        while self.peek().is_some_and(|c| b" \t\r\n,:".contains(&c)) {
            self.at += 1;
        }
    }
    fn complain(&mut self, span: Range<usize>, message: &str, label: &str, help: &str) {
        let complaint = Complaint::error(self.source, message).at(span, label);
        self.complaints.push(complaint.with_help(help));
    }
    /// The value that comes next; nothing if the text is not what serde took it for.
    fn value(&mut self) -> Option<Positioned> {
        self.skip();
        let from = self.at;
        if self.depth == DEEPEST {
            let message = format!("values lie deeper in each other than {DEEPEST} levels");
            self.complain(from..from + 1, &message, "too deep", "the book says what a file holds");
            return None;
        }
        self.depth += 1;
        let value = match self.peek()? {
            b'{' => Value::Table(self.object()?),
            b'[' => Value::Array(self.list()?),
            b'"' => Value::String(self.string()?),
            _ => self.word()?,
        };
        self.depth -= 1;
        Some(Positioned { span: from..self.at, value })
    }
    fn object(&mut self) -> Option<Table> {
        let mut table = Table::new();
        self.at += 1;
        loop {
            self.skip();
            if self.peek()? == b'}' {
                self.at += 1;
                return Some(table);
            }
            let from = self.at;
            let name = self.string()?;
            let key_span = from..self.at;
            let item = self.value()?;
            match table.entry(name) {
                Slot::Vacant(free) => {
                    free.insert(Entry { key_span, item });
                }
                Slot::Occupied(first) => {
                    let message = format!("{:?} is given twice in one object", first.key());
                    self.complain(key_span, &message, "the second", "leave one of them out");
                }
            }
        }
    }
    fn list(&mut self) -> Option<Vec<Positioned>> {
        let mut items = vec![];
        self.at += 1;
        loop {
            self.skip();
            if self.peek()? == b']' {
                self.at += 1;
                return Some(items);
            }
            items.push(self.value()?);
        }
    }
    fn string(&mut self) -> Option<String> {
        let from = self.at;
        let mut escaped = false;
        let inside = self.source.text.as_bytes().get(from + 1..)?;
        let end = inside.iter().position(|&c| {
            let ends = c == b'"' && !escaped;
            escaped = c == b'\\' && !escaped;
            ends
        })?;
        self.at = from + end + 2;
        serde_json::from_str(self.source.text.get(from..self.at)?).ok()
    }
    /// A number, `true`, `false` or `null`.
    fn word(&mut self) -> Option<Value> {
        let from = self.at;
        let rest = self.source.text.get(from..)?;
        let part = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        let word = &rest[..rest.find(|c| !part(c)).unwrap_or(rest.len())];
        self.at += word.len().max(1);
        if let Ok(flag) = word.parse() {
            return Some(Value::Boolean(flag));
        }
        if word == "null" {
            let help = "leave the key out: what is not given is zero, or the identity";
            self.complain(from..self.at, "null is no value", "no value", help);
            return Some(Value::Integer(0));
        }
        let whole = word.parse().map(Value::Integer).ok();
        whole.or_else(|| word.parse().map(Value::Float).ok())
    }
}

/// What keeps a text from being JSON.
fn not_json(source: &Arc<Source>, error: &serde_json::Error) -> Complaint {
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    let at = token(&source.text, error.line(), error.column());
    Complaint::error(source, format!("not JSON: {message}")).at(at, "here")
}

/// Byte range of the word, number or mark that ends at a line and column, both from 1.
fn token(text: &str, line: usize, column: usize) -> Range<usize> {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut end = (before + column).min(text.len());
    while !text.is_char_boundary(end) {
        end += 1;
    }
    let head = &text[..end];
    let start = if let Some(word) = head.strip_suffix('"') {
        word.rfind('"').unwrap_or(word.len())
    } else {
        let number = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        let start = head.trim_end_matches(number).len();
        start.min(head.char_indices().last().map_or(0, |(last, _)| last))
    };
    start..end
}

#[cfg(test)]
mod tests {
    use crate::{Document, at};

    #[test]
    fn every_value_knows_its_place() {
        let text = "{\"a\": [1, -2.5e3, true],\n \"b\\u0041\\\"\": {\"c\": \"ä\"}}";
        let document = Document::parse_json("a.json", text).unwrap();
        let at = |path: &[crate::Step<'_>]| document.span(path).map(|s| &text[s]);
        assert_eq!(at(at!["a", 1]), Some("-2.5e3"));
        assert_eq!(at(at!["bA\"", "c"]), Some("\"ä\""));
        assert_eq!(document.key_span(at!["bA\""]).map(|s| &text[s]), Some("\"b\\u0041\\\"\""));
    }

    #[test]
    fn what_json_allows_and_nobody_means_is_a_complaint() {
        let said = |text: &str| {
            let all = Document::parse_json("a.json", text).unwrap_err();
            all.iter().map(|c| c.message.clone()).collect::<Vec<_>>()
        };
        assert_eq!(said("[1]"), ["the file must be an object, found a list"]);
        assert_eq!(
            said("{\"a\": 1, \"a\": 2, \"b\": {\"a\": null, \"a\": 1}}"),
            [
                "\"a\" is given twice in one object",
                "null is no value",
                "\"a\" is given twice in one object"
            ]
        );
        assert_eq!(said("{\"a\": 1"), ["not JSON: EOF while parsing an object"]);
        let deep = format!("{{\"a\": {}{}}}", "[".repeat(100_000), "]".repeat(100_000));
        assert_eq!(said(&deep), ["values lie deeper in each other than 100 levels"]);
        for deep in ["[", "{\"a\":"] {
            assert!(said(&deep.repeat(100_000))[0].starts_with("not JSON: EOF"));
        }
    }
}

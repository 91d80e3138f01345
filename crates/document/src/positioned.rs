//! A TOML document as a tree whose every value knows where it stands.

use crate::excerpt::Lines;
use crate::{Complaint, Source};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// A value and its place.
#[derive(Debug, Clone)]
pub(crate) struct Positioned {
    /// Byte range of the value; of the header for a table that has one.
    pub(crate) span: Range<usize>,
    pub(crate) value: Value,
}

/// Keys in alphabetical order: results do not depend on the order of the file.
pub(crate) type Table = BTreeMap<String, Entry>;

/// A value and the key before it.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key_span: Range<usize>,
    pub(crate) item: Positioned,
}

#[derive(Debug, Clone)]
pub(crate) enum Value {
    String(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    Datetime(toml::value::Datetime),
    Array(Vec<Positioned>),
    Table(Table),
}

impl Value {
    /// What it is, in words.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::String(_) => "a string",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a number",
            Self::Boolean(_) => "a true or false",
            Self::Datetime(_) => "a date",
            Self::Array(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

/// The positioned tree of a text, or all that keeps it from being TOML.
pub(crate) fn parse(source: &Arc<Source>) -> Result<Table, Vec<Complaint>> {
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    let mut complaints = syntax_complaints(source, &errors);
    if complaints.is_empty() {
        let tree = table_of(source, table.get_ref(), &mut complaints);
        if complaints.is_empty() {
            return Ok(tree);
        }
    }
    Err(complaints)
}

/// The value that a part of a text is.
pub(crate) fn value_of(source: &Arc<Source>, span: Range<usize>) -> Result<Positioned, Complaint> {
    let begin = span.start;
    let value = DeValue::parse(&source.text[span]).map_err(|error| {
        let at = error.span().map_or(0..0, |at| at.start + begin..at.end + begin);
        Complaint::error(source, format!("not TOML: {}", error.message()))
            .at(at, "here")
            .with_help("a number stands alone: its key says the unit; a text may stand in quotes")
    })?;
    let mut complaints = vec![];
    let mut value = positioned(source, &value, &mut complaints);
    value.shift(begin);
    match complaints.pop() {
        None => Ok(value),
        Some(mut complaint) => {
            complaint.span = complaint.span.map(|at| at.start + begin..at.end + begin);
            Err(complaint)
        }
    }
}

impl Positioned {
    /// A string that stands without quotes.
    pub(crate) fn string(text: &str, span: Range<usize>) -> Self {
        Self { span, value: Value::String(text.to_owned()) }
    }

    /// Let it and all in it stand so many bytes farther on.
    pub(crate) fn shift(&mut self, by: usize) {
        let farther = |span: &mut Range<usize>| *span = span.start + by..span.end + by;
        farther(&mut self.span);
        match &mut self.value {
            Value::Array(items) => items.iter_mut().for_each(|item| item.shift(by)),
            Value::Table(table) => table.values_mut().for_each(|entry| {
                farther(&mut entry.key_span);
                entry.item.shift(by);
            }),
            _ => {}
        }
    }
}

/// One complaint for each line: what follows on the same line follows from the first.
fn syntax_complaints(source: &Arc<Source>, errors: &[toml::de::Error]) -> Vec<Complaint> {
    let lines = Lines::of(&source.text);
    let mut seen = BTreeSet::new();
    let mut complaints = Vec::new();
    for error in errors {
        let span = error.span();
        if !seen.insert(span.as_ref().map(|s| lines.number(s.start))) {
            continue;
        }
        let complaint = Complaint::error(source, format!("not TOML: {}", error.message()));
        let Some(span) = span else {
            complaints.push(complaint);
            continue;
        };
        let bare_unit = source.text.get(span.clone()).is_some_and(begins_with_number);
        let complaint = complaint.at(span, "here");
        complaints.push(if bare_unit {
            complaint.with_help("write the number alone: its key says the unit")
        } else {
            complaint
        });
    }
    complaints
}

/// `3 kg` is a number to its author.
fn begins_with_number(value: &str) -> bool {
    value.trim_start_matches(['-', '+', '.']).starts_with(|c: char| c.is_ascii_digit())
}

fn table_of(source: &Arc<Source>, table: &DeTable<'_>, complaints: &mut Vec<Complaint>) -> Table {
    let entry =
        |(key, item): (&toml::Spanned<toml::de::DeString<'_>>, &toml::Spanned<DeValue<'_>>)| {
            let item = positioned(source, item, complaints);
            (key.get_ref().to_string(), Entry { key_span: key.span(), item })
        };
    table.iter().map(entry).collect()
}

fn positioned(
    source: &Arc<Source>,
    item: &toml::Spanned<DeValue<'_>>,
    complaints: &mut Vec<Complaint>,
) -> Positioned {
    let value = match item.get_ref() {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(digits) => Value::Integer(
            i64::from_str_radix(digits.as_str(), digits.radix()).unwrap_or_else(|_| {
                let complaint = Complaint::error(source, "integer beyond the range of 64 bits");
                complaints.push(complaint.at(item.span(), "too large"));
                0
            }),
        ),
        DeValue::Float(digits) => Value::Float(digits.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Boolean(*flag),
        DeValue::Datetime(date) => Value::Datetime(*date),
        DeValue::Array(items) => {
            Value::Array(items.iter().map(|i| positioned(source, i, complaints)).collect())
        }
        DeValue::Table(table) => Value::Table(table_of(source, table, complaints)),
    };
    Positioned { span: item.span(), value }
}

/// `over` laid over `base`: tables merge key by key, everything else is replaced.
pub(crate) fn lay_over(base: &mut Table, over: &Table) {
    for (key, entry) in over {
        match (base.get_mut(key).map(|e| &mut e.item.value), &entry.item.value) {
            (Some(Value::Table(below)), Value::Table(above)) => lay_over(below, above),
            _ => {
                base.insert(key.clone(), entry.clone());
            }
        }
    }
}

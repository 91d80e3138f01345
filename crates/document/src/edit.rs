//! A document with a value more or less than its text has: what a program lays over a user's file.

use crate::document::{Document, Step};
use crate::positioned::{Entry, Positioned, Table, Value};
use std::ops::Range;

impl Document {
    /// The value at a path, if it is there.
    pub fn value(&self, path: &[Step<'_>]) -> Option<toml::Value> {
        self.exact(path).map(|item| plain(&item.value))
    }

    /// Number of values in the list at a path; zero where there is none.
    pub fn len(&self, path: &[Step<'_>]) -> usize {
        match self.exact(path).map(|item| &item.value) {
            Some(Value::Array(items)) => items.len(),
            _ => 0,
        }
    }

    /// The document with a value at a path: tables above it are made where there are none, and behind the
    /// last value of a list it is one more. Its place in the text is the end. A path that leads through
    /// something else than tables and lists changes nothing.
    #[must_use]
    pub fn with(&self, path: &[Step<'_>], value: &toml::Value) -> Self {
        let mut document = self.clone();
        let end = document.source().text.len();
        put(document.root_mut(), path, positioned(value, &(end..end)));
        document
    }

    /// The document without the value at a path.
    #[must_use]
    pub fn without(&self, path: &[Step<'_>]) -> Self {
        let mut document = self.clone();
        remove(document.root_mut(), path);
        document
    }
}

fn plain(value: &Value) -> toml::Value {
    match value {
        Value::String(text) => toml::Value::String(text.clone()),
        Value::Integer(x) => toml::Value::Integer(*x),
        Value::Float(x) => toml::Value::Float(*x),
        Value::Boolean(flag) => toml::Value::Boolean(*flag),
        Value::Datetime(date) => toml::Value::Datetime(*date),
        Value::Array(items) => {
            toml::Value::Array(items.iter().map(|item| plain(&item.value)).collect())
        }
        Value::Table(table) => {
            let entries = table.iter();
            let plain = |(key, entry): (&String, &Entry)| (key.clone(), plain(&entry.item.value));
            toml::Value::Table(entries.map(plain).collect())
        }
    }
}

fn positioned(value: &toml::Value, span: &Range<usize>) -> Positioned {
    let value = match value {
        toml::Value::String(text) => Value::String(text.clone()),
        toml::Value::Integer(x) => Value::Integer(*x),
        toml::Value::Float(x) => Value::Float(*x),
        toml::Value::Boolean(flag) => Value::Boolean(*flag),
        toml::Value::Datetime(date) => Value::Datetime(*date),
        toml::Value::Array(items) => {
            Value::Array(items.iter().map(|item| positioned(item, span)).collect())
        }
        toml::Value::Table(table) => {
            let entry = |(key, item): (&String, &toml::Value)| {
                let item = positioned(item, span);
                (key.clone(), Entry { key_span: span.clone(), item })
            };
            Value::Table(table.iter().map(entry).collect())
        }
    };
    Positioned { span: span.clone(), value }
}

fn put(table: &mut Table, path: &[Step<'_>], value: Positioned) {
    let Some((Step::Key(key), rest)) = path.split_first() else { return };
    let span = value.span.clone();
    if rest.is_empty() {
        let key_span = table.get(*key).map_or(span, |entry| entry.key_span.clone());
        table.insert((*key).to_owned(), Entry { key_span, item: value });
        return;
    }
    let empty = match rest[0] {
        Step::Key(_) => Value::Table(Table::new()),
        Step::Index(_) => Value::Array(vec![]),
    };
    let made =
        || Entry { key_span: span.clone(), item: Positioned { span: span.clone(), value: empty } };
    let entry = table.entry((*key).to_owned()).or_insert_with(made);
    put_within(&mut entry.item, rest, value);
}

fn put_within(item: &mut Positioned, path: &[Step<'_>], value: Positioned) {
    match (&mut item.value, path) {
        (Value::Table(table), [Step::Key(_), ..]) => put(table, path, value),
        (Value::Array(items), [Step::Index(i)]) if *i < items.len() => items[*i] = value,
        (Value::Array(items), [Step::Index(i)]) if *i == items.len() => items.push(value),
        (Value::Array(items), [Step::Index(i), rest @ ..]) if *i < items.len() => {
            put_within(&mut items[*i], rest, value);
        }
        _ => {}
    }
}

fn remove(table: &mut Table, path: &[Step<'_>]) {
    let Some((Step::Key(key), rest)) = path.split_first() else { return };
    if rest.is_empty() {
        table.remove(*key);
    } else if let Some(entry) = table.get_mut(*key) {
        remove_within(&mut entry.item, rest);
    }
}

fn remove_within(item: &mut Positioned, path: &[Step<'_>]) {
    match (&mut item.value, path) {
        (Value::Table(table), [Step::Key(_), ..]) => remove(table, path),
        (Value::Array(items), [Step::Index(i)]) if *i < items.len() => {
            items.remove(*i);
        }
        (Value::Array(items), [Step::Index(i), rest @ ..]) if *i < items.len() => {
            remove_within(&mut items[*i], rest);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::at;

    const TEXT: &str = "name = \"m\"\n[control]\nlaw = \"x\"\n[[compare]]\naxis = \"a\"\n\
                        [[compare.row]]\nname = \"r\"\nset.seed = 3\n";

    fn document() -> Document {
        Document::parse("m.toml", TEXT).unwrap_or_else(|found| panic!("{found:?}"))
    }

    #[test]
    fn a_value_is_put_anywhere_and_found_again() {
        let row: toml::Value = toml::Value::Table("name = \"s\"".parse().expect("a table"));
        let more = document()
            .with(at!["compare", 0, "row", 1], &row)
            .with(at!["control", "steering", "gain"], &2.5.into())
            .with(at!["failure"], &toml::Value::Array(vec![]))
            .with(at!["name"], &"n".into());
        assert_eq!(more.value(at!["compare", 0, "row", 1, "name"]), Some("s".into()));
        assert_eq!(more.len(at!["compare", 0, "row"]), 2);
        assert_eq!(more.value(at!["control", "steering", "gain"]), Some(2.5.into()));
        assert_eq!(more.value(at!["control", "law"]), Some("x".into()));
        assert_eq!(more.value(at!["failure"]), Some(toml::Value::Array(vec![])));
        // What stands in the text keeps its place, and its text.
        assert_eq!(more.span(at!["control", "law"]), document().span(at!["control", "law"]));
        assert_eq!(more.source().text, TEXT);
        assert_eq!(more.span(at!["failure"]), Some(TEXT.len()..TEXT.len()));
    }

    #[test]
    fn a_path_through_what_is_no_table_and_no_list_changes_nothing() {
        for path in [at!["name", "inner"] as &[Step<'_>], at!["compare", 2], at!["name", 0], &[]] {
            let same = document().with(path, &true.into());
            assert_eq!(same.canonical(&[]), document().canonical(&[]), "{path:?}");
            let same = document().without(path);
            assert_eq!(same.canonical(&[]), document().canonical(&[]), "{path:?}");
        }
    }

    #[test]
    fn a_value_is_taken_away() {
        let less = document().without(at!["compare", 0, "row", 0, "set", "seed"]);
        assert_eq!(less.value(at!["compare", 0, "row", 0, "set", "seed"]), None);
        assert_eq!(less.len(at!["compare", 0, "row"]), 1);
        let less = less.without(at!["compare", 0]);
        assert_eq!((less.len(at!["compare"]), less.value(at!["name"])), (0, Some("m".into())));
    }
}

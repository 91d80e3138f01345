//! The tables of a format, in the order of its structs.

use super::shapes::{Format, kind, meaning, only_key};
use super::units::unit;
use super::{Default, KeyRow, KeyTable};
use serde_json::Value as Schema;

/// All tables of a format, each behind the one in which it is first named. One that several name stands
/// once.
pub(super) fn tables(schema: &Schema) -> Vec<KeyTable> {
    let mut found = Found { format: Format(schema), tables: vec![], named: vec![] };
    found.table(schema, &Path { text: String::new(), is_list: false }, meaning(schema));
    found.tables
}

/// Where a table stands in a file.
#[derive(Clone)]
struct Path {
    text: String,
    is_list: bool,
}

impl Path {
    fn written(&self) -> String {
        match (self.text.is_empty(), self.is_list) {
            (true, _) => String::new(),
            (_, true) => format!("[[{}]]", self.text),
            (_, false) => format!("[{}]", self.text),
        }
    }
    fn below(&self, key: &str, is_list: bool) -> Self {
        let dot = if self.text.is_empty() { "" } else { "." };
        Self { text: format!("{}{dot}{key}", self.text), is_list }
    }
    /// Its own key.
    fn key(&self) -> &str {
        self.text.trim_end_matches(".NAME").rsplit('.').next().unwrap_or_default()
    }
}

struct Found<'s> {
    format: Format<'s>,
    tables: Vec<KeyTable>,
    /// Definitions that have a table, and where.
    named: Vec<(&'s str, String)>,
}

impl<'s> Found<'s> {
    fn table(&mut self, schema: &'s Schema, path: &Path, about: String) {
        let (mut rows, mut below) = (vec![], vec![]);
        let shapes = self.format.options(schema);
        let alternatives: Vec<&Schema> =
            shapes.into_iter().filter(|shape| shape["properties"].is_object()).collect();
        for shape in &alternatives {
            let Some(properties) = shape["properties"].as_object() else { continue };
            for (key, of_key) in properties {
                if rows.iter().any(|row: &KeyRow| row.key == *key) {
                    continue;
                }
                let (mut row, table) = self.row(shape, key, of_key, path);
                if let Some((inner, place)) = table {
                    self.name_place(&mut row, inner, &place, &mut below);
                }
                rows.push(row);
            }
        }
        let about = if alternatives.len() > 1 {
            // Of several shapes none is required.
            for row in &mut rows {
                row.default = Default::None;
            }
            format!("{about}: the keys {}", keys_of_each(&alternatives))
        } else {
            about
        };
        self.tables.push(KeyTable { path: path.written(), meaning: about, rows });
        for (inner, place, about) in below {
            self.table(inner, &place, about);
        }
    }

    fn row(
        &self,
        shape: &'s Schema,
        key: &str,
        schema: &'s Schema,
        path: &Path,
    ) -> (KeyRow, Option<(&'s Schema, Path)>) {
        let is_required =
            shape["required"].as_array().is_some_and(|all| all.iter().any(|name| name == key));
        let default = match schema.get("default") {
            _ if is_required => Default::Required,
            Some(value) => as_toml(value).map_or(Default::None, Default::Value),
            None => Default::None,
        };
        let (_, resolved) = self.format.resolved(schema);
        // A key that alone makes a shape is told by the shape.
        let of_shape = only_key(shape).map_or(String::new(), |_| meaning(shape));
        let told = [meaning(schema), of_shape, meaning(resolved)];
        let meaning = told.into_iter().find(|text| !text.is_empty()).unwrap_or_default();
        let row = KeyRow {
            key: key.to_owned(),
            meaning,
            unit: if self.is_number(schema) {
                unit(key, path.key()).to_owned()
            } else {
                String::new()
            },
            value: self.format.value(schema),
            default,
        };
        (row, self.inner(schema, &path.below(key, false)))
    }

    /// Whether a value is a number, or numbers in a list or by name.
    fn is_number(&self, schema: &'s Schema) -> bool {
        self.format.options(schema).iter().any(|option| match kind(option) {
            "number" => true,
            "array" => self.is_number(&option["items"]),
            "object" => option
                .get("additionalProperties")
                .is_some_and(|of| of.is_object() && self.is_number(of)),
            _ => false,
        })
    }

    /// The table that a value is or holds, and where that stands.
    fn inner(&self, schema: &'s Schema, path: &Path) -> Option<(&'s Schema, Path)> {
        let (_, resolved) = self.format.resolved(schema);
        let options = self.format.options(resolved);
        if let Some(list) = options.iter().find(|option| kind(option) == "array") {
            let place = Path { is_list: true, ..path.clone() };
            return self.inner(&list["items"], &place);
        }
        let has_keys = |option: &&&Schema| option["properties"].is_object();
        if let Some(named) = options.iter().find_map(|o| o.get("additionalProperties"))
            && named.is_object()
        {
            return self.inner(named, &path.below("NAME", path.is_list));
        }
        // A choice of tables with one plain key each is told where it is named.
        let tables: Vec<_> = options.iter().filter(has_keys).collect();
        let is_plain = |option: &&&&Schema| {
            only_key(option).is_some_and(|(_, of)| self.inner(of, path).is_none())
        };
        let all_plain = tables.len() > 1 || options.len() > 1;
        if tables.is_empty() || (all_plain && tables.iter().all(|t| is_plain(&t))) {
            return None;
        }
        Some((schema, path.clone()))
    }

    /// The row of a key says where its table stands; a table that has none yet gets one.
    fn name_place(
        &mut self,
        row: &mut KeyRow,
        inner: &'s Schema,
        place: &Path,
        below: &mut Vec<(&'s Schema, Path, String)>,
    ) {
        let options = self.format.options(inner);
        let name = self.definition(inner);
        let known = name.and_then(|name| self.named.iter().find(|(known, _)| *known == name));
        let written = known.map_or_else(|| place.written(), |(_, written)| written.clone());
        if known.is_none() {
            if let Some(name) = name {
                self.named.push((name, written.clone()));
            }
            let (_, resolved) = self.format.resolved(inner);
            below.push((inner, place.clone(), meaning(resolved)));
        }
        let words: Vec<_> =
            options.iter().filter(|option| !option["properties"].is_object()).collect();
        let each = words.iter().map(|option| self.format.value(option));
        let what = if place.is_list { "tables" } else { "table" };
        let table = format!("{what} `{written}`");
        row.value = each.chain([table]).collect::<Vec<_>>().join("; or ");
        row.unit.clear();
        // What a table stands for by itself is told in its rows.
        if row.default != Default::Required {
            row.default = Default::None;
        }
    }

    /// The definition behind an optional key or not.
    fn definition(&self, schema: &'s Schema) -> Option<&'s str> {
        let (name, resolved) = self.format.resolved(schema);
        name.or_else(|| {
            let options = resolved["anyOf"].as_array()?;
            options.iter().find_map(|option| self.format.resolved(option).0)
        })
    }
}

/// The keys of several shapes: `rpy_deg`, or `w`, `x`, `y`, `z`.
fn keys_of_each(shapes: &[&Schema]) -> String {
    let keys = |shape: &&Schema| {
        let all = shape["properties"].as_object().into_iter().flat_map(|all| all.keys());
        all.map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
    };
    shapes.iter().map(keys).collect::<Vec<_>>().join(", or ")
}

/// A default as a file would write it; nothing for what is empty.
fn as_toml(value: &Schema) -> Option<String> {
    match value {
        Schema::Null => None,
        Schema::Array(items) if items.is_empty() => None,
        Schema::Object(table) if table.is_empty() => None,
        Schema::String(text) if text.is_empty() => None,
        Schema::Array(items) => {
            let items: Vec<_> = items.iter().filter_map(as_toml).collect();
            Some(format!("[{}]", items.join(", ")))
        }
        Schema::Number(number) => number.as_f64().map(|number| number.to_string()),
        other => Some(other.to_string()),
    }
}

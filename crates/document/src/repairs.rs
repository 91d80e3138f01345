//! What makes a document of a wrong shape readable: a right value for each wrong or missing one.

use crate::Complaint;
use crate::in_part::{Key, UNKNOWN, key, spans_of};
use crate::positioned::{Entry, Positioned, Table, Value};
use serde_json::Value as Schema;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Values for a document, by the places where they belong.
#[derive(Debug, Default)]
pub(crate) struct Repairs {
    /// The keys that were meant by unknown ones.
    meant: BTreeMap<Key, String>,
    /// Right values for wrong ones.
    stand_ins: BTreeMap<Key, Value>,
    /// Wrong values of keys that need not be there.
    left_out: BTreeSet<Key>,
    /// Missing keys of the table at a place (none for the whole file), with their values.
    missing: BTreeMap<Option<Key>, Vec<(String, Value)>>,
}

impl Repairs {
    /// An unknown key stands for the one that was meant.
    pub(crate) fn rename(&mut self, place: &Range<usize>, meant: &str) {
        self.meant.insert(key(place), meant.to_owned());
    }
    /// A right value for the wrong one at a place; the first one holds.
    pub(crate) fn replace(&mut self, place: &Range<usize>, value: Value) {
        self.stand_ins.entry(key(place)).or_insert(value);
    }
    /// A wrong value may go with its key: better nothing than a number that others are held against.
    pub(crate) fn leave_out(&mut self, item: &Positioned) {
        let guess = self.stand_ins.get(&key(&item.span));
        if !matches!(guess, Some(Value::String(word)) if word != UNKNOWN) {
            self.left_out.insert(key(&item.span));
        }
    }
    /// A value for a key that the table at a place has not.
    pub(crate) fn add(&mut self, table: Option<&Range<usize>>, name: &str, value: Value) {
        self.missing.entry(table.map(key)).or_default().push((name.to_owned(), value));
    }
    /// Those of another walk as well.
    pub(crate) fn take(&mut self, other: Self) {
        self.meant.extend(other.meant);
        self.stand_ins.extend(other.stand_ins);
        self.left_out.extend(other.left_out);
        for (place, values) in other.missing {
            self.missing.entry(place).or_default().extend(values);
        }
    }
    /// Mend a document about which there are complaints; what nothing mends is taken away.
    pub(crate) fn mend(&self, root: &mut Table, complaints: &[Complaint]) {
        let mut faulty = spans_of(complaints);
        for place in self.missing.keys().flatten() {
            faulty.remove(place);
        }
        self.table(root, None, &faulty);
    }
    fn table(&self, table: &mut Table, here: Option<&Range<usize>>, faulty: &BTreeSet<Key>) {
        self.let_be_meant(table);
        table.retain(|_, entry| {
            let is_faulty = faulty.contains(&key(&entry.key_span));
            // A list of tables has the place of its first table: its items are looked at by themselves.
            let of_tables = matches!(&entry.item.value, Value::Array(items)
                if items.iter().any(|item| item.span == entry.item.span));
            let is_left_out = self.left_out.contains(&key(&entry.item.span)) && !of_tables;
            !is_faulty && !is_left_out && (of_tables || self.stays(&mut entry.item, faulty))
        });
        for entry in table.values_mut() {
            self.within(&mut entry.item, faulty);
        }
        for (name, value) in self.missing.get(&here.map(key)).into_iter().flatten() {
            let nowhere = here.map_or(0..0, |span| span.end..span.end);
            let item = Positioned { span: nowhere.clone(), value: value.clone() };
            table.entry(name.clone()).or_insert(Entry { key_span: nowhere, item });
        }
    }
    /// What stands below a value.
    fn within(&self, item: &mut Positioned, faulty: &BTreeSet<Key>) {
        let here = item.span.clone();
        match &mut item.value {
            Value::Table(table) => self.table(table, Some(&here), faulty),
            Value::Array(items) => {
                items.retain_mut(|item| self.stays(item, faulty));
                for item in items {
                    self.within(item, faulty);
                }
            }
            _ => {}
        }
    }
    /// Whether a value is right, or has been replaced by a right one: that stands nowhere, at the end
    /// of the wrong one. What is said of it later is dropped.
    fn stays(&self, item: &mut Positioned, faulty: &BTreeSet<Key>) -> bool {
        let place = key(&item.span);
        if let Some(value) = self.stand_ins.get(&place) {
            *item = Positioned { span: item.span.end..item.span.end, value: value.clone() };
            return true;
        }
        !faulty.contains(&place)
    }
    /// Let each unknown key be the one that was meant.
    fn let_be_meant(&self, table: &mut Table) {
        if self.meant.is_empty() {
            return;
        }
        let unknown = table.iter().filter_map(|(name, entry)| {
            self.meant.get(&key(&entry.key_span)).map(|meant| (name.clone(), meant.clone()))
        });
        for (name, meant) in unknown.collect::<Vec<_>>() {
            if !table.contains_key(&meant)
                && let Some(mut entry) = table.remove(&name)
            {
                // No longer at the faulty place, so that it is not taken away.
                entry.key_span = entry.item.span.clone();
                table.insert(meant, entry);
            }
        }
    }
}

/// How deep a value is made up: a format may hold itself.
const DEPTH: usize = 8;

/// A value that one of some shapes allows, where one is as good as another; `choice` finds the shapes
/// that a schema allows.
pub(crate) fn stand_in<'s>(
    options: &[&'s Schema],
    choice: &dyn Fn(&'s Schema) -> Vec<&'s Schema>,
) -> Option<Value> {
    options.iter().find_map(|option| made_up(option, choice, DEPTH))
}

fn made_up<'s>(
    schema: &'s Schema,
    choice: &dyn Fn(&'s Schema) -> Vec<&'s Schema>,
    depth: usize,
) -> Option<Value> {
    let deeper = depth.checked_sub(1)?;
    let any = |schema| choice(schema).into_iter().find_map(|o| made_up(o, choice, deeper));
    let first_word = schema["enum"].as_array().and_then(|words| words.first());
    if let Some(word) = schema["const"].as_str().or(first_word.and_then(Schema::as_str)) {
        return Some(Value::String(word.to_owned()));
    }
    let first = schema["type"].as_array().and_then(|several| several.first());
    match schema["type"].as_str().or(first.and_then(Schema::as_str))? {
        "number" => Some(Value::Float(allowed(schema))),
        #[allow(clippy::cast_possible_truncation, reason = "a small number")]
        "integer" => Some(Value::Integer(allowed(schema).ceil() as i64)),
        "boolean" => Some(Value::Boolean(false)),
        "string" => Some(Value::String(UNKNOWN.to_owned())),
        "array" => {
            let least = schema["minItems"].as_u64().and_then(|n| usize::try_from(n).ok());
            let item = |i: usize| {
                let of_item = schema["prefixItems"].get(i).or_else(|| schema.get("items"));
                of_item.and_then(any).map(|value| Positioned { span: 0..0, value })
            };
            (0..least.unwrap_or(0)).map(item).collect::<Option<_>>().map(Value::Array)
        }
        "object" => {
            let required = schema["required"].as_array().into_iter().flatten();
            let entry = |name: &'s str| {
                let item = Positioned { span: 0..0, value: any(&schema["properties"][name])? };
                Some((name.to_owned(), Entry { key_span: 0..0, item }))
            };
            required.filter_map(Schema::as_str).map(entry).collect::<Option<_>>().map(Value::Table)
        }
        _ => None,
    }
}

/// A number within the bounds of a schema: 1 if it is, for most quantities are above zero.
fn allowed(schema: &Schema) -> f64 {
    let bound = |key: &str| schema[key].as_f64();
    let low = bound("minimum").or(bound("exclusiveMinimum").map(|x| x + 0.5 * x.abs().max(1e-3)));
    let high = bound("maximum").or(bound("exclusiveMaximum").map(|x| x - 0.5 * x.abs().max(1e-3)));
    1.0_f64.max(low.unwrap_or(f64::MIN)).min(high.unwrap_or(f64::MAX))
}

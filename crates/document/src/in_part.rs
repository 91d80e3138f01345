//! Reading on past a wrong shape: what is left of a document when its faulty keys are taken away, and
//! which complaints about the rest still mean something.

use crate::document::Document;
use crate::positioned::{Entry, Positioned, Table, Value};
use crate::schema_walk::Walk;
use crate::{Complaint, schema_of};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::ops::Range;

/// As much of a document as could be read.
#[derive(Debug)]
pub struct Part<T> {
    /// What it says; `None` if too much is missing to go on.
    pub value: Option<T>,
    /// The document that the value was read from: the faulty keys are not in it, all others keep
    /// their places.
    pub document: Document,
    /// What is wrong with the shape of the whole.
    pub complaints: Vec<Complaint>,
}

impl Document {
    /// The document as a `T`, without the keys whose shape is wrong, so that the rest can be checked
    /// for its meaning all the same.
    pub fn read_in_part<T: DeserializeOwned + JsonSchema>(&self) -> Part<T> {
        let schema = schema_of::<T>();
        let walk = Walk::over(self.source(), &schema, self.root());
        let Walk { complaints, meant, stand_ins, missing, .. } = walk;
        let spans: Vec<_> = complaints.iter().filter_map(|c| c.span.clone()).collect();
        let mut document = self.clone();
        rename(document.root_mut(), &meant);
        stand_in(document.root_mut(), &stand_ins);
        fill(document.root_mut(), None, &missing);
        let filled: Vec<_> = missing.into_iter().filter_map(|(place, ..)| place).collect();
        let faulty: Vec<_> = spans.into_iter().filter(|span| !filled.contains(span)).collect();
        let sound = prune_table(document.root_mut(), &faulty);
        let read = if sound { document.read::<T>() } else { Err(vec![]) };
        match read {
            Ok(value) => Part { value: Some(value), document, complaints },
            // What serde says of a sound shape is all that there is to say.
            Err(said) if complaints.is_empty() => Part { value: None, document, complaints: said },
            Err(_) => Part { value: None, document, complaints },
        }
    }

    /// Complaints about shape and about meaning together, in the order of the file. What was said of
    /// a value in which the shape is wrong already is left out: it may follow from that alone.
    pub fn beside(&self, shape: Vec<Complaint>, meaning: Vec<Complaint>) -> Vec<Complaint> {
        if shape.is_empty() {
            return meaning;
        }
        let spans: Vec<_> = shape.iter().filter_map(|c| c.span.clone()).collect();
        let follows = |complaint: &Complaint| match &complaint.span {
            None => true,
            // A stand-in stands nowhere.
            Some(span) if span.is_empty() => true,
            Some(span) => faulty_within(self.root(), span, &spans),
        };
        let mut all = shape;
        all.extend(meaning.into_iter().filter(|complaint| !follows(complaint)));
        all.sort_by_key(|c| c.span.as_ref().map_or(usize::MAX, |s| s.start));
        all
    }
}

/// Let each unknown key stand for the one that was meant.
fn rename(table: &mut Table, meant: &[(Range<usize>, String)]) {
    let keys: Vec<String> = table.keys().cloned().collect();
    for key in keys {
        let span = &table[&key].key_span;
        if let Some((_, name)) = meant.iter().find(|(place, _)| place == span)
            && !table.contains_key(name)
            && let Some(mut entry) = table.remove(&key)
        {
            // No longer at the faulty place, so that it is not taken away.
            entry.key_span = entry.item.span.clone();
            table.insert(name.clone(), entry);
        }
    }
    for entry in table.values_mut() {
        match &mut entry.item.value {
            Value::Table(inner) => rename(inner, meant),
            Value::Array(items) => items.iter_mut().for_each(|item| {
                if let Value::Table(inner) = &mut item.value {
                    rename(inner, meant);
                }
            }),
            _ => {}
        }
    }
}

/// Put right values where wrong ones stand, at a place that is nowhere, so that they are not taken
/// away. What is said of them later is dropped: it belongs to the wrong value.
fn stand_in(table: &mut Table, right: &[(Range<usize>, Value)]) {
    for entry in table.values_mut() {
        replace(&mut entry.item, right);
    }
}

fn replace(item: &mut Positioned, right: &[(Range<usize>, Value)]) {
    if let Some((_, value)) = right.iter().find(|(place, _)| *place == item.span) {
        // The end of the value: still a place to point at, and not the faulty one.
        *item = Positioned { span: item.span.end..item.span.end, value: value.clone() };
    }
    match &mut item.value {
        Value::Table(inner) => stand_in(inner, right),
        Value::Array(items) => items.iter_mut().for_each(|item| replace(item, right)),
        _ => {}
    }
}

/// Put values where keys are missing, in the table that stands at `here`.
fn fill(
    table: &mut Table,
    here: Option<&Range<usize>>,
    missing: &[(Option<Range<usize>>, String, Value)],
) {
    for (_, key, value) in missing.iter().filter(|(place, ..)| place.as_ref() == here) {
        let nowhere = here.map_or(0..0, |span| span.end..span.end);
        let item = Positioned { span: nowhere.clone(), value: value.clone() };
        table.entry(key.clone()).or_insert(Entry { key_span: nowhere, item });
    }
    for entry in table.values_mut() {
        let items = match &mut entry.item.value {
            Value::Array(items) => items.as_mut_slice(),
            _ => std::slice::from_mut(&mut entry.item),
        };
        for item in items {
            let span = item.span.clone();
            if let Value::Table(inner) = &mut item.value {
                fill(inner, Some(&span), missing);
            }
        }
    }
}

/// Take the faulty keys away; false if a whole element of a list would have to go, for others may
/// refer to it.
fn prune_table(table: &mut Table, faulty: &[Range<usize>]) -> bool {
    let mut whole = true;
    table.retain(|_, entry| {
        // A list of tables stands where its first table does: look at the tables first.
        if let Value::Array(items) = &mut entry.item.value {
            for item in items.iter_mut() {
                if let Value::Table(inner) = &mut item.value {
                    whole &= !faulty.contains(&item.span) && prune_table(inner, faulty);
                } else if faulty.contains(&item.span) {
                    return false;
                }
            }
        }
        if faulty.contains(&entry.key_span) || faulty.contains(&entry.item.span) {
            return false;
        }
        if let Value::Table(inner) = &mut entry.item.value {
            whole &= prune_table(inner, faulty);
        }
        true
    });
    whole
}

/// Whether a faulty place lies in a value that stands at `span`: in the innermost such value, for a
/// list of tables stands where the first of them does.
fn faulty_within(table: &Table, span: &Range<usize>, faulty: &[Range<usize>]) -> bool {
    innermost(table, span).is_some_and(|item| holds_fault(item, faulty))
}

fn innermost<'a>(table: &'a Table, span: &Range<usize>) -> Option<&'a Positioned> {
    table.values().find_map(|entry| {
        let here = entry.item.span == *span || entry.key_span == *span;
        innermost_item(&entry.item, span).or(here.then_some(&entry.item))
    })
}

fn innermost_item<'a>(item: &'a Positioned, span: &Range<usize>) -> Option<&'a Positioned> {
    match &item.value {
        Value::Table(table) => innermost(table, span),
        Value::Array(items) => items
            .iter()
            .find_map(|item| innermost_item(item, span).or((item.span == *span).then_some(item))),
        _ => None,
    }
}

/// Whether a faulty place lies in a value.
fn holds_fault(item: &Positioned, faulty: &[Range<usize>]) -> bool {
    faulty.contains(&item.span)
        || match &item.value {
            Value::Array(items) => items.iter().any(|item| holds_fault(item, faulty)),
            Value::Table(table) => table
                .values()
                .any(|entry| faulty.contains(&entry.key_span) || holds_fault(&entry.item, faulty)),
            _ => false,
        }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::at;
    use serde::Deserialize;

    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    struct Arm {
        name: String,
        mass_kg: f64,
        #[serde(default)]
        length_m: Option<f64>,
        #[serde(default)]
        joint: Vec<Joint>,
    }
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    struct Joint {
        travel_deg: [f64; 2],
        #[serde(default)]
        rate_deg_s: f64,
    }

    #[test]
    fn faulty_optional_keys_do_not_hide_the_rest() {
        let text = "name = \"a\"\nmass_kg = -1\nlength_m = \"long\"\n[[joint]]\ntravel_deg = [3, 1]\nrat_deg_s = 2\n";
        let document = Document::parse("arm.toml", text).unwrap();
        let part = document.read_in_part::<Arm>();
        let arm = part.value.expect("nothing that is needed is missing");
        assert_eq!((arm.name.as_str(), arm.mass_kg, arm.length_m), ("a", -1.0, None));
        assert_eq!(arm.joint[0].rate_deg_s, 2.0, "the key that was meant");
        assert_eq!(arm.joint[0].travel_deg, [3.0, 1.0]);
        let meaning = vec![
            document.error(at!["mass_kg"], "negative", "here"),
            document.error(at!["joint", 0, "travel_deg"], "reversed", "here"),
            document.error(at!["length_m"], "missing", "follows from its shape"),
        ];
        let all = document.beside(part.complaints, meaning);
        let said: Vec<&str> = all.iter().map(|c| c.message.as_str()).collect();
        assert_eq!(said.len(), 4, "{said:?}");
        assert_eq!((said[0], said[2]), ("negative", "reversed"));
    }

    #[test]
    fn a_list_that_loses_an_element_is_not_read_further() {
        let text = "name = \"a\"\nmass_kg = 1\n[[joint]]\nrate_deg_s = 2\n";
        let part = Document::parse("arm.toml", text).unwrap().read_in_part::<Arm>();
        assert!(part.value.is_none());
        assert_eq!(part.complaints.len(), 1, "{:?}", part.complaints);
    }
}

//! Reading on past a wrong shape: the document with stand-ins for what is wrong, and which complaints
//! about the rest still mean something.

use crate::document::Document;
use crate::positioned::{Positioned, Table, Value};
use crate::schema_walk::Walk;
use crate::{Complaint, schema_of};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};
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

/// What stands for a name that a file leaves out, while the rest is checked. It answers to every name:
/// nothing is said to be missing that it may be.
pub const UNKNOWN: &str = "\u{0}unknown";

/// How often a document is mended: the value of a key that was meant by another may be wrong as well.
const ROUNDS: usize = 4;

impl Document {
    /// The document as a `T`, with values that can stand in where the shape is wrong and without the
    /// other faulty keys, so that the rest can be checked for its meaning all the same.
    pub fn read_in_part<T: DeserializeOwned + JsonSchema>(&self) -> Part<T> {
        let schema = schema_of::<T>();
        let walk = Walk::over(self.source(), &schema, self.root());
        let Walk { complaints, repairs, .. } = walk;
        if complaints.is_empty() {
            let document = self.clone();
            return match document.deserialized::<T>() {
                Ok(value) => Part { value: Some(value), document, complaints },
                // What serde says of a sound shape is all that there is to say.
                Err(complaints) => Part { value: None, document, complaints },
            };
        }
        let mut document = self.clone();
        repairs.mend(document.root_mut(), &complaints);
        for _ in 1..ROUNDS {
            let walk = Walk::over(self.source(), &schema, document.root());
            let Walk { complaints: left, repairs, .. } = walk;
            if left.is_empty() {
                break;
            }
            repairs.mend(document.root_mut(), &left);
        }
        let value = document.read::<T>().ok();
        Part { value, document, complaints }
    }

    /// Complaints about shape and about meaning together, in the order of the file. What was said of
    /// a value in which the shape is wrong already is left out: it may follow from that alone.
    pub fn beside(&self, shape: Vec<Complaint>, meaning: Vec<Complaint>) -> Vec<Complaint> {
        if shape.is_empty() {
            return meaning;
        }
        let mut places = Places { faulty: spans_of(&shape), holds_fault: BTreeMap::new() };
        places.of_table(self.root());
        let follows = |complaint: &Complaint| match &complaint.span {
            None => true,
            // A stand-in stands nowhere.
            Some(span) if span.is_empty() => true,
            Some(span) => {
                complaint.message.contains(UNKNOWN)
                    || places.holds_fault.get(&key(span)).is_some_and(|holds| *holds)
            }
        };
        let elsewhere = |c: &Complaint| !std::sync::Arc::ptr_eq(&c.source, self.source());
        let mut all = shape;
        all.extend(meaning.into_iter().filter(|c| elsewhere(c) || !follows(c)));
        all.sort_by_key(|c| c.span.as_ref().map_or(usize::MAX, |s| s.start));
        all
    }
}

/// A span that can be looked up.
pub(crate) type Key = (usize, usize);

pub(crate) fn key(span: &Range<usize>) -> Key {
    (span.start, span.end)
}

pub(crate) fn spans_of(complaints: &[Complaint]) -> BTreeSet<Key> {
    complaints.iter().filter_map(|c| c.span.as_ref().map(key)).collect()
}

/// Of each place at which a value or its key stands: whether a fault lies in the value. Where several
/// stand at one place it is the innermost, for a list of tables stands where its first table does.
struct Places {
    faulty: BTreeSet<Key>,
    holds_fault: BTreeMap<Key, bool>,
}

impl Places {
    /// Whether a fault lies in a table.
    fn of_table(&mut self, table: &Table) -> bool {
        let mut any = false;
        for entry in table.values() {
            let holds = self.of_item(&entry.item);
            self.holds_fault.entry(key(&entry.key_span)).or_insert(holds);
            any |= holds || self.faulty.contains(&key(&entry.key_span));
        }
        any
    }
    fn of_item(&mut self, item: &Positioned) -> bool {
        let within = match &item.value {
            Value::Table(table) => self.of_table(table),
            Value::Array(items) => {
                // Every item is gone through.
                let holding = items.iter().filter(|item| self.of_item(item)).count();
                holding > 0
            }
            _ => false,
        };
        let holds = within || self.faulty.contains(&key(&item.span));
        self.holds_fault.entry(key(&item.span)).or_insert(holds);
        holds
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
    fn an_element_without_a_needed_list_does_not_hide_the_rest() {
        let text = "name = \"a\"\nmass_kg = 1\n[[joint]]\nrate_deg_s = 2\n";
        let part = Document::parse("arm.toml", text).unwrap().read_in_part::<Arm>();
        let arm = part.value.expect("two numbers stand in");
        assert_eq!((arm.joint[0].rate_deg_s, arm.joint[0].travel_deg), (2.0, [1.0; 2]));
        assert_eq!(part.complaints.len(), 1, "{:?}", part.complaints);
    }

    #[test]
    fn whatever_is_wrong_with_the_shape_something_stands_in() {
        for text in [
            "",
            "name = 3\nmass_kg = 'heavy'\njoint = 7",
            "name = 'a'\nmass_kg = 1\njoint = [1, { travel_deg = [1] }, { travel_deg = ['x', nan] }]",
            "name = 'a'\nmass = 'heavy'\njoin = 'none'\n",
            "name = 'a'\nmass_kg = inf\nlength = 3\n[joint]\ntravel_deg = 3",
        ] {
            let part = Document::parse("arm.toml", text).unwrap().read_in_part::<Arm>();
            assert!(part.value.is_some() && !part.complaints.is_empty(), "{text}\n{part:?}");
        }
    }
}

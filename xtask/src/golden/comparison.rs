//! What a case expects against what the product finds, number by number.

use super::file::short;
use serde_json::{Map, Value};
use std::fmt::Write;

/// How far a quantity may be off.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    /// Of the largest element of its array.
    pub(super) relative: f64,
    /// In the quantity's own unit: what is always allowed.
    pub(super) absolute: f64,
}

/// What a kind of file asks.
#[derive(Debug)]
pub(super) struct Tolerances {
    /// The sentence of the file, or of the README beside it.
    pub(super) sentence: &'static str,
    /// Of every array, where nothing else is said.
    pub(super) every: Bound,
    /// Of the members of these names, and all below.
    pub(super) of: &'static [(&'static str, Bound)],
    /// Names of objects whose numbers are one array, as `joint_rates`; and of lists of rows, of which each
    /// column is one.
    pub(super) arrays: &'static [&'static str],
}

impl Tolerances {
    /// The bound of the innermost name that has one.
    fn bound(&self, path: &[String]) -> Bound {
        let named = |key: &String| self.of.iter().find(|(name, _)| name == key);
        path.iter().rev().find_map(named).map_or(self.every, |(_, bound)| *bound)
    }
}

/// What the product finds, in the shape of what is expected. What is not finite is null there.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) value: Value,
    /// Names of what is left out, and why.
    pub(super) left_out: Vec<(String, &'static str)>,
}

/// A number or an array of numbers, and how far it is off.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Quantity {
    pub(super) path: String,
    pub(super) deviation: f64,
    pub(super) allowed: f64,
}

impl Quantity {
    /// What is not a number is met by no tolerance.
    pub(super) fn is_met(&self) -> bool {
        self.deviation <= self.allowed
    }
    /// How much of the tolerance is used up; what misses it comes after all that meets it.
    fn share(&self) -> f64 {
        match self.deviation / self.allowed {
            share if share.is_nan() && self.is_met() => 0.0,
            share if share.is_nan() => f64::INFINITY,
            share => share,
        }
    }
}

/// The outcome of a case.
#[derive(Debug, Default)]
pub(super) struct Comparison {
    pub(super) quantities: Vec<Quantity>,
    /// Lists of other lengths, words that differ.
    pub(super) differences: Vec<String>,
    /// Numbers that nobody compared: where, and why.
    pub(super) left_out: Vec<(String, &'static str)>,
}

impl Comparison {
    /// All that a case expects against all that was found.
    pub(super) fn of(expect: &Value, found: &Found, tolerances: &Tolerances) -> Self {
        let mut walk = Walk { found, tolerances, path: Vec::new(), outcome: Self::default() };
        walk.value(expect, Some(&found.value));
        walk.outcome
    }
    /// Whether something was compared, and all of that agrees.
    pub(super) fn is_met(&self) -> bool {
        let all = self.quantities.iter().all(Quantity::is_met);
        all && !self.quantities.is_empty() && self.differences.is_empty()
    }
    /// The quantity that uses up most of its tolerance.
    pub(super) fn worst(&self) -> Option<&Quantity> {
        self.quantities.iter().max_by(|a, b| a.share().total_cmp(&b.share()))
    }
}

/// A walk through what is expected.
struct Walk<'a> {
    found: &'a Found,
    tolerances: &'a Tolerances,
    path: Vec<String>,
    outcome: Comparison,
}

impl Walk<'_> {
    fn value(&mut self, expect: &Value, found: Option<&Value>) {
        let Some(found) = found else { return self.leave_out(expect) };
        if let Some(expected) = numbers(expect) {
            return self.array(&expected, found);
        }
        match expect {
            Value::Object(members) if is_attitude(members) => self.attitude(members, found),
            Value::Object(members) if self.is_one_array() => self.joints(members, found),
            Value::Object(members) => {
                if !found.is_object() {
                    return self.differs(expect, found);
                }
                for (key, value) in members {
                    self.below(key.clone(), |walk| walk.value(value, found.get(key)));
                }
            }
            Value::Array(items) => self.list(items, found),
            Value::Bool(_) if expect == found => {
                let path = self.place();
                self.outcome.quantities.push(Quantity { path, deviation: 0.0, allowed: 0.0 });
            }
            word if word == found => {}
            _ => self.differs(expect, found),
        }
    }

    fn below(&mut self, name: String, go: impl FnOnce(&mut Self)) {
        self.path.push(name);
        go(self);
        self.path.pop();
    }

    /// Where the walk is: `results[0].momentum.angular`.
    fn place(&self) -> String {
        let mut place = String::new();
        for part in &self.path {
            let dot = if place.is_empty() || part.starts_with('[') { "" } else { "." };
            let _ = write!(place, "{dot}{part}");
        }
        place
    }

    fn differs(&mut self, expect: &Value, found: &Value) {
        let place = self.place();
        let line = format!("{place}: found {}, expected {}", short(found), short(expect));
        self.outcome.differences.push(line);
    }

    /// Note what nobody compares, if it holds a number or a truth.
    fn leave_out(&mut self, expect: &Value) {
        if !holds_values(expect) {
            return;
        }
        let names = self.path.iter().rev();
        let why = names.filter_map(|key| self.found.left_out.iter().find(|(name, _)| name == key));
        let why = why.map(|(_, why)| *why).next().unwrap_or("the kind gives no such number");
        self.outcome.left_out.push((self.place(), why));
    }

    fn note(&mut self, expected: &[f64], found: &[f64]) {
        let Bound { relative, absolute } = self.tolerances.bound(&self.path);
        let largest = expected.iter().map(|x| x.abs()).fold(0.0, worse);
        let deviation = expected.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, worse);
        let allowed = worse(absolute, relative * largest);
        let path = self.place();
        self.outcome.quantities.push(Quantity { path, deviation, allowed });
    }

    fn array(&mut self, expected: &Shaped, found: &Value) {
        match shaped(found) {
            Some(found) if found.shape == expected.shape => self.note(&expected.all, &found.all),
            _ => self.differs(&expected.to_value(), found),
        }
    }

    /// An attitude is the same with either sign.
    fn attitude(&mut self, members: &Map<String, Value>, found: &Value) {
        let expected = ["w", "x", "y", "z"].map(|key| number(members.get(key)));
        let found = ["w", "x", "y", "z"].map(|key| number(found.get(key)));
        let dot: f64 = expected.iter().zip(&found).map(|(a, b)| a * b).sum();
        let sign = if dot < 0.0 { -1.0 } else { 1.0 };
        self.note(&expected, &found.map(|x| sign * x));
    }

    fn is_one_array(&self) -> bool {
        self.path.last().is_some_and(|key| self.tolerances.arrays.contains(&key.as_str()))
    }

    /// Numbers by the names of joints: one array.
    fn joints(&mut self, members: &Map<String, Value>, found: &Value) {
        let expected: Vec<f64> = members.values().map(|value| number(Some(value))).collect();
        let found: Vec<f64> = members.keys().map(|key| number(found.get(key))).collect();
        self.note(&expected, &found);
    }

    /// Objects in a list are paired by the words in them, where there are any, or else by place.
    fn list(&mut self, items: &[Value], found: &Value) {
        let Some(list) = found.as_array().filter(|list| list.len() == items.len()) else {
            return self.differs(&Value::Array(items.to_vec()), found);
        };
        let columns = if self.is_one_array() { self.columns(items, list) } else { vec![] };
        for (i, item) in items.iter().enumerate() {
            let item = &without(item, &columns);
            let said = |other: &Value, key: &String| other.get(key).is_some();
            let same = |other: &&Value| {
                words(item).all(|(key, word)| other.get(key).is_none_or(|found| found == word))
            };
            let is_named = words(item).any(|(key, _)| list.iter().all(|other| said(other, key)));
            let partner = if is_named { list.iter().find(same) } else { list.get(i) };
            self.below(format!("[{i}]"), |walk| match partner {
                Some(partner) => walk.value(item, Some(partner)),
                None => walk.differs(item, &Value::Null),
            });
        }
    }
}

impl Walk<'_> {
    /// Compares the columns of a list of rows, each as one array; their names. Objects in rows are rows of
    /// their own.
    fn columns(&mut self, rows: &[Value], found: &[Value]) -> Vec<String> {
        let column = |of: &[Value], key: &str| -> Vec<Value> {
            of.iter().map(|row| row.get(key).cloned().unwrap_or_default()).collect()
        };
        let first = rows.first().and_then(Value::as_object);
        let mut done = vec![];
        for key in first.into_iter().flat_map(|row| row.keys()) {
            // Rows that say nothing of it are left out.
            let silent = |row: &Value| row.is_object() && row.get(key).is_none();
            let (said, unsaid): (Vec<_>, Vec<_>) =
                rows.iter().zip(found).partition(|(_, found)| !silent(found));
            if !said.is_empty() && !unsaid.is_empty() {
                let lost: Vec<_> = unsaid.iter().filter_map(|(row, _)| row.get(key)).collect();
                self.below(key.clone(), |walk| lost.iter().for_each(|row| walk.leave_out(row)));
            }
            let (rows, found): (Vec<_>, Vec<_>) = if said.is_empty() {
                (rows.to_vec(), found.to_vec())
            } else {
                said.into_iter().map(|(a, b)| (a.clone(), b.clone())).unzip()
            };
            let (expected, of_found) = (column(&rows, key), column(&found, key));
            let there = found.iter().any(|row| row.get(key).is_some() || row.is_null());
            let whole = Value::Array(expected.clone());
            if numbers(&whole).is_some() {
                let of_found = Value::Array(of_found);
                self.below(key.clone(), |walk| walk.value(&whole, there.then_some(&of_found)));
                done.push(key.clone());
            } else if there && expected.iter().all(|row| row.is_object() && !is_turn(row)) {
                let mut names = vec![];
                self.below(key.clone(), |walk| names = walk.columns(&expected, &of_found));
                let numbers_left = expected.iter().any(|row| holds_values(&without(row, &names)));
                if !numbers_left {
                    done.push(key.clone());
                }
            }
        }
        done
    }
}

fn is_turn(value: &Value) -> bool {
    value.as_object().is_some_and(is_attitude)
}

/// An object without some of its members.
fn without(value: &Value, keys: &[String]) -> Value {
    match value {
        Value::Object(members) => {
            let rest = members.iter().filter(|(key, _)| !keys.contains(key));
            Value::Object(rest.map(|(key, value)| (key.clone(), value.clone())).collect())
        }
        other => other.clone(),
    }
}

/// The larger of two; what is not a number is largest.
fn worse(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// A number; not a number where there is none.
fn number(value: Option<&Value>) -> f64 {
    value.and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// The members of an object that are strings.
fn words(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flatten().filter(|(_, word)| word.is_string())
}

fn is_attitude(members: &Map<String, Value>) -> bool {
    members.len() == 4 && ["w", "x", "y", "z"].iter().all(|key| members.contains_key(*key))
}

fn holds_values(value: &Value) -> bool {
    match value {
        Value::Number(_) | Value::Bool(_) => true,
        Value::Array(items) => items.iter().any(holds_values),
        Value::Object(members) => members.values().any(holds_values),
        _ => false,
    }
}

/// Numbers and the lengths of the lists they stand in, from the outside in.
#[derive(Debug, Default)]
struct Shaped {
    all: Vec<f64>,
    shape: Vec<usize>,
}

impl Shaped {
    fn to_value(&self) -> Value {
        if self.shape.is_empty() { Value::from(self.all[0]) } else { Value::from(self.all.clone()) }
    }
}

/// A number, or lists of nothing but numbers, and at least one; null stands for what is not finite.
fn shaped(value: &Value) -> Option<Shaped> {
    match value {
        Value::Number(_) | Value::Null => {
            Some(Shaped { all: vec![number(Some(value))], shape: vec![] })
        }
        Value::Array(items) if !items.is_empty() => {
            let mut whole = Shaped { all: vec![], shape: vec![items.len()] };
            for item in items {
                let part = shaped(item)?;
                whole.all.extend(part.all);
                whole.shape.extend(part.shape);
            }
            Some(whole)
        }
        _ => None,
    }
}

/// The same of what is expected, where every element must be a number.
fn numbers(value: &Value) -> Option<Shaped> {
    shaped(value).filter(|whole| whole.all.iter().all(|x| !x.is_nan()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const TENTH: Tolerances = Tolerances {
        sentence: "",
        every: Bound { relative: 0.1, absolute: 0.0 },
        of: &[("loose", Bound { relative: 0.0, absolute: 5.0 })],
        arrays: &["rates"],
    };

    fn compared(expect: &Value, value: Value) -> Comparison {
        let found = Found { value, left_out: vec![("gone".to_owned(), "it went")] };
        Comparison::of(expect, &found, &TENTH)
    }

    #[test]
    fn a_deviation_is_held_against_the_largest_element_of_its_array() {
        let expect = json!({ "a": [[10.0, 0.0], [0.0, 1.0]] });
        assert!(compared(&expect, json!({ "a": [[10.0, 0.9], [0.0, 1.0]] })).is_met());
        let missed = compared(&expect, json!({ "a": [[10.0, 1.1], [0.0, 1.0]] }));
        assert!(!missed.is_met());
        let worst = missed.worst().expect("one quantity");
        assert_eq!((worst.path.as_str(), worst.deviation, worst.allowed), ("a", 1.1, 1.0));
    }

    /// The columns of rows are held against their largest element, objects in them likewise; a row that says
    /// nothing of a column is told, and none that does is lost with it.
    #[test]
    fn a_column_of_rows_is_one_array() {
        let expect = json!({ "rates": [
            { "t": 1.0, "in": { "x": 10.0 } }, { "t": 2.0, "in": { "x": 0.1 } }, { "t": 3.0, "in": { "x": 5.0 } }
        ] });
        let row = |t: f64, x: f64| json!({ "t": t, "in": { "x": x } });
        let found =
            |middle: Value, last: f64| json!({ "rates": [row(1.0, 10.0), middle, row(3.0, last)] });
        assert!(compared(&expect, found(row(2.0, 1.05), 5.0)).is_met());
        assert!(!compared(&expect, found(row(2.0, 1.2), 5.0)).is_met());
        assert!(!compared(&expect, found(Value::Null, 5.0)).is_met());
        let silent = compared(&expect, found(json!({ "t": 2.0 }), 5.0));
        assert!(silent.is_met() && silent.left_out.len() == 1, "{silent:?}");
        assert!(!compared(&expect, found(json!({ "t": 2.0 }), 6.2)).is_met());
        assert!(!compared(&expect, json!({ "rates": [row(1.0, 10.0), row(2.0, 0.1)] })).is_met());
    }

    #[test]
    fn what_is_not_a_number_meets_no_tolerance() {
        let expect = json!({ "a": [1.0, 2.0, 3.0], "loose": 1.0 });
        for broken in [json!([null, 2.0, 3.0]), json!([1.0, 2.0, null]), json!(["x", 2.0, 3.0])] {
            assert!(!compared(&expect, json!({ "a": broken, "loose": 1.0 })).is_met());
        }
        let nan = json!({ "a": [1.0, 2.0, 3.0], "loose": f64::NAN });
        let missed = compared(&expect, nan);
        assert!(!missed.is_met() && missed.worst().is_some_and(|q| q.deviation.is_nan()));
        let q = json!({ "w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0 });
        let broken = json!({ "w": 1.0, "x": null, "y": 0.0, "z": 0.0 });
        assert!(compared(&q, q.clone()).is_met() && !compared(&q, broken).is_met());
    }

    #[test]
    fn a_tolerance_is_that_of_the_innermost_name() {
        let expect = json!({ "loose": { "b": 1.0 }, "tight": { "b": 1.0 } });
        assert!(
            compared(&expect, json!({ "loose": { "b": 5.0 }, "tight": { "b": 1.05 } })).is_met()
        );
        assert!(
            !compared(&expect, json!({ "loose": { "b": 5.0 }, "tight": { "b": 5.0 } })).is_met()
        );
    }

    #[test]
    fn numbers_that_nobody_compares_are_told_with_the_reason() {
        let expect = json!({ "a": 1.0, "gone": { "x": [1.0] }, "b": [{ "c": 1 }], "word": "w" });
        let outcome = compared(&expect, json!({ "a": 1.0 }));
        let told = |path: &str, why| (path.to_owned(), why);
        let expected = [told("gone", "it went"), told("b", "the kind gives no such number")];
        assert_eq!(outcome.left_out, expected);
        assert!(outcome.is_met(), "what is left out is no miss");
        assert!(!compared(&expect, json!({})).is_met(), "comparing nothing is no agreement");
    }

    #[test]
    fn lists_are_paired_by_their_words_and_must_be_as_long() {
        let expect = json!([{ "joint": "a", "x": 1.0 }, { "joint": "b", "x": 2.0 }]);
        let turned = json!([{ "joint": "b", "x": 2.0 }, { "joint": "a", "x": 1.0 }]);
        assert!(compared(&expect, turned).is_met());
        assert!(!compared(&expect, json!([{ "joint": "a", "x": 1.0 }])).is_met());
        let other = json!([{ "joint": "a", "x": 1.0 }, { "joint": "c", "x": 2.0 }]);
        assert!(!compared(&expect, other).is_met());
        assert!(!compared(&json!([1.0, 2.0]), json!([1.0])).is_met());
    }

    #[test]
    fn attitudes_may_have_either_sign_and_joints_are_one_array() {
        let q = |s: f64| json!({ "w": 0.6 * s, "x": 0.8 * s, "y": 0.0, "z": 0.0 });
        assert!(compared(&q(1.0), q(-1.0)).is_met());
        let rates = |small: f64| json!({ "rates": { "j1": 10.0, "j2": small } });
        assert!(compared(&rates(0.0), rates(0.5)).is_met());
        assert!(!compared(&rates(0.0), rates(1.5)).is_met());
        assert!(!compared(&rates(0.0), json!({ "rates": { "j1": 10.0 } })).is_met());
    }

    #[test]
    fn words_that_differ_are_a_difference() {
        assert!(!compared(&json!({ "a": 1.0, "w": "x" }), json!({ "a": 1.0, "w": "y" })).is_met());
        assert!(compared(&json!({ "a": 1.0, "w": "x" }), json!({ "a": 1.0 })).is_met());
    }
}

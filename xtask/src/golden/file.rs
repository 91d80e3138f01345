//! A golden file: its cases, what each is of, and complaints about it.

use serde_json::{Map, Value};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

/// Files whose whole name is their kind; `derivatives_` begins such a name.
const WHOLE_NAMES: [&str; 3] = ["one_arm", "two_arms", "paper_equations"];
/// Begins the name of a file whose expectations are its other members.
const DERIVATIVES: &str = "derivatives_";
/// Members of such a file that are no expectation.
const NOT_EXPECTED: [&str; 3] = ["made_by", "vehicle", "input"];
/// A list of postures that stands beside the golden files.
const NO_GOLDEN_FILE: &str = "miss_distance_postures";

/// A golden file, or a case in it, that cannot be used.
#[derive(Debug)]
pub(super) struct Complaint {
    file: PathBuf,
    place: String,
    what: String,
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}: ", self.file.display())?;
        if !self.place.is_empty() {
            write!(f, "at {}: ", self.place)?;
        }
        f.write_str(&self.what)
    }
}

/// A case: what is given and what is expected.
#[derive(Debug)]
pub(super) struct Case {
    /// The file it stands in.
    pub(super) file: PathBuf,
    /// Where in the file: `cases[2]`; empty for the whole file.
    place: String,
    /// Kind of the file, then the case's own after a stroke.
    pub(super) kind: String,
    /// Number in the file from 1, and what the case says of itself.
    pub(super) label: String,
    /// All of it.
    pub(super) value: Value,
    /// What is expected.
    pub(super) expect: Value,
}

impl Case {
    /// A complaint about a place below the case.
    pub(super) fn complaint(&self, place: &str, what: impl Into<String>) -> Complaint {
        let parts = [self.place.as_str(), place];
        let place = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(".");
        Complaint { file: self.file.clone(), place, what: what.into() }
    }
    /// What stands at a path of members, as `input.target.fixture`.
    pub(super) fn at(&self, path: &str) -> Result<&Value, Complaint> {
        let found = path.split('.').try_fold(&self.value, |value, key| value.get(key));
        found.ok_or_else(|| self.complaint(path, "is missing"))
    }
    /// The list that is expected under a name; empty where there is none.
    pub(super) fn rows(&self, name: &str) -> &[Value] {
        self.expect[name].as_array().map_or(&[], Vec::as_slice)
    }
    /// The words at a path.
    pub(super) fn text(&self, path: &str) -> Result<&str, Complaint> {
        let value = self.at(path)?;
        let wrong = || self.complaint(path, format!("expected a string, found {}", short(value)));
        value.as_str().ok_or_else(wrong)
    }
    /// The number at a path.
    pub(super) fn number(&self, path: &str) -> Result<f64, Complaint> {
        let value = self.at(path)?;
        let wrong = || self.complaint(path, format!("expected a number, found {}", short(value)));
        value.as_f64().ok_or_else(wrong)
    }
    /// The value at a path, as a type that says what it must hold.
    pub(super) fn read<T: serde::de::DeserializeOwned>(&self, path: &str) -> Result<T, Complaint> {
        let value = self.at(path)?;
        serde_json::from_value(value.clone()).map_err(|why| self.complaint(path, why.to_string()))
    }
}

/// The cases of a file, and the tolerance that its head states.
#[derive(Debug)]
pub(super) struct GoldenFile {
    pub(super) cases: Vec<Case>,
    /// The sentence at `tolerance`.
    pub(super) tolerance: Option<String>,
}

impl GoldenFile {
    /// Read a file; nothing if it is no golden file.
    pub(super) fn read(path: &Path) -> Result<Option<Self>, Complaint> {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if stem == NO_GOLDEN_FILE {
            return Ok(None);
        }
        let complaint = |place: String, what: String| Complaint { file: path.into(), place, what };
        let text =
            fs::read_to_string(path).map_err(|why| complaint(String::new(), why.to_string()))?;
        let whole: Value = serde_json::from_str(&text).map_err(|why| {
            complaint(format!("line {}, column {}", why.line(), why.column()), why.to_string())
        })?;
        let kind = kind_of(&stem);
        let tolerance = whole.get("tolerance").and_then(Value::as_str).map(str::to_owned);
        let (place, list) = match whole {
            Value::Array(list) => (String::new(), list),
            Value::Object(mut head) => match head.remove("cases") {
                Some(Value::Array(list)) => ("cases".to_owned(), list),
                Some(_) => return Err(complaint("cases".to_owned(), "expected a list".to_owned())),
                None => {
                    return Ok(Some(Self { cases: vec![single(path, &kind, head)?], tolerance }));
                }
            },
            other => {
                let what =
                    format!("expected an object or a list of cases, found {}", short(&other));
                return Err(complaint(String::new(), what));
            }
        };
        if list.is_empty() {
            return Err(complaint(place, "there is no case".to_owned()));
        }
        let numbered = list.into_iter().enumerate();
        let cases = numbered.map(|(i, value)| one_of(path, &kind, &place, i, value));
        Ok(Some(Self { cases: cases.collect::<Result<_, _>>()?, tolerance }))
    }
}

/// Kind of a file from its name: up to the last `_`, or all of it.
fn kind_of(stem: &str) -> String {
    if WHOLE_NAMES.contains(&stem) || stem.starts_with(DERIVATIVES) {
        return stem.to_owned();
    }
    stem.rsplit_once('_').map_or(stem, |(kind, _)| kind).to_owned()
}

/// A file that is one case.
fn single(path: &Path, kind: &str, head: Map<String, Value>) -> Result<Case, Complaint> {
    let expect = if kind.starts_with(DERIVATIVES) {
        let expected = head.iter().filter(|(key, _)| !NOT_EXPECTED.contains(&key.as_str()));
        Value::Object(expected.map(|(key, value)| (key.clone(), value.clone())).collect())
    } else {
        let missing = || Complaint {
            file: path.into(),
            place: String::new(),
            what: "neither `cases` nor `expect` is there".to_owned(),
        };
        head.get("expect").ok_or_else(missing)?.clone()
    };
    Ok(Case {
        file: path.into(),
        place: String::new(),
        kind: kind.to_owned(),
        label: "1".to_owned(),
        value: Value::Object(head),
        expect,
    })
}

/// Case number `i` of a list.
fn one_of(path: &Path, kind: &str, list: &str, i: usize, value: Value) -> Result<Case, Complaint> {
    let word = |key: &str| value.get(key).and_then(Value::as_str);
    let kind = word("kind").map_or(kind.to_owned(), |own| format!("{kind}/{own}"));
    let vehicle = value.pointer("/input/vehicle").and_then(Value::as_str);
    let says = word("kind").or(word("vehicle")).or(vehicle).unwrap_or_default();
    let mut case = Case {
        file: path.into(),
        place: format!("{list}[{i}]"),
        kind,
        label: format!("{} {says}", i + 1).trim_end().to_owned(),
        expect: Value::Null,
        value: Value::Null,
    };
    if !value.is_object() {
        let what = format!("expected a case with `input` and `expect`, found {}", short(&value));
        return Err(case.complaint("", what));
    }
    case.value = value;
    case.expect = case.at("expect")?.clone();
    Ok(case)
}

/// A value in a few words.
pub(super) fn short(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(members) => format!("an object of {} members", members.len()),
        plain => plain.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kind_is_the_name_up_to_its_last_stroke_but_for_the_contract_files() {
        let names =
            ["one_arm", "derivatives_one_arm", "two_bodies_shared", "capture_hidden", "peg"];
        let kinds = ["one_arm", "derivatives_one_arm", "two_bodies", "capture", "peg"];
        assert_eq!(names.map(kind_of), kinds);
    }
}

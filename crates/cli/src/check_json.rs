//! What `wrasse check --json` prints: one object for each file, each on its own line.

use serde_json::{Map, Value, json};
use std::path::Path;
use wrasse_document::{Complaint, Severity};
use wrasse_vehicle::{DeepCheck, Finding, Fine, Place};

/// What was found of a file; `what` says what it is, if it can be used.
pub(crate) fn file_json(
    file: &Path,
    complaints: &[Complaint],
    what: Option<&str>,
    deep: Option<&DeepCheck>,
) -> Value {
    let mut object = Map::new();
    let mut put = |key: &str, value: Value| object.insert(key.to_owned(), value);
    put("file", json!(file.to_string_lossy()));
    put("usable", json!(what.is_some()));
    put("what", json!(what));
    put("complaints", complaints.iter().map(complaint).collect());
    if let Some(deep) = deep {
        put("findings", deep.findings.iter().map(finding).collect());
        put("fine", deep.fine.iter().map(fine).collect());
    }
    Value::Object(object)
}

/// A file that could not be read at all.
pub(crate) fn unreadable_json(file: &Path, message: &str) -> Value {
    let complaint = json!({
        "severity": "error", "message": message, "file": file.to_string_lossy(),
        "line": null, "column": null, "help": null,
    });
    json!({
        "file": file.to_string_lossy(), "usable": false, "what": null, "complaints": [complaint],
    })
}

fn complaint(complaint: &Complaint) -> Value {
    let placed = complaint.placed();
    let (line, column) = placed.line_and_column().unzip();
    json!({
        "severity": match placed.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        },
        "message": placed.message,
        "file": placed.source.path.to_string_lossy(),
        "line": line,
        "column": column,
        "help": placed.help,
    })
}

fn finding(found: &Finding) -> Value {
    let place = found.place.as_ref();
    let (line, column) = place.map(Place::line_and_column).unzip();
    json!({
        "kind": found.kind.word(),
        "severity": found.severity.word(),
        "subject": found.subject,
        "message": found.message,
        "why": found.kind.why(),
        "file": place.map(|place| place.source.path.to_string_lossy()),
        "line": line,
        "column": column,
        "numbers": numbers(&found.numbers),
    })
}

fn fine(fine: &Fine) -> Value {
    let (kind, message) = (fine.kind.word(), &fine.message);
    json!({ "kind": kind, "message": message, "numbers": numbers(&fine.numbers) })
}

/// By name; what is not finite is null.
fn numbers(numbers: &[(&'static str, f64)]) -> Value {
    numbers
        .iter()
        .map(|(name, value)| ((*name).to_owned(), json!(value)))
        .collect::<Map<_, _>>()
        .into()
}

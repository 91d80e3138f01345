//! The summary: everything but the time histories, as JSON.

use serde_json::{Value, json};
use wrasse_mission::Outcome;

/// Version of the summary's layout; it rises when a key changes its meaning or goes away.
const FORMAT: u32 = 1;

/// What `summary.json` holds and `--json` prints: keys in a fixed order, numbers that are not
/// finite as `null`, units in the keys or beside the values.
pub fn summary_json(outcome: &Outcome) -> Value {
    let mut summary = json!({
        "format": FORMAT,
        "passed": passed(outcome),
    });
    let told = serde_json::to_value(outcome).expect("an outcome has string keys only");
    if let (Value::Object(summary), Value::Object(told)) = (&mut summary, told) {
        summary.extend(told);
    }
    summary
}

/// Whether there is a case, and every case passed.
pub(crate) fn passed(outcome: &Outcome) -> bool {
    !outcome.cases.is_empty() && outcome.cases.iter().all(|case| case.passed)
}

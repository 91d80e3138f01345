//! Summaries: everything but the time histories, as JSON for programs.
//!
//! What `summary.json` holds and `--json` prints: keys in a fixed order, numbers that are not
//! finite as `null`, units in the keys or beside the values.

use serde::Serialize;
use serde_json::{Value, json};
use wrasse_mission::Outcome;
use wrasse_study::StudyOutcome;
use wrasse_sweep::SweepOutcome;

use crate::wording::comparison::passed;

/// The summary of a run.
pub fn summary_json(outcome: &Outcome) -> Value {
    summary(json!({ "format": 1, "passed": passed(outcome) }), outcome)
}

/// The summary of a study.
pub fn study_json(outcome: &StudyOutcome) -> Value {
    summary(json!({ "format": 1 }), outcome)
}

/// The summary of a sweep.
pub fn sweep_json(outcome: &SweepOutcome) -> Value {
    summary(json!({ "format": 2 }), outcome)
}

/// An outcome behind the keys of `head`; `format` there is the version of the layout, which rises
/// when a key changes its meaning or goes away.
fn summary(mut head: Value, outcome: &impl Serialize) -> Value {
    let outcome = serde_json::to_value(outcome).expect("an outcome has string keys only");
    if let (Value::Object(head), Value::Object(outcome)) = (&mut head, outcome) {
        head.extend(outcome);
    }
    head
}

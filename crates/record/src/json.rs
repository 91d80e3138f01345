//! Summaries: everything but the time histories, as JSON for programs.
//!
//! What `summary.json` holds and `--json` prints: keys in a fixed order, numbers that are not
//! finite as `null`, units in the keys or beside the values.

use serde::Serialize;
use serde_json::{Value, json};
use wrasse_mission::Outcome;
use wrasse_rehearsal::{CaseOutcome, Metric, Verdict, measured_in};
use wrasse_study::StudyOutcome;
use wrasse_sweep::SweepOutcome;

use crate::provenance::Provenance;
use crate::wording::cases::quantity;
use crate::wording::comparison::passed;

/// The summary of a run.
pub fn summary_json(outcome: &Outcome, provenance: &Provenance) -> Value {
    let head = json!({ "format": 2, "passed": passed(outcome) });
    let mut whole = summary(head, outcome, provenance);
    for (k, case) in outcome.cases.iter().enumerate() {
        whole["cases"][k]["metrics"] = json!(metrics(case));
    }
    whole
}

/// The metrics of a case, those that a requirement is about in its unit: one number, one unit in a file.
fn metrics(case: &CaseOutcome) -> Vec<Metric> {
    let in_its_unit = |metric: &Metric| {
        let about = |v: &&Verdict| quantity(&v.requirement, &v.comparison) == metric.name;
        let verdict = case.verdicts.iter().find(about)?;
        let (wanted, own) = (measured_in(&verdict.unit)?, measured_in(&metric.unit)?);
        let value = metric.value * own.1 / wanted.1;
        Some(Metric { value, unit: verdict.unit.clone(), name: metric.name.clone() })
    };
    case.metrics
        .iter()
        .map(|metric| in_its_unit(metric).unwrap_or_else(|| metric.clone()))
        .collect()
}

/// The summary of a study.
pub fn study_json(outcome: &StudyOutcome, provenance: &Provenance) -> Value {
    summary(json!({ "format": 1 }), outcome, provenance)
}

/// The summary of a sweep.
pub fn sweep_json(outcome: &SweepOutcome, provenance: &Provenance) -> Value {
    summary(json!({ "format": 2 }), outcome, provenance)
}

/// An outcome behind the keys of `head`, and whence it comes; `format` there is the version of the layout, which rises
/// when a key changes its meaning or goes away.
fn summary(mut head: Value, outcome: &impl Serialize, provenance: &Provenance) -> Value {
    let outcome = serde_json::to_value(outcome).expect("an outcome has string keys only");
    if let (Value::Object(head), Value::Object(outcome)) = (&mut head, outcome) {
        head.extend(outcome);
        head.insert("provenance".into(), json!(provenance));
    }
    head
}

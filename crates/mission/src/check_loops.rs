//! Whether the control rate is high enough for the loops that are closed once a period.

use wrasse_document::{Complaint, Document, Step, at};
use wrasse_rehearsal::{Case, REMARK_BELOW, sampled_loops};

/// Complains of each loop that is unstable as sampled, and remarks on those that are near it.
pub(crate) fn check_loops(document: &Document, case: &Case) -> Vec<Complaint> {
    let mut complaints = vec![];
    for found in sampled_loops(case) {
        let keys: Vec<Step<'_>> =
            core::iter::once("control").chain(found.key.split('.')).map(Step::Key).collect();
        let is_there = keys.split_last().is_some_and(
            |(last, above)| matches!(last, Step::Key(last) if document.keys(above).contains(last)),
        );
        // A default is complained of where the rate, or the table, is written.
        let rate = at!["control", "rate_hz"];
        let path: &[Step<'_>] = if is_there { &keys } else { rate };
        if found.is_unstable() {
            let message = format!("this loop is unstable as sampled: {}", found.text());
            complaints.push(document.error(path, message, "here").with_help(found.help()));
        } else if found.margin() < REMARK_BELOW {
            let message = format!("this loop is near its limit as sampled: {}", found.text());
            complaints.push(document.warning(path, message, "here").with_help(found.help()));
        }
    }
    complaints
}

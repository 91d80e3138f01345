//! One mistake in a good file: which complaint it draws, where, and nothing besides.
#![allow(dead_code, reason = "each test binary uses its part")]

use wrasse_document::{Complaint, Severity};
use wrasse_vehicle::{Vehicle, read_vehicle};

pub(crate) fn told_of(file: &str, text: &str) -> Vec<Complaint> {
    match read_vehicle(file, text) {
        Ok(Vehicle { remarks, .. }) => remarks,
        Err(complaints) => {
            assert!(complaints.iter().any(|c| c.severity == Severity::Error), "{complaints:#?}");
            complaints
        }
    }
}

pub(crate) fn line(complaint: &Complaint) -> usize {
    let start = complaint.span.as_ref().expect("a place").start;
    1 + complaint.source.text[..start].matches('\n').count()
}

pub(crate) fn under_the_caret(complaint: &Complaint) -> &str {
    &complaint.source.text[complaint.span.clone().expect("a place")]
}

/// A mistake: what it replaces and by what; then line, text under the caret, and part of the message.
pub(crate) struct Mistake(
    pub(crate) &'static str,
    pub(crate) &'static str,
    pub(crate) usize,
    pub(crate) &'static str,
    pub(crate) &'static str,
);

#[track_caller]
pub(crate) fn each_alone_in((file, good): (&str, &str), severity: Severity, mistakes: &[Mistake]) {
    for Mistake(right, wrong, at_line, caret, message) in mistakes {
        assert_eq!(good.matches(right).count(), 1, "not once in the file: {right}");
        let complaints = told_of(file, &good.replace(right, wrong));
        let [complaint] = &complaints[..] else {
            panic!("{wrong}: expected one complaint, found {complaints:#?}")
        };
        assert_eq!(complaint.severity, severity, "{complaint:#?}");
        assert_eq!(line(complaint), *at_line, "{complaint:#?}");
        assert_eq!(under_the_caret(complaint), *caret, "{complaint:#?}");
        let whole = format!("{}; {}", complaint.message, complaint.help.as_deref().unwrap_or(""));
        assert!(whole.contains(message), "expected '{message}' in '{whole}'");
    }
}

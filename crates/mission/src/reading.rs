//! A reader's view of one case: the document, the vehicle, and what it found wrong.

use wrasse_document::{Complaint, Document, Step, UNKNOWN, closest};
use wrasse_dynamics::JointKind;
use wrasse_vehicle::Vehicle;

/// A reader's view of one case: the document, what it found wrong, the vehicle.
pub(crate) struct Reading<'a> {
    pub(crate) document: &'a Document,
    pub(crate) complaints: Vec<Complaint>,
    pub(crate) vehicle: &'a Vehicle,
    /// Whether the actuators could be read: of some that could not, nothing is said to be missing.
    pub(crate) knows_actuators: bool,
}

impl Reading<'_> {
    /// Note an error at a path.
    pub(crate) fn error(&mut self, path: &[Step<'_>], message: String, help: &str) {
        let complaint = self.document.error(path, message, "here");
        self.complaints.push(if help.is_empty() { complaint } else { complaint.with_help(help) });
    }
    /// Note an error about the key at a path rather than its value.
    pub(crate) fn wrong_key(&mut self, path: &[Step<'_>], message: String, help: &str) {
        let at = self.document.key_span(path).unwrap_or(0..0);
        let complaint = Complaint::error(self.document.source(), message).at(at, "here");
        self.complaints.push(complaint.with_help(help));
    }
    /// Note a doubt at a path.
    pub(crate) fn warning(&mut self, path: &[Step<'_>], message: String, help: &str) {
        self.complaints.push(self.document.warning(path, message, "here").with_help(help));
    }
    /// The place of a name in a list; an error with a suggestion if it is not there.
    pub(crate) fn find(
        &mut self,
        path: &[Step<'_>],
        what: &str,
        name: &str,
        among: &[String],
    ) -> Option<usize> {
        let made_up = |n: &String| n == UNKNOWN;
        let found = match among.iter().position(|n| n == name) {
            // A name that is left out may be any.
            None if name == UNKNOWN => (!among.is_empty()).then_some(0),
            None => among.iter().position(made_up),
            found => found,
        };
        if found.is_none() {
            let help = match closest(name, among.iter().map(String::as_str)) {
                Some(close) => format!("did you mean {close:?}?"),
                None if among.is_empty() => format!("there is no {what} at all"),
                None => format!("one of {}", among.join(", ")),
            };
            self.error(path, format!("there is no {what} called {name:?}"), &help);
        }
        found
    }
    /// Whether the file says something at a path.
    pub(crate) fn is_there(&self, path: &[Step<'_>]) -> bool {
        let Some((Step::Key(last), above)) = path.split_last() else { return false };
        self.document.keys(above).contains(last)
    }
    /// A joint's position in the unit of files.
    pub(crate) fn shown(&self, j: usize, x: f64) -> String {
        match self.vehicle.robot.joint(j).kind {
            JointKind::Revolute => format!("{} deg", rounded(x.to_degrees())),
            JointKind::Prismatic => format!("{} m", rounded(x)),
        }
    }
    /// A number that must be above zero.
    pub(crate) fn positive(&mut self, path: &[Step<'_>], x: f64) -> f64 {
        if x > 0.0 {
            return x;
        }
        self.error(path, format!("{} must be above zero, found {x}", key(path)), "");
        1.0
    }
    /// A number that must be from `low` to `high`, for the reason given.
    pub(crate) fn within(
        &mut self,
        path: &[Step<'_>],
        x: f64,
        (low, high): (f64, f64),
        why: &str,
    ) -> f64 {
        if (low..=high).contains(&x) {
            return x;
        }
        let message = format!("{} must be from {low} to {high}, found {x}", key(path));
        self.error(path, message, why);
        low
    }
    /// A number that must not be below zero.
    pub(crate) fn not_negative(&mut self, path: &[Step<'_>], x: f64) -> f64 {
        if x >= 0.0 {
            return x;
        }
        self.error(path, format!("{} must not be below zero, found {x}", key(path)), "");
        0.0
    }
}

/// Six decimals, as far as they say something.
fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

/// How to speak of the value at a path: by its key, or its place in the list of that key.
fn key(path: &[Step<'_>]) -> String {
    match path {
        [.., Step::Key(key)] => format!("`{key}`"),
        [.., Step::Key(key), Step::Index(i)] => format!("value {} of `{key}`", i + 1),
        _ => "the value".into(),
    }
}

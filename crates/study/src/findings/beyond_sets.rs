//! What no set can change: a force that pushes the vehicle away, a task that asks for nothing.

use super::verdicts::{Verdicts, asks_nothing};
use super::wording::{finding, rounded};
use crate::outcome::Finding;

impl Verdicts<'_> {
    /// A force pushes the vehicle away, whatever holds its attitude.
    pub(super) fn push_moves(&self) -> Option<Finding> {
        let tasks =
            self.that(|t| !t.own_motion && t.gathered_nm.is_some() && t.tool_error_mm > 1.0);
        let worst = tasks
            .iter()
            .copied()
            .reduce(|a, b| if b.tool_error_mm > a.tool_error_mm { b } else { a })?;
        let text = format!(
            "In {} of {} tasks a force pushes the vehicle away with its attitude held: by {} mm in {} s \
             at most. Wheels and CMGs cannot react a force, thrusters and a grapple can.",
            tasks.len(),
            self.asked(),
            rounded(worst.tool_error_mm),
            worst.duration_s
        );
        Some(finding("no torque reacts a force", text, &tasks))
    }
    /// Tasks that ask the base for nothing: every set suffices, which says nothing of the sets.
    pub(super) fn nothing_asked(&self) -> Option<Finding> {
        let flown = self.tasks.iter().filter(|t| t.unflown.is_none());
        let tasks: Vec<_> = flown.filter(|t| asks_nothing(t)).collect();
        let text = format!(
            "{} of {} tasks ask the base for no torque and no momentum. They say nothing of the sets and \
             are not counted above.",
            tasks.len(),
            self.tasks.len()
        );
        (!tasks.is_empty()).then(|| finding("nothing asked", text, &tasks))
    }
}

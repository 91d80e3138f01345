//! The table of verdicts, and how it is counted.

use super::wording::rounded;
use crate::judgement::Answer;
use crate::outcome::{SetCard, SetKind, SetVerdict, TaskOutcome};
use wrasse_mission::ClaimIs;

/// A task that asks for less torque (N·m) and momentum (N·m·s) than this asks for nothing: it is far
/// below the friction of any bearing, and above what round-off leaves.
const NOTHING: f64 = 1e-6;

/// The table of verdicts.
pub(super) struct Verdicts<'a> {
    /// What the claim of the study says, if it is one that verdicts can be held against.
    pub(super) claim: Option<ClaimIs>,
    pub(super) sets: &'a [SetCard],
    pub(super) tasks: &'a [TaskOutcome],
}

fn is_no_worse(verdict: &SetVerdict, answer: Answer) -> bool {
    verdict.suffices <= answer
}

impl<'a> Verdicts<'a> {
    /// Verdicts of sets of a kind on a task.
    pub(super) fn of(
        &self,
        task: &'a TaskOutcome,
        kind: SetKind,
    ) -> impl Iterator<Item = &'a SetVerdict> {
        let kinds = self.sets.iter().map(move |set| set.kind == kind);
        task.verdicts.iter().zip(kinds.collect::<Vec<_>>()).filter(|(_, is)| *is).map(|(v, _)| v)
    }
    pub(super) fn some(&self, task: &'a TaskOutcome, kind: SetKind, answer: Answer) -> bool {
        self.of(task, kind).any(|verdict| is_no_worse(verdict, answer))
    }
    /// Tasks that were flown, ask for something, and fulfil a condition.
    pub(super) fn that(&self, holds: impl Fn(&'a TaskOutcome) -> bool) -> Vec<&'a TaskOutcome> {
        let counts = |t: &&TaskOutcome| t.unflown.is_none() && !asks_nothing(t);
        self.tasks.iter().filter(counts).filter(|t| holds(t)).collect()
    }
    pub(super) fn asked(&self) -> usize {
        self.that(|_| true).len()
    }
    pub(super) fn has(&self, kind: SetKind) -> bool {
        self.sets.iter().any(|set| set.kind == kind)
    }
    /// What to say of the claim that CMGs are needed, if the study makes it.
    pub(super) fn of_the_claim(&self, text: &'static str) -> &'static str {
        if self.claim == Some(ClaimIs::CmgsNeeded) { text } else { "" }
    }
    /// That thrusters suffice in some of the tasks, and what the cheapest that do take at most (kg).
    pub(super) fn thrusters_too(&self, tasks: &[&'a TaskOutcome]) -> String {
        let least = |t: &&'a TaskOutcome| {
            let enough = self.of(t, SetKind::Thrusters).filter(|v| v.suffices == Answer::Yes);
            enough.filter_map(|v| v.fuel_kg).reduce(f64::min)
        };
        let fuel: Vec<f64> = tasks.iter().filter_map(least).collect();
        if fuel.is_empty() {
            return String::new();
        }
        let most = rounded(1e3 * fuel.iter().copied().fold(0.0, f64::max));
        format!(
            " Thrusters suffice too in {} of them, for up to {most} g of propellant each.",
            fuel.len()
        )
    }
}

pub(super) fn asks_nothing(task: &TaskOutcome) -> bool {
    task.peak_torque_nm < NOTHING && task.peak_momentum_nms < NOTHING
}

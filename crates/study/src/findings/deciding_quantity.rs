//! What decides whether a set suffices: torque, steering, duration, the error of the tool.

use super::verdicts::Verdicts;
use super::wording::{FINEST_MM, finding, rounded, span};
use crate::judgement::Answer;
use crate::outcome::{Finding, Flown, SetKind, SetVerdict};

impl Verdicts<'_> {
    /// No wheels suffice, and some hold the momentum but cannot give the torque: a slower motion is a
    /// remedy.
    pub(super) fn torque_decides(&self) -> Option<Finding> {
        let held = |v: &SetVerdict| v.momentum == Answer::Yes && v.torque == Answer::No;
        let tasks = self.that(|t| {
            !self.some(t, SetKind::Wheels, Answer::Yes) && self.of(t, SetKind::Wheels).any(held)
        });
        let factors = tasks.iter().flat_map(|t| self.of(t, SetKind::Wheels).filter(|v| held(v)));
        let factors: Vec<f64> = factors.filter_map(|v| v.slower.plain).collect();
        let low = factors.iter().copied().fold(f64::INFINITY, f64::min);
        let high = factors.iter().copied().fold(0.0, f64::max);
        let remedy = if factors.is_empty() {
            String::new()
        } else {
            format!(
                " Done {low:.1} to {high:.0} times more slowly, the vehicle's own motions are within them."
            )
        };
        let text = format!(
            "In {} of {} tasks no set of wheels suffices, and one can hold the momentum and lacks only \
             the torque.{remedy}",
            tasks.len(),
            self.asked()
        );
        self.has(SetKind::Wheels).then(|| finding("torque decides", text, &tasks))
    }
    /// CMGs that the envelopes do not rule out, if they are steered past the inner singular surfaces.
    pub(super) fn steering_decides(&self) -> Option<Finding> {
        let needs = |v: &SetVerdict| v.suffices == Answer::WithSteering;
        let tasks = self.that(|t| self.of(t, SetKind::Cmgs).any(needs));
        let pairs: usize =
            tasks.iter().map(|t| self.of(t, SetKind::Cmgs).filter(|v| needs(v)).count()).sum();
        let text = format!(
            "{pairs} times a set of CMGs is not ruled out, but needs steering that starts from good \
             gimbal angles, or avoids or escapes singularities: the demand is within the outer surface, \
             and beyond what the pseudo-inverse reaches. Whether a law gets there, a flight shows."
        );
        (!tasks.is_empty()).then(|| finding("steering decides", text, &tasks))
    }
    /// Tasks that end under load: how long each set lasts.
    pub(super) fn duration_decides(&self) -> Option<Finding> {
        let tasks = self.that(|t| t.gathered_nm.is_some());
        let lasting = |kind| {
            let times =
                tasks.iter().flat_map(|t| self.of(t, kind)).filter(|v| v.torque != Answer::No);
            let times: Vec<f64> = times.filter_map(|v| v.saturates_s.best).collect();
            let low = times.iter().copied().fold(f64::INFINITY, f64::min);
            let high = times.iter().copied().fold(0.0, f64::max);
            (!times.is_empty()).then_some((low, high))
        };
        let mut text = format!(
            "{} of {} tasks end under load and gather momentum on and on.",
            tasks.len(),
            self.asked()
        );
        for (kind, name) in [(SetKind::Wheels, "wheels"), (SetKind::Cmgs, "CMGs")] {
            match lasting(kind) {
                Some((low, high)) => {
                    text += &format!(
                        " Sets of {name} that can give the torque are full after {} to {} s.",
                        rounded(low),
                        rounded(high)
                    );
                }
                None if self.has(kind) => {
                    text += &format!(" No set of {name} can give the torque.");
                }
                None => {}
            }
        }
        (!tasks.is_empty()).then(|| finding("duration decides", text, &tasks))
    }
    /// Closed loop: what the tool says of the sets whose envelope suffices, and of the others.
    pub(super) fn tool_error_decides(&self) -> Option<Finding> {
        let flown = self.that(|t| t.verdicts.iter().any(|v| v.flown.is_some()));
        let told =
            [SetKind::Wheels, SetKind::Cmgs, SetKind::Thrusters, SetKind::Hybrid].map(|kind| {
                let all: Vec<_> = flown
                    .iter()
                    .flat_map(|t| self.of(t, kind))
                    .filter_map(|v| Some((v.suffices != Answer::No, v.flown.as_ref()?)))
                    .collect();
                let parts = [(true, "suffice"), (false, "do not")].map(|(enough, word)| {
                    errors(
                        all.iter().filter(|(is, _)| *is == enough).map(|(_, flown)| *flown),
                        word,
                    )
                });
                let parts: Vec<String> = parts.into_iter().flatten().collect();
                (!parts.is_empty()).then(|| format!(" {}: {}.", name(kind), parts.join("; ")))
            });
        let told: String = told.into_iter().flatten().collect();
        let text = format!(
            "Largest error of the tool in closed loop, with sets that by their envelopes\u{2026}{told}"
        );
        (!told.is_empty()).then(|| finding("tool error decides", text, &flown))
    }
}

fn name(kind: SetKind) -> &'static str {
    match kind {
        SetKind::Ideal => "The reference",
        SetKind::Actuator => "The vehicle's ideal actuator",
        SetKind::Wheels => "Wheels",
        SetKind::Cmgs => "CMGs",
        SetKind::Thrusters => "Thrusters",
        SetKind::Hybrid => "CMGs or wheels with thrusters",
        SetKind::Nothing => "Nothing",
    }
}

/// Smallest and largest tool error of flights, and in how many the requirements hold.
fn errors<'a>(flights: impl Iterator<Item = &'a Flown>, word: &str) -> Option<String> {
    let flights: Vec<&Flown> = flights.collect();
    let errors = || flights.iter().map(|flown| flown.tool_error_mm);
    let (low, high) = (errors().fold(f64::INFINITY, f64::min), errors().fold(0.0, f64::max));
    let hold = flights.iter().filter(|flown| flown.requirements_hold).count();
    (!flights.is_empty()).then(|| {
        format!(
            "{word}, {} mm (requirements hold in {hold} of {} flights)",
            span(low, high, FINEST_MM),
            flights.len()
        )
    })
}

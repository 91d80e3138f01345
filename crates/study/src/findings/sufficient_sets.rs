//! Which kinds of sets suffice, and what the claim of the study is worth there.

use super::verdicts::Verdicts;
use super::wording::{finding, rounded};
use crate::judgement::Answer;
use crate::outcome::{Finding, SetKind};

impl Verdicts<'_> {
    /// The claim holds against wheels: a set of CMGs does, no set of wheels.
    pub(super) fn only_cmgs(&self) -> Option<Finding> {
        let cmgs = |t, answer| self.some(t, SetKind::Cmgs, answer);
        let tasks = self.that(|t| {
            !self.some(t, SetKind::Wheels, Answer::WithSteering) && cmgs(t, Answer::WithSteering)
        });
        let steered = tasks.iter().filter(|t| !cmgs(t, Answer::Yes)).count();
        let mut text = format!(
            "In {} of {} tasks a set of CMGs suffices and no set of wheels does.",
            tasks.len(),
            self.asked()
        );
        if steered > 0 {
            text +=
                &format!(" In {steered} of them only if steering passes inner singular surfaces.");
        }
        text += self.of_the_claim(" There the claim holds against wheels.");
        text += &self.thrusters_too(&tasks);
        let both = self.has(SetKind::Wheels) && self.has(SetKind::Cmgs);
        both.then(|| finding("CMGs are needed", text, &tasks))
    }
    /// The claim is not needed: wheels do.
    pub(super) fn wheels_suffice(&self) -> Option<Finding> {
        let tasks = self.that(|t| self.some(t, SetKind::Wheels, Answer::Yes));
        let text = format!(
            "In {} of {} tasks a set of wheels suffices.{}",
            tasks.len(),
            self.asked(),
            self.of_the_claim(" There the claim does not hold.")
        );
        self.has(SetKind::Wheels).then(|| finding("wheels suffice", text, &tasks))
    }
    /// The claim is not enough: no CMGs do either.
    pub(super) fn neither(&self) -> Option<Finding> {
        let stored = [SetKind::Wheels, SetKind::Cmgs];
        let tasks =
            self.that(|t| stored.iter().all(|kind| !self.some(t, *kind, Answer::WithSteering)));
        let worst = tasks.iter().map(|t| t.peak_torque_nm).fold(0.0, f64::max);
        let mut text = format!(
            "In {} of {} tasks no set of wheels and no set of CMGs suffices (up to {} N·m).",
            tasks.len(),
            self.asked(),
            rounded(worst)
        );
        if tasks.iter().any(|t| t.own_motion) {
            text += " The vehicle's own motions can be done more slowly.";
        }
        if tasks.iter().any(|t| !t.own_motion) {
            text += " Against what acts from outside the load path can be closed by a grapple, or the \
                     line of action moved towards the centre of mass.";
        }
        text += self.of_the_claim(" There the claim says too little.");
        text += &self.thrusters_too(&tasks);
        self.has(SetKind::Cmgs).then(|| finding("not even CMGs", text, &tasks))
    }
    /// Thrusters: what they can do, and what it costs.
    pub(super) fn thrusters(&self) -> Option<Finding> {
        let tasks = self.that(|t| self.some(t, SetKind::Thrusters, Answer::Yes));
        let enough = tasks.iter().flat_map(|t| self.of(t, SetKind::Thrusters));
        let fuel = enough.filter(|v| v.suffices == Answer::Yes).filter_map(|v| v.fuel_kg);
        let most = rounded(1e3 * fuel.fold(0.0, f64::max));
        let text = format!(
            "In {} of {} tasks a set of thrusters can give the torque, for up to {most} g of propellant a \
             time; momentum leaves with the exhaust, so nothing saturates.",
            tasks.len(),
            self.asked()
        );
        self.has(SetKind::Thrusters).then(|| finding("thrusters", text, &tasks))
    }
}

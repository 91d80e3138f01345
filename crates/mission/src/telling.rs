//! What a flight tells of itself for the report: limits that were met or passed, what was missing, what
//! was lost. None of it changes how it goes on.

use crate::flight::Flight;
use crate::limits_passed::{Passed, limits_passed};
use crate::observe::Observation;
use crate::outcome::EventKind;
use crate::saturations::{MISSED, at_limits, describe};
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;
use wrasse_world::BaseAttitude;

/// Angle from which on the attitude counts as lost (rad): 5 deg, where a tool 1 m out is 9 cm off.
const LOST: f64 = 0.0873;

impl Flight<'_> {
    /// Say once in a phase which limits cut the commands of the coming period.
    pub(crate) fn tell_cut(&mut self, command: &Command<f64, JOINTS>) {
        let mut cut = std::mem::take(&mut self.cut);
        for limit in at_limits(self.case, command, &self.world.actuator_readings()) {
            if !cut.contains(&limit) {
                cut.push(limit);
            }
        }
        let (missing, turned) = (command.allocation.missing.torque.norm(), self.turned());
        self.limits.note(&cut, self.world.time(), missing, turned);
        for &saturation in &cut {
            if !self.said.contains(&saturation) {
                self.said.push(saturation);
                let text = describe(self.case, saturation);
                self.say(EventKind::Limit, text);
            }
        }
        self.cut = cut;
    }

    /// Say how long limits were met, and which failures and wrenches the flight was too short for.
    pub(crate) fn sum_up(&mut self) {
        let met = self.limits.summary(self.case);
        for text in met.into_iter().chain(self.refusals.summary()) {
            self.say(EventKind::Limit, text);
        }
        let end = self.world.time();
        let failures = self.case.failures.iter().zip(&self.failed).filter(|(_, failed)| !**failed);
        let mut never: Vec<String> = failures
            .map(|(f, _)| format!("{} was to fail at {} s: the flight ended before", f.name, f.at))
            .collect();
        let wrenches = self.case.wrenches.iter().filter(|wrench| wrench.from >= end);
        never.extend(
            wrenches.map(|w| {
                format!("a wrench was to act from {} s on: the flight ended before", w.from)
            }),
        );
        for text in never {
            self.say(EventKind::Failure, text);
        }
    }

    /// Say once in a phase that torque or force is missing, and once that the attitude is lost.
    pub(crate) fn tell_missing(&mut self, command: &Command<f64, JOINTS>) {
        let (wanted, missing) = (command.allocation.wanted, command.allocation.missing);
        for (kind, of, missing, wanted, unit) in [
            (Passed::TorqueMissing, "torque", missing.torque, wanted.torque, "N·m"),
            (Passed::ForceMissing, "force", missing.force, wanted.force, "N"),
        ] {
            let (missing, wanted) = (missing.norm(), wanted.norm());
            if missing > MISSED * wanted && missing > MISSED {
                let text = format!(
                    "the actuators cannot give the {of} that is wanted: {missing:.3} of {wanted:.3} {unit} \
                     missing"
                );
                self.tell_once(kind, text);
            }
        }
        let time = self.world.time();
        if let Some(text) = self.dead_band.note(self.case, command, time).filter(|_| !self.dry) {
            self.tell_once(Passed::DeadBand, text);
        }
        if command.allocation.desaturation != self.unloads {
            self.unloads = command.allocation.desaturation;
            let stored = command.allocation.stored_B.norm();
            let done = if self.unloads { "begin to empty" } else { "have emptied" };
            let text = format!("thrusters {done} wheels and CMGs: {stored:.2} N·m·s are stored");
            self.say(EventKind::Limit, text);
        }
        if let Some(reason) = command.no_posture_unloading {
            let text = format!("the posture cannot unload the base: {reason}");
            self.tell_once(Passed::NoPostureUnloading, text);
        }
        if self.sensing.blinded {
            let text = "the base turns too fast for its star tracker".into();
            self.tell_once(Passed::Blinded, text);
        }
        if let Some(estimate) = self.computer.navigation().attitude_estimate() {
            for (passed, text) in self.refusals.note(estimate, self.world.time()) {
                self.tell_once(passed, text);
            }
        }
        let turned = self.turned();
        if self.case.base == BaseAttitude::Controlled && turned > LOST && !self.lost {
            self.lost = true;
            let text = format!(
                "attitude control lost: the base stands {:.2} deg from the attitude it should keep",
                turned.to_degrees()
            );
            self.say(EventKind::Limit, text);
        }
    }

    /// Say which limits the truth passes, each once in a phase.
    pub(crate) fn tell_limits(&mut self, seen: &Observation) {
        for (passed, text) in limits_passed(self.case, seen) {
            self.tell_once(passed, text);
        }
    }

    /// Say something that was not yet said in this phase.
    fn tell_once(&mut self, passed: Passed, text: String) {
        if !self.said_passed.contains(&passed) {
            self.said_passed.push(passed);
            self.say(EventKind::Limit, text);
        }
    }
}

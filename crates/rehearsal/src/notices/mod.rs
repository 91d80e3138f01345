//! What a report tells of a flight: limits that were met or passed, what was missing, what was lost. None of
//! it changes how it goes on.

mod dead_band;
mod estimator_refusals;
mod limits_passed;
pub(crate) mod overlap;
pub(crate) mod saturations;
mod solid_shape;

use crate::outcome::{Event, EventKind};
use crate::signals::observe::Observation;
use crate::simulation::Simulation;
use crate::true_plant::TruePlant;
use dead_band::DeadBand;
use estimator_refusals::Refusals;
use limits_passed::{Passed, limits_passed};
use saturations::{EquipmentLimits, MISSED, at_limits, describe};
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Saturation};

/// Angle from which on the attitude counts as lost (rad): 5 deg, where a tool 1 m out is 9 cm off.
const LOST: f64 = 0.0873;

/// What was said of a flight, and what decides what to say next.
#[derive(Debug, Default)]
pub(crate) struct Notices {
    refusals: Refusals,
    limits: EquipmentLimits,
    dead_band: DeadBand,
    /// Whether the attitude was lost.
    is_lost: bool,
    /// Whether thrusters empty wheels and CMGs.
    unloads: bool,
    /// The step that is flown, and what was already said of it.
    phase: Option<usize>,
    cut: Vec<Saturation>,
    passed: Vec<Passed>,
}

/// A flight in its world.
type Flight<'s, 'a> = &'s Simulation<'a, TruePlant<'a>>;

impl Notices {
    /// Say once in a phase which limits cut the commands of the coming period.
    pub(crate) fn commanded(
        &mut self,
        flight: Flight<'_, '_>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        if self.phase.replace(command.phase) != Some(command.phase) {
            self.cut.clear();
            self.passed.clear();
        }
        let (case, plant, time_s) = (flight.case(), flight.plant(), flight.time());
        let mut cut = plant.cut.clone();
        for limit in at_limits(case, command, &plant.actuator_readings()) {
            if !cut.contains(&limit) {
                cut.push(limit);
            }
        }
        let missing = command.allocation.missing.torque.norm();
        self.limits.note(&cut, time_s, missing, plant.turned());
        for saturation in cut {
            if !self.cut.contains(&saturation) {
                self.cut.push(saturation);
                let text = describe(case, saturation);
                events.push(Event { time_s, kind: EventKind::Limit, text });
            }
        }
    }

    /// Say how long limits were met, and which failures and wrenches the flight was too short for.
    pub(crate) fn sum_up(&self, flight: Flight<'_, '_>) -> Vec<Event> {
        let (case, end) = (flight.case(), flight.time());
        let mut events = vec![];
        let mut say = |kind, text| events.push(Event { time_s: end, kind, text });
        let met = self.limits.summary(case);
        for text in met.into_iter().chain(self.refusals.summary()) {
            say(EventKind::Limit, text);
        }
        let failures =
            case.failures.iter().zip(&flight.plant().failed).filter(|(_, failed)| !**failed);
        let mut never: Vec<String> = failures
            .map(|(f, _)| format!("{} was to fail at {} s: the flight ended before", f.name, f.at))
            .collect();
        let wrenches = case.wrenches.iter().filter(|wrench| wrench.from >= end);
        never.extend(
            wrenches.map(|w| {
                format!("a wrench was to act from {} s on: the flight ended before", w.from)
            }),
        );
        for text in never {
            say(EventKind::Failure, text);
        }
        events
    }

    /// Say once in a phase that torque or force is missing, and once that the attitude is lost.
    fn tell_missing(
        &mut self,
        flight: Flight<'_, '_>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        let (case, plant, time_s) = (flight.case(), flight.plant(), flight.time());
        let say = |text| Event { time_s, kind: EventKind::Limit, text };
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
                self.tell_once(kind, say(text), events);
            }
        }
        if let Some(text) = self.dead_band.note(case, command, time_s).filter(|_| !plant.is_dry) {
            self.tell_once(Passed::DeadBand, say(text), events);
        }
        if command.allocation.desaturation != self.unloads {
            self.unloads = command.allocation.desaturation;
            let stored = command.allocation.stored_B.norm();
            let done = if self.unloads { "begin to empty" } else { "have emptied" };
            let text = format!("thrusters {done} wheels and CMGs: {stored:.2} N·m·s are stored");
            events.push(say(text));
        }
        if let Some(reason) = command.no_posture_unloading {
            let text = format!("the posture cannot unload the base: {reason}");
            self.tell_once(Passed::NoPostureUnloading, say(text), events);
        }
        if plant.sensing.blinded {
            let text = "the base turns too fast for its star tracker".into();
            self.tell_once(Passed::Blinded, say(text), events);
        }
        if let Some(estimate) = flight.computer().navigation().attitude_estimate() {
            for (passed, text) in self.refusals.note(estimate, time_s) {
                self.tell_once(passed, say(text), events);
            }
        }
        let turned = plant.turned();
        if case.base == BaseAttitude::Controlled && turned > LOST && !self.is_lost {
            self.is_lost = true;
            let text = format!(
                "attitude control lost: the base stands {:.2} deg from the attitude it should keep",
                turned.to_degrees()
            );
            events.push(say(text));
        }
    }

    /// What there is to say after a period of which this was seen.
    pub(crate) fn flown(
        &mut self,
        flight: Flight<'_, '_>,
        command: &Command<f64, JOINTS>,
        seen: &Observation,
        events: &mut Vec<Event>,
    ) {
        let time_s = flight.time();
        for (passed, text) in limits_passed(flight.case(), seen) {
            self.tell_once(passed, Event { time_s, kind: EventKind::Limit, text }, events);
        }
        self.tell_missing(flight, command, events);
    }

    /// Say something that was not yet said in this phase.
    fn tell_once(&mut self, passed: Passed, event: Event, events: &mut Vec<Event>) {
        if !self.passed.contains(&passed) {
            self.passed.push(passed);
            events.push(event);
        }
    }
}

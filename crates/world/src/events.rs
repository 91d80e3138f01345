//! Events that depend on the state: a quantity crosses zero within a step, the crossing is located to the
//! last bits of time, something happens, and the integration starts again.

use crate::advance::NonFinite;
use crate::couplings::Coupled;
use crate::scene::Scene;
use crate::system::System;
use std::fmt;
use wrasse_spatial::Quat;

/// Which way a quantity crosses zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// From below zero to zero or above.
    Rising,
    /// From zero or above to below zero.
    Falling,
    /// Either way.
    Any,
}

impl Crossing {
    fn has_happened(self, before: f64, after: f64) -> bool {
        let (rises, falls) = (before < 0.0 && after >= 0.0, before >= 0.0 && after < 0.0);
        match self {
            Self::Rising => rises,
            Self::Falling => falls,
            Self::Any => rises || falls,
        }
    }
}

/// A quantity of a scene.
pub type EventValue<const J: usize> = Box<dyn Fn(&Scene<J>) -> f64 + Send + Sync>;
/// What happens to a scene.
pub type Happening<const J: usize> = Box<dyn FnMut(&mut Scene<J>) + Send + Sync>;

/// What happens when a quantity crosses zero.
pub struct Event<const J: usize> {
    /// The quantity, smooth where nothing happens.
    pub value: EventValue<J>,
    /// Which way.
    pub crossing: Crossing,
    /// What happens then. It is called once for each crossing.
    pub then: Happening<J>,
}

impl<const J: usize> fmt::Debug for Event<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event").field("crossing", &self.crossing).finish_non_exhaustive()
    }
}

/// The events of a scene, their quantities at the last accepted step, and how the scene was there.
#[derive(Debug, Default)]
pub(crate) struct Watched<const J: usize> {
    events: Vec<Event<J>>,
    values: Vec<f64>,
    rows: Vec<(Quat<f64>, Vec<f64>, Vec<f64>)>,
    couplings: Vec<(Vec<f64>, Vec<f64>)>,
    booked: (Vec<f64>, Vec<f64>),
}

impl<const J: usize> Scene<J> {
    /// Let something happen when a quantity crosses zero.
    pub fn add_event(&mut self, event: Event<J>) {
        self.watched.events.push(event);
        self.make_room();
    }

    /// Room for a copy of all variables, where anything is watched.
    pub(crate) fn make_room_for_events(&mut self) {
        if !self.may_go_back() {
            return;
        }
        let copy = |s: &System<J>| (s.quat_NB, s.row.clone(), s.carry.clone());
        self.watched.rows = self.systems.iter().flatten().map(copy).collect();
        let copy = |c: &Coupled| (c.row.clone(), c.carry.clone());
        self.watched.couplings = self.couplings.iter().flatten().map(copy).collect();
        self.watched.booked = (self.booked.clone(), self.booked_carry.clone());
    }

    /// Whether anything may end a step before its time.
    pub(crate) fn may_go_back(&self) -> bool {
        self.has_events() || self.has_contacts()
    }

    pub(crate) fn has_events(&self) -> bool {
        !self.watched.events.is_empty()
    }

    /// Note the quantities and the variables before a step.
    pub(crate) fn note_before_step(&mut self, t: f64) {
        let mut watched = std::mem::take(&mut self.watched);
        let into_period = std::mem::replace(&mut self.clock.into_period, t);
        watched.values.clear();
        watched.values.extend(watched.events.iter().map(|event| (event.value)(self)));
        self.clock.into_period = into_period;
        for (copy, system) in watched.rows.iter_mut().zip(self.systems.iter().flatten()) {
            copy.0 = system.quat_NB;
            copy.1.copy_from_slice(&system.row);
            copy.2.copy_from_slice(&system.carry);
        }
        for (copy, coupled) in watched.couplings.iter_mut().zip(self.couplings.iter().flatten()) {
            copy.0.copy_from_slice(&coupled.row);
            copy.1.copy_from_slice(&coupled.carry);
        }
        watched.booked.0.copy_from_slice(&self.booked);
        watched.booked.1.copy_from_slice(&self.booked_carry);
        self.watched = watched;
    }

    pub(crate) fn return_to_start_of_step(&mut self) {
        let watched = &self.watched;
        for (copy, system) in watched.rows.iter().zip(self.systems.iter_mut().flatten()) {
            system.quat_NB = copy.0;
            system.row.copy_from_slice(&copy.1);
            system.carry.copy_from_slice(&copy.2);
        }
        for (copy, coupled) in watched.couplings.iter().zip(self.couplings.iter_mut().flatten()) {
            coupled.row.copy_from_slice(&copy.0);
            coupled.carry.copy_from_slice(&copy.1);
        }
        self.booked.copy_from_slice(&watched.booked.0);
        self.booked_carry.copy_from_slice(&watched.booked.1);
    }

    /// Whether any quantity has crossed zero since the start of the step.
    fn has_crossed(&self) -> bool {
        let each = self.watched.events.iter().zip(&self.watched.values);
        each.into_iter()
            .any(|(event, before)| event.crossing.has_happened(*before, (event.value)(self)))
    }

    /// After a step of `h` (s) from `t0` (s into the set-points) that was accepted: if a quantity has
    /// crossed zero in it, go back to the crossing and let happen what then happens. `step` makes a step
    /// of a given length from where the scene stands. How long the step has become is returned.
    ///
    /// The first crossing is found by bisection, over steps that all begin where the step began: after 60
    /// of them its time is known to the last bits.
    pub(crate) fn stop_at_events(
        &mut self,
        (t0, h): (f64, f64),
        step: impl Fn(&mut Self, f64, f64) -> Result<(), NonFinite>,
    ) -> Result<f64, NonFinite> {
        let into_period = std::mem::replace(&mut self.clock.into_period, t0 + h);
        if !self.has_crossed() {
            self.clock.into_period = into_period;
            return Ok(h);
        }
        let (mut before, mut after) = (0.0, h);
        let last_bits = 2.0 * f64::EPSILON * (self.clock.period_start + t0 + h).abs();
        while after - before > last_bits {
            let middle = before + 0.5 * (after - before);
            if middle <= before || middle >= after {
                break;
            }
            self.return_to_start_of_step();
            step(self, t0, middle)?;
            self.clock.into_period = t0 + middle;
            if self.has_crossed() { after = middle } else { before = middle }
        }
        self.return_to_start_of_step();
        step(self, t0, after)?;
        self.clock.into_period = t0 + after;
        self.let_happen();
        self.clock.into_period = into_period;
        Ok(after)
    }

    /// Let all that has crossed happen, in the order in which the events were added.
    fn let_happen(&mut self) {
        let mut events = std::mem::take(&mut self.watched.events);
        let crossed: Vec<bool> = events
            .iter()
            .zip(&self.watched.values)
            .map(|(event, before)| event.crossing.has_happened(*before, (event.value)(self)))
            .collect();
        for (event, _) in events.iter_mut().zip(&crossed).filter(|(_, crossed)| **crossed) {
            (event.then)(self);
        }
        // What happened may have added more.
        events.append(&mut self.watched.events);
        self.watched.events = events;
        self.make_room();
    }
}

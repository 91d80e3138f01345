//! Sees what the signals need after each control period, and keeps their statistics.

use crate::case::Case;
use crate::outcome::Event;
use crate::signals::Needs;
use crate::signals::observe::{Observation, Track, observe};
use crate::signals::quantity::Statistics;
use crate::simulation::{Observer, Simulation};
use crate::true_plant::TruePlant;
use wrasse_dynamics::Configuration;
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;

/// Sees signals, and keeps their statistics.
#[derive(Debug)]
pub struct Watch {
    needs: Needs,
    /// Numbers of the quantities that are kept; all without them.
    only: Option<Vec<usize>>,
    track: Track,
    statistics: Statistics,
    last: Option<Observation>,
    /// A place for what a posture gives.
    place: Box<Configuration<f64, JOINTS>>,
}

impl Watch {
    /// All signals of a case, as far as what is worked out has them.
    pub fn new(case: &Case, needs: Needs) -> Self {
        let place = Box::new(Configuration::new());
        let statistics = Statistics::new(case.quantities.clone(), case.phases.len());
        Self { needs, only: None, track: Track::default(), statistics, last: None, place }
    }

    /// The quantities of these numbers alone.
    pub fn of(case: &Case, numbers: Vec<usize>) -> Self {
        let watch = Self::new(case, Needs::of(case, &numbers));
        Self { only: Some(numbers), ..watch }
    }

    /// Sees the period that was flown.
    pub(crate) fn see(
        &mut self,
        flight: &Simulation<'_, TruePlant<'_>>,
        command: &Command<f64, JOINTS>,
    ) -> &Observation {
        let world = &flight.plant().world;
        self.track.follow(command, flight.computer(), &world.quat_NB());
        let seen = observe(flight, command, &self.track, self.needs, &mut self.place);
        match &self.only {
            None => self.statistics.add(command.phase, &seen.values),
            Some(only) => self.statistics.add_only(only, command.phase, &seen.values),
        }
        self.last.insert(seen)
    }

    /// Values of the signals after the last period, in the order of the case's quantities; NaN where one is
    /// absent or was not worked out.
    pub fn values(&self) -> &[f64] {
        self.last.as_ref().map_or(&[], |seen| &seen.values)
    }

    /// What was kept, and what was seen last.
    pub(crate) fn finish(self) -> (Statistics, Option<Observation>) {
        (self.statistics, self.last)
    }
}

impl<'a> Observer<TruePlant<'a>> for Watch {
    fn flown(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &Command<f64, JOINTS>,
        _: &mut Vec<Event>,
    ) {
        self.see(flight, command);
    }
}

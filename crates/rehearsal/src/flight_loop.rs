//! A flight from its start to its end, and those who look on: for a report, or for its verdicts alone.

use crate::case::Case;
use crate::notices::Notices;
use crate::notices::overlap::Overlaps;
use crate::outcome::snapshot::snapshot;
use crate::outcome::telemetry::Recorder;
use crate::outcome::{DemandSample, End, Event, Snapshot, Telemetry};
use crate::signals::Needs;
use crate::signals::observe::{Observation, Track, observe};
use crate::signals::quantity::Statistics;
use crate::signals::watch::Watch;
use crate::simulation::{Observer, Plant, Simulation};
use crate::true_plant::TruePlant;
use wrasse_dynamics::Configuration;
use wrasse_flight::{Command, LONGEST};
use wrasse_vehicle::JOINTS;
use wrasse_world::{Ledger, Stepper};

/// Flies until all steps are done; how it ended.
pub fn fly<P: Plant>(flight: &mut Simulation<'_, P>, observer: &mut dyn Observer<P>) -> End {
    while !flight.is_done() {
        if flight.periods() >= u64::from(LONGEST) {
            return flight.too_long();
        }
        if let Err(end) = flight.step(observer) {
            return end;
        }
    }
    End::Completed
}

/// What a flight for a report leaves behind.
#[derive(Debug)]
pub(crate) struct Flown {
    pub(crate) end: End,
    pub(crate) statistics: Statistics,
    pub(crate) ledger: Ledger,
    pub(crate) events: Vec<Event>,
    pub(crate) overlaps: Overlaps,
    pub(crate) telemetry: Telemetry,
    pub(crate) snapshots: Vec<Snapshot>,
    pub(crate) demand: Vec<DemandSample>,
    /// The last thing seen.
    pub(crate) last: Option<Observation>,
}

/// Looks on for a report: all signals, what is told of a flight, time histories and pictures.
struct Reporter<'p> {
    watch: Watch,
    notices: Notices,
    overlaps: Overlaps,
    recorder: Recorder,
    snapshots: Vec<Snapshot>,
    demand: Vec<DemandSample>,
    /// Control periods that are expected.
    expected: u64,
    progress: &'p mut dyn FnMut(f64),
}

impl<'a> Observer<TruePlant<'a>> for Reporter<'_> {
    fn commanded(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        self.notices.commanded(flight, command, events);
        if flight.periods() == 0 {
            let (track, place) = (Track::before_the_start(), &mut Configuration::new());
            let start = observe(flight, command, &track, Needs::ALL, place);
            self.recorder.sample(flight, command, &start);
        }
    }

    fn flown(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        let (case, world) = (flight.case(), &flight.plant().world);
        let seen = self.watch.see(flight, command);
        self.overlaps.flown(flight, seen, events);
        self.notices.flown(flight, command, seen, events);
        self.demand.push(DemandSample::of(flight.time(), command, seen));
        let (done, is_last) = (flight.periods(), flight.is_done());
        if done % case.periods_per_sample() == 0 || is_last {
            self.recorder.sample(flight, command, seen);
        }
        if is_snapshot(done, self.expected, case.snapshots) || is_last {
            let reference = command.reference.X_NE.translation;
            let tips = [seen.X_NE.translation, reference];
            let guided = flight.computer().tool();
            self.snapshots.push(snapshot(case, world, guided, tips));
        }
        (self.progress)((done as f64 / self.expected as f64).min(1.0));
    }
}

/// Fly a case for its report; `expected` control periods were planned, `progress` is told the share of
/// them that is done.
pub(crate) fn fly_for_report(
    case: &Case,
    stepper: Stepper,
    expected: u64,
    progress: &mut dyn FnMut(f64),
) -> Flown {
    let mut flight = Simulation::with_stepper(case, stepper);
    let world = &flight.plant().world;
    let guided = flight.computer().tool();
    let first = snapshot(case, world, guided, [world.pose(guided).translation; 2]);
    let mut reporter = Reporter {
        watch: Watch::new(case, Needs::ALL),
        notices: Notices::default(),
        overlaps: Overlaps::default(),
        recorder: Recorder::default(),
        snapshots: vec![first],
        demand: vec![],
        expected,
        progress,
    };
    let end = fly(&mut flight, &mut reporter);
    let mut events = flight.events().to_vec();
    events.extend(reporter.notices.sum_up(&flight));
    let (statistics, last) = reporter.watch.finish();
    Flown {
        end,
        statistics,
        ledger: *flight.plant().ledger(),
        events,
        overlaps: reporter.overlaps,
        telemetry: reporter.recorder.finish(),
        snapshots: reporter.snapshots,
        demand: reporter.demand,
        last,
    }
}

/// Whether the drawing shows this period: some evenly between the start and the expected end.
fn is_snapshot(done: u64, expected: u64, count: u32) -> bool {
    let gaps = u64::from(count - 1).max(1);
    (1..gaps).any(|i| (expected * i / gaps).max(1) == done)
}

/// Looks on for verdicts alone.
pub(crate) struct Judge {
    pub(crate) watch: Watch,
    pub(crate) overlaps: Overlaps,
}

impl<'a> Observer<TruePlant<'a>> for Judge {
    fn flown(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        let seen = self.watch.see(flight, command);
        self.overlaps.flown(flight, seen, events);
    }
}

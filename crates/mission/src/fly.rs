//! One case flown for its report: the flight computer and the world, a control period at a time, with
//! all that is recorded of it.

use crate::flight::Flight;
use crate::mission::Case;
use crate::observe::{Observation, Track, Truth, observe};
use crate::outcome::{DemandSample, End, Event, Snapshot, Telemetry};
use crate::overlap::Overlap;
use crate::picture::snapshot;
use crate::plan::Plan;
use crate::quantity::Watch;
use crate::signals::Needs;
use crate::telemetry::Recorder;
use wrasse_world::Stepper;

/// What a flight leaves behind.
#[derive(Debug)]
pub(crate) struct Flown {
    pub(crate) end: End,
    pub(crate) watch: Watch,
    pub(crate) ledger: wrasse_world::Ledger,
    pub(crate) events: Vec<Event>,
    pub(crate) overlaps: Vec<Overlap>,
    pub(crate) telemetry: Telemetry,
    pub(crate) snapshots: Vec<Snapshot>,
    pub(crate) demand: Vec<DemandSample>,
    /// The last thing seen.
    pub(crate) last: Option<Observation>,
}

/// Fly a case as planned; `progress` is told the share that is done.
pub(crate) fn fly(
    case: &Case,
    plan: &Plan,
    stepper: Stepper,
    progress: &mut dyn FnMut(f64),
) -> Flown {
    let mut flight = Flight::new(case, stepper, true);
    let mut watch = Watch::new(case.quantities.clone(), case.phases.len());
    let mut ledger = flight.world.open_ledger();
    let (mut recorder, mut track) = (Recorder::default(), Track::default());
    let (mut snapshots, mut last) = (vec![], None);
    let every = case.periods_per_sample();
    let mut end = End::Completed;
    let mut demand = vec![];
    let tool = flight.world.pose(flight.computer.tool()).translation;
    snapshots.push(snapshot(case, &flight.world, &flight.world.payload_poses(), [tool; 2]));
    for period in 0..plan.periods {
        let command = match flight.next_period() {
            Ok(command) => command,
            Err(stop) => {
                end = stop;
                break;
            }
        };
        track.follow(&command, &flight.computer, &flight.world.quat_NB());
        flight.world.update_ledger(&mut ledger);
        let error = flight.estimate_error;
        let truth = Truth::of(&flight.world, Needs::ALL);
        let jacobian = || flight.computer.task_jacobian();
        let seen = observe(case, &truth, &command, &track, error, Needs::ALL, &jacobian);
        flight.look_for_overlap(&seen, period == 0);
        flight.tell_limits(&seen);
        flight.tell_missing(&command);
        demand.push(DemandSample::of(flight.world.time(), &command, &seen));
        watch.add(command.phase, &seen.values);
        let done = period + 1;
        if done % every == 0 || done == plan.periods {
            recorder.sample(flight.world.time(), case, &seen, &ledger);
        }
        if is_snapshot(done, plan.periods, case.snapshots) {
            let reference = command.reference.X_NE.translation;
            let tips = [seen.X_NE.translation, reference];
            snapshots.push(snapshot(case, &flight.world, &flight.world.payload_poses(), tips));
        }
        last = Some(seen);
        if let Some(stop) = flight.grip(&command) {
            end = stop;
            break;
        }
        flight.world.update_ledger(&mut ledger);
        progress(done as f64 / plan.periods as f64);
    }
    flight.sum_up();
    Flown {
        end,
        watch,
        ledger,
        events: flight.events,
        overlaps: flight.overlaps,
        telemetry: recorder.finish(),
        snapshots,
        demand,
        last,
    }
}

/// Whether the drawing shows this period: the last, and some evenly between it and the start.
fn is_snapshot(done: u64, all: u64, count: u32) -> bool {
    let gaps = u64::from(count - 1).max(1);
    (1..=gaps).any(|i| (all * i / gaps).max(1) == done)
}

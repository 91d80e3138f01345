//! A case run: planned, flown and judged.

use crate::case::Case;
use crate::flight_loop::{Flown, fly_for_report};
use crate::outcome::ledger::ledger;
use crate::outcome::{CaseOutcome, End, Ledger, Metric, Telemetry};
use crate::plan::advice::{advice, with_advice};
use crate::plan::{Plan, plan};
use crate::signals::requirement::Requirement;
use wrasse_world::Stepper;

/// What a run may be asked beyond its mission.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RunOptions {
    /// Run each case a second time at half the step, and report the difference.
    pub error_estimate: bool,
}

/// Run a case: planned, flown and judged; `tell` is told what is done, and which share of it.
pub fn run_case(case: &Case, options: RunOptions, tell: &mut dyn FnMut(&str, f64)) -> CaseOutcome {
    tell("planning", 0.0);
    let plan = plan(case);
    if let Some(end) = &plan.blocked {
        tell("looking for what would help", 0.0);
        return not_flown(case, &plan, advised(case, &plan, end));
    }
    let flown =
        fly_for_report(case, case.stepper, plan.periods, &mut |share| tell("flying", share));
    let mut error_estimate = vec![];
    if options.error_estimate {
        let finer = halved(case.stepper);
        let mut tell = |share| tell("flying at half the step", share);
        let again = fly_for_report(case, finer, plan.periods, &mut tell);
        error_estimate = difference(case, &flown, &again);
    }
    let required = case.requirements.iter().map(|r| r.verdict(&flown.statistics));
    let verdicts: Vec<_> = required.chain(case.overlap_verdicts(&flown.overlaps)).collect();
    let mut ledger = ledger(&flown.ledger, case.base);
    // Of what is not finite there are no books.
    ledger.closes &= !is_breakdown(&flown.end);
    let completed = matches!(flown.end, End::Completed);
    CaseOutcome {
        labels: case.labels.clone(),
        passed: completed && ledger.closes && verdicts.iter().all(|v| v.pass),
        end: flown.end,
        verdicts,
        metrics: flown.statistics.metrics(),
        ledger,
        as_flown: case.as_flown.clone(),
        plan: plan.lines,
        events: flown.events,
        error_estimate,
        telemetry: flown.telemetry,
        demand: flown.demand,
        snapshots: flown.snapshots,
    }
}

/// The outcome of a case whose way ends in the planning: nothing moved.
fn not_flown(case: &Case, plan: &Plan, end: End) -> CaseOutcome {
    CaseOutcome {
        labels: case.labels.clone(),
        passed: false,
        verdicts: case.requirements.iter().map(Requirement::unanswered).collect(),
        metrics: vec![],
        // Of what is not finite there are no books; of what did not move they are closed.
        ledger: Ledger { closes: !is_breakdown(&end), ..Ledger::default() },
        as_flown: case.as_flown.clone(),
        plan: plan.lines.clone(),
        events: vec![],
        error_estimate: vec![],
        telemetry: Telemetry::default(),
        demand: vec![],
        snapshots: vec![],
        end,
    }
}

fn is_breakdown(end: &End) -> bool {
    matches!(end, End::Breakdown { .. })
}

/// An end with what would help.
fn advised(case: &Case, plan: &Plan, end: &End) -> End {
    match end {
        End::Infeasible { phase, time_s, reason } => {
            let reason = with_advice(reason, &advice(case, plan));
            End::Infeasible { phase: phase.clone(), time_s: *time_s, reason }
        }
        other => other.clone(),
    }
}

fn halved(stepper: Stepper) -> Stepper {
    match stepper {
        Stepper::Fixed { step } => Stepper::Fixed { step: 0.5 * step },
        Stepper::Adaptive { tolerance } => Stepper::Adaptive { tolerance: tolerance / 32.0 },
    }
}

/// Error of the first of two runs, the second at half the step: 16/15 of their difference at order
/// four, and no less than it at the adaptive stepper's tighter tolerance.
fn difference(case: &Case, coarse: &Flown, fine: &Flown) -> Vec<Metric> {
    let (Some(a), Some(b)) = (&coarse.last, &fine.last) else { return vec![] };
    let estimate = |name: &str, unit: &str, difference: f64| Metric {
        name: format!("integration_error.{name}"),
        value: difference * 16.0 / 15.0,
        unit: unit.into(),
    };
    let joints = (0..case.vehicle.robot.joint_count())
        .map(|j| (a.state.q[j] - b.state.q[j]).abs())
        .fold(0.0, f64::max);
    let turn = (a.base_turn - b.base_turn).norm();
    let energy = (coarse.ledger.now.energy - fine.ledger.now.energy).abs();
    vec![
        estimate("tool.position", "m", (a.X_NE.translation - b.X_NE.translation).norm()),
        estimate("base.rotation", "rad", turn),
        estimate("base.translation", "m", (a.base_shift - b.base_shift).norm()),
        estimate("joints", "rad or m", joints),
        estimate("energy", "J", energy),
    ]
}

//! A mission run: each case planned, flown and judged.

use crate::advice::{advice, with_advice};
use crate::books::ledger;
use crate::fly::{Flown, fly};
use crate::mission::{Case, Mission};
use crate::outcome::{
    CaseOutcome, End, Ledger, Metric, Outcome, ProvenanceRow, Telemetry, VehicleCard,
};
use crate::overlap::looked_at;
use crate::plan::{Plan, plan};
use crate::requirement::Requirement;
use wrasse_vehicle::Grade;
use wrasse_world::Stepper;

/// What a run may be asked beyond its mission.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RunOptions {
    /// Run each case a second time at half the step, and report the difference.
    pub error_estimate: bool,
}

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress<'a> {
    /// Number of the case, from zero.
    pub case: usize,
    /// Number of cases.
    pub cases: usize,
    /// Share of the case that is done (–).
    pub share: f64,
    /// What is being done.
    pub doing: &'a str,
}

/// Run a mission.
pub fn run(
    mission: &Mission,
    options: RunOptions,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Outcome {
    let cases = mission.cases.len();
    let mut outcomes = vec![];
    for number in 0..cases {
        let mut tell = |doing: &str, share| {
            progress(Progress { case: number, cases, share, doing });
        };
        outcomes.push(run_case(mission, number, options, &mut tell));
    }
    Outcome {
        mission: mission.name.clone(),
        summary: mission.summary.clone(),
        mission_file: mission.file.clone(),
        mission_text: mission.text.clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        seed: mission.seed,
        vehicle: vehicle_card(mission),
        environment: format!("{} {}", environment(mission), looked_at(&mission.cases[0])),
        cases: outcomes,
    }
}

/// What acts on the vehicle, in a sentence.
fn environment(mission: &Mission) -> &'static str {
    if mission.cases.iter().all(|case| case.wrenches.is_empty()) {
        "Free space: nothing acts on the vehicle but its own actuators."
    } else {
        "Free space: nothing acts on the vehicle but its own actuators and the applied wrenches."
    }
}

fn vehicle_card(mission: &Mission) -> VehicleCard {
    let case = &mission.cases[0];
    let vehicle = &case.vehicle;
    let provenance = vehicle.provenance.iter().chain(&case.equipment.provenance);
    let rows = provenance.map(|p| ProvenanceRow {
        of: p.of.clone(),
        grade: match p.grade {
            Grade::Published => "published",
            Grade::Derived => "derived",
            Grade::Assumed => "assumed",
        }
        .into(),
        source: p.source.clone(),
    });
    VehicleCard {
        name: vehicle.name.clone(),
        summary: vehicle.summary.clone(),
        file: case.vehicle_name.clone(),
        mass_kg: vehicle.robot.mass(),
        joints: vehicle.robot.joint_count(),
        provenance: rows.collect(),
        remarks: vehicle
            .remarks
            .iter()
            .chain(&mission.remarks)
            .map(|c| c.message.clone())
            .collect(),
    }
}

/// Run the case of this number alone; `tell` is told what is done, and which share of it.
///
/// # Panics
/// If there is no case of this number.
pub fn run_case(
    mission: &Mission,
    case: usize,
    options: RunOptions,
    tell: &mut dyn FnMut(&str, f64),
) -> CaseOutcome {
    let case = &mission.cases[case];
    tell("planning", 0.0);
    let plan = plan(case);
    if let Some(end) = &plan.blocked {
        tell("looking for what would help", 0.0);
        return not_flown(case, &plan, advised(case, &plan, end));
    }
    let flown = fly(case, &plan, case.stepper, &mut |share| tell("flying", share));
    let mut error_estimate = vec![];
    if options.error_estimate {
        let finer = halved(case.stepper);
        let again = fly(case, &plan, finer, &mut |share| tell("flying at half the step", share));
        error_estimate = difference(case, &flown, &again);
    }
    let required = case.requirements.iter().map(|r| r.verdict(&flown.watch));
    let verdicts: Vec<_> = required.chain(case.overlap_verdicts(&flown.overlaps)).collect();
    let mut ledger = ledger(&flown.ledger, case.base);
    // Of what is not finite there are no books.
    ledger.closes &= !matches!(flown.end, End::Breakdown { .. });
    let completed = matches!(flown.end, End::Completed);
    CaseOutcome {
        labels: case.labels.clone(),
        passed: completed && ledger.closes && verdicts.iter().all(|v| v.pass),
        end: flown.end,
        verdicts,
        metrics: flown.watch.metrics(),
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
        end,
        passed: false,
        verdicts: case.requirements.iter().map(Requirement::unanswered).collect(),
        metrics: vec![],
        ledger: Ledger { closes: true, ..Ledger::default() },
        as_flown: case.as_flown.clone(),
        plan: plan.lines.clone(),
        events: vec![],
        error_estimate: vec![],
        telemetry: Telemetry::default(),
        demand: vec![],
        snapshots: vec![],
    }
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

//! A study flown and judged.

use crate::bounds::Bounds;
use crate::capability::Capability;
use crate::demand::Demand;
use crate::envelope::{Mesh, facets, singular_surfaces};
use crate::findings::findings;
use crate::flights::fly;
use crate::hand_check::Start;
use crate::judgement::{Judgement, judge};
use crate::outcome::{Finding, Flown, SetCard, SetKind, SetVerdict, StudyOutcome, TaskOutcome};
use crate::study::{Study, Task};
use wrasse_hardware::{List, ReactionWheel};
use wrasse_mission::{Progress, ProvenanceRow};
use wrasse_rehearsal::{Booking, CaseOutcome, End, EventKind, Metric, Source};
use wrasse_spatial::{Vec3, vec3};
use wrasse_vehicle::{Equipment, Grade};

/// Rings of faces on a drawn surface, from pole to pole.
const RINGS: u16 = 10;

/// Fly a study on so many threads and judge every set on every task.
pub fn size(study: &Study, threads: usize, progress: &mut dyn FnMut(Progress<'_>)) -> StudyOutcome {
    let flown = fly(&study.mission, &study.cases(), threads, progress);
    let closes = flown.iter().all(|case| case.ledger.closes && !broke_down(case));
    let flights = flown.len();
    let sets: Vec<SetCard> = (0..study.sets.len()).map(|k| card(study, k)).collect();
    let mut flown = flown.into_iter();
    let mut tasks = vec![];
    for task in &study.tasks {
        let count = if task.closed_loop { task.cases.len() } else { 1 };
        let of_task: Vec<_> = flown.by_ref().take(count).collect();
        tasks.push(task_outcome(study, task, &of_task));
    }
    let mission = &study.mission;
    let table = mission.study.as_ref();
    let claim = table.map(|table| table.claim.clone()).unwrap_or_default();
    let claim_is = table.and_then(|table| table.claim_is);
    StudyOutcome {
        study: mission.name.clone(),
        summary: mission.summary.clone(),
        file: mission.file.clone(),
        text: mission.text.clone(),
        settings: mission.settings.clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        seed: mission.seed,
        mass_limit_kg: table.and_then(|table| table.mass_limit_kg),
        power_limit_w: table.and_then(|table| table.power_limit_w),
        flights,
        closes,
        findings: findings(claim_is, &sets, &tasks).into_iter().chain(left_out(study)).collect(),
        claim,
        sets,
        tasks,
    }
}

/// Sets that this vehicle cannot be flown with, and why.
fn left_out(study: &Study) -> Option<Finding> {
    let each = study.left_out.iter().map(|(set, why)| format!("{set}: {why}"));
    let text: Vec<String> = each.collect();
    let about = "left out".to_owned();
    (!text.is_empty()).then(|| Finding { about, text: text.join("; ") + ".", tasks: vec![] })
}

fn broke_down(case: &CaseOutcome) -> bool {
    matches!(case.end, End::Breakdown { .. })
}

/// What a set is, from its case in the first task.
fn card(study: &Study, k: usize) -> SetCard {
    let case = study.tasks.first().and_then(|task| task.cases.get(k)).copied();
    let nothing = Equipment::default();
    let equipment = case.map_or(&nothing, |case| &study.mission.cases[case].equipment);
    let ideal = k == study.reference;
    let limited = case.and_then(|case| study.mission.cases[case].ideal_actuator());
    let capability = match case {
        Some(case) if !ideal => capability(study, case, Vec3::zero()),
        _ => Capability::ideal(),
    };
    let units = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
    let known = |x: Option<f64>| if ideal { None } else { x };
    let limits =
        study.mission.study.as_ref().map(|table| (table.mass_limit_kg, table.power_limit_w));
    let (most_mass, most_power) = limits.unwrap_or_default();
    let within = |x: Option<f64>, most: Option<f64>| known(x).zip(most).map(|(x, most)| x <= most);
    SetCard {
        name: study.sets[k].clone(),
        kind: match limited {
            _ if ideal => SetKind::Ideal,
            Some(_) => SetKind::Actuator,
            None => kind(equipment),
        },
        mass_kg: known(equipment.mass),
        power_w: known(equipment.power),
        within_mass_limit: within(equipment.mass, most_mass),
        within_power_limit: within(equipment.power, most_power),
        propellant_kg: known(capability.propellant),
        torque_nm: units.map(|d| bounded(capability.torque_along(d))),
        momentum_nms: units.map(|d| bounded(capability.momentum_along(d))),
        momentum_everywhere_nms: (!capability.is_unbounded())
            .then(|| capability.momentum.smallest_radius().1),
        provenance: if ideal { vec![] } else { provenance(equipment) },
        surfaces: if ideal { vec![] } else { surfaces(&capability) },
    }
}

/// What the set of a case can do, about a centre of mass (m, base axes). An ideal actuator within its
/// limits is three wheels of these limits along the axes of the base.
fn capability(study: &Study, case: usize, p_BScm_B: Vec3<f64>) -> Capability {
    let Some(limits) = study.mission.cases[case].ideal_actuator() else {
        return Capability::of(&study.mission.cases[case].equipment, p_BScm_B);
    };
    let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
    let wheel = |axis_B| ReactionWheel {
        axis_B,
        inertia: 1.0,
        torque_limit: limits.torque_limit,
        speed_limit: limits.momentum_limit,
        ..ReactionWheel::default()
    };
    let mut three = Equipment::default();
    three.actuators.wheels = List::new(&axes.map(wheel));
    Capability::of(&three, p_BScm_B)
}

fn kind(equipment: &Equipment) -> SetKind {
    let actuators = &equipment.actuators;
    let stores = !(actuators.wheels.is_empty() && actuators.cmgs.is_empty());
    match (actuators.thrusters.is_empty(), stores) {
        (false, true) => SetKind::Hybrid,
        (false, false) => SetKind::Thrusters,
        (true, true) if actuators.cmgs.is_empty() => SetKind::Wheels,
        (true, true) => SetKind::Cmgs,
        (true, false) => SetKind::Nothing,
    }
}

/// A reach for a table; none if endless.
fn bounded(reach: Bounds<f64>) -> Option<Bounds<f64>> {
    reach.best.is_finite().then_some(reach)
}

fn provenance(equipment: &Equipment) -> Vec<ProvenanceRow> {
    let row = |p: &wrasse_vehicle::Provenance| ProvenanceRow {
        of: p.of.clone(),
        grade: match p.grade {
            Grade::Published => "published",
            Grade::Derived => "derived",
            Grade::Assumed => "assumed",
        }
        .into(),
        source: p.source.clone(),
    };
    equipment.provenance.iter().map(row).collect()
}

/// The momentum of a set as surfaces: singular surfaces of CMGs, faces of wheels.
fn surfaces(capability: &Capability) -> Vec<Mesh> {
    if !capability.cmgs.is_empty() {
        return singular_surfaces(&capability.cmgs, RINGS);
    }
    let mut mesh = Mesh::default();
    for facet in facets(&capability.momentum.centred()) {
        let first = mesh.points.len();
        mesh.faces.push((first..first + facet.corners.len()).collect());
        mesh.points.extend(facet.corners);
    }
    if mesh.faces.is_empty() { vec![] } else { vec![mesh] }
}

/// A task from its flights: the reference first, then the other sets if they were flown.
fn task_outcome(study: &Study, task: &Task, flown: &[CaseOutcome]) -> TaskOutcome {
    let reference = &flown[0];
    let own_motion = is_own_motion(reference);
    let demand = demand(reference);
    let start = Start::new(&study.mission.cases[task.cases[study.reference]]);
    let centre = start.centre_of_mass();
    let mut others = flown[1..].iter();
    let verdicts = (0..study.sets.len()).map(|k| {
        let ideal = k == study.reference;
        let capability =
            if ideal { Capability::ideal() } else { capability(study, task.cases[k], centre) };
        let judged = judge(&demand, &capability, own_motion);
        // The reference is the first of the flights, wherever it stands among the sets.
        let flight = if ideal { task.closed_loop.then_some(reference) } else { others.next() };
        verdict(&study.sets[k], &judged, flight.map(flown_with))
    });
    let verdicts = if reference.demand.is_empty() { vec![] } else { verdicts.collect() };
    let rows: Vec<_> = task.labels.iter().map(|(_, row)| row.as_str()).collect();
    let name = if rows.is_empty() { study.mission.name.clone() } else { rows.join(", ") };
    TaskOutcome {
        name,
        labels: task.labels.clone(),
        unflown: ended(reference),
        own_motion,
        duration_s: demand.duration(),
        peak_torque_nm: demand.peak_torque().norm(),
        peak_torque_by_axis_nm: demand.torque_by_axis().to_array(),
        peak_momentum_nms: demand.peak_momentum().norm(),
        gathered_nm: demand.sustained().filter(|_| !own_motion).map(Vec3::norm),
        by_hand: start.by_hand(demand.duration()),
        tool_error_mm: 1e3 * largest_tool_error(reference),
        verdicts,
        demand: demand.thinned(),
    }
}

/// How a flight ended, if not at its end.
fn ended(case: &CaseOutcome) -> Option<String> {
    match &case.end {
        End::Completed => None,
        End::Infeasible { reason, .. }
        | End::Stopped { reason, .. }
        | End::Breakdown { reason, .. } => Some(reason.clone()),
    }
}

/// Whether nothing acts from outside: then the task can be done more slowly.
fn is_own_motion(case: &CaseOutcome) -> bool {
    case.ledger.sources[Source::Applied] == Booking::default()
}

/// The demand on the base of a flight with the reference. The torque is what changed the momentum that
/// the reference stores: also what no feedforward knew of.
fn demand(case: &CaseOutcome) -> Demand {
    let mut demand = Demand::default();
    let (mut time, mut held) = (0.0, Vec3::zero());
    for sample in &case.demand {
        let now = Vec3::from_array(sample.momentum_B);
        demand.torque_B.push((held - now) * (1.0 / (sample.time - time)));
        demand.momentum_B.push(now);
        demand.time.push(sample.time);
        (time, held) = (sample.time, now);
    }
    // Before the first period nothing is held yet.
    if let Some(first) = demand.torque_B.first().copied() {
        demand.time.insert(0, 0.0);
        demand.torque_B.insert(0, first);
        demand.momentum_B.insert(0, Vec3::zero());
    }
    demand.force_B = holding_force(case, &demand);
    demand
}

/// Force that would hold the base against what pulls at the tool (N): the impulse from outside, spread
/// over time as the torque is, for both come of one pull at one lever. Base axes are those of the start.
fn holding_force(case: &CaseOutcome, demand: &Demand) -> Vec<Vec3<f64>> {
    let impulse = case.ledger.sources[Source::Applied].linear;
    let torques = || demand.torque_B.iter().map(|torque| torque.norm());
    let mut before = 0.0;
    let steps = demand.time.iter().map(|t| t - core::mem::replace(&mut before, *t));
    let whole: f64 = torques().zip(steps).map(|(torque, step)| torque * step).sum();
    let share = if whole > 0.0 { 1.0 / whole } else { 0.0 };
    torques().map(|torque| impulse * (-torque * share)).collect()
}

fn largest_tool_error(case: &CaseOutcome) -> f64 {
    case.demand.iter().map(|sample| sample.tool_error).fold(0.0, f64::max)
}

/// The value of a metric.
fn metric(case: &CaseOutcome, name: &str) -> Option<f64> {
    case.metrics.iter().find(|m: &&Metric| m.name == name).map(|m| m.value)
}

/// Whether the requirements hold. One without a value in a flight that came to its end is on units that
/// the set lacks: it does not apply.
fn requirements_hold(case: &CaseOutcome) -> bool {
    let completed = matches!(case.end, End::Completed);
    let holds = |v: &wrasse_rehearsal::Verdict| v.pass || (completed && v.value.is_none());
    case.verdicts.iter().all(holds)
}

fn flown_with(case: &CaseOutcome) -> Flown {
    let limit = case.events.iter().find(|event| event.kind == EventKind::Limit);
    let turns = case.demand.iter().map(|sample| sample.base_turn);
    Flown {
        tool_error_mm: 1e3 * largest_tool_error(case),
        tool_error_at_end_mm: 1e3 * case.demand.last().map_or(0.0, |sample| sample.tool_error),
        attitude_error_deg: turns.fold(0.0, f64::max).to_degrees(),
        propellant_kg: metric(case, "thrusters.propellant_used.final").filter(|kg| *kg > 0.0),
        requirements_hold: requirements_hold(case),
        ended: ended(case),
        limit: limit.map(|event| event.text.clone()),
        closes: case.ledger.closes,
    }
}

fn verdict(set: &str, judged: &Judgement, flown: Option<Flown>) -> SetVerdict {
    let finite = |x: f64| x.is_finite().then_some(x);
    SetVerdict {
        set: set.to_owned(),
        suffices: judged.torque.max(judged.momentum).max(judged.propellant),
        torque: judged.torque,
        momentum: judged.momentum,
        propellant: judged.propellant,
        torque_load: judged.torque_load.map(finite),
        torque_nm: judged.torque_there.map(finite),
        momentum_nms: judged.momentum_there.map(finite),
        saturates_s: judged.saturates,
        slower: judged.time_scaling,
        fuel_kg: judged.fuel,
        fuel_in_place_kg: judged.fuel_in_place,
        flown,
    }
}

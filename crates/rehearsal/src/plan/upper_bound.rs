//! How long a mission of steps can take, and what its planning could not foresee.

use crate::case::{Case, StepCase};
use crate::outcome::PlanLine;
use crate::plan::Plan;
use crate::plan::step_cycles::{cycle_without_attempts, longest_ways};
use wrasse_flight::{Condition, JointTiming, Next, Phase, Step, Timing};
use wrasse_vehicle::JOINTS;

/// Time in which joints that move come to rest before a line of the tool begins (s).
const REST: f64 = 2.0;

/// The bound and what was not foreseen, where steps end otherwise than by their motions one after the
/// other.
pub(crate) fn upper_bound(case: &Case, plan: &Plan) -> Option<PlanLine> {
    if plan.blocked.is_some() || case.phases.iter().all(|p| is_plain(&p.step)) {
        return None;
    }
    let times: Vec<Option<f64>> =
        case.phases.iter().enumerate().map(|(i, p)| longest(case, plan, i, &p.step)).collect();
    let mut text = match bound(case, &times) {
        Some(bound) => format!("at most {bound:.2} s"),
        None => "no bound is known".into(),
    };
    let names = |wanted: &dyn Fn(usize, &StepCase) -> bool| {
        let found = case.phases.iter().enumerate().filter(|(i, p)| wanted(*i, p));
        found.map(|(_, p)| p.name.as_str()).collect::<Vec<_>>().join(", ")
    };
    let unknown = names(&|i, _| times[i].is_none());
    let taken = names(&|_, p| matches!(p.step.until, Condition::Beyond { .. }));
    let untried = names(&|i, _| plan.longest[i] == 0);
    for (what, list) in [
        ("whose time depends on where they begin", unknown),
        ("whose conditions were taken to hold at their timeouts", taken),
        ("not gone through, for they come after faults or other conditions", untried),
    ] {
        if !list.is_empty() {
            text += &format!("; steps {what}: {list}");
        }
    }
    Some(PlanLine { phase: "duration".into(), text })
}

/// Whether a step ends with its motion and leads to the next.
fn is_plain(step: &Step<f64, JOINTS>) -> bool {
    step.until == Condition::Done
        && step.then == Next::InOrder
        && (step.timeout, step.on_fault, step.attempts) == (None, None, None)
}

/// The longest that a step can take (s); `None` where that is not known.
fn longest(case: &Case, plan: &Plan, number: usize, step: &Step<f64, JOINTS>) -> Option<f64> {
    let flown = plan.longest[number];
    match step.until {
        Condition::Elapsed(time) => Some(step.timeout.map_or(time, |timeout| time.min(timeout))),
        Condition::Done if flown > 0 => Some(flown as f64 * case.period()),
        Condition::Done => {
            let own = step.tasks().map(|task| duration(&task.motion, case.period()));
            let all = own.reduce(|a, b| Some(a?.max(b?))).flatten();
            step.timeout.or(all)
        }
        Condition::Reached { .. } | Condition::Beyond { .. } => step.timeout,
    }
}

/// How long a motion takes wherever it begins (s).
fn duration(motion: &Phase<f64, JOINTS>, period: f64) -> Option<f64> {
    match *motion {
        Phase::MoveTool { timing: Timing::Duration(duration), .. } => Some(duration + REST),
        Phase::MoveJoints { timing: JointTiming::Duration(duration), .. }
        | Phase::Hold { duration, .. }
        | Phase::UnloadByPosture { duration, .. } => Some(duration),
        Phase::Grip { .. } => Some(period),
        Phase::MoveTool { .. } | Phase::MoveJoints { .. } => None,
    }
}

/// The longest that all steps can take (s); `None` where that is not known. A step with attempts begins so
/// often at most, and from each such beginning to the next the way is no longer than the longest one on
/// which the attempts are used up.
fn bound(case: &Case, times: &[Option<f64>]) -> Option<f64> {
    let steps = case.steps();
    if cycle_without_attempts(&steps).is_some() {
        return None;
    }
    let (mut total, mut starts) = (0.0, 1.0);
    for (i, step) in steps.iter().enumerate() {
        let Some(attempts) = step.attempts else { continue };
        let often = if is_in_a_cycle(&steps, i) { f64::from(attempts) } else { 1.0 };
        total += often * times[i]?;
        starts += often;
    }
    let ways = longest_ways(&steps, times).into_iter();
    let longest = ways.reduce(|a, b| Some(a?.max(b?))).flatten()?;
    // What ends the last step may be seen in a period of its own.
    Some(total + starts * longest + case.period())
}

/// Whether a step can come after itself.
fn is_in_a_cycle(steps: &[Step<f64, JOINTS>], number: usize) -> bool {
    let followers = |number: usize| {
        let step = &steps[number];
        let all = [Some(step.then), step.on_fault, step.on_exhausted];
        all.into_iter().flatten().filter_map(move |next| next.after(number, steps.len()))
    };
    let mut reached = vec![false; steps.len()];
    let mut open: Vec<usize> = followers(number).collect();
    while let Some(next) = open.pop() {
        if !std::mem::replace(&mut reached[next], true) {
            open.extend(followers(next));
        }
    }
    reached[number]
}

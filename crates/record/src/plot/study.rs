//! The plots of a study: demand against what the sets can give, time to saturation against force,
//! tool error against the time of a move.

use maud::{Markup, html};
use wrasse_study::{SetCard, SetKind, SetVerdict, StudyOutcome, TaskOutcome};

use super::Line;
use super::chart::Shown::{Linear, Logarithmic};
use super::chart::{Series, Shape, chart};

/// Most tasks whose time histories are drawn.
const TASKS: usize = 40;
/// Points of a curve over a decade.
const CURVE: i32 = 8;

/// Torque and momentum of each task over time, with what each set can give along their peaks.
pub(crate) fn task_figures(outcome: &StudyOutcome) -> Markup {
    let tasks = outcome.tasks.iter().filter(|task| task.unflown.is_none()).take(TASKS);
    html! {
        p.hint {
            "Dashed: what a set can give along the peak of the demand, with plain steering; sets \
             beyond three times the peak are left out."
        }
        div.sheet {
            @for task in tasks {
                (against(outcome, task, &TORQUE).unwrap_or_default())
                (against(outcome, task, &MOMENTUM).unwrap_or_default())
            }
        }
    }
}

/// A quantity that a task asks for and a set can give.
struct DemandQuantity {
    name: &'static str,
    axis: &'static str,
    asked: fn(&TaskOutcome) -> Vec<f64>,
    given: fn(&SetVerdict) -> Option<f64>,
}

const TORQUE: DemandQuantity = DemandQuantity {
    name: "torque",
    axis: "torque (N·m)",
    asked: |task| task.demand.torque_B.iter().map(|v| v.norm()).collect(),
    given: |verdict| verdict.torque_nm.plain,
};
const MOMENTUM: DemandQuantity = DemandQuantity {
    name: "momentum",
    axis: "momentum (N·m·s)",
    asked: |task| task.demand.momentum_B.iter().map(|v| v.norm()).collect(),
    given: |verdict| verdict.momentum_nms.plain,
};

/// A demand over time and the limits of the sets.
fn against(outcome: &StudyOutcome, task: &TaskOutcome, what: &DemandQuantity) -> Option<Markup> {
    let (time, asked) = (&task.demand.time, (what.asked)(task));
    let peak = asked.iter().copied().fold(0.0, f64::max);
    let (first, last) = (time.first()?, time.last()?);
    let points = time.iter().zip(asked).map(|(t, x)| [*t, x]).collect();
    let mut series = vec![Series { name: "asked", line: Line::FIRST, shape: Shape::Line, points }];
    for (k, (set, verdict)) in outcome.sets.iter().zip(&task.verdicts).enumerate() {
        let limit = (what.given)(verdict).filter(|limit| *limit <= 3.0 * peak);
        let Some(limit) = limit else { continue };
        let points = vec![[*first, limit], [*last, limit]];
        series.push(Series { name: &set.name, line: Line::nth(k), shape: Shape::Line, points });
    }
    let title = format!("{}: {}", task.name, what.name);
    chart(&title, [Linear("time (s)"), Linear(what.axis)], &series)
}

/// How long each set lasts against a force on the tool: curves along the direction of the task with
/// the longest lever, points for the tasks that end under load.
pub(crate) fn saturation_figure(outcome: &StudyOutcome) -> Markup {
    let lasting: Vec<_> = outcome.tasks.iter().filter(|t| force(t).is_some()).collect();
    let lever = |task: &TaskOutcome| task.gathered_nm.unwrap_or(0.0) / force(task).unwrap_or(1.0);
    let Some(worst) =
        lasting.iter().copied().reduce(|a, b| if lever(b) > lever(a) { b } else { a })
    else {
        return Markup::default();
    };
    let lever = lever(worst);
    let mut series = vec![];
    for (k, set) in outcome.sets.iter().enumerate() {
        let verdict = &worst.verdicts[k];
        let (Some(torque), Some(momentum)) = (verdict.torque_nm.best, verdict.momentum_nms.best)
        else {
            continue;
        };
        series.push(curve(set, k, lever, torque, momentum));
        let points = lasting.iter().filter_map(|task| {
            let verdict = &task.verdicts[k];
            let able = verdict.torque_load.best.is_some_and(|load| load <= 1.0);
            able.then_some([force(task)?, verdict.saturates_s.best?])
        });
        let points: Vec<_> = points.collect();
        if !points.is_empty() {
            series.push(Series { name: "", line: Line::nth(k), shape: Shape::Points, points });
        }
    }
    let axes = [Logarithmic("force (N)"), Logarithmic("time until full (s)")];
    let figure = chart("Time to saturation against the force on the tool", axes, &series);
    html! {
        (figure.unwrap_or_default())
        p.hint {
            "Curves: momentum over torque, with " (format!("{lever:.3}")) " N·m for each newton as \
             in \u{201c}" (worst.name) "\u{201d}, up to the force whose torque the set can give. \
             Points: the tasks that end under load. With the best steering."
        }
    }
}

/// Size of the force at the end of a task that ends under load (N).
fn force(task: &TaskOutcome) -> Option<f64> {
    task.gathered_nm?;
    let force = task.demand.force_B.last()?.norm();
    (force > 0.0).then_some(force)
}

/// `t = H / (F d)` from a hundredth of a newton on, up to the force that the torque allows.
fn curve(set: &SetCard, k: usize, lever: f64, torque: f64, momentum: f64) -> Series<'_> {
    let most = torque / lever;
    let mut points = vec![];
    for step in 0..=4 * CURVE {
        let force = most * libm::pow(10.0, f64::from(step - 4 * CURVE) / f64::from(CURVE));
        points.push([force, momentum / (force * lever)]);
    }
    points.retain(|[force, _]| *force >= 0.01);
    Series { name: &set.name, line: Line::nth(k), shape: Shape::Line, points }
}

/// Tool error against the time of a move, for the sets that were flown in closed loop.
pub(crate) fn error_figure(outcome: &StudyOutcome) -> Markup {
    let flown: Vec<_> = outcome
        .tasks
        .iter()
        .filter(|task| task.own_motion && task.verdicts.iter().any(|v| v.flown.is_some()))
        .collect();
    let series = outcome.sets.iter().enumerate().map(|(k, set)| {
        let points = flown.iter().filter_map(|task| {
            let error = if set.kind == SetKind::Ideal {
                task.tool_error_mm
            } else {
                task.verdicts[k].flown.as_ref()?.tool_error_mm
            };
            Some([task.duration_s, error])
        });
        let mut points: Vec<_> = points.collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Series { name: &set.name, line: Line::nth(k), shape: Shape::Joined, points }
    });
    let series: Vec<_> = series.filter(|series| !series.points.is_empty()).collect();
    let axes = [Linear("time of the move (s)"), Logarithmic("largest tool error (mm)")];
    chart("Tool error against the time of the move", axes, &series).unwrap_or_default()
}

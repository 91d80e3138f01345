//! The plots of a study: demand against what the sets can give, time to saturation against force, tool
//! error against the time of a move.

use wrasse_study::{SetCard, SetKind, StudyOutcome, TaskOutcome};

use crate::study_plot::{Axis, Mark, Series, plot};

/// Most tasks whose time histories are drawn.
const TASKS: usize = 40;
/// Points of a curve over a decade.
const CURVE: i32 = 8;

const fn linear(label: &str) -> Axis<'_> {
    Axis { label, logarithmic: false }
}

const fn logarithmic(label: &str) -> Axis<'_> {
    Axis { label, logarithmic: true }
}

/// Colours of sets; the first colour of all is that of the demand.
const COLOURS: usize = 15;

/// The colour of a set: the same in every plot.
fn colour(k: usize) -> usize {
    2 + k % COLOURS
}

/// Torque and momentum of each task over time, with what each set can give along their peaks.
pub(crate) fn task_figures(outcome: &StudyOutcome) -> String {
    let tasks = outcome.tasks.iter().filter(|task| task.unflown.is_none()).take(TASKS);
    let figures = tasks.map(|task| {
        let torque: Vec<f64> = task.demand.torque_B.iter().map(|v| v.norm()).collect();
        let momentum: Vec<f64> = task.demand.momentum_B.iter().map(|v| v.norm()).collect();
        let limits = |pick: fn(&wrasse_study::SetVerdict) -> Option<f64>| {
            task.verdicts.iter().map(pick).collect::<Vec<_>>()
        };
        let torques = against(outcome, task, "torque", &torque, &limits(|v| v.torque_nm.plain));
        let momenta =
            against(outcome, task, "momentum", &momentum, &limits(|v| v.momentum_nms.plain));
        torques + &momenta
    });
    format!(
        "<p class=\"hint\">Dashed: what a set can give along the peak of the demand, with plain steering; \
         sets beyond three times the peak are left out.</p>\n<div class=\"sheet\">{}</div>\n",
        figures.collect::<String>()
    )
}

/// A demand over time and the limits of the sets.
fn against(
    outcome: &StudyOutcome,
    task: &TaskOutcome,
    what: &str,
    asked: &[f64],
    limits: &[Option<f64>],
) -> String {
    let time = &task.demand.time;
    let peak = asked.iter().copied().fold(0.0, f64::max);
    let (Some(first), Some(last)) = (time.first(), time.last()) else { return String::new() };
    let points = time.iter().zip(asked).map(|(t, x)| [*t, *x]).collect();
    let mut series = vec![Series { name: "asked".into(), colour: 1, mark: Mark::Line, points }];
    for (k, (set, limit)) in outcome.sets.iter().zip(limits).enumerate() {
        let Some(limit) = limit.filter(|limit| *limit <= 3.0 * peak) else { continue };
        series.push(Series {
            name: set.name.clone(),
            colour: colour(k),
            mark: Mark::Dashed,
            points: vec![[*first, limit], [*last, limit]],
        });
    }
    let unit = if what == "torque" { "torque (N·m)" } else { "momentum (N·m·s)" };
    let title = format!("{}: {what}", task.name);
    plot(&title, linear("time (s)"), linear(unit), &series).unwrap_or_default()
}

/// How long each set lasts against a force on the tool: curves along the direction of the task with the
/// longest lever, points for the tasks that end under load.
pub(crate) fn saturation_figure(outcome: &StudyOutcome) -> String {
    let lasting: Vec<_> = outcome.tasks.iter().filter(|t| force(t).is_some()).collect();
    let lever = |task: &TaskOutcome| task.gathered_nm.unwrap_or(0.0) / force(task).unwrap_or(1.0);
    let Some(worst) =
        lasting.iter().copied().reduce(|a, b| if lever(b) > lever(a) { b } else { a })
    else {
        return String::new();
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
            series.push(Series {
                name: String::new(),
                colour: colour(k),
                mark: Mark::Points,
                points,
            });
        }
    }
    let figure = plot(
        "Time to saturation against the force on the tool",
        logarithmic("force (N)"),
        logarithmic("time until full (s)"),
        &series,
    );
    let figure = figure.unwrap_or_default();
    format!(
        "{figure}<p class=\"hint\">Curves: momentum over torque, with {lever:.3} N·m for each newton as in \
         \u{201c}{}\u{201d}, up to the force whose torque the set can give. Points: the tasks that end \
         under load. With the best steering.</p>\n",
        crate::markup::escaped(&worst.name)
    )
}

/// Size of the force at the end of a task that ends under load (N).
fn force(task: &TaskOutcome) -> Option<f64> {
    task.gathered_nm?;
    let force = task.demand.force_B.last()?.norm();
    (force > 0.0).then_some(force)
}

/// `t = H / (F d)` from a hundredth of a newton on, up to the force that the torque allows.
fn curve(set: &SetCard, k: usize, lever: f64, torque: f64, momentum: f64) -> Series {
    let most = torque / lever;
    let mut points = vec![];
    for step in 0..=4 * CURVE {
        let force = most * libm::pow(10.0, f64::from(step - 4 * CURVE) / f64::from(CURVE));
        points.push([force, momentum / (force * lever)]);
    }
    points.retain(|[force, _]| *force >= 0.01);
    Series { name: set.name.clone(), colour: colour(k), mark: Mark::Line, points }
}

/// Tool error against the time of a move, for the sets that were flown in closed loop.
pub(crate) fn error_figure(outcome: &StudyOutcome) -> String {
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
        // There may be more sets than colours.
        let mark = if k < COLOURS { Mark::Joined } else { Mark::JoinedDashed };
        Series { name: set.name.clone(), colour: colour(k), mark, points }
    });
    let series: Vec<_> = series.filter(|series| !series.points.is_empty()).collect();
    plot(
        "Tool error against the time of the move",
        linear("time of the move (s)"),
        logarithmic("largest tool error (mm)"),
        &series,
    )
    .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_of_eleven_sets_has_a_colour_of_its_own_that_is_not_that_of_the_demand() {
        let colours: Vec<_> = (0..11).map(colour).collect();
        let css = include_str!("../assets/study.css");
        for (k, one) in colours.iter().enumerate() {
            assert!(*one != 1 && !colours[..k].contains(one), "{colours:?}");
            assert!(css.contains(&format!(".line-{one} {{ stroke:")), "{one} is not in the style");
        }
    }
}

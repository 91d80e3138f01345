//! The report's sections on one case: verdicts, motion, plots, plan, events, ledger, metrics.

use wrasse_mission::{CaseOutcome, Ledger, Metric, Verdict};

use crate::comparison::{judged, reason};
use crate::drawing::drawing;
use crate::ledger_rests::ledger_rests;
use crate::markup::{dotted, escaped, figure, table, verdict_mark, words};
use crate::numbers::{beside_limit, power, significant};
use crate::tables::no_ledger;

/// Most events in the page, in the table and in the plots.
pub(crate) const EVENTS: usize = 400;

/// Where a case stands in the page.
pub(crate) struct Place {
    /// Level of its headings.
    pub(crate) level: usize,
    /// What its anchors begin with.
    pub(crate) anchor: String,
}

impl Place {
    /// A section with its heading and an anchor; nothing if there is nothing to put in it.
    fn section(&self, name: &str, title: &str, content: &str) -> String {
        if content.is_empty() {
            return String::new();
        }
        let (level, anchor) = (self.level, &self.anchor);
        format!(
            "<section id=\"{anchor}{name}\">\n<h{level}><a href=\"#{anchor}{name}\">{title}</a></h{level}>\n\
             {content}</section>\n"
        )
    }
}

/// All sections of a case.
pub(crate) fn case_sections(case: &CaseOutcome, place: &Place) -> String {
    [
        place.section("verdicts", "Verdicts", &verdicts(case)),
        place.section("motion", "Motion", &drawing(&case.snapshots).unwrap_or_default()),
        place.section("plots", "Plots", &plots(case)),
        place.section("as-flown", "Laws and world as flown", &as_flown(case)),
        place.section("plan", "Plan", &plan(case)),
        place.section("events", "Events", &events(case)),
        place.section("ledger", "Ledger", &ledger(case)),
        place.section("error", "Integration error", &error_estimate(case)),
        place.section("metrics", "Metrics", &metrics_folded(case)),
    ]
    .concat()
}

fn verdicts(case: &CaseOutcome) -> String {
    let mut html = String::new();
    if let Some(reason) = reason(&case.end) {
        html += &format!("<p class=\"ending\">{}</p>\n", escaped(&reason));
    }
    if case.verdicts.is_empty() {
        return html + "<p>The mission states no requirements.</p>\n";
    }
    let rows: Vec<_> = case.verdicts.iter().map(verdict_row).collect();
    html + &table(
        "verdicts",
        &["Requirement", "Limit", "Value", "Unit", "Verdict", "Of the limit"],
        &rows,
    )
}

fn verdict_row(verdict: &Verdict) -> Vec<String> {
    let value = verdict.value.map_or("none".to_owned(), |v| beside_limit(v, verdict.limit));
    vec![
        format!("<td>{}</td>", dotted(&judged(&verdict.requirement, &verdict.comparison))),
        figure(&format!("{} {}", verdict.comparison, significant(verdict.limit))),
        figure(&value),
        words(&verdict.unit),
        format!("<td>{}</td>", verdict_mark(verdict.pass)),
        share_of_limit(verdict),
    ]
}

/// How much of an upper limit is used, as a bar with its figure.
fn share_of_limit(verdict: &Verdict) -> String {
    let share = verdict.value.map(|value| value / verdict.limit);
    match share {
        Some(share)
            if verdict.comparison.starts_with('<') && verdict.limit > 0.0 && share >= 0.0 =>
        {
            let (length, per_cent) = (100.0 * share.min(1.0), significant_per_cent(share));
            let class = if verdict.pass { "bar" } else { "bar over" };
            format!(
                "<td><span class=\"{class}\"><span style=\"width:{length:.1}%\"></span></span> \
                 {per_cent}</td>"
            )
        }
        _ => "<td></td>".to_owned(),
    }
}

/// A share in per cent, as exact as a margin is read.
fn significant_per_cent(share: f64) -> String {
    let per_cent = 100.0 * share;
    match per_cent {
        p if p > 0.0 && p < 0.1 => "&lt; 0.1 %".to_owned(),
        p if p < 10.0 => format!("{p:.1} %"),
        p if p < 1e4 => format!("{p:.0} %"),
        _ => "&gt; 10000 %".to_owned(),
    }
}

fn plots(case: &CaseOutcome) -> String {
    if case.telemetry.time.is_empty() || case.telemetry.channels.is_empty() {
        return String::new();
    }
    "<p class=\"hint\">Drag across a plot to zoom, double-click to go back; all plots follow. \
     Click a line's name to hide it. Numbered lines are the events below.</p>\n\
     <div class=\"plots\"><p class=\"noscript\">The plots need JavaScript; their numbers are in \
     telemetry.parquet.</p></div>\n"
        .to_owned()
}

fn as_flown(case: &CaseOutcome) -> String {
    let rows: Vec<_> = case
        .as_flown
        .iter()
        .map(|setting| vec![words(&setting.key), words(&setting.value), words(setting.origin)])
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    table("text", &["Setting", "Value", "From"], &rows)
}

fn plan(case: &CaseOutcome) -> String {
    if case.plan.is_empty() {
        return String::new();
    }
    let rows: Vec<_> =
        case.plan.iter().map(|line| vec![words(&line.phase), words(&line.text)]).collect();
    table("text", &["Phase", "What the planning found before the arm moved"], &rows)
}

fn events(case: &CaseOutcome) -> String {
    if case.events.is_empty() {
        return String::new();
    }
    let rows: Vec<_> = case
        .events
        .iter()
        .enumerate()
        .take(EVENTS)
        .map(|(k, event)| {
            let (number, time) = ((k + 1).to_string(), significant(event.time_s));
            vec![figure(&number), figure(&time), words(&event.text)]
        })
        .collect();
    let rest = if case.events.len() > EVENTS {
        let all = case.events.len();
        format!("<p>These are the first {EVENTS} of {all}; summary.json has the rest.</p>\n")
    } else {
        String::new()
    };
    table("text", &["No.", "Time (s)", "What happened"], &rows) + &rest
}

fn ledger(case: &CaseOutcome) -> String {
    if let Some(why) = no_ledger(case) {
        let (first, rest) = why.split_at(1);
        return format!("<p>{}{rest}.</p>\n", first.to_uppercase());
    }
    let ledger = &case.ledger;
    let head = [
        "",
        "Start",
        "Joint drives",
        "Attitude actuator",
        "Thrusters",
        "Outside",
        "With propellant",
        "Grasps",
        "End",
        "Unexplained",
        "Of",
        "Relative",
        "Bound",
    ];
    let names = ["Angular momentum (N·m·s)", "Linear momentum (N·s)", "Kinetic energy (J)"];
    let rows: Vec<Vec<String>> = names
        .iter()
        .zip(ledger_entries(ledger))
        .zip(ledger_rests(ledger))
        .map(|((name, entries), rest)| {
            let rests = [
                power(rest.rest),
                significant(rest.scale),
                power(rest.relative),
                power(rest.bound),
            ];
            let mut row = vec![format!("<th scope=\"row\">{name}</th>")];
            row.extend(entries.iter().chain(&rests).map(|e| format!("<td class=\"n\">{e}</td>")));
            row
        })
        .collect();
    let closes = if ledger.closes {
        "<p><span class=\"pass\">\u{2713} closes</span>: every rest is within its bound.</p>\n"
    } else {
        "<p><span class=\"fail\">\u{2717} stays open</span>: a rest is above its bound.</p>\n"
    };
    format!(
        "{closes}{}{}<p class=\"hint\">Vectors are in inertial axes, angular momentum is about the \
         centre of mass of everything simulated. What the attitude actuator stores is the opposite \
         of its entry; what wheels and CMGs store is part of start and end, and the work on the bodies \
         of thrusters, wheels and CMGs stands under the attitude actuator. Rests are the largest over \
         the run.</p>\n",
        table("ledger", &head, &rows),
        stores(ledger)
    )
}

/// What was booked of angular momentum, linear momentum and energy, in the order of the table.
fn ledger_entries(ledger: &Ledger) -> [[String; 8]; 3] {
    let none = String::new;
    let left = |v: [f64; 3]| stacked(v.map(|x| -x));
    [
        [
            stacked(ledger.angular_start),
            none(),
            stacked(ledger.angular_from_actuator),
            stacked(ledger.angular_from_thrusters),
            stacked(ledger.angular_from_outside),
            left(ledger.angular_with_propellant),
            none(),
            stacked(ledger.angular_end),
        ],
        [
            stacked(ledger.linear_start),
            none(),
            none(),
            stacked(ledger.linear_from_thrusters),
            stacked(ledger.linear_from_outside),
            left(ledger.linear_with_propellant),
            none(),
            stacked(ledger.linear_end),
        ],
        [
            significant(ledger.energy_start),
            significant(ledger.work_of_joints),
            significant(ledger.work_of_actuator),
            none(),
            significant(ledger.work_from_outside),
            significant(-ledger.energy_with_propellant),
            significant(ledger.energy_at_grasps),
            significant(ledger.energy_end),
        ],
    ]
}

/// Where the angular momentum was at the start and at the end, if there are wheels or CMGs.
fn stores(ledger: &Ledger) -> String {
    let each = [("wheels", ledger.angular_in_wheels), ("CMGs", ledger.angular_in_cmgs)];
    let rows: Vec<_> = each
        .into_iter()
        .filter(|(_, [start, end])| start.iter().chain(end).any(|x| *x != 0.0))
        .map(|(what, ends)| {
            let [start, end] = ends.map(|v| format!("<td class=\"n\">{}</td>", stacked(v)));
            vec![words(&format!("in the {what} (N·m·s)")), start, end]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    table("text", &["Angular momentum", "Start", "End"], &rows)
}

/// A vector's components below each other.
fn stacked(value: [f64; 3]) -> String {
    value.map(significant).join("<br/>")
}

fn error_estimate(case: &CaseOutcome) -> String {
    if case.error_estimate.is_empty() {
        return String::new();
    }
    let told = "<p>Estimated from a second run at half the step.</p>\n";
    told.to_owned() + &metrics(&case.error_estimate)
}

fn metrics_folded(case: &CaseOutcome) -> String {
    if case.metrics.is_empty() {
        return String::new();
    }
    format!(
        "<details><summary>Everything that could have been required ({})</summary>\n{}</details>\n",
        case.metrics.len(),
        metrics(&case.metrics)
    )
}

fn metrics(metrics: &[Metric]) -> String {
    let rows: Vec<_> = metrics
        .iter()
        .map(|m| vec![words(&m.name), figure(&significant(m.value)), words(&m.unit)])
        .collect();
    table("text", &["Metric", "Value", "Unit"], &rows)
}

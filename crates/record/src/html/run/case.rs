//! The report's sections on one case: verdicts, motion, plots, plan, events, ledger, metrics.

use maud::{Markup, html};
use wrasse_rehearsal::{CaseOutcome, Metric, Verdict};

use super::super::{
    Head, dotted, figure, folded, number, section_of_level, table, verdict_mark, words,
};
use super::ledger::ledger;
use crate::plot::motion::drawing;
use crate::wording::cases::{judged, reason};
use crate::wording::numbers::{beside_limit, significant};

/// Most events in the page, in the table and in the plots.
pub(super) const EVENTS: usize = 400;

/// Where a case stands in the page.
pub(super) struct Place {
    /// Level of its headings: 2 or 3.
    pub(super) level: usize,
    /// What its anchors begin with.
    pub(super) anchor: String,
}

/// All sections of a case.
pub(super) fn case_sections(case: &CaseOutcome, place: &Place) -> Markup {
    let section = |name: &str, title: &str, content: Option<Markup>| {
        let anchor = format!("{}{name}", place.anchor);
        section_of_level(place.level, &anchor, title, &content.unwrap_or_default())
    };
    html! {
        (section("verdicts", "Verdicts", Some(verdicts(case))))
        (section("motion", "Motion", drawing(&case.snapshots)))
        (section("plots", "Plots", plots(case)))
        (section("as-flown", "Laws and world as flown", as_flown(case)))
        (section("plan", "Plan", plan(case)))
        (section("events", "Events", events(case)))
        (section("ledger", "Ledger", Some(ledger(case))))
        (section("error", "Integration error", error_estimate(case)))
        (section("metrics", "Metrics", metrics_folded(case)))
    }
}

fn verdicts(case: &CaseOutcome) -> Markup {
    let head = [
        Head::Plain("Requirement"),
        Head::Plain("Limit"),
        Head::Plain("Value"),
        Head::Plain("Unit"),
        Head::Verdict("Verdict"),
        Head::Plain("Of the limit"),
    ];
    let body = html! { @for verdict in &case.verdicts { (verdict_row(verdict)) } };
    html! {
        @if let Some(reason) = reason(&case.end) { p.ending { (reason) } }
        @if case.verdicts.is_empty() { p { "The mission states no requirements." } }
        @else { (table("verdicts", &head, &body)) }
    }
}

fn verdict_row(verdict: &Verdict) -> Markup {
    let value = verdict.value.map_or("none".to_owned(), |v| beside_limit(v, verdict.limit));
    html! {
        tr {
            td { (dotted(&judged(&verdict.requirement, &verdict.comparison))) }
            td.n { (verdict.comparison) " " (significant(verdict.limit)) }
            (figure(&value))
            td { (verdict.unit) }
            td.kept { (verdict_mark(verdict.pass)) }
            td { (share_of_limit(verdict).unwrap_or_default()) }
        }
    }
}

/// How much of an upper limit is used, as a bar with its figure.
fn share_of_limit(verdict: &Verdict) -> Option<Markup> {
    let has_share = verdict.comparison.starts_with('<') && verdict.limit > 0.0;
    let share = verdict.value.map(|value| value / verdict.limit);
    let share = share.filter(|share| has_share && *share >= 0.0)?;
    let class = if verdict.pass { "bar" } else { "bar over" };
    let length = format!("width:{:.1}%", 100.0 * share.min(1.0));
    Some(html! {
        span class=(class) { span style=(length) {} } " " (per_cent(share))
    })
}

/// A share in per cent, as exact as a margin is read.
fn per_cent(share: f64) -> String {
    let per_cent = 100.0 * share;
    match per_cent {
        p if p > 0.0 && p < 0.1 => "< 0.1 %".to_owned(),
        p if p < 10.0 => format!("{p:.1} %"),
        p if p < 1e4 => format!("{p:.0} %"),
        _ => "> 10000 %".to_owned(),
    }
}

fn plots(case: &CaseOutcome) -> Option<Markup> {
    if case.telemetry.time.is_empty() || case.telemetry.channels.is_empty() {
        return None;
    }
    Some(html! {
        p.hint {
            "Drag across a plot to zoom, double-click to go back; all plots follow. Click a line's \
             name to hide it. Numbered lines are the events below, red ones the limits of \
             requirements, with an arrow where they lie beyond the plot."
        }
        div.plots {
            p.noscript {
                "The plots need JavaScript; their numbers are in telemetry.parquet."
            }
        }
    })
}

fn as_flown(case: &CaseOutcome) -> Option<Markup> {
    let rows = case.as_flown.iter().map(|s| [&*s.key, &s.value, s.origin]);
    (!case.as_flown.is_empty()).then(|| words(["Setting", "Value", "From"], rows))
}

fn plan(case: &CaseOutcome) -> Option<Markup> {
    let head = ["Phase", "What the planning found before the arm moved"];
    let rows = case.plan.iter().map(|line| [&*line.phase, &line.text]);
    (!case.plan.is_empty()).then(|| words(head, rows))
}

fn events(case: &CaseOutcome) -> Option<Markup> {
    let all = case.events.len();
    let body = html! {
        @for (k, event) in case.events.iter().enumerate().take(EVENTS) {
            tr { td.n { (k + 1) } (number(Some(event.time_s), "")) td { (event.text) } }
        }
    };
    let head = ["No.", "Time (s)", "What happened"].map(Head::Plain);
    (all > 0).then(|| {
        html! {
            (table("text", &head, &body))
            @if all > EVENTS {
                p { "These are the first " (EVENTS) " of " (all) "; summary.json has the rest." }
            }
        }
    })
}

fn error_estimate(case: &CaseOutcome) -> Option<Markup> {
    (!case.error_estimate.is_empty()).then(|| {
        html! {
            p { "Estimated from a second run at half the step." }
            (metrics(&case.error_estimate))
        }
    })
}

fn metrics_folded(case: &CaseOutcome) -> Option<Markup> {
    let summary = format!("Everything that could have been required ({})", case.metrics.len());
    (!case.metrics.is_empty()).then(|| folded(&summary, &metrics(&case.metrics)))
}

fn metrics(metrics: &[Metric]) -> Markup {
    let body = html! {
        @for metric in metrics {
            tr { td { (metric.name) } (number(Some(metric.value), "")) td { (metric.unit) } }
        }
    };
    table("text", &["Metric", "Value", "Unit"].map(Head::Plain), &body)
}

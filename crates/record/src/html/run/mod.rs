//! The report of a run: one page that opens without a network.

use maud::{Markup, PreEscaped, html};
use wrasse_mission::{Outcome, VehicleCard};
use wrasse_rehearsal::CaseOutcome;

use super::{
    Head, Page, dotted, facts, figure, file_flown, file_text, folded, json_in_script, section,
    table, verdict_mark, version_and_seed, words,
};
use crate::wording::cases::case_name;
use crate::wording::comparison::{Comparison, comparison, passed};
use crate::wording::numbers::significant;
use case::{Place, case_sections};
use histories::{FEWEST_SAMPLES, NUMBERS, histories, numbers_per_sample};

mod case;
mod histories;
mod ledger;
mod limits;

/// Most of the page that goes to the sections of the cases, plots not counted (bytes).
const DETAILS: usize = 2_500_000;

const UPLOT: &str = include_str!("../../../assets/uplot.min.js");
const UPLOT_STYLE: &str = include_str!("../../../assets/uplot.min.css");
const SCRIPT: &str = include_str!("../../../assets/report.js");

/// The page as text: its styles, scripts, drawings and plotted numbers are all inside, and its
/// content policy forbids it to load anything.
pub fn report_html(outcome: &Outcome) -> String {
    let (cases, shown) = closely(outcome);
    let data = json_in_script(&histories(&outcome.cases[..shown]).to_string());
    let page = Page {
        title: html! { (outcome.mission) " \u{2013} wrasse" },
        styles: &[UPLOT_STYLE],
        main: html! {
            (header(outcome))
            (compared(outcome, shown).unwrap_or_default())
            (what_was_run(outcome))
            (cases)
        },
        version: &outcome.version,
        scripts: html! {
            script type="application/json" id="plot-data" { (data) }
            script { (PreEscaped(UPLOT)) }
            script { (PreEscaped(SCRIPT)) }
        },
    };
    page.text()
}

fn header(outcome: &Outcome) -> Markup {
    let good = outcome.cases.iter().filter(|case| case.passed).count();
    html! {
        header {
            h1 { (outcome.mission) }
            p.lead { (outcome.summary) }
            p.verdict {
                (verdict_mark(passed(outcome)))
                @match outcome.cases.len() {
                    0 => { " " span { "no case was run" } }
                    1 => {}
                    all => { " " span { (good) " of " (all) " cases pass" } }
                }
            }
        }
    }
}

fn what_was_run(outcome: &Outcome) -> Markup {
    let vehicle = &outcome.vehicle;
    let numbers = format!(
        "{} kg without payload, {} moving joints, from {}",
        significant(vehicle.mass_kg),
        vehicle.joints,
        vehicle.file
    );
    let rows = [
        ("Vehicle", format!("{} \u{2013} {}", vehicle.name, vehicle.summary)),
        ("", numbers),
        ("Environment", outcome.environment.clone()),
        ("Mission file", file_flown(&outcome.mission_file, &outcome.settings)),
        version_and_seed(&outcome.version, outcome.seed),
    ];
    let content = html! {
        (facts(&rows))
        (remarks(vehicle).unwrap_or_default())
        (provenance(vehicle))
        (file_text("mission file", &outcome.mission_text))
    };
    section("run", "What was run", &content)
}

fn remarks(vehicle: &VehicleCard) -> Option<Markup> {
    let summary = format!("Remarks on the files ({})", vehicle.remarks.len());
    let list = html! { ul { @for remark in &vehicle.remarks { li { (remark) } } } };
    (!vehicle.remarks.is_empty()).then(|| folded(&summary, &list))
}

fn provenance(vehicle: &VehicleCard) -> Markup {
    if vehicle.provenance.is_empty() {
        let missing = "The vehicle file does not say where its numbers come from.";
        return html! { p.hint { (missing) } };
    }
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for row in &vehicle.provenance {
        match counts.iter_mut().find(|(grade, _)| *grade == row.grade) {
            Some((_, count)) => *count += 1,
            None => counts.push((&row.grade, 1)),
        }
    }
    let counts: Vec<_> = counts.iter().map(|(grade, count)| format!("{count} {grade}")).collect();
    let rows = vehicle.provenance.iter().map(|row| [&*row.of, &row.grade, &row.source]);
    let summary = format!("Where the vehicle's numbers come from ({})", counts.join(", "));
    folded(&summary, &words(["Of", "Grade", "Source"], rows))
}

/// The table that compares the cases, and what chooses the case that is looked at closely.
fn compared(outcome: &Outcome, shown: usize) -> Option<Markup> {
    if outcome.cases.len() < 2 {
        return None;
    }
    let compared = comparison(outcome);
    let largest = compared.largest();
    let body = html! {
        @for (k, row) in compared.rows.iter().enumerate() {
            tr {
                @for label in &row.labels { td { (label) } }
                td {
                    @if k < shown { a href={ "#case-" (k + 1) } { (row.ending) } }
                    @else { (row.ending) }
                }
                td.kept { (verdict_mark(row.passed)) }
                @for (value, most) in row.values.iter().zip(&largest) { (size(*value, *most)) }
            }
        }
    };
    let content = html! {
        (table("comparison", &heads(&compared), &body))
        div id="overlay" {}
    };
    Some(section("cases", "The cases compared", &content))
}

fn heads(compared: &Comparison<'_>) -> Vec<Markup> {
    let mut heads: Vec<Markup> =
        compared.axes.iter().map(|axis| html! { (Head::Plain(axis)) }).collect();
    heads.push(html! { (Head::Plain("Outcome")) (Head::Verdict("Verdict")) });
    heads.extend(compared.columns.iter().map(|column| {
        html! { th scope="col" { (dotted(column.name)) " " small { (column.unit) } } }
    }));
    heads
}

/// A figure with its size beside the column's largest, which the style draws behind it.
fn size(value: Option<f64>, largest: f64) -> Markup {
    let Some(value) = value else {
        return figure("\u{2013}");
    };
    let share = value.abs() / largest;
    let share = if share.is_finite() { share } else { 0.0 };
    html! { td.n style={ "--share:" (format!("{share:.3}")) } { (significant(value)) } }
}

/// The sections of the cases, and for how many of them there is room.
fn closely(outcome: &Outcome) -> (Markup, usize) {
    if let [case] = outcome.cases.as_slice() {
        let place = Place { level: 2, anchor: String::new() };
        let sections = html! { div.case id="case-1" { (case_sections(case, &place)) } };
        return (sections, 1);
    }
    let (mut sections, mut shown, mut numbers) = (String::new(), 0, 0);
    for (k, case) in outcome.cases.iter().enumerate() {
        numbers += numbers_per_sample(case) * FEWEST_SAMPLES.min(case.telemetry.time.len());
        let section = one_of_several(case, k).0;
        if k > 0 && (sections.len() + section.len() > DETAILS || numbers > NUMBERS) {
            break;
        }
        sections += &section;
        shown = k + 1;
    }
    (html! { (chooser(outcome, shown)) (PreEscaped(sections)) }, shown)
}

fn one_of_several(case: &CaseOutcome, k: usize) -> Markup {
    let place = Place { level: 3, anchor: format!("case-{}-", k + 1) };
    html! {
        section.case id={ "case-" (k + 1) } {
            h2 { (case_name(case)) }
            (case_sections(case, &place))
        }
    }
}

fn chooser(outcome: &Outcome, shown: usize) -> Markup {
    html! {
        @if shown < outcome.cases.len() {
            p.hint {
                "To keep the page small, only the first " (shown) " of " (outcome.cases.len())
                " cases are shown closely; summary.json and telemetry.parquet hold them all."
            }
        }
        form id="chooser" {
            label {
                "Case looked at closely "
                select {
                    @for (k, case) in outcome.cases[..shown].iter().enumerate() {
                        option value={ "case-" (k + 1) } {
                            (if case.passed { '\u{2713}' } else { '\u{2717}' }) " "
                            (case_name(case))
                        }
                    }
                }
            }
        }
    }
}

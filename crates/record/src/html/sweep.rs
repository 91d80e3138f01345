//! The report of a sweep: one page that opens without a network and needs no script.

use maud::{Markup, html};
use wrasse_sweep::{CaseSweep, DrawnValue, PassRate, RequirementSweep, SweepOutcome};

use super::{
    Head, Page, facts, figure, file_flown, file_text, folded, number, section, table,
    version_and_seed,
};
use crate::plot::histogram::Histogram;
use crate::wording::cases::name_of;
use crate::wording::numbers::significant;
use crate::wording::sweep::{figures, pass_rate};

/// Cases whose requirements are drawn: more would make the page slow.
const DRAWN: usize = 24;

/// The page as text: styles and drawings are inside, and its content policy forbids it to load
/// anything.
pub fn sweep_html(outcome: &SweepOutcome) -> String {
    let page = Page {
        title: html! { (outcome.mission) " \u{2013} wrasse sweep" },
        styles: &[include_str!("../../assets/sweep.css")],
        main: html! {
            (header(outcome))
            (compared(outcome).unwrap_or_default())
            @for (k, case) in outcome.cases.iter().enumerate() { (case_section(outcome, k, case)) }
            (what_was_flown(outcome))
        },
        version: &outcome.version,
        scripts: Markup::default(),
    };
    page.text()
}

fn header(outcome: &SweepOutcome) -> Markup {
    html! {
        header {
            h1 { (outcome.mission) }
            p.lead { (outcome.summary) }
            @if let [case] = outcome.cases.as_slice() {
                p.verdict { (pass_rate(&case.passed)) " pass" }
            }
            p {
                (outcome.samples) " samples of seed " (outcome.seed) ". Intervals are those of \
                 Clopper and Pearson: whatever the true pass rate is, "
                (significant(100.0 * outcome.confidence)) " % of sweeps enclose it, or more."
            }
        }
    }
}

/// The pass rates of several cases beside each other.
fn compared(outcome: &SweepOutcome) -> Option<Markup> {
    let body = html! {
        @for (k, case) in outcome.cases.iter().enumerate() {
            tr {
                td { a href={ "#case-" (k + 1) } { (name_of(&case.labels)) } }
                td.kept { (pass_rate(&case.passed)) }
                td { (rate_bar(&case.passed)) }
            }
        }
    };
    let head = [Head::Plain("Case"), Head::Verdict("Pass"), Head::Plain("Rate and its interval")];
    let content = html! {
        p { "All cases fly the same draws." }
        (table("text", &head, &body))
    };
    (outcome.cases.len() > 1).then(|| section("cases", "The cases compared", &content))
}

/// A share from 0 to 1 as a mark, its interval as a bar, if it has one.
fn rate_bar(rate: &PassRate) -> Markup {
    let Some([low, high]) = rate.interval else {
        return html! { (if rate.of > 1 { "the same in all" } else { "" }) };
    };
    let told = |x: f64| format!("{x:.1}");
    let at = told((200.0 * rate.share() - 1.0).clamp(0.0, 198.0));
    html! {
        svg.rate viewBox="0 0 200 14" role="img"
            aria-label={ "from " (told(100.0 * low)) " % to " (told(100.0 * high)) " %" } {
            rect.field x="0" y="3" width="200" height="8" {}
            rect.interval x=(told(200.0 * low)) y="3" width=(told((200.0 * (high - low)).max(1.0)))
                height="8" {}
            rect.share x=(at) y="0" width="2" height="14" {}
        }
    }
}

fn case_section(outcome: &SweepOutcome, k: usize, case: &CaseSweep) -> Markup {
    let name = match outcome.cases.len() {
        1 => "Requirements".to_owned(),
        _ => name_of(&case.labels),
    };
    let content = html! {
        (requirements(case))
        (ends(case))
        @if k < DRAWN {
            div.spreads {
                @for (i, requirement) in case.requirements.iter().enumerate() {
                    (drawing(case, i, requirement))
                }
            }
        }
    };
    section(&format!("case-{}", k + 1), &name, &content)
}

fn requirements(case: &CaseSweep) -> Markup {
    let mut head = vec![Head::Plain("Requirement"), Head::Verdict("Holds in")];
    let columns = ["", "min", "p1", "p5", "median", "p95", "p99", "max", "unit"];
    head.extend(columns.map(Head::Plain));
    let body = html! {
        @for requirement in &case.requirements {
            tr {
                td { (requirement.requirement) }
                td.n.kept { (requirement.holds.passed) " of " (requirement.holds.of) }
                td { (rate_bar(&requirement.holds)) }
                @for text in figures(requirement) { (figure(&text)) }
                td { (requirement.unit) }
            }
        }
    };
    html! {
        @if case.requirements.is_empty() { p { "The mission states no requirements." } }
        @else { (table("sweep", &head, &body)) }
    }
}

/// Flights that did not come to their end, and open books.
fn ends(case: &CaseSweep) -> Markup {
    html! {
        @for end in case.ends.iter().filter(|end| end.end != "completed") {
            p.ending {
                (end.count) " of the flights: " (end.end) ". The first, sample " (end.first) ": "
                (end.reason)
            }
        }
        @if case.open_books > 0 {
            p.ending {
                "The ledger stays open in " (case.open_books) " of the flights: a smaller "
                code { "world.step_s" } " closes it if the integration is the reason."
            }
        }
    }
}

/// The spread of one requirement's values, what they go with, and the worst samples.
fn drawing(case: &CaseSweep, i: usize, requirement: &RequirementSweep) -> Markup {
    let histogram = Histogram {
        values: case.rows.iter().filter_map(|row| row.values[i]).collect(),
        limit: requirement.limit,
        large_is_bad: requirement.comparison.starts_with('<'),
        unit: &requirement.unit,
    };
    let goes_with = requirement
        .influences
        .iter()
        .map(|influence| format!("{} ({:+.2})", influence.quantity, influence.rank_correlation));
    let goes_with = goes_with.collect::<Vec<_>>().join(", ");
    html! {
        figure {
            h3 { (requirement.requirement) }
            @if let Some(svg) = histogram.svg() { (svg) } @else { p { "There are no values." } }
            @if !goes_with.is_empty() {
                p.hint { "Goes with (rank correlation): " (goes_with) "." }
            }
            (folded("The worst samples", &worst(requirement)))
        }
    }
}

fn worst(requirement: &RequirementSweep) -> Markup {
    let body = html! {
        @for worst in &requirement.worst {
            tr {
                td.n { (worst.sample) }
                (number(worst.value, "none"))
                td { (flown(&worst.drawn)) }
                td { code { (worst.command) } }
            }
        }
    };
    table("text", &["Sample", "Value", "Flown with", "Fly it again"].map(Head::Plain), &body)
}

/// Values with their deviations: `payload.module.mass_kg 208.3 kg (+8.3)`.
fn flown(drawn: &[DrawnValue]) -> String {
    let each = drawn.iter().map(|d| {
        let sign = if d.deviation < 0.0 { "" } else { "+" };
        let (value, off) = (significant(d.flown), significant(d.deviation));
        format!("{} {value} {} ({sign}{off})", d.quantity, d.unit)
    });
    each.collect::<Vec<_>>().join(", ")
}

fn what_was_flown(outcome: &SweepOutcome) -> Markup {
    let drawn = outcome.cases.first().map_or(&[][..], |case| &case.drawn);
    let body = html! {
        @for d in drawn {
            tr {
                td { (d.quantity) }
                @for value in [Some(d.nominal), d.least, d.largest] { (number(value, "none")) }
                td { (d.unit) }
            }
        }
    };
    let head = ["Drawn anew in each sample", "Files say", "Flown from", "to", "Unit"];
    let rows = [
        ("Mission file", file_flown(&outcome.mission_file, &outcome.settings)),
        version_and_seed(&outcome.version, outcome.seed),
    ];
    let content = html! {
        (facts(&rows))
        @if drawn.is_empty() {
            p {
                "The mission disperses nothing: its samples differ by the noise of sensors and \
                 thrusters only."
            }
        } @else { (table("text", &head.map(Head::Plain), &body)) }
        (file_text("mission file", &outcome.mission_text))
    };
    section("run", "What was flown", &content)
}

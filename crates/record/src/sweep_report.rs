//! The report of a sweep: one page that opens without a network and needs no script.

use wrasse_sweep::{CaseSweep, DrawnValue, PassRate, RequirementSweep, SweepOutcome};

use crate::comparison::name_of;
use crate::markup::{escaped, figure, table, words};
use crate::numbers::significant;
use crate::sweep_histogram::Histogram;
use crate::sweep_tables::{figures, pass_rate};

/// Cases whose requirements are drawn: more would make the page slow.
const DRAWN: usize = 24;

/// The page as text: styles and drawings are inside, and its content policy forbids it to load
/// anything.
pub fn sweep_html(outcome: &SweepOutcome) -> String {
    let cases = outcome.cases.iter().enumerate().map(|(k, case)| case_section(outcome, k, case));
    [
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'\"/>\n",
        &format!("<title>{} \u{2013} wrasse sweep</title>\n", escaped(&outcome.mission)),
        "<style>\n",
        include_str!("../assets/report.css"),
        include_str!("../assets/sweep.css"),
        "</style>\n</head>\n<body>\n<main>\n",
        &header(outcome),
        &compared(outcome),
        &cases.collect::<String>(),
        &what_was_flown(outcome),
        "</main>\n",
        &format!("<footer>wrasse {}</footer>\n", escaped(&outcome.version)),
        "</body>\n</html>\n",
    ]
    .concat()
}

fn header(outcome: &SweepOutcome) -> String {
    let rate = match outcome.cases.as_slice() {
        [case] => format!("<p class=\"verdict\">{} pass</p>\n", escaped(&pass_rate(&case.passed))),
        _ => String::new(),
    };
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{rate}<p>{} samples of seed {}. Intervals are those \
         of Clopper and Pearson: whatever the true pass rate is, {} % of sweeps enclose it, or more.</p>\n\
         </header>\n",
        escaped(&outcome.mission),
        escaped(&outcome.summary),
        outcome.samples,
        outcome.seed,
        significant(100.0 * outcome.confidence)
    )
}

/// The pass rates of several cases beside each other.
fn compared(outcome: &SweepOutcome) -> String {
    if outcome.cases.len() < 2 {
        return String::new();
    }
    let rows: Vec<_> = outcome
        .cases
        .iter()
        .enumerate()
        .map(|(k, case)| {
            let name = escaped(&name_of(&case.labels));
            vec![
                format!("<td><a href=\"#case-{}\">{name}</a></td>", k + 1),
                words(&pass_rate(&case.passed)),
                rate_bar(&case.passed),
            ]
        })
        .collect();
    format!(
        "<section id=\"cases\">\n<h2><a href=\"#cases\">The cases compared</a></h2>\n<p>All cases fly the same \
         draws.</p>\n{}</section>\n",
        table("text", &["Case", "Pass", "Rate and its interval"], &rows)
    )
}

/// A share from 0 to 1 as a mark, its interval as a bar, if it has one.
fn rate_bar(rate: &PassRate) -> String {
    let share = rate.share();
    let Some([low, high]) = rate.interval else {
        return words(if rate.of > 1 { "the same in all" } else { "" });
    };
    format!(
        "<td><svg class=\"rate\" viewBox=\"0 0 200 14\" role=\"img\" aria-label=\"from {:.1} % to {:.1} %\">\
         <rect class=\"field\" x=\"0\" y=\"3\" width=\"200\" height=\"8\"/>\
         <rect class=\"interval\" x=\"{:.1}\" y=\"3\" width=\"{:.1}\" height=\"8\"/>\
         <rect class=\"share\" x=\"{:.1}\" y=\"0\" width=\"2\" height=\"14\"/></svg></td>",
        100.0 * low,
        100.0 * high,
        200.0 * low,
        (200.0 * (high - low)).max(1.0),
        (200.0 * share - 1.0).clamp(0.0, 198.0)
    )
}

fn case_section(outcome: &SweepOutcome, k: usize, case: &CaseSweep) -> String {
    let name = match outcome.cases.len() {
        1 => "Requirements".to_owned(),
        _ => escaped(&name_of(&case.labels)),
    };
    let mut html = format!(
        "<section id=\"case-{0}\">\n<h2><a href=\"#case-{0}\">{name}</a></h2>\n{1}{2}",
        k + 1,
        requirements(case),
        ends(case)
    );
    if k < DRAWN {
        let drawn = case.requirements.iter().enumerate();
        let figures: String = drawn.map(|(i, r)| drawing(case, i, r)).collect();
        html += &format!("<div class=\"spreads\">\n{figures}</div>\n");
    }
    html + "</section>\n"
}

fn requirements(case: &CaseSweep) -> String {
    let head =
        ["Requirement", "Holds in", "", "min", "p1", "p5", "median", "p95", "p99", "max", "unit"];
    let rows: Vec<_> = case
        .requirements
        .iter()
        .map(|r| {
            let mut cells = vec![
                words(&r.requirement),
                figure(&format!("{} of {}", r.holds.passed, r.holds.of)),
                rate_bar(&r.holds),
            ];
            cells.extend(figures(r).iter().map(|text| figure(text)));
            cells.push(words(&r.unit));
            cells
        })
        .collect();
    if rows.is_empty() {
        return "<p>The mission states no requirements.</p>\n".to_owned();
    }
    table("sweep", &head, &rows)
}

/// Flights that did not come to their end, and open books.
fn ends(case: &CaseSweep) -> String {
    let mut html = String::new();
    for end in case.ends.iter().filter(|end| end.end != "completed") {
        html += &format!(
            "<p class=\"ending\">{} of the flights: {}. The first, sample {}: {}</p>\n",
            end.count,
            escaped(&end.end),
            end.first,
            escaped(&end.reason)
        );
    }
    if case.open_books > 0 {
        html += &format!(
            "<p class=\"ending\">The ledger stays open in {} of the flights: a smaller \
             <code>world.step_s</code> closes it if the integration is the reason.</p>\n",
            case.open_books
        );
    }
    html
}

/// The spread of one requirement's values, what they go with, and the worst samples.
fn drawing(case: &CaseSweep, i: usize, requirement: &RequirementSweep) -> String {
    let histogram = Histogram {
        values: case.rows.iter().filter_map(|row| row.values[i]).collect(),
        limit: requirement.limit,
        large_is_bad: requirement.comparison.starts_with('<'),
        unit: &requirement.unit,
    };
    let svg = histogram.svg().unwrap_or_else(|| "<p>There are no values.</p>".to_owned());
    let goes_with: Vec<_> = requirement
        .influences
        .iter()
        .map(|influence| {
            format!("{} ({:+.2})", escaped(&influence.quantity), influence.rank_correlation)
        })
        .collect();
    let goes_with = if goes_with.is_empty() {
        String::new()
    } else {
        format!("<p class=\"hint\">Goes with (rank correlation): {}.</p>\n", goes_with.join(", "))
    };
    let worst: Vec<_> = requirement
        .worst
        .iter()
        .map(|worst| {
            vec![
                figure(&worst.sample.to_string()),
                figure(&worst.value.map_or("none".to_owned(), significant)),
                words(&flown(&worst.drawn)),
                format!("<td><code>{}</code></td>", escaped(&worst.command)),
            ]
        })
        .collect();
    format!(
        "<figure><h3>{}</h3>\n{svg}\n{goes_with}<details><summary>The worst samples</summary>\n{}</details>\
         </figure>\n",
        escaped(&requirement.requirement),
        table("text", &["Sample", "Value", "Flown with", "Fly it again"], &worst)
    )
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

fn what_was_flown(outcome: &SweepOutcome) -> String {
    let drawn = outcome.cases.first().map_or(&[][..], |case| &case.drawn);
    let drawn = if drawn.is_empty() {
        "<p>The mission disperses nothing: its samples differ by the noise of sensors and thrusters \
         only.</p>\n"
            .to_owned()
    } else {
        let shown = |x: Option<f64>| figure(&x.map_or("none".to_owned(), significant));
        let rows = drawn.iter().map(|d| {
            let values = [shown(Some(d.nominal)), shown(d.least), shown(d.largest)];
            [vec![words(&d.quantity)], values.to_vec(), vec![words(&d.unit)]].concat()
        });
        let head = ["Drawn anew in each sample", "Files say", "Flown from", "to", "Unit"];
        table("text", &head, &rows.collect::<Vec<_>>())
    };
    format!(
        "<section id=\"run\">\n<h2><a href=\"#run\">What was flown</a></h2>\n<dl>\n<dt>Mission file</dt>\
         <dd>{}</dd>\n<dt>Version and seed</dt><dd>wrasse {}, seed {}</dd>\n</dl>\n{drawn}<details><summary>Text of the \
         mission file</summary>\n<pre>{}</pre></details>\n</section>\n",
        escaped(&outcome.mission_file),
        escaped(&outcome.version),
        outcome.seed,
        escaped(&outcome.mission_text)
    )
}

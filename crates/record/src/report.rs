//! The report: one page that opens without a network.

use wrasse_mission::{CaseOutcome, Outcome, VehicleCard};

use crate::case_sections::{Place, case_sections};
use crate::comparison::{case_name, comparison};
use crate::markup::{dotted, escaped, figure, json_in_script, table, verdict_mark, words};
use crate::numbers::significant;
use crate::plots::{FEWEST_SAMPLES, NUMBERS, numbers_per_sample, plot_data};
use crate::summary::passed;

/// Most of the page that goes to the sections of the cases, plots not counted (bytes).
const DETAILS: usize = 2_500_000;

/// The page as text: its styles, scripts, drawings and plotted numbers are all inside, and its
/// content policy forbids it to load anything.
pub fn report_html(outcome: &Outcome) -> String {
    let (details, shown) = details(outcome);
    let data = json_in_script(&plot_data(&outcome.cases[..shown]).to_string());
    [
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n",
        &format!("<title>{} \u{2013} wrasse</title>\n", escaped(&outcome.mission)),
        "<style>\n",
        include_str!("../assets/uplot.min.css"),
        include_str!("../assets/report.css"),
        "</style>\n</head>\n<body>\n<main>\n",
        &header(outcome),
        &comparison_section(outcome, shown),
        &what_was_run(outcome),
        &details,
        "</main>\n",
        &format!("<footer>wrasse {}</footer>\n", escaped(&outcome.version)),
        "<script type=\"application/json\" id=\"plot-data\">",
        &data,
        "</script>\n<script>\n",
        include_str!("../assets/uplot.min.js"),
        "</script>\n<script>\n",
        include_str!("../assets/report.js"),
        "</script>\n</body>\n</html>\n",
    ]
    .concat()
}

fn header(outcome: &Outcome) -> String {
    let good = outcome.cases.iter().filter(|case| case.passed).count();
    let mark = verdict_mark(passed(outcome));
    let count = match outcome.cases.len() {
        0 => " <span>no case was run</span>".to_owned(),
        1 => String::new(),
        all => format!(" <span>{good} of {all} cases pass</span>"),
    };
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n<p class=\"verdict\">{mark}{count}</p>\n</header>\n",
        escaped(&outcome.mission),
        escaped(&outcome.summary)
    )
}

fn what_was_run(outcome: &Outcome) -> String {
    let vehicle = &outcome.vehicle;
    let facts = [
        ("Vehicle", format!("{} \u{2013} {}", vehicle.name, vehicle.summary)),
        (
            "",
            format!(
                "{} kg without payload, {} moving joints, from {}",
                significant(vehicle.mass_kg),
                vehicle.joints,
                vehicle.file
            ),
        ),
        ("Environment", outcome.environment.clone()),
        ("Mission file", outcome.mission_file.clone()),
        ("Version and seed", format!("wrasse {}, seed {}", outcome.version, outcome.seed)),
    ];
    let facts: Vec<_> = facts
        .iter()
        .map(|(name, text)| format!("<dt>{name}</dt><dd>{}</dd>\n", escaped(text)))
        .collect();
    format!(
        "<section id=\"run\">\n<h2><a href=\"#run\">What was run</a></h2>\n<dl>\n{}</dl>\n{}{}\
         <details><summary>Text of the mission file</summary>\n<pre>{}</pre></details>\n</section>\n",
        facts.concat(),
        remarks(vehicle),
        provenance(vehicle),
        escaped(&outcome.mission_text)
    )
}

fn remarks(vehicle: &VehicleCard) -> String {
    if vehicle.remarks.is_empty() {
        return String::new();
    }
    let items: Vec<_> =
        vehicle.remarks.iter().map(|r| format!("<li>{}</li>\n", escaped(r))).collect();
    format!(
        "<details><summary>Remarks on the files ({})</summary>\n<ul>{}</ul></details>\n",
        items.len(),
        items.concat()
    )
}

fn provenance(vehicle: &VehicleCard) -> String {
    if vehicle.provenance.is_empty() {
        return "<p class=\"hint\">The vehicle file does not say where its numbers come from.</p>\n"
            .to_owned();
    }
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for row in &vehicle.provenance {
        match counts.iter_mut().find(|(grade, _)| *grade == row.grade) {
            Some((_, count)) => *count += 1,
            None => counts.push((&row.grade, 1)),
        }
    }
    let counts: Vec<_> =
        counts.iter().map(|(grade, count)| format!("{count} {}", escaped(grade))).collect();
    let rows: Vec<_> = vehicle
        .provenance
        .iter()
        .map(|row| vec![words(&row.of), words(&row.grade), words(&row.source)])
        .collect();
    format!(
        "<details><summary>Where the vehicle's numbers come from ({})</summary>\n{}</details>\n",
        counts.join(", "),
        table("text", &["Of", "Grade", "Source"], &rows)
    )
}

/// The table that compares the cases, and what chooses the case that is looked at closely.
fn comparison_section(outcome: &Outcome, shown: usize) -> String {
    if outcome.cases.len() < 2 {
        return String::new();
    }
    let compared = comparison(outcome);
    let mut head: Vec<String> = compared.axes.iter().map(|axis| escaped(axis)).collect();
    head.extend(["Outcome".to_owned(), "Verdict".to_owned()]);
    for column in &compared.columns {
        let name = dotted(column.name);
        head.push(format!("{name} <small>{}</small>", escaped(column.unit)));
    }
    let largest = compared.largest();
    let rows: Vec<_> = compared
        .rows
        .iter()
        .enumerate()
        .map(|(k, row)| {
            let mut cells: Vec<_> = row.labels.iter().map(|label| words(label)).collect();
            let ending = escaped(&row.ending);
            cells.push(if k < shown {
                format!("<td><a href=\"#case-{}\">{ending}</a></td>", k + 1)
            } else {
                format!("<td>{ending}</td>")
            });
            cells.push(format!("<td>{}</td>", verdict_mark(row.passed)));
            cells.extend(row.values.iter().zip(&largest).map(|(v, most)| size_cell(*v, *most)));
            cells
        })
        .collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    format!(
        "<section id=\"cases\">\n<h2><a href=\"#cases\">The cases compared</a></h2>\n{}\
         <div id=\"overlay\"></div>\n</section>\n",
        table("comparison", &head, &rows)
    )
}

/// A figure with its size beside the column's largest, which the style draws behind it.
fn size_cell(value: Option<f64>, largest: f64) -> String {
    let Some(value) = value else {
        return figure("\u{2013}");
    };
    let share = value.abs() / largest;
    let share = if share.is_finite() { share } else { 0.0 };
    format!("<td class=\"n\" style=\"--share:{share:.3}\">{}</td>", significant(value))
}

/// The sections of the cases, and for how many of them there is room.
fn details(outcome: &Outcome) -> (String, usize) {
    if let [case] = outcome.cases.as_slice() {
        let place = Place { level: 2, anchor: String::new() };
        let sections = case_sections(case, &place);
        return (format!("<div id=\"case-1\" class=\"case\">\n{sections}</div>\n"), 1);
    }
    let (mut html, mut shown, mut numbers) = (String::new(), 0, 0);
    for (k, case) in outcome.cases.iter().enumerate() {
        numbers += numbers_per_sample(case) * FEWEST_SAMPLES.min(case.telemetry.time.len());
        let section = one_of_several(case, k);
        if k > 0 && (html.len() + section.len() > DETAILS || numbers > NUMBERS) {
            break;
        }
        html += &section;
        shown = k + 1;
    }
    (chooser(outcome, shown) + &html, shown)
}

fn one_of_several(case: &CaseOutcome, k: usize) -> String {
    let place = Place { level: 3, anchor: format!("case-{}-", k + 1) };
    format!(
        "<section id=\"case-{}\" class=\"case\">\n<h2>{}</h2>\n{}</section>\n",
        k + 1,
        escaped(&case_name(case)),
        case_sections(case, &place)
    )
}

fn chooser(outcome: &Outcome, shown: usize) -> String {
    let options: Vec<_> = outcome.cases[..shown]
        .iter()
        .enumerate()
        .map(|(k, case)| {
            let mark = if case.passed { '\u{2713}' } else { '\u{2717}' };
            format!(
                "<option value=\"case-{}\">{mark} {}</option>",
                k + 1,
                escaped(&case_name(case))
            )
        })
        .collect();
    let rest = if shown < outcome.cases.len() {
        format!(
            "<p class=\"hint\">To keep the page small, only the first {shown} of {} cases are shown \
             closely; summary.json and telemetry.parquet hold them all.</p>\n",
            outcome.cases.len()
        )
    } else {
        String::new()
    };
    format!(
        "{rest}<form id=\"chooser\"><label>Case looked at closely <select>{}</select></label></form>\n",
        options.concat()
    )
}

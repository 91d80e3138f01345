//! The report of a study: one page that opens without a network and needs no script.

use wrasse_study::{Answer, Both, SetCard, SetKind, SetVerdict, StudyOutcome, TaskOutcome};

use crate::markup::{escaped, figure, table, words};
use crate::numbers::{FINEST, beside_largest, counted, error, pace, rounded as short};
use crate::study_envelope::{MomentumPath, envelope_figure};
use crate::study_figures::{error_figure, saturation_figure, task_figures};

/// Most envelopes in one page: each takes a quarter of a megabyte.
const ENVELOPES: usize = 6;

/// The page as text: styles and drawings are inside, and its content policy forbids it to load
/// anything.
pub fn study_html(outcome: &StudyOutcome) -> String {
    [
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'\"/>\n",
        &format!("<title>{} \u{2013} wrasse</title>\n", escaped(&outcome.study)),
        "<style>\n",
        include_str!("../assets/report.css"),
        include_str!("../assets/study.css"),
        "</style>\n</head>\n<body>\n<main>\n",
        &header(outcome),
        &section("findings", "What follows", &findings(outcome)),
        &section("demands", "What the tasks ask", &demands(&outcome.tasks)),
        &section("sets", "The sets of actuators", &sets(&outcome.sets)),
        &section("verdicts", "Which sets can give it", &verdicts(outcome)),
        &section("flights", "Flown in closed loop", &flights(outcome)),
        &section("momentum", "Momentum asked and held", &envelopes(outcome)),
        &section("plots", "Torque and momentum over time", &task_figures(outcome)),
        &section("file", "What was run", &what_was_run(outcome)),
        "</main>\n",
        &format!("<footer>wrasse {}</footer>\n", escaped(&outcome.version)),
        "</body>\n</html>\n",
    ]
    .concat()
}

/// A section with its heading and an anchor; nothing if there is nothing to put in it.
fn section(name: &str, title: &str, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!(
        "<section id=\"{name}\">\n<h2><a href=\"#{name}\">{title}</a></h2>\n{content}</section>\n"
    )
}

fn header(outcome: &StudyOutcome) -> String {
    let claim = if outcome.claim.is_empty() {
        String::new()
    } else {
        format!("<blockquote class=\"claim\"><p>{}</p></blockquote>\n", escaped(&outcome.claim))
    };
    let ledgers = if outcome.closes {
        "<span class=\"pass\">\u{2713} all ledgers close</span>"
    } else {
        "<span class=\"fail\">\u{2717} a ledger stays open</span> A smaller <code>world.step_s</code> closes \
         it if the integration is the reason."
    };
    format!(
        "<header>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{claim}<p>{}, {} of actuators, {}. {ledgers}</p>\n\
         </header>\n",
        escaped(&outcome.study),
        escaped(&outcome.summary),
        counted(outcome.tasks.len(), "task"),
        counted(outcome.sets.len(), "set"),
        counted(outcome.flights, "flight")
    )
}

fn findings(outcome: &StudyOutcome) -> String {
    if outcome.findings.is_empty() {
        return String::new();
    }
    let items = outcome.findings.iter().map(|finding| {
        let tasks = if finding.tasks.is_empty() {
            String::new()
        } else {
            format!(
                "<details><summary>{}</summary><p class=\"hint\">{}</p></details>",
                counted(finding.tasks.len(), "task"),
                escaped(&finding.tasks.join("; "))
            )
        };
        format!("<dt>{}</dt><dd>{}{tasks}</dd>\n", escaped(&finding.about), escaped(&finding.text))
    });
    format!("<dl class=\"findings\">\n{}</dl>\n", items.collect::<String>())
}

fn demands(tasks: &[TaskOutcome]) -> String {
    let rows = tasks.iter().map(|task| {
        let mut row = vec![words(&task.name)];
        if let Some(why) = &task.unflown {
            row.push(format!("<td colspan=\"10\">not flown: {}</td>", escaped(why)));
            return row;
        }
        let hand = task.by_hand.as_ref();
        let [x, y, z] = task.peak_torque_by_axis_nm.map(Some);
        let figures = [
            Some(task.duration_s),
            Some(task.peak_torque_nm),
            hand.map(|h| h.torque),
            x,
            y,
            z,
            Some(task.peak_momentum_nms),
            hand.map(|h| h.momentum),
            task.gathered_nm,
        ];
        let largest = figures.iter().flatten().copied().fold(0.0, f64::max);
        let told = |x: f64| short(beside_largest(x, largest));
        row.extend(figures.map(|x| figure(&x.map_or("\u{2013}".to_owned(), told))));
        let off = beside_largest(task.tool_error_mm, largest);
        row.push(figure(&error(off, FINEST)));
        row
    });
    let head = [
        "Task",
        "Lasts <small>s</small>",
        "Peak torque <small>N·m</small>",
        "by hand",
        "x",
        "y",
        "z",
        "Peak momentum <small>N·m·s</small>",
        "by hand",
        "Gathered at the end <small>N·m</small>",
        "Tool error <small>mm</small>",
    ];
    let hows = tasks.iter().filter_map(|task| {
        let hand = task.by_hand.as_ref()?;
        Some(format!("<dt>{}</dt><dd>{}</dd>\n", escaped(&task.name), escaped(&hand.how)))
    });
    let hows: String = hows.collect();
    let by_hand = if hows.is_empty() {
        String::new()
    } else {
        format!("<details><summary>How it is found by hand</summary><dl>\n{hows}</dl></details>\n")
    };
    "<p class=\"hint\">Each task is flown with the reference. Momentum is what the actuators have to \
     hold; for a task that ends under load it grows on and on.</p>\n"
        .to_owned()
        + &table("sizes", &head, &rows.collect::<Vec<_>>())
        + &by_hand
}

/// A figure with plain steering, and in brackets with the best if that is another.
fn both(value: Both<Option<f64>>, none: &str) -> String {
    both_told(value, none, short)
}

fn both_told(value: Both<Option<f64>>, none: &str, told: fn(f64) -> String) -> String {
    let [plain, best] = [value.plain, value.best].map(|v| v.map_or(none.to_owned(), told));
    figure(&if plain == best { plain } else { format!("{plain} ({best})") })
}

fn sets(sets: &[SetCard]) -> String {
    let reach = |reach: &Option<Both<f64>>| match reach {
        None => figure("any"),
        Some(both_of) => both(Both { plain: Some(both_of.plain), best: Some(both_of.best) }, ""),
    };
    let number = |value: Option<f64>| figure(&value.map_or("\u{2013}".to_owned(), short));
    let rows = sets.iter().map(|set| {
        let mut row = vec![words(&set.name)];
        row.extend(set.torque_nm.iter().map(reach));
        row.extend(set.momentum_nms.iter().map(reach));
        row.push(figure(&set.momentum_everywhere_nms.map_or("any".to_owned(), short)));
        row.extend([set.mass_kg, set.power_w, set.propellant_kg].map(number));
        row
    });
    let head = [
        "Set",
        "Torque x <small>N·m</small>",
        "y",
        "z",
        "Momentum x <small>N·m·s</small>",
        "y",
        "z",
        "in every direction",
        "Mass <small>kg</small>",
        "Power <small>W</small>",
        "Propellant <small>kg</small>",
    ];
    let sources = sets.iter().flat_map(|set| {
        set.provenance
            .iter()
            .map(|p| vec![words(&set.name), words(&p.of), words(&p.grade), words(&p.source)])
    });
    let sources: Vec<_> = sources.collect();
    let sources = if sources.is_empty() {
        String::new()
    } else {
        format!(
            "<details><summary>Where the numbers come from</summary>\n{}</details>\n",
            table("text", &["Set", "Of", "Grade", "Source"], &sources)
        )
    };
    "<p class=\"hint\">CMGs: with steering by the pseudo-inverse from the gimbal angles at the start, and \
     in brackets with the best steering there can be. Thrusters: couples.</p>\n"
        .to_owned()
        + &table("sizes", &head, &rows.collect::<Vec<_>>())
        + &sources
}

fn verdicts(outcome: &StudyOutcome) -> String {
    let mut rows = vec![];
    for task in outcome.tasks.iter().filter(|task| task.unflown.is_none()) {
        rows.push(vec![format!(
            "</tr><tr class=\"task\"><th colspan=\"9\" scope=\"rowgroup\">{} <small>asks {} N·m and {} N·m·s in {} s</small></th>",
            escaped(&task.name),
            short(task.peak_torque_nm),
            short(task.peak_momentum_nms),
            short(task.duration_s)
        )]);
        rows.extend(task.verdicts.iter().map(|verdict| verdict_row(task, verdict)));
    }
    let head = [
        "Set",
        "Torque there <small>N·m</small>",
        "Torque",
        "Momentum there <small>N·m·s</small>",
        "Momentum",
        "Full after <small>s</small>",
        "Times slower",
        "Fuel <small>g</small>",
        "with the base in place <small>g</small>",
    ];
    "<p class=\"hint\">What is there is counted along the peak of the demand. Figures in brackets: with the \
     best steering. A motion that is N times slower needs an N-th of the momentum and an N²-th of the \
     torque; against a force from outside no pace helps. \
     How many times slower is rounded up.</p>\n"
        .to_owned()
        + &table("sizes", &head, &rows)
}

fn verdict_row(task: &TaskOutcome, verdict: &SetVerdict) -> Vec<String> {
    let grams = |kg: Option<f64>| figure(&kg.map_or("\u{2013}".to_owned(), |kg| short(1e3 * kg)));
    let slower =
        if task.own_motion { both_told(verdict.slower, "never", pace) } else { figure("\u{2013}") };
    vec![
        words(&verdict.set),
        both(verdict.torque_nm, "any"),
        format!("<td>{}</td>", mark(verdict.torque)),
        both(verdict.momentum_nms, "any"),
        format!("<td>{}</td>", mark(verdict.momentum)),
        both(verdict.saturates_s, "never"),
        slower,
        grams(verdict.fuel_kg),
        grams(verdict.fuel_in_place_kg),
    ]
}

/// An answer as a sign, a word and a colour.
fn mark(answer: Answer) -> &'static str {
    match answer {
        Answer::Yes => "<span class=\"yes\">\u{2713} yes</span>",
        Answer::WithSteering => "<span class=\"steering\">\u{223c} with steering</span>",
        Answer::No => "<span class=\"no\">\u{2717} no</span>",
    }
}

/// Beside the verdict of a flight whose ledger does not close.
const LEDGER_OPEN: &str = " <span class=\"fail\">\u{2717} ledger open</span>";

fn flights(outcome: &StudyOutcome) -> String {
    let flown = outcome.tasks.iter().flat_map(|task| {
        task.verdicts.iter().filter_map(move |v| Some((task, v, v.flown.as_ref()?)))
    });
    let rows = flown.map(|(task, verdict, flown)| {
        let limit = flown.ended.as_ref().or(flown.limit.as_ref());
        let holds = crate::markup::verdict_mark(flown.requirements_hold);
        let open = if flown.closes { "" } else { LEDGER_OPEN };
        vec![
            words(&task.name),
            words(&verdict.set),
            figure(&error(flown.tool_error_mm, FINEST)),
            figure(&error(flown.tool_error_at_end_mm, FINEST)),
            figure(&error(flown.attitude_error_deg, FINEST)),
            figure(&flown.propellant_kg.map_or("\u{2013}".to_owned(), |kg| short(1e3 * kg))),
            format!("<td>{holds}{open}</td>"),
            words(limit.map_or("", String::as_str)),
        ]
    });
    let rows: Vec<_> = rows.collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = [
        "Task",
        "Set",
        "Tool error <small>mm</small>",
        "at the end <small>mm</small>",
        "Attitude error <small>deg</small>",
        "Propellant <small>g</small>",
        "Requirements",
        "First limit, or how it ended",
    ];
    table("sizes flown", &head, &rows) + &error_figure(outcome)
}

/// The momentum envelopes of the CMGs, with what the tasks ask on top; of the wheels if there are no
/// CMGs.
fn envelopes(outcome: &StudyOutcome) -> String {
    let drawn =
        |kind| outcome.sets.iter().filter(move |set| set.kind == kind && !set.surfaces.is_empty());
    let kind = if drawn(SetKind::Cmgs).next().is_some() { SetKind::Cmgs } else { SetKind::Wheels };
    let mut html = saturation_figure(outcome);
    for set in drawn(kind).take(ENVELOPES) {
        let paths: Vec<_> = largest_demands(outcome)
            .into_iter()
            .map(|task| MomentumPath { name: &task.name, points: &task.demand.momentum_B })
            .collect();
        html +=
            &envelope_figure(&format!("{}.", set.name), &set.surfaces, &paths).unwrap_or_default();
    }
    html
}

/// The tasks that ask for most momentum: some of the vehicle's own motions, some pushes from outside.
fn largest_demands(outcome: &StudyOutcome) -> Vec<&TaskOutcome> {
    let largest = |own_motion: bool| {
        let asks = |t: &&TaskOutcome| t.own_motion == own_motion && t.peak_momentum_nms > 0.0;
        let mut tasks: Vec<_> = outcome.tasks.iter().filter(asks).collect();
        tasks.sort_by(|a, b| b.peak_momentum_nms.total_cmp(&a.peak_momentum_nms));
        tasks.truncate(4);
        tasks
    };
    [largest(true), largest(false)].concat()
}

fn what_was_run(outcome: &StudyOutcome) -> String {
    format!(
        "<dl>\n<dt>File</dt><dd>{}</dd>\n<dt>Version and seed</dt><dd>wrasse {}, seed {}</dd>\n</dl>\n\
         <details><summary>Text of the file</summary>\n<pre>{}</pre></details>\n",
        escaped(&outcome.file),
        escaped(&outcome.version),
        outcome.seed,
        escaped(&outcome.text)
    )
}

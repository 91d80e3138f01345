//! The report of a study: one page that opens without a network and needs no script.

use maud::{Markup, html};
use wrasse_study::{
    Answer, Bounds, Flown, SetCard, SetKind, SetVerdict, StudyOutcome, TaskOutcome,
};

use super::Head::{Plain, Unit, Verdict};
use super::{
    Page, facts, figure, file_flown, file_text, folded, said, section, table, verdict_mark,
    version_and_seed, words,
};
use crate::plot::envelope::{MomentumPath, envelope_figure};
use crate::plot::study::{error_figure, saturation_figure, task_figures};
use crate::wording::numbers::{FINEST, beside_largest, counted, error, pace, rounded as short};

/// Most envelopes in one page: each takes a quarter of a megabyte.
const ENVELOPES: usize = 6;

/// The page as text: styles and drawings are inside, and its content policy forbids it to load
/// anything.
pub fn study_html(outcome: &StudyOutcome) -> String {
    let page = Page {
        title: html! { (outcome.study) " \u{2013} wrasse" },
        styles: &[include_str!("../../assets/study.css")],
        main: html! {
            (header(outcome))
            (section("findings", "What follows", &findings(outcome)))
            (section("demands", "What the tasks ask", &demands(&outcome.tasks)))
            (section("sets", "The sets of actuators", &sets(&outcome.sets)))
            (section("verdicts", "Which sets can give it", &verdicts(outcome)))
            (section("flights", "Flown in closed loop", &flights(outcome)))
            (section("momentum", "Momentum asked and held", &envelopes(outcome)))
            (section("plots", "Torque and momentum over time", &task_figures(outcome)))
            (section("file", "What was run", &what_was_run(outcome)))
        },
        version: &outcome.version,
        scripts: Markup::default(),
    };
    page.text()
}

fn header(outcome: &StudyOutcome) -> Markup {
    html! {
        header {
            h1 { (outcome.study) }
            p.lead { (outcome.summary) }
            @if !outcome.claim.is_empty() { blockquote.claim { p { (outcome.claim) } } }
            p {
                (counted(outcome.tasks.len(), "task")) ", "
                (counted(outcome.sets.len(), "set")) " of actuators, "
                (counted(outcome.flights, "flight")) ". "
                (said(outcome.closes, "all ledgers close", "a ledger stays open"))
                @if !outcome.closes {
                    " A smaller " code { "world.step_s" }
                    " closes it if the integration is the reason."
                }
            }
        }
    }
}

fn findings(outcome: &StudyOutcome) -> Markup {
    let tasks = |tasks: &[String]| {
        folded(&counted(tasks.len(), "task"), &html! { p.hint { (tasks.join("; ")) } })
    };
    html! {
        @if !outcome.findings.is_empty() {
            dl.findings {
                @for finding in &outcome.findings {
                    dt { (finding.about) }
                    dd {
                        (finding.text)
                        @if !finding.tasks.is_empty() { (tasks(&finding.tasks)) }
                    }
                }
            }
        }
    }
}

fn demands(tasks: &[TaskOutcome]) -> Markup {
    let head = [
        Plain("Task"),
        Unit("Lasts", "s"),
        Unit("Peak torque", "N·m"),
        Plain("by hand"),
        Plain("x"),
        Plain("y"),
        Plain("z"),
        Unit("Peak momentum", "N·m·s"),
        Plain("by hand"),
        Unit("Gathered at the end", "N·m"),
        Unit("Tool error", "mm"),
    ];
    let body = html! { @for task in tasks { tr { td { (task.name) } (demand(task)) } } };
    let hows = tasks.iter().filter_map(|t| Some((&*t.name, t.by_hand.as_ref()?.how.clone())));
    let hows: Vec<_> = hows.collect();
    html! {
        p.hint {
            "Each task is flown with the reference. Momentum is what the actuators have to hold; for \
             a task that ends under load it grows on and on."
        }
        (table("sizes", &head, &body))
        @if !hows.is_empty() { (folded("How it is found by hand", &facts(&hows))) }
    }
}

fn demand(task: &TaskOutcome) -> Markup {
    if let Some(why) = &task.unflown {
        return html! { td colspan="10" { "not flown: " (why) } };
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
    html! {
        @for x in figures { (rounded(x.map(|x| beside_largest(x, largest)))) }
        (figure(&error(beside_largest(task.tool_error_mm, largest), FINEST)))
    }
}

/// A cell with three digits of a number; a dash where there is none.
fn rounded(value: Option<f64>) -> Markup {
    figure(&value.map_or("\u{2013}".to_owned(), short))
}

/// A figure with plain steering, and in brackets with the best if that is another.
fn both(value: Bounds<Option<f64>>, none: &str, told: fn(f64) -> String) -> Markup {
    let [plain, best] = [value.plain, value.best].map(|v| v.map_or(none.to_owned(), told));
    figure(&if plain == best { plain } else { format!("{plain} ({best})") })
}

fn sets(sets: &[SetCard]) -> Markup {
    let head = [
        Plain("Set"),
        Unit("Torque x", "N·m"),
        Plain("y"),
        Plain("z"),
        Unit("Momentum x", "N·m·s"),
        Plain("y"),
        Plain("z"),
        Plain("in every direction"),
        Unit("Mass", "kg"),
        Unit("Power", "W"),
        Unit("Propellant", "kg"),
    ];
    let reach = |of: &Option<Bounds<f64>>| {
        let [plain, best] = [of.map(|of| of.plain), of.map(|of| of.best)];
        both(Bounds { plain, best }, "any", short)
    };
    let body = html! {
        @for set in sets {
            tr {
                td { (set.name) }
                @for of in set.torque_nm.iter().chain(&set.momentum_nms) { (reach(of)) }
                (figure(&set.momentum_everywhere_nms.map_or("any".to_owned(), short)))
                @for value in [set.mass_kg, set.power_w, set.propellant_kg] { (rounded(value)) }
            }
        }
    };
    let sources = sets.iter().flat_map(|set| {
        set.provenance.iter().map(|row| [&*set.name, &row.of, &row.grade, &row.source])
    });
    let sources: Vec<_> = sources.collect();
    html! {
        p.hint {
            "CMGs: with steering by the pseudo-inverse from the gimbal angles at the start, and \
             in brackets with the best steering there can be. Thrusters: couples."
        }
        (table("sizes", &head, &body))
        @if !sources.is_empty() {
            (folded(
                "Where the numbers come from",
                &words(["Set", "Of", "Grade", "Source"], sources.into_iter()),
            ))
        }
    }
}

fn verdicts(outcome: &StudyOutcome) -> Markup {
    let head = [
        Plain("Set"),
        Unit("Torque there", "N·m"),
        Verdict("Torque"),
        Unit("Momentum there", "N·m·s"),
        Verdict("Momentum"),
        Unit("Full after", "s"),
        Plain("Times slower"),
        Unit("Fuel", "g"),
        Unit("with the base in place", "g"),
    ];
    let body = html! {
        @for task in outcome.tasks.iter().filter(|task| task.unflown.is_none()) {
            tr.task {
                th colspan="9" scope="rowgroup" {
                    (task.name) " "
                    small {
                        "asks " (short(task.peak_torque_nm)) " N·m and "
                        (short(task.peak_momentum_nms)) " N·m·s in " (short(task.duration_s)) " s"
                    }
                }
            }
            @for verdict in &task.verdicts { (verdict_row(task, verdict)) }
        }
    };
    html! {
        p.hint {
            "What is there is counted along the peak of the demand. Figures in brackets: with the \
             best steering. A motion that is N times slower needs an N-th of the momentum and an \
             N²-th of the torque; against a force from outside no pace helps. How many times \
             slower is rounded up."
        }
        (table("sizes judged", &head, &body))
    }
}

fn verdict_row(task: &TaskOutcome, verdict: &SetVerdict) -> Markup {
    html! {
        tr {
            td { (verdict.set) }
            (both(verdict.torque_nm, "any", short))
            td.kept { (mark(verdict.torque)) }
            (both(verdict.momentum_nms, "any", short))
            td.kept { (mark(verdict.momentum)) }
            (both(verdict.saturates_s, "never", short))
            @if task.own_motion { (both(verdict.slower, "never", pace)) }
            @else { (rounded(None)) }
            @for kg in [verdict.fuel_kg, verdict.fuel_in_place_kg] { (grams(kg)) }
        }
    }
}

fn grams(kg: Option<f64>) -> Markup {
    rounded(kg.map(|kg| 1e3 * kg))
}

/// An answer as a sign, a word and a colour.
fn mark(answer: Answer) -> Markup {
    let (class, text) = match answer {
        Answer::Yes => ("yes", "\u{2713} yes"),
        Answer::WithSteering => ("steering", "\u{223c} with steering"),
        Answer::No => ("no", "\u{2717} no"),
    };
    html! { span class=(class) { (text) } }
}

fn flights(outcome: &StudyOutcome) -> Markup {
    let head = [
        Plain("Task"),
        Plain("Set"),
        Unit("Tool error", "mm"),
        Unit("at the end", "mm"),
        Unit("Attitude error", "deg"),
        Unit("Propellant", "g"),
        Verdict("Requirements"),
        Plain("First limit, or how it ended"),
    ];
    let flown = outcome.tasks.iter().flat_map(|task| {
        task.verdicts.iter().filter_map(move |v| Some((task, v, v.flown.as_ref()?)))
    });
    let body = html! {
        @for (task, verdict, flown) in flown {
            tr { td { (task.name) } td { (verdict.set) } (flight(flown)) }
        }
    };
    html! {
        @if !body.0.is_empty() {
            (table("sizes flown", &head, &body))
            (error_figure(outcome))
        }
    }
}

fn flight(flown: &Flown) -> Markup {
    html! {
        @for off in [flown.tool_error_mm, flown.tool_error_at_end_mm, flown.attitude_error_deg] {
            (figure(&error(off, FINEST)))
        }
        (grams(flown.propellant_kg))
        td.kept {
            (verdict_mark(flown.requirements_hold))
            @if !flown.closes { " " span.fail { "\u{2717} ledger open" } }
        }
        td { (flown.ended.as_ref().or(flown.limit.as_ref()).map_or("", String::as_str)) }
    }
}

/// The momentum envelopes of the CMGs, with what the tasks ask on top; of the wheels if there are
/// no CMGs.
fn envelopes(outcome: &StudyOutcome) -> Markup {
    let drawn =
        |kind| outcome.sets.iter().filter(move |set| set.kind == kind && !set.surfaces.is_empty());
    let kind = if drawn(SetKind::Cmgs).next().is_some() { SetKind::Cmgs } else { SetKind::Wheels };
    let asked = largest_demands(outcome).into_iter();
    let paths: Vec<_> = asked
        .map(|task| MomentumPath { name: &task.name, points: &task.demand.momentum_B })
        .collect();
    html! {
        (saturation_figure(outcome))
        @for set in drawn(kind).take(ENVELOPES) {
            @let title = format!("{}.", set.name);
            (envelope_figure(&title, &set.surfaces, &paths).unwrap_or_default())
        }
    }
}

/// The tasks that ask for most momentum: some of the vehicle's own motions, some pushes from
/// outside.
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

fn what_was_run(outcome: &StudyOutcome) -> Markup {
    let rows = [
        ("File", file_flown(&outcome.file, &outcome.settings)),
        version_and_seed(&outcome.version, outcome.seed),
    ];
    html! { (facts(&rows)) (file_text("file", &outcome.text)) }
}

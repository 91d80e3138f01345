//! The verdicts of a run as plain text.

use wrasse_mission::Outcome;
use wrasse_rehearsal::{CaseOutcome, Event, EventKind, Ledger, Verdict};

use super::{Side, aligned, printable};
use crate::wording::cases::{case_name, judged, reason};
use crate::wording::comparison::{Comparison, comparison};
use crate::wording::ledger::{OPEN, Rest, ledger_rests, no_ledger, sources};
use crate::wording::numbers::{beside_limit, power, significant};

/// Verdicts, the end if it came early, and the ledger in a line each for momentum and energy;
/// for a mission that compares cases, one table with a row for each.
pub fn verdict_table(outcome: &Outcome) -> String {
    match outcome.cases.as_slice() {
        [] => "the mission has no cases\n".to_owned(),
        [case] => single(case),
        cases => compared(outcome, cases),
    }
}

fn single(case: &CaseOutcome) -> String {
    let mut text = verdicts(&case.verdicts);
    if let Some(reason) = reason(&case.end) {
        text += &format!("\n{}\n", printable(&reason));
    }
    text += &limits_reached(case);
    text += "\n";
    text += &match no_ledger(case) {
        None => ledger_lines(&case.ledger, ""),
        Some(why) => format!("{why}\n"),
    };
    text + &integration_error(case)
}

/// Most limits, or cases, that are told one by one.
const LIMITS: usize = 12;

/// Limits that were reached or passed, and units that failed.
fn limits(case: &CaseOutcome) -> Vec<&Event> {
    let told = |kind| matches!(kind, EventKind::Limit | EventKind::Failure | EventKind::Fault);
    case.events.iter().filter(|event| told(event.kind)).collect()
}

/// Limits that were reached or passed and units that failed, a line each.
fn limits_reached(case: &CaseOutcome) -> String {
    let limits = limits(case);
    let lines = limits
        .iter()
        .take(LIMITS)
        .map(|event| format!("at {} s: {}\n", significant(event.time_s), printable(&event.text)));
    let mut text: String = lines.collect();
    if limits.len() > LIMITS {
        text += &format!("and {} more: see the report\n", limits.len() - LIMITS);
    }
    if text.is_empty() { text } else { format!("\n{text}") }
}

/// The first limit or failure of each case that has any, a line each.
fn limits_of_cases(cases: &[CaseOutcome]) -> Vec<String> {
    let line = |case: &CaseOutcome| {
        let limits = limits(case);
        let first = limits.first()?;
        let rest = match limits.len() {
            1 => String::new(),
            all => format!("; and {} more: see the report", all - 1),
        };
        let time = significant(first.time_s);
        Some(format!("{}: at {time} s: {}{rest}", case_name(case), first.text))
    };
    cases.iter().filter_map(line).collect()
}

/// As many lines, one for each case, as a reader takes in.
fn first_lines(lines: &[String]) -> String {
    let mut text: String = lines.iter().take(LIMITS).map(|line| printable(line) + "\n").collect();
    if lines.len() > LIMITS {
        text += &format!("and {} more cases: see the report\n", lines.len() - LIMITS);
    }
    text
}

/// The integration error in a line, if it was asked for.
fn integration_error(case: &CaseOutcome) -> String {
    if case.error_estimate.is_empty() {
        return String::new();
    }
    let parts = case.error_estimate.iter().map(|metric| {
        let name = metric.name.strip_prefix("integration_error.").unwrap_or(&metric.name);
        format!("{name} {} {}", power(metric.value), metric.unit)
    });
    format!(
        "integration error, from a second run at half the step: {}\n",
        parts.collect::<Vec<_>>().join(", ")
    )
}

fn verdicts(verdicts: &[Verdict]) -> String {
    if verdicts.is_empty() {
        return "the mission states no requirements\n".to_owned();
    }
    let mut rows = vec![["requirement", "limit", "value", "unit", "verdict"].map(String::from)];
    for verdict in verdicts {
        rows.push([
            judged(&verdict.requirement, &verdict.comparison),
            format!("{} {}", verdict.comparison, significant(verdict.limit)),
            verdict.value.map_or("none".to_owned(), |value| beside_limit(value, verdict.limit)),
            verdict.unit.clone(),
            if verdict.pass { "pass" } else { "FAIL" }.to_owned(),
        ]);
    }
    let rows: Vec<_> = rows.into_iter().map(Vec::from).collect();
    aligned(&rows, &[Side::Left, Side::Right, Side::Right, Side::Left, Side::Left])
}

fn compared(outcome: &Outcome, cases: &[CaseOutcome]) -> String {
    let mut text = comparison_rows(&comparison(outcome));
    let passed = cases.iter().filter(|case| case.passed).count();
    text += &format!("\n{passed} of {} cases pass\n", cases.len());
    let whys = cases.iter().filter_map(|case| {
        let why: Vec<_> = reason(&case.end).into_iter().chain(broken(&case.verdicts)).collect();
        (!why.is_empty()).then(|| format!("{}: {}", case_name(case), why.join("; ")))
    });
    text += &first_lines(&whys.collect::<Vec<_>>());
    let limits = limits_of_cases(cases);
    if !limits.is_empty() {
        text += &format!("\n{}", first_lines(&limits));
    }
    if let Some(worst) = worst_ledger(cases) {
        let whose = format!(" (worst of the cases: {})", printable(&case_name(worst)));
        text += "\n";
        text += &ledger_lines(&worst.ledger, &whose);
    }
    text
}

/// The requirements that were judged and do not hold; those without a value go with an early end.
fn broken(verdicts: &[Verdict]) -> impl Iterator<Item = String> {
    verdicts.iter().filter(|verdict| !verdict.pass).filter_map(|verdict| {
        let value = beside_limit(verdict.value?, verdict.limit);
        Some(format!("{} fails with {value} {}", verdict.requirement, verdict.unit))
    })
}

/// Names of metrics stand over their figures part by part, so that columns stay narrow.
fn comparison_rows(table: &Comparison<'_>) -> String {
    let parts: Vec<Vec<&str>> =
        table.columns.iter().map(|column| column.name.split('.').collect()).collect();
    let depth = parts.iter().map(Vec::len).max().unwrap_or(0);
    let mut rows: Vec<Vec<String>> = (0..depth)
        .map(|line| {
            let mut cells = vec![""; table.axes.len() + 2];
            for parts in &parts {
                // Names end on the same line, above the units.
                let part = (line + parts.len()).checked_sub(depth).map(|k| parts[k]);
                cells.push(part.unwrap_or_default());
            }
            cells.into_iter().map(String::from).collect()
        })
        .collect();
    let mut last = table.axes.clone();
    last.extend(["outcome", "verdict"]);
    last.extend(table.columns.iter().map(|column| column.unit));
    rows.push(last.into_iter().map(String::from).collect());
    for row in &table.rows {
        let mut cells: Vec<String> = row.labels.iter().map(ToString::to_string).collect();
        cells.push(row.ending.clone());
        cells.push(if row.passed { "pass" } else { "FAIL" }.to_owned());
        cells.extend(row.values.iter().map(|v| v.map_or("-".to_owned(), significant)));
        rows.push(cells);
    }
    let mut sides = vec![Side::Left; table.axes.len() + 2];
    sides.extend(vec![Side::Right; table.columns.len()]);
    aligned(&rows, &sides)
}

/// The first case whose ledger stays open, else the one that comes nearest to a bound.
fn worst_ledger(cases: &[CaseOutcome]) -> Option<&CaseOutcome> {
    let share = |case: &CaseOutcome| {
        let ledger = &case.ledger;
        let open = if ledger.closes { 0.0 } else { f64::INFINITY };
        ledger_rests(ledger).iter().map(|rest| rest.relative / rest.bound).fold(open, f64::max)
    };
    // Not `max_by`, which returns the last of equals.
    let flown = cases.iter().filter(|case| no_ledger(case).is_none());
    flown.reduce(|worst, case| if share(case) > share(worst) { case } else { worst })
}

/// The work of each source that has done any: `; joint drives 0.1 J, thrusters 2 J`.
fn works(ledger: &Ledger) -> String {
    let done = sources(ledger).filter(|(_, given)| given.work != 0.0);
    let each =
        done.map(|(source, given)| format!("{} {} J", source.name(), significant(given.work)));
    let all = each.collect::<Vec<_>>().join(", ");
    if all.is_empty() { all } else { format!("; {all}") }
}

/// One line for momentum and one for energy.
fn ledger_lines(ledger: &Ledger, whose: &str) -> String {
    let [angular, linear, energy] = ledger_rests(ledger);
    let told = |rest: &Rest| {
        format!(
            "{} of {} {} unexplained ({}, bound {})",
            power(rest.rest),
            significant(rest.scale),
            rest.unit,
            power(rest.relative),
            power(rest.bound)
        )
    };
    let closes = |within: bool| if within { "ledger closes" } else { "LEDGER OPEN" };
    let hint = if ledger.closes { "" } else { OPEN };
    format!(
        "momentum  {}: angular {}; linear {}{whose}\n\
         energy    {}: {}{}\n{hint}",
        closes(angular.within() && linear.within()),
        told(&angular),
        told(&linear),
        closes(energy.within()),
        told(&energy),
        works(ledger),
    )
}

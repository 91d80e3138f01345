//! A sweep as plain text, for the terminal.

use wrasse_sweep::{CaseSweep, Drawn, RequirementSweep, SweepOutcome};

use super::{Side, aligned, printable};
use crate::wording::cases::name_of;
use crate::wording::numbers::significant;
use crate::wording::sweep::{figures, pass_rate};

/// Pass rates, percentiles and the worst sample of each requirement, case by case.
pub fn sweep_table(outcome: &SweepOutcome) -> String {
    let mut text = format!("seed {}, {} samples\n", outcome.seed, outcome.samples);
    for case in &outcome.cases {
        if outcome.cases.len() > 1 {
            text += &format!("\n{}\n", printable(&name_of(&case.labels)));
        }
        text += &format!("\n{}", of_case(case));
    }
    text
}

fn of_case(case: &CaseSweep) -> String {
    let mut text = requirements(&case.requirements);
    text += &drawn(&case.drawn);
    text += &format!("\n{} pass\n", pass_rate(&case.passed));
    for end in case.ends.iter().filter(|end| end.end != "completed") {
        text += &format!(
            "{} of the flights end otherwise ({}); the first, sample {}: {}\n",
            end.count,
            end.end,
            end.first,
            printable(&end.reason)
        );
    }
    if case.open_books > 0 {
        text += &format!("LEDGER OPEN in {} of the flights\n", case.open_books);
    }
    let worst = case.requirements.iter().filter_map(|r| r.worst.first().map(|w| (r, w)));
    for (requirement, worst) in worst {
        let value = worst.value.map_or("no value".to_owned(), |value| {
            format!("{} {}", significant(value), requirement.unit)
        });
        text += &format!(
            "worst of {}: {value} in sample {}\n  {}\n",
            printable(&requirement.requirement),
            worst.sample,
            printable(&worst.command)
        );
    }
    text
}

/// The values flown of what was drawn.
fn drawn(all: &[Drawn]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let head = ["drawn", "files say", "flown from", "to", "unit"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for drawn in all {
        let shown = |x: Option<f64>| x.map_or("-".to_owned(), significant);
        rows.push(vec![
            drawn.quantity.clone(),
            significant(drawn.nominal),
            shown(drawn.least),
            shown(drawn.largest),
            drawn.unit.clone(),
        ]);
    }
    let sides = [Side::Left, Side::Right, Side::Right, Side::Right, Side::Left];
    format!("\n{}", aligned(&rows, &sides))
}

fn requirements(all: &[RequirementSweep]) -> String {
    if all.is_empty() {
        return "the mission states no requirements\n".to_owned();
    }
    let head = ["requirement", "holds in", "min", "p1", "p5", "p50", "p95", "p99", "max", "unit"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for requirement in all {
        let mut row = vec![
            requirement.requirement.clone(),
            format!("{} of {}", requirement.holds.passed, requirement.holds.of),
        ];
        row.extend(figures(requirement));
        row.push(requirement.unit.clone());
        rows.push(row);
    }
    let mut sides = vec![Side::Left, Side::Right];
    sides.extend([Side::Right; 7]);
    sides.push(Side::Left);
    aligned(&rows, &sides)
}

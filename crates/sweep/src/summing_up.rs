//! Rows to findings: percentiles, pass rates, the worst samples, what they go with.

use crate::drawn::Drawn;
use crate::outcome::{CaseSweep, EndCount, Influence, RequirementSweep, SweepOutcome, WorstSample};
use crate::pass_rate::{CONFIDENCE, PassRate};
use crate::percentiles::Percentiles;
use crate::rank_correlation::rank_correlation;
use crate::row::Row;
use crate::sweep::Sweep;
use wrasse_rehearsal::{End, Verdict};

/// Worst samples that are told of each requirement.
const WORST: usize = 5;

/// Influences that are told of each requirement.
const INFLUENCES: usize = 3;

/// Standard deviations of a rank correlation of things that have nothing to do with each other, 1/√(n - 1),
/// below which none is told.
const CHANCE: f64 = 3.0;

/// What all samples together say; rows in order of case, then sample.
pub(crate) fn sum_up(asked: &Sweep<'_>, rows: Vec<Row>) -> SweepOutcome {
    let mission = asked.mission;
    let mut of_cases: Vec<Vec<Row>> = vec![vec![]; mission.cases.len()];
    for row in rows {
        of_cases[row.case].push(row);
    }
    let cases = of_cases.into_iter().enumerate().map(|(case, rows)| of_case(asked, case, rows));
    SweepOutcome {
        mission: mission.name.clone(),
        summary: mission.summary.clone(),
        mission_file: mission.file.clone(),
        mission_text: mission.text.clone(),
        settings: mission.settings.clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        seed: asked.seed,
        samples: asked.samples,
        confidence: CONFIDENCE,
        cases: cases.collect(),
    }
}

fn of_case(asked: &Sweep<'_>, case: usize, rows: Vec<Row>) -> CaseSweep {
    let mission = asked.mission;
    let drawn = Drawn::all(mission, case, &rows);
    let draws = mission.cases[case].varies();
    // Without requirements nothing is looked at that could differ.
    let looks = !mission.cases[case].requirements.is_empty();
    let varies = !(looks && all_alike(&rows, |row| (&row.values, &row.end)));
    let required = mission.cases[case].required();
    let each = required.into_iter().enumerate();
    CaseSweep {
        labels: mission.cases[case].labels.clone(),
        passed: rate(rows.iter().filter(|row| row.passed).count(), rows.len(), draws, varies),
        ends: ends(&rows),
        open_books: rows.iter().filter(|row| has_open_books(row)).count(),
        requirements: each
            .map(|(i, v)| of_requirement(asked, &rows, i, v, &drawn, draws))
            .collect(),
        varies: draws && varies,
        drawn,
        rows,
    }
}

/// A pass rate, with its interval where the samples differ.
fn rate(passed: usize, of: usize, draws: bool, varies: bool) -> PassRate {
    match (draws, varies) {
        (false, _) => PassRate::of_one_flight(passed, of),
        (true, false) => PassRate::of_the_same(passed, of),
        (true, true) => PassRate::of(passed, of),
    }
}

/// Whether several samples were flown, and this is the same in each of them.
fn all_alike<'r, T: PartialEq>(rows: &'r [Row], of: impl Fn(&'r Row) -> T) -> bool {
    rows.len() > 1 && rows.windows(2).all(|pair| of(&pair[0]) == of(&pair[1]))
}

/// Whether its books stay open; where numbers broke down there are none.
fn has_open_books(row: &Row) -> bool {
    !row.closes && !matches!(row.end, End::Breakdown { .. })
}

/// How the flights ended, in the order in which the ways are first met.
fn ends(rows: &[Row]) -> Vec<EndCount> {
    let mut ends: Vec<EndCount> = vec![];
    for row in rows {
        let (end, reason) = match &row.end {
            End::Completed => ("completed", String::new()),
            End::Infeasible { reason, .. } => ("infeasible", reason.clone()),
            End::Stopped { reason, .. } => ("stopped", reason.clone()),
            End::Breakdown { reason, .. } => ("breakdown", reason.clone()),
        };
        match ends.iter_mut().find(|known| known.end == end) {
            Some(known) => known.count += 1,
            None => ends.push(EndCount { end: end.into(), count: 1, first: row.sample, reason }),
        }
    }
    ends
}

fn of_requirement(
    asked: &Sweep<'_>,
    rows: &[Row],
    i: usize,
    required: Verdict,
    drawn: &[Drawn],
    draws: bool,
) -> RequirementSweep {
    let varies = !all_alike(rows, |row| (row.values[i], row.holds[i]));
    let holding = rows.iter().filter(|row| row.holds[i]).count();
    let values = || rows.iter().filter_map(|row| row.values[i]);
    let mut influences: Vec<Influence> = vec![];
    for (k, Drawn { quantity, .. }) in drawn.iter().enumerate() {
        let pairs: Vec<_> = rows
            .iter()
            .filter_map(|row| row.values[i].map(|value| (row.deviations[k], value)))
            .collect();
        let by_chance = CHANCE / (pairs.len() as f64 - 1.0).max(1.0).sqrt();
        let found = rank_correlation(&pairs).filter(|found| found.abs() > by_chance);
        influences.extend(
            found
                .map(|rank_correlation| Influence { quantity: quantity.clone(), rank_correlation }),
        );
    }
    influences.sort_by(|a, b| b.rank_correlation.abs().total_cmp(&a.rank_correlation.abs()));
    influences.truncate(INFLUENCES);
    RequirementSweep {
        holds: rate(holding, rows.len(), draws, varies),
        absent: rows.len() - values().count(),
        values: Percentiles::of(values()),
        worst: worst(asked, rows, i, required.comparison.starts_with('<'), drawn),
        influences,
        requirement: required.requirement,
        comparison: required.comparison,
        limit: required.limit,
        unit: required.unit,
    }
}

/// The samples without a value, then those with the worst.
fn worst(
    asked: &Sweep<'_>,
    rows: &[Row],
    i: usize,
    large_is_bad: bool,
    drawn: &[Drawn],
) -> Vec<WorstSample> {
    let mut order: Vec<&Row> = rows.iter().collect();
    let badness = |row: &Row| match row.values[i] {
        None => f64::INFINITY,
        Some(value) if large_is_bad => value,
        Some(value) => -value,
    };
    // Equal ones stay in the order of their numbers.
    order.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
    order.truncate(WORST);
    let each = order.into_iter().map(|row| WorstSample {
        sample: row.sample,
        value: row.values[i],
        command: asked.command(row.sample),
        drawn: drawn.iter().zip(&row.deviations).map(|(d, x)| d.with(*x)).collect(),
    });
    each.collect()
}

//! A sweep as a table: a row for each sample.

use super::{Cells, Field, Kind, Table, Values, numbers};
use crate::error::RecordError;
use crate::wording::cases::name_of;
use std::collections::BTreeSet;
use wrasse_rehearsal::End;
use wrasse_sweep::{CaseSweep, DrawnValue, Row, SweepOutcome};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Holds<'a> {
    Case,
    Sample,
    Passed,
    Closes,
    End,
    Reason,
    /// How far from the files this quantity was, and its value in flight.
    Drawn(&'a str),
    Flown(&'a str),
    /// The value that this requirement is about.
    Value(&'a str),
    /// Whether this requirement holds.
    Verdict(&'a str),
}

/// The bytes of `samples.parquet`.
///
/// Columns: `case` (text), `sample`, `passed`, `closes` (whether the books do), `end`, `reason`
/// (null where the flight was completed); then for each dispersed quantity `drawn NAME`, its
/// deviation from the files, and `flown NAME [UNIT]`, the value that flew; then for each
/// requirement `value REQUIREMENT` in its unit (null where there is none) and `holds REQUIREMENT`.
/// A case without a quantity or requirement has nulls there. One row group for each case. Key-value
/// metadata: `mission`, `version`, `seed`, `samples`. The same outcome gives the same bytes.
///
/// # Errors
/// If the writer refuses.
pub fn samples_parquet(outcome: &SweepOutcome) -> Result<Vec<u8>, RecordError> {
    table(outcome).parquet()
}

/// The same as CSV, with the units in the head.
///
/// # Errors
/// If the writer refuses.
pub fn samples_csv(outcome: &SweepOutcome) -> Result<Vec<u8>, RecordError> {
    table(outcome).csv()
}

fn table(outcome: &SweepOutcome) -> Table<'_, &CaseSweep> {
    let columns = columns(outcome);
    let fields = columns.iter().map(|column| field(outcome, *column)).collect();
    let flown = outcome.cases.iter().filter(|case| !case.rows.is_empty());
    Table {
        name: "samples",
        fields,
        metadata: metadata(outcome),
        groups: flown.collect(),
        cells: Box::new(move |case, k| cells(case, columns[k])),
    }
}

/// The columns of all cases, each once, in order of first appearance.
fn columns(outcome: &SweepOutcome) -> Vec<Holds<'_>> {
    let mut all =
        vec![Holds::Case, Holds::Sample, Holds::Passed, Holds::Closes, Holds::End, Holds::Reason];
    let mut seen = BTreeSet::new();
    let drawn = outcome.cases.iter().flat_map(|case| &case.drawn).map(|d| d.quantity.as_str());
    for name in drawn.filter(|name| seen.insert(*name)) {
        all.extend([Holds::Drawn(name), Holds::Flown(name)]);
    }
    let mut seen = BTreeSet::new();
    let required = outcome.cases.iter().flat_map(|case| &case.requirements);
    for requirement in required.map(|r| &r.requirement).filter(|text| seen.insert(*text)) {
        all.extend([Holds::Value(requirement), Holds::Verdict(requirement)]);
    }
    all
}

fn field(outcome: &SweepOutcome, column: Holds<'_>) -> Field {
    let number = |name: String, unit: &str, meaning: &str| {
        Field::new(name, Kind::Number, unit, meaning).with_nulls()
    };
    let plain = |name, kind, meaning| Field::new(name, kind, "", meaning);
    match column {
        Holds::Case => plain("case", Kind::Text, "the case of a comparison"),
        Holds::Sample => plain("sample", Kind::Whole, "number of the sample"),
        Holds::Passed => plain("passed", Kind::Flag, "whether all requirements hold"),
        Holds::Closes => plain("closes", Kind::Flag, "whether the ledger closes"),
        Holds::End => plain("end", Kind::Text, "how the flight ended"),
        Holds::Reason => plain("reason", Kind::Text, "why it ended before its time").with_nulls(),
        Holds::Drawn(quantity) => {
            let meaning = "deviation from the files, as it was drawn";
            number(format!("drawn {quantity}"), unit_of(outcome, quantity), meaning)
        }
        Holds::Flown(quantity) => {
            let unit = unit_of(outcome, quantity);
            number(format!("flown {quantity} [{unit}]"), unit, "the value that flew")
        }
        Holds::Value(requirement) => {
            let unit = unit_of_requirement(outcome, requirement);
            number(format!("value {requirement}"), unit, "the value that the requirement is about")
        }
        Holds::Verdict(requirement) => {
            let name = format!("holds {requirement}");
            Field::new(name, Kind::Flag, "", "whether the requirement holds").with_nulls()
        }
    }
}

/// The unit that a requirement is written in.
fn unit_of_requirement<'o>(outcome: &'o SweepOutcome, requirement: &str) -> &'o str {
    let mut all = outcome.cases.iter().flat_map(|case| &case.requirements);
    all.find(|r| r.requirement == requirement).map_or("", |r| r.unit.as_str())
}

fn metadata(outcome: &SweepOutcome) -> Vec<(String, String)> {
    let pairs = [
        ("mission", outcome.mission.clone()),
        ("version", outcome.version.clone()),
        ("seed", outcome.seed.to_string()),
        ("samples", outcome.samples.to_string()),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into()
}

fn cells(case: &CaseSweep, column: Holds<'_>) -> Cells<'static> {
    let rows = || case.rows.iter();
    match column {
        Holds::Case => Cells::all(Values::Text(vec![name_of(&case.labels); case.rows.len()])),
        Holds::Sample => {
            let number = |row: &Row| i64::try_from(row.sample).unwrap_or(i64::MAX);
            Cells::all(Values::Whole(rows().map(number).collect()))
        }
        Holds::Passed => Cells::all(Values::Flags(rows().map(|row| row.passed).collect())),
        Holds::Closes => Cells::all(Values::Flags(rows().map(|row| row.closes).collect())),
        Holds::End => Cells::all(Values::Text(rows().map(|row| ending(row).0).collect())),
        Holds::Reason => Cells::some(rows().map(|row| ending(row).1), Values::Text),
        Holds::Drawn(quantity) => {
            Cells::some(drawn(case, quantity).map(|x| Some(x?.deviation)), numbers)
        }
        Holds::Flown(quantity) => {
            Cells::some(drawn(case, quantity).map(|x| Some(x?.flown)), numbers)
        }
        Holds::Value(requirement) => {
            let place = place_of(case, requirement);
            Cells::some(rows().map(|row| row.values[place?]), numbers)
        }
        Holds::Verdict(requirement) => {
            let place = place_of(case, requirement);
            Cells::some(rows().map(|row| Some(row.holds[place?])), Values::Flags)
        }
    }
}

/// The unit of a drawn quantity.
fn unit_of<'o>(outcome: &'o SweepOutcome, quantity: &str) -> &'o str {
    let mut all = outcome.cases.iter().flat_map(|case| &case.drawn);
    all.find(|drawn| drawn.quantity == quantity).map_or("", |drawn| drawn.unit.as_str())
}

/// What was drawn of a quantity in each sample of a case, if it is drawn there.
fn drawn<'c>(
    case: &'c CaseSweep,
    quantity: &str,
) -> impl Iterator<Item = Option<DrawnValue>> + use<'c> {
    let place = case.drawn.iter().position(|drawn| drawn.quantity == quantity);
    case.rows.iter().map(move |row| {
        let i = place?;
        Some(case.drawn[i].with(*row.deviations.get(i)?))
    })
}

fn place_of(case: &CaseSweep, requirement: &str) -> Option<usize> {
    case.requirements.iter().position(|r| r.requirement == requirement)
}

/// How a flight ended, in a word, and why.
fn ending(row: &Row) -> (String, Option<String>) {
    let (word, reason) = match &row.end {
        End::Completed => ("completed", None),
        End::Infeasible { reason, .. } => ("infeasible", Some(reason.clone())),
        End::Stopped { reason, .. } => ("stopped", Some(reason.clone())),
        End::Breakdown { reason, .. } => ("breakdown", Some(reason.clone())),
    };
    (word.to_owned(), reason)
}

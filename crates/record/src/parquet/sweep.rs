//! A sweep as Parquet: a row for each sample.

use std::collections::BTreeSet;

use parquet::basic::Type as Physical;
use wrasse_rehearsal::End;
use wrasse_sweep::{CaseSweep, DrawnValue, Row, SweepOutcome};

use super::{Cells, Field, Values, file, numbers, texts};
use crate::error::RecordError;
use crate::wording::cases::name_of;

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
    let columns = columns(outcome);
    let fields: Vec<Field> = columns.iter().map(|column| field(outcome, *column)).collect();
    let flown = outcome.cases.iter().filter(|case| !case.rows.is_empty());
    file("samples", &fields, metadata(outcome), flown, |case, k| cells(case, columns[k]))
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
    let number = |name: String| Field::new(name, Physical::DOUBLE).with_nulls();
    match column {
        Holds::Case => Field::new("case", Physical::BYTE_ARRAY),
        Holds::Sample => Field::new("sample", Physical::INT64),
        Holds::Passed => Field::new("passed", Physical::BOOLEAN),
        Holds::Closes => Field::new("closes", Physical::BOOLEAN),
        Holds::End => Field::new("end", Physical::BYTE_ARRAY),
        Holds::Reason => Field::new("reason", Physical::BYTE_ARRAY).with_nulls(),
        Holds::Drawn(quantity) => number(format!("drawn {quantity}")),
        Holds::Flown(quantity) => {
            number(format!("flown {quantity} [{}]", unit_of(outcome, quantity)))
        }
        Holds::Value(requirement) => number(format!("value {requirement}")),
        Holds::Verdict(requirement) => {
            Field::new(format!("holds {requirement}"), Physical::BOOLEAN).with_nulls()
        }
    }
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
        Holds::Case => Cells::all(texts(vec![name_of(&case.labels); case.rows.len()])),
        Holds::Sample => {
            let number = |row: &Row| i64::try_from(row.sample).unwrap_or(i64::MAX);
            Cells::all(Values::Whole(rows().map(number).collect()))
        }
        Holds::Passed => Cells::all(Values::Flags(rows().map(|row| row.passed).collect())),
        Holds::Closes => Cells::all(Values::Flags(rows().map(|row| row.closes).collect())),
        Holds::End => Cells::all(texts(rows().map(|row| ending(row).0).collect())),
        Holds::Reason => Cells::some(rows().map(|row| ending(row).1), texts),
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

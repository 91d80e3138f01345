//! A sweep as Parquet: a row for each sample.

use std::collections::BTreeSet;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use wrasse_mission::End;
use wrasse_sweep::{CaseSweep, DrawnValue, Row, SweepOutcome};

use crate::RecordError;
use crate::comparison::name_of;
use crate::parquet_file::next_column;

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
/// Columns: `case` (text), `sample`, `passed`, `closes` (whether the books do), `end`, `reason` (null
/// where the flight was completed); then for each dispersed quantity `drawn NAME`, its deviation from the
/// files, and `flown NAME [UNIT]`, the value that flew; then for each requirement `value REQUIREMENT` in its unit (null where there is
/// none) and `holds REQUIREMENT`. A case without a quantity or requirement has nulls there. One row
/// group for each case. Key-value metadata: `mission`, `version`, `seed`, `samples`. The same outcome
/// gives the same bytes.
///
/// # Errors
/// If the writer refuses.
pub fn samples_parquet(outcome: &SweepOutcome) -> Result<Vec<u8>, RecordError> {
    let columns = columns(outcome);
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(metadata(outcome)))
        .build();
    let mut bytes = Vec::new();
    let mut file =
        SerializedFileWriter::new(&mut bytes, schema(outcome, &columns)?, Arc::new(properties))?;
    for case in outcome.cases.iter().filter(|case| !case.rows.is_empty()) {
        let mut rows = file.next_row_group()?;
        for column in &columns {
            write_column(&mut rows, case, *column)?;
        }
        rows.close()?;
    }
    file.close()?;
    Ok(bytes)
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

fn schema(outcome: &SweepOutcome, columns: &[Holds<'_>]) -> Result<TypePtr, RecordError> {
    let mut fields = vec![];
    for column in columns {
        let (name, kind, is_optional) = match column {
            Holds::Case => ("case".to_owned(), Physical::BYTE_ARRAY, false),
            Holds::Sample => ("sample".to_owned(), Physical::INT64, false),
            Holds::Passed => ("passed".to_owned(), Physical::BOOLEAN, false),
            Holds::Closes => ("closes".to_owned(), Physical::BOOLEAN, false),
            Holds::End => ("end".to_owned(), Physical::BYTE_ARRAY, false),
            Holds::Reason => ("reason".to_owned(), Physical::BYTE_ARRAY, true),
            Holds::Drawn(quantity) => (format!("drawn {quantity}"), Physical::DOUBLE, true),
            Holds::Flown(quantity) => (
                format!("flown {quantity} [{}]", unit_of(outcome, quantity)),
                Physical::DOUBLE,
                true,
            ),
            Holds::Value(requirement) => (format!("value {requirement}"), Physical::DOUBLE, true),
            Holds::Verdict(requirement) => {
                (format!("holds {requirement}"), Physical::BOOLEAN, true)
            }
        };
        let text = (kind == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        let repetition = if is_optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let field = Type::primitive_type_builder(&name, kind)
            .with_repetition(repetition)
            .with_logical_type(text)
            .build()?;
        fields.push(Arc::new(field));
    }
    Ok(Arc::new(Type::group_type_builder("samples").with_fields(fields).build()?))
}

fn metadata(outcome: &SweepOutcome) -> Vec<KeyValue> {
    let pair = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    vec![
        pair("mission", outcome.mission.clone()),
        pair("version", outcome.version.clone()),
        pair("seed", outcome.seed.to_string()),
        pair("samples", outcome.samples.to_string()),
    ]
}

fn write_column(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    case: &CaseSweep,
    column: Holds<'_>,
) -> Result<(), RecordError> {
    let all = &case.rows;
    match column {
        Holds::Case => text(rows, &vec![Some(name_of(&case.labels)); all.len()], false),
        Holds::End => {
            text(rows, &all.iter().map(|row| Some(ending(row).0)).collect::<Vec<_>>(), false)
        }
        Holds::Reason => text(rows, &all.iter().map(|row| ending(row).1).collect::<Vec<_>>(), true),
        Holds::Sample => {
            let numbers: Vec<i64> =
                all.iter().map(|row| i64::try_from(row.sample).unwrap_or(i64::MAX)).collect();
            let mut column = next_column(rows)?;
            column.typed::<Int64Type>().write_batch(&numbers, None, None)?;
            Ok(column.close()?)
        }
        Holds::Passed => flags(rows, all.iter().map(|row| Some(row.passed)), false),
        Holds::Closes => flags(rows, all.iter().map(|row| Some(row.closes)), false),
        Holds::Drawn(quantity) => {
            numbers(rows, drawn(case, quantity).map(|x| x.map(|x| x.deviation)))
        }
        Holds::Flown(quantity) => numbers(rows, drawn(case, quantity).map(|x| x.map(|x| x.flown))),
        Holds::Value(requirement) => {
            let place = place_of(case, requirement);
            numbers(rows, all.iter().map(|row| place.and_then(|i| row.values[i])))
        }
        Holds::Verdict(requirement) => {
            let place = place_of(case, requirement);
            flags(rows, all.iter().map(|row| place.map(|i| row.holds[i])), true)
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
    match &row.end {
        End::Completed => ("completed".into(), None),
        End::Infeasible { reason, .. } => ("infeasible".into(), Some(reason.clone())),
        End::Stopped { reason, .. } => ("stopped".into(), Some(reason.clone())),
        End::Breakdown { reason, .. } => ("breakdown".into(), Some(reason.clone())),
    }
}

/// Definition level 1 says "a value", 0 says "null"; a column without nulls has no levels.
fn levels<T>(values: &[Option<T>], is_optional: bool) -> Option<Vec<i16>> {
    is_optional.then(|| values.iter().map(|value| i16::from(value.is_some())).collect())
}

fn text(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: &[Option<String>],
    is_optional: bool,
) -> Result<(), RecordError> {
    let levels = levels(values, is_optional);
    let there: Vec<ByteArray> =
        values.iter().flatten().map(|text| ByteArray::from(text.as_bytes().to_vec())).collect();
    let mut column = next_column(rows)?;
    column.typed::<ByteArrayType>().write_batch(&there, levels.as_deref(), None)?;
    Ok(column.close()?)
}

fn flags(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: impl Iterator<Item = Option<bool>>,
    is_optional: bool,
) -> Result<(), RecordError> {
    let values: Vec<Option<bool>> = values.collect();
    let there: Vec<bool> = values.iter().flatten().copied().collect();
    let levels = levels(&values, is_optional);
    let mut column = next_column(rows)?;
    column.typed::<BoolType>().write_batch(&there, levels.as_deref(), None)?;
    Ok(column.close()?)
}

fn numbers(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: impl Iterator<Item = Option<f64>>,
) -> Result<(), RecordError> {
    let values: Vec<Option<f64>> = values.collect();
    let there: Vec<f64> = values.iter().flatten().copied().collect();
    let levels = levels(&values, true);
    let mut column = next_column(rows)?;
    column.typed::<DoubleType>().write_batch(&there, levels.as_deref(), None)?;
    Ok(column.close()?)
}

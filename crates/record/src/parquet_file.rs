//! Telemetry as Parquet: a row for each sample, a column for each channel.

use std::collections::BTreeSet;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{
    SerializedColumnWriter, SerializedFileWriter, SerializedRowGroupWriter,
};
use parquet::schema::types::{Type, TypePtr};
use wrasse_mission::{CaseOutcome, Channel, Outcome};

use crate::RecordError;
use crate::comparison::case_name;

/// The bytes of `telemetry.parquet`.
///
/// Columns: `case` (text), `time_s` (s), then every channel under its own name, in the order in
/// which the cases bring them; a case without a channel has nulls there. One row group for each
/// case. Key-value metadata: `mission`, `version`, `seed`, `vehicle`, and `unit:NAME` for each
/// column of numbers. The same outcome gives the same bytes.
///
/// # Errors
/// Channels that are not as long as their time base, or that share a name.
pub fn telemetry_parquet(outcome: &Outcome) -> Result<Vec<u8>, RecordError> {
    for case in &outcome.cases {
        check(case)?;
    }
    let columns = columns(outcome);
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        .set_column_dictionary_enabled("case".into(), true)
        .set_key_value_metadata(Some(metadata(outcome, &columns)))
        .build();
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, schema(&columns)?, Arc::new(properties))?;
    for case in outcome.cases.iter().filter(|case| !case.telemetry.time.is_empty()) {
        let mut rows = file.next_row_group()?;
        write_case(&mut rows, case, &columns)?;
        rows.close()?;
    }
    file.close()?;
    Ok(bytes)
}

/// Every channel has a value for each sample and a name of its own.
fn check(case: &CaseOutcome) -> Result<(), RecordError> {
    let mut names = BTreeSet::from(["case", "time_s"]);
    for channel in &case.telemetry.channels {
        if !names.insert(&channel.name) {
            return Err(RecordError::ChannelTwice {
                case: case_name(case),
                channel: channel.name.clone(),
            });
        }
        let (found, expected) = (channel.values.len(), case.telemetry.time.len());
        if found != expected {
            return Err(RecordError::ChannelLength {
                case: case_name(case),
                channel: channel.name.clone(),
                found,
                expected,
            });
        }
    }
    Ok(())
}

/// The channels of all cases, each name once, in order of first appearance.
fn columns(outcome: &Outcome) -> Vec<&Channel> {
    let mut seen = BTreeSet::new();
    let channels = outcome.cases.iter().flat_map(|case| &case.telemetry.channels);
    channels.filter(|channel| seen.insert(channel.name.as_str())).collect()
}

fn schema(columns: &[&Channel]) -> Result<TypePtr, RecordError> {
    let mut fields = vec![
        Type::primitive_type_builder("case", Physical::BYTE_ARRAY)
            .with_repetition(Repetition::REQUIRED)
            .with_logical_type(Some(LogicalType::String))
            .build()?,
        Type::primitive_type_builder("time_s", Physical::DOUBLE)
            .with_repetition(Repetition::REQUIRED)
            .build()?,
    ];
    for channel in columns {
        fields.push(
            Type::primitive_type_builder(&channel.name, Physical::DOUBLE)
                .with_repetition(Repetition::OPTIONAL)
                .build()?,
        );
    }
    let fields = fields.into_iter().map(Arc::new).collect();
    Ok(Arc::new(Type::group_type_builder("telemetry").with_fields(fields).build()?))
}

fn metadata(outcome: &Outcome, columns: &[&Channel]) -> Vec<KeyValue> {
    let mut pairs = vec![
        KeyValue::new("mission".to_owned(), outcome.mission.clone()),
        KeyValue::new("version".to_owned(), outcome.version.clone()),
        KeyValue::new("seed".to_owned(), outcome.seed.to_string()),
        KeyValue::new("vehicle".to_owned(), outcome.vehicle.name.clone()),
        KeyValue::new("unit:time_s".to_owned(), "s".to_owned()),
    ];
    pairs.extend(columns.iter().map(|c| KeyValue::new(format!("unit:{}", c.name), c.unit.clone())));
    pairs
}

fn write_case(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    case: &CaseOutcome,
    columns: &[&Channel],
) -> Result<(), RecordError> {
    let samples = case.telemetry.time.len();
    let mut column = next_column(rows)?;
    let names = vec![ByteArray::from(case_name(case).into_bytes()); samples];
    column.typed::<ByteArrayType>().write_batch(&names, None, None)?;
    column.close()?;

    let mut column = next_column(rows)?;
    column.typed::<DoubleType>().write_batch(&case.telemetry.time, None, None)?;
    column.close()?;

    for wanted in columns {
        let found = case.telemetry.channels.iter().find(|c| c.name == wanted.name);
        let values = found.map_or(&[][..], |channel| &channel.values);
        // Definition level 1 says "a value", 0 says "null".
        let levels = vec![i16::from(found.is_some()); samples];
        let mut column = next_column(rows)?;
        column.typed::<DoubleType>().write_batch(values, Some(&levels), None)?;
        column.close()?;
    }
    Ok(())
}

/// The column that is written next.
pub(crate) fn next_column<'a>(
    rows: &'a mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
) -> Result<SerializedColumnWriter<'a>, RecordError> {
    Ok(rows.next_column()?.expect("the schema has a field for each column that is written"))
}

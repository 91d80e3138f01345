//! A table as CSV: a head with the units, numbers as the shortest decimals that give their bits again, and
//! nothing where there is no value.

use super::{Cells, Field, Table, Values};
use crate::error::RecordError;

pub(super) fn file<G>(table: &Table<'_, G>) -> Result<Vec<u8>, RecordError> {
    let mut writer = csv::Writer::from_writer(vec![]);
    writer.write_record(table.fields.iter().map(head))?;
    for group in &table.groups {
        let mut columns: Vec<_> =
            (0..table.fields.len()).map(|field| texts((table.cells)(group, field))).collect();
        let rows = columns.first().map_or(0, Vec::len);
        for row in 0..rows {
            writer
                .write_record(columns.iter_mut().map(|column| std::mem::take(&mut column[row])))?;
        }
    }
    writer.into_inner().map_err(|refused| RecordError::Csv(refused.into_error().into()))
}

/// `tool.position_error [mm]`.
fn head(field: &Field) -> String {
    if field.unit.is_empty() || field.name.ends_with(']') {
        return field.name.clone();
    }
    format!("{} [{}]", field.name, field.unit)
}

/// A column, row by row.
fn texts(Cells { there, levels }: Cells<'_>) -> Vec<String> {
    let values: Vec<String> = match there {
        Values::Text(texts) => texts,
        Values::Whole(numbers) => numbers.iter().map(i64::to_string).collect(),
        Values::Flags(flags) => flags.iter().map(bool::to_string).collect(),
        Values::Numbers(numbers) => numbers.iter().map(f64::to_string).collect(),
    };
    let Some(levels) = levels else { return values };
    let mut values = values.into_iter();
    let cell = |level: i16| if level == 1 { values.next() } else { None }.unwrap_or_default();
    levels.into_iter().map(cell).collect()
}

//! A table as Parquet, without Arrow: one row group for each group of rows.

use super::{Cells, Field, Kind, Table, Values, arrow_schema};
use crate::error::RecordError;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use std::sync::Arc;

pub(super) fn file<G>(table: Table<'_, G>) -> Result<Vec<u8>, RecordError> {
    let Table { name, fields, metadata, groups, cells } = table;
    let schema_of_fields = (arrow_schema::KEY.to_owned(), arrow_schema::encoded(&fields));
    let pairs = metadata.into_iter().chain([schema_of_fields]);
    let pairs = pairs.map(|(key, value)| KeyValue::new(key, value)).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(pairs));
    let repeating = fields.iter().filter(|field| field.repeats);
    let properties = repeating.fold(properties, |properties, field| {
        properties.set_column_dictionary_enabled(field.name.as_str().into(), true)
    });
    let mut bytes = Vec::new();
    let properties = Arc::new(properties.build());
    let mut file = SerializedFileWriter::new(&mut bytes, schema(name, &fields)?, properties)?;
    for group in groups {
        let mut rows = file.next_row_group()?;
        for field in 0..fields.len() {
            let Cells { there, levels } = cells(&group, field);
            let levels = levels.as_deref();
            match there {
                Values::Text(texts) => {
                    let text = |text: String| ByteArray::from(text.into_bytes());
                    let texts: Vec<_> = texts.into_iter().map(text).collect();
                    write::<ByteArrayType>(&mut rows, &texts, levels)?;
                }
                Values::Whole(numbers) => write::<Int64Type>(&mut rows, &numbers, levels)?,
                Values::Flags(flags) => write::<BoolType>(&mut rows, &flags, levels)?,
                Values::Numbers(numbers) => write::<DoubleType>(&mut rows, &numbers, levels)?,
            }
        }
        rows.close()?;
    }
    file.close()?;
    Ok(bytes)
}

fn schema(name: &str, fields: &[Field]) -> Result<TypePtr, RecordError> {
    let mut types = vec![];
    for field in fields {
        let (physical, text) = match field.kind {
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            Kind::Whole => (Physical::INT64, None),
            Kind::Flag => (Physical::BOOLEAN, None),
            Kind::Number => (Physical::DOUBLE, None),
        };
        let nulls = if field.has_nulls { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let built = Type::primitive_type_builder(&field.name, physical)
            .with_repetition(nulls)
            .with_logical_type(text);
        types.push(Arc::new(built.build()?));
    }
    Ok(Arc::new(Type::group_type_builder(name).with_fields(types).build()?))
}

fn write<T: DataType>(
    rows: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<(), RecordError> {
    let mut column = rows.next_column()?.expect("the schema has each field that is written");
    column.typed::<T>().write_batch(values, levels, None)?;
    Ok(column.close()?)
}

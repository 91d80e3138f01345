//! Tables as Parquet: columns of text, flags and numbers, in groups of rows.

use std::borrow::Cow;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::error::RecordError;

pub(crate) mod run;
pub(crate) mod sweep;

/// What a column is called and what it holds; one without nulls is required.
pub(crate) struct Field {
    name: String,
    kind: Physical,
    has_nulls: bool,
    /// Its values are few and are written once each.
    repeats: bool,
}

impl Field {
    fn new(name: impl Into<String>, kind: Physical) -> Self {
        Self { name: name.into(), kind, has_nulls: false, repeats: false }
    }
    fn with_nulls(self) -> Self {
        Self { has_nulls: true, ..self }
    }
    fn repeating(self) -> Self {
        Self { repeats: true, ..self }
    }
}

/// The values of a column in a group of rows.
pub(crate) enum Values<'a> {
    Text(Vec<ByteArray>),
    Whole(Vec<i64>),
    Flags(Vec<bool>),
    Numbers(Cow<'a, [f64]>),
}

/// Values, and for each row 1 for "a value" and 0 for "null", if the column has nulls.
pub(crate) struct Cells<'a> {
    there: Values<'a>,
    levels: Option<Vec<i16>>,
}

impl<'a> Cells<'a> {
    fn all(there: Values<'a>) -> Self {
        Self { there, levels: None }
    }
    fn some<T>(rows: impl Iterator<Item = Option<T>>, values: fn(Vec<T>) -> Values<'a>) -> Self {
        let rows: Vec<Option<T>> = rows.collect();
        let levels = rows.iter().map(|row| i16::from(row.is_some())).collect();
        Self { there: values(rows.into_iter().flatten().collect()), levels: Some(levels) }
    }
}

/// The bytes of a file with one table: its fields, and for each of `groups` the cells of each
/// field.
fn file<'g, G>(
    name: &str,
    fields: &[Field],
    metadata: Vec<(String, String)>,
    groups: impl Iterator<Item = G>,
    cells: impl Fn(&G, usize) -> Cells<'g>,
) -> Result<Vec<u8>, RecordError> {
    let pairs = metadata.into_iter().map(|(key, value)| KeyValue::new(key, value)).collect();
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
    let mut file = SerializedFileWriter::new(&mut bytes, schema(name, fields)?, properties)?;
    for group in groups {
        let mut rows = file.next_row_group()?;
        for field in 0..fields.len() {
            let Cells { there, levels } = cells(&group, field);
            let levels = levels.as_deref();
            match &there {
                Values::Text(text) => write::<ByteArrayType>(&mut rows, text, levels)?,
                Values::Whole(numbers) => write::<Int64Type>(&mut rows, numbers, levels)?,
                Values::Flags(flags) => write::<BoolType>(&mut rows, flags, levels)?,
                Values::Numbers(numbers) => write::<DoubleType>(&mut rows, numbers, levels)?,
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
        let text = (field.kind == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        let nulls = if field.has_nulls { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let built = Type::primitive_type_builder(&field.name, field.kind)
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

/// Text as a column keeps it.
fn texts(texts: Vec<String>) -> Values<'static> {
    Values::Text(texts.into_iter().map(|text| ByteArray::from(text.into_bytes())).collect())
}

/// Numbers that a column makes for itself.
fn numbers(numbers: Vec<f64>) -> Values<'static> {
    Values::Numbers(Cow::Owned(numbers))
}

//! Tables of results: columns of text, flags and numbers, each with its unit and meaning, in groups of
//! rows; as Parquet and as CSV.

mod arrow_schema;
mod csv;
mod parquet;
pub(crate) mod run;
pub(crate) mod sweep;

use crate::error::RecordError;
use std::borrow::Cow;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Text,
    Whole,
    Flag,
    Number,
}

/// What a column is called, what it holds and what that means; one without nulls is required.
pub(crate) struct Field {
    name: String,
    unit: String,
    meaning: String,
    kind: Kind,
    has_nulls: bool,
    /// Its values are few and are written once each.
    repeats: bool,
}

impl Field {
    fn new(name: impl Into<String>, kind: Kind, unit: &str, meaning: &str) -> Self {
        let (unit, meaning) = (unit.into(), meaning.into());
        Self { name: name.into(), unit, meaning, kind, has_nulls: false, repeats: false }
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
    Text(Vec<String>),
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

/// Makes the cells of a column in a group of rows.
type CellsOf<'a, G> = Box<dyn Fn(&G, usize) -> Cells<'a> + 'a>;

/// A table whose cells are made group by group.
pub(crate) struct Table<'a, G> {
    name: &'static str,
    fields: Vec<Field>,
    /// Of the table as a whole.
    metadata: Vec<(String, String)>,
    groups: Vec<G>,
    cells: CellsOf<'a, G>,
}

impl<G> Table<'_, G> {
    /// The bytes of a Parquet file.
    ///
    /// # Errors
    /// If the writer refuses.
    pub(crate) fn parquet(self) -> Result<Vec<u8>, RecordError> {
        parquet::file(self)
    }

    /// The bytes of a CSV file.
    ///
    /// # Errors
    /// If the writer refuses.
    pub(crate) fn csv(&self) -> Result<Vec<u8>, RecordError> {
        csv::file(self)
    }
}

/// Numbers that a column makes for itself.
fn numbers(numbers: Vec<f64>) -> Values<'static> {
    Values::Numbers(Cow::Owned(numbers))
}

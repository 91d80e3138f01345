//! A parsed file that remembers where each value stands.

use crate::deserialize::Root;
use crate::json;
use crate::positioned::{self, Entry, Positioned, Table, Value};
use crate::schema_walk::Walk;
use crate::{Complaint, Severity, Source};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

/// A TOML file, parsed, with the place of each key and value.
#[derive(Debug, Clone)]
pub struct Document {
    source: Arc<Source>,
    root: Table,
}

/// One step of a path into a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step<'a> {
    /// Into a table.
    Key(&'a str),
    /// Into a list, from zero.
    Index(usize),
}

impl<'a> From<&'a str> for Step<'a> {
    fn from(key: &'a str) -> Self {
        Self::Key(key)
    }
}
impl<'a> From<&'a String> for Step<'a> {
    fn from(key: &'a String) -> Self {
        Self::Key(key)
    }
}
impl From<usize> for Step<'_> {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}
impl fmt::Display for Step<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key(key) => f.write_str(key),
            Self::Index(index) => write!(f, "{index}"),
        }
    }
}

/// A path into a document: `at!["body", 3, "mass_kg"]`.
#[macro_export]
macro_rules! at {
    ($($step:expr),* $(,)?) => { &[$($crate::Step::from($step)),*] };
}

/// The place that a path leads to: its value, and its key if it has one.
struct Place<'d> {
    key_span: Option<Range<usize>>,
    item: &'d Positioned,
}

impl Document {
    /// The document of a text.
    ///
    /// # Errors
    /// Every place where the text is not TOML.
    pub fn parse(
        path: impl Into<PathBuf>,
        text: impl Into<String>,
    ) -> Result<Self, Vec<Complaint>> {
        Self::of(&Source::new(path, text))
    }
    /// The document of a text that is already a source.
    ///
    /// # Errors
    /// Every place where the text is not TOML.
    pub fn of(source: &Arc<Source>) -> Result<Self, Vec<Complaint>> {
        let root = positioned::parse(source)?;
        Ok(Self { source: Arc::clone(source), root })
    }
    /// The document of a JSON text: one object.
    ///
    /// # Errors
    /// Where the text is not JSON; every key that an object has twice, and every null.
    pub fn parse_json(
        path: impl Into<PathBuf>,
        text: impl Into<String>,
    ) -> Result<Self, Vec<Complaint>> {
        let source = Source::new(path, text);
        let root = json::parse(&source)?;
        Ok(Self { source, root })
    }
    /// The text and its path.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }
    /// The document as a `T`.
    ///
    /// # Errors
    /// Every key that `T` does not know, every key that is missing, every value of a wrong type.
    pub fn read<T: DeserializeOwned + JsonSchema>(&self) -> Result<T, Vec<Complaint>> {
        let schema = schema_of::<T>();
        let complaints = Walk::over(&self.source, &schema, &self.root).complaints;
        if !complaints.is_empty() {
            return Err(complaints);
        }
        self.deserialized()
    }
    /// The document as a `T` whose shape it has.
    pub(crate) fn deserialized<T: DeserializeOwned>(&self) -> Result<T, Vec<Complaint>> {
        T::deserialize(Root(&self.root))
            .map_err(|misfit| vec![Complaint::error(&self.source, misfit.to_string())])
    }
    /// Take another source of the same text.
    pub(crate) fn set_source(&mut self, source: Source) {
        self.source = Arc::new(source);
    }
    pub(crate) fn root(&self) -> &Table {
        &self.root
    }
    pub(crate) fn root_mut(&mut self) -> &mut Table {
        &mut self.root
    }
    /// Byte range of the value at a path, or of the nearest table or list above it that is there;
    /// `None` for the document as a whole.
    pub fn span(&self, path: &[Step<'_>]) -> Option<Range<usize>> {
        self.find(path).map(|place| place.item.span.clone())
    }
    /// Byte range of the value at a path, if all of the way is there.
    pub fn exact_span(&self, path: &[Step<'_>]) -> Option<Range<usize>> {
        self.exact(path).map(|item| item.span.clone())
    }
    /// Byte range of the key at a path; of the value where it is in a list.
    pub fn key_span(&self, path: &[Step<'_>]) -> Option<Range<usize>> {
        self.find(path).map(|place| place.key_span.unwrap_or(place.item.span.clone()))
    }
    /// Keys of the table at a path, in alphabetical order; none if there is no table.
    pub fn keys(&self, path: &[Step<'_>]) -> Vec<&str> {
        let table = match self.exact(path).map(|item| &item.value) {
            Some(Value::Table(table)) => table,
            None if path.is_empty() => &self.root,
            _ => return vec![],
        };
        table.keys().map(String::as_str).collect()
    }
    /// An error about the value at a path.
    pub fn error(
        &self,
        path: &[Step<'_>],
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> Complaint {
        self.complain(Severity::Error, path, message, label)
    }
    /// A warning about the value at a path.
    pub fn warning(
        &self,
        path: &[Step<'_>],
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> Complaint {
        self.complain(Severity::Warning, path, message, label)
    }
    /// A complaint about the value at a path.
    pub fn complain(
        &self,
        severity: Severity,
        path: &[Step<'_>],
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> Complaint {
        let complaint = Complaint::new(severity, &self.source, message);
        match self.span(path) {
            Some(span) => complaint.at(span, label),
            None => complaint,
        }
    }
    /// The document with the table at a path laid over it, and some top-level keys taken away.
    ///
    /// Tables merge key by key, everything else is replaced. Each value keeps the place where it
    /// stands in the file. A path that does not lead to a table lays nothing over.
    #[must_use]
    pub fn overlaid(&self, overlay: &[Step<'_>], without: &[&str]) -> Self {
        let mut root = self.root.clone();
        if let Some(Value::Table(over)) = self.exact(overlay).map(|item| &item.value) {
            positioned::lay_over(&mut root, over);
        }
        for key in without {
            root.remove(*key);
        }
        Self { source: Arc::clone(&self.source), root }
    }
    /// The deepest place on the way of a path that is there.
    fn find(&self, path: &[Step<'_>]) -> Option<Place<'_>> {
        let (Step::Key(first), rest) = path.split_first()? else { return None };
        let mut place = place_of(self.root.get(*first)?);
        for step in rest {
            match (step, &place.item.value) {
                (Step::Key(key), Value::Table(table)) if table.contains_key(*key) => {
                    place = place_of(&table[*key]);
                }
                (Step::Index(index), Value::Array(items)) if *index < items.len() => {
                    place = Place { key_span: None, item: &items[*index] };
                }
                _ => break,
            }
        }
        Some(place)
    }
    /// The item that a path leads to, if all of the way is there.
    pub(crate) fn exact(&self, path: &[Step<'_>]) -> Option<&Positioned> {
        let (Step::Key(first), rest) = path.split_first()? else { return None };
        let first = &self.root.get(*first)?.item;
        rest.iter().try_fold(first, |item, step| match (step, &item.value) {
            (Step::Key(key), Value::Table(table)) => table.get(*key).map(|entry| &entry.item),
            (Step::Index(index), Value::Array(items)) => items.get(*index),
            _ => None,
        })
    }
}

fn place_of(entry: &Entry) -> Place<'_> {
    Place { key_span: Some(entry.key_span.clone()), item: &entry.item }
}

/// The JSON Schema (draft 2020-12) of a format, for editors.
pub fn schema_of<T: JsonSchema>() -> serde_json::Value {
    schemars::schema_for!(T).to_value()
}

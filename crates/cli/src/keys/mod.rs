//! Every key of a file format, from its schema: as pages of the book, and as a table in the terminal.

mod shapes;
mod tables;
mod text;
mod units;

pub(crate) use text::terminal;

/// One table of a format.
#[derive(Debug, Clone, PartialEq, Eq)]
struct KeyTable {
    /// As a file writes it: `[control]`, `[[phase]]`; empty for the top of the file.
    path: String,
    /// What it is for.
    meaning: String,
    rows: Vec<KeyRow>,
}

/// One key.
#[derive(Debug, Clone, PartialEq, Eq)]
struct KeyRow {
    key: String,
    meaning: String,
    /// Empty for what has none.
    unit: String,
    /// What a value may be: type, words, range.
    value: String,
    /// What stands for it where it is left out.
    default: Default,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Default {
    /// It cannot be left out.
    Required,
    /// A value, as TOML.
    Value(String),
    /// Nothing, or what the meaning says.
    None,
}

impl Default {
    fn shown(&self) -> &str {
        match self {
            Self::Required => "required",
            Self::Value(value) => value,
            Self::None => "-",
        }
    }
}

//! Where a number comes from, and how sure it is.

/// How sure a number is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// In a document that the source names.
    Published,
    /// Computed from published numbers, as the source says.
    Derived,
    /// Chosen here.
    Assumed,
}

/// Where a number, or a block of them, comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// What it is about, as a path in the file: `body.bus.mass_kg`.
    pub of: String,
    /// How sure it is.
    pub grade: Grade,
    /// Document, page, or reasoning.
    pub source: String,
}

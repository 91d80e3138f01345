//! A user's file, its positions, and complaints that point at them.
//!
//! A format is a plain `serde` struct that also derives `schemars::JsonSchema`. The schema is walked
//! side by side with the file, so that everything wrong with its shape is said at once; checks of
//! meaning come later and find the place of a value by its path.

mod complaint;
mod document;
mod positioned;
mod render;
mod schema_walk;
mod suggestion;

pub use complaint::{Complaint, Severity, Source};
pub use document::{Document, Step, schema_of};
pub use render::render;
pub use suggestion::closest;

//! A user's file, its positions, and complaints that point at them.
//!
//! A format is a plain `serde` struct that also derives `schemars::JsonSchema`. The schema is walked
//! side by side with the file, so that everything wrong with its shape is said at once; checks of
//! meaning come later and find the place of a value by its path.
//!
//! ```
//! use wrasse_document::{Document, at, render};
//!
//! #[derive(serde::Deserialize, schemars::JsonSchema)]
//! #[serde(deny_unknown_fields)]
//! struct Payload {
//!     mass_kg: f64,
//! }
//!
//! let unknown = Document::parse("payload.toml", "mass = 500").unwrap();
//! let complaints = unknown.read::<Payload>().err().unwrap();
//! assert!(render(&complaints, false).contains("write `mass_kg`"));
//!
//! let negative = Document::parse("payload.toml", "mass_kg = -500").unwrap();
//! assert!(negative.read::<Payload>().unwrap().mass_kg < 0.0);
//! let complaint = negative.error(at!["mass_kg"], "mass must be positive", "this mass");
//! assert_eq!(complaint.span, Some(10..14));
//! ```

mod canonical;
mod complaint;
mod decode;
mod deserialize;
mod document;
mod edit;
mod excerpt;
mod in_part;
mod json;
mod laid_over;
mod positioned;
mod read_text;
mod render;
mod repairs;
mod schema_walk;
mod setting;
mod suggestion;
mod visible;

pub use complaint::{Complaint, Severity, Source};
pub use document::{Document, Step, schema_of};
pub use in_part::{Part, UNKNOWN};
pub use read_text::{MOST_BYTES, Unreadable, read_stream, read_text};
pub use render::render;
pub use setting::Setting;
pub use suggestion::closest;
pub use visible::{visible, visible_json, visible_lines};

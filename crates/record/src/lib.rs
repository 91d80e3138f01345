//! Results out: Parquet telemetry, the summary, the HTML report, the table for the terminal.
//!
//! Nothing here computes physics: an [`Outcome`](wrasse_mission::Outcome) goes in, files and
//! text come out, the same bytes for the same outcome. Folders are kinds of results, each with a
//! file for the run, the study and the sweep; `wording` is what more than one of them says.
#![allow(clippy::format_push_string, reason = "`text += &format!(…)` reads as what it does")]

mod columns;
mod error;
mod html;
mod json;
mod place;
mod plot;
mod provenance;
mod results;
mod terminal;
mod wording;

pub use self::columns::run::{telemetry_csv, telemetry_parquet};
pub use self::columns::sweep::{samples_csv, samples_parquet};
pub use error::RecordError;
pub use html::run::report_html;
pub use html::study::study_html;
pub use html::sweep::sweep_html;
pub use json::{study_json, summary_json, sweep_json};
pub use place::prepare_place;
pub use provenance::{FileRecord, Provenance};
pub use results::{StudyWritten, SweepWritten, Written, write_results, write_study, write_sweep};
pub use terminal::run::verdict_table;
pub use terminal::study::study_table;
pub use terminal::sweep::sweep_table;

//! Results out: Parquet telemetry, the summary, the HTML report, the table for the terminal.
//!
//! Nothing here computes physics: an [`Outcome`](wrasse_mission::Outcome) goes in, files and
//! text come out, the same bytes for the same outcome.
#![allow(clippy::format_push_string, reason = "`text += &format!(…)` reads as what it does")]

mod case_sections;
mod comparison;
mod drawing;
mod ledger_rests;
mod markup;
mod numbers;
mod parquet_file;
mod place;
mod plots;
mod report;
mod results;
mod study_envelope;
mod study_figures;
mod study_plot;
mod study_report;
mod study_results;
mod study_tables;
mod summary;
mod sweep_histogram;
mod sweep_parquet;
mod sweep_report;
mod sweep_results;
mod sweep_tables;
mod tables;

pub use parquet_file::telemetry_parquet;
pub use place::prepare_place;
pub use report::report_html;
pub use results::{RecordError, Written, write_results};
pub use study_report::study_html;
pub use study_results::{StudyWritten, study_json, write_study};
pub use study_tables::study_table;
pub use summary::summary_json;
pub use sweep_parquet::samples_parquet;
pub use sweep_report::sweep_html;
pub use sweep_results::{SweepWritten, sweep_json, write_sweep};
pub use sweep_tables::sweep_table;
pub use tables::verdict_table;

//! Many samples of a mission: flown by several threads, kept as they are done, counted up.
//!
//! A sample's numbers depend on the seed and its own number alone, so the results are the same bits for
//! any number of threads, in one go or in many.

mod checksum;
mod drawn;
mod folder;
mod outcome;
mod parts;
mod pass_rate;
mod percentiles;
mod rank_correlation;
mod row;
mod summing_up;
mod sweep;
mod sweep_error;

pub use drawn::{Drawn, DrawnValue};
pub use folder::OwnedFolder;
pub use outcome::{CaseSweep, EndCount, Influence, RequirementSweep, SweepOutcome, WorstSample};
pub use pass_rate::{CONFIDENCE, PassRate};
pub use percentiles::Percentiles;
pub use row::Row;
pub use sweep::{Sweep, sweep};
pub use sweep_error::SweepError;

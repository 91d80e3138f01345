//! Many samples of a mission: flown side by side, kept as they are done, counted up.
//!
//! A sample's numbers depend on the seed and its own number alone, so the results are the same bits for
//! any number of threads, in one go or in many.

mod outcome;
mod parts;
mod pass_rate;
mod percentiles;
mod rank_correlation;
mod row;
mod summing_up;
mod sweep;

pub use outcome::{CaseSweep, EndCount, Influence, RequirementSweep, SweepOutcome, WorstSample};
pub use parts::SweepError;
pub use pass_rate::{CONFIDENCE, PassRate};
pub use percentiles::Percentiles;
pub use row::Row;
pub use sweep::{Sweep, sweep};

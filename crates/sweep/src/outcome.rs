//! What a sweep leaves behind. Plain data for those who record, draw or judge it.

use crate::drawn::{Drawn, DrawnValue};
use crate::pass_rate::PassRate;
use crate::percentiles::Percentiles;
use crate::row::Row;
use serde::Serialize;

/// Everything about one `wrasse sweep`.
#[derive(Debug, Clone, Serialize)]
pub struct SweepOutcome {
    /// Name of the mission.
    pub mission: String,
    /// What it is for, from the mission file.
    pub summary: String,
    /// The mission file, as given.
    pub mission_file: String,
    /// The whole text of the mission file.
    #[serde(skip)]
    pub mission_text: String,
    /// Values that the command line laid over it.
    #[serde(skip)]
    pub settings: Vec<String>,
    /// wrasse's version.
    pub version: String,
    /// Seed of all draws.
    pub seed: u64,
    /// Samples flown in each case.
    pub samples: u64,
    /// Confidence of the intervals of the pass rates (–).
    pub confidence: f64,
    /// One case, or one for each combination that the mission compares: all fly the same draws.
    pub cases: Vec<CaseSweep>,
}

/// The samples of one case.
#[derive(Debug, Clone, Serialize)]
pub struct CaseSweep {
    /// What tells it from the others: (axis, row); empty for a mission with a single case.
    pub labels: Vec<(String, String)>,
    /// Samples that came to their end with all requirements met and their books closed.
    pub passed: PassRate,
    /// How often the flights ended in which way.
    pub ends: Vec<EndCount>,
    /// Flights whose books of momentum or energy stay open.
    pub open_books: usize,
    /// Whether anything differs from sample to sample: draws that act on the case, or noise.
    pub varies: bool,
    /// What was drawn: the values of the files and the range that was flown.
    pub drawn: Vec<Drawn>,
    /// Requirements in the order of the file.
    pub requirements: Vec<RequirementSweep>,
    /// Every sample, in order.
    #[serde(skip)]
    pub rows: Vec<Row>,
}

/// How often flights ended in one way.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct EndCount {
    /// `completed`, `infeasible`, `stopped` or `breakdown`.
    pub end: String,
    /// How often.
    pub count: usize,
    /// The first sample that ended so, and what it said.
    pub first: u64,
    /// Why the first ended so; empty where it was completed.
    pub reason: String,
}

/// One requirement over all samples. Values are in the unit the requirement was written in.
#[derive(Debug, Clone, Serialize)]
pub struct RequirementSweep {
    /// The requirement as written.
    pub requirement: String,
    /// `<=` or `>=` and so on.
    pub comparison: String,
    /// The limit.
    pub limit: f64,
    /// Unit of limit and values.
    pub unit: String,
    /// Samples in which it holds.
    pub holds: PassRate,
    /// Samples that ended before there was a value.
    pub absent: usize,
    /// Where the values lie.
    pub values: Option<Percentiles>,
    /// The worst samples, the worst first.
    pub worst: Vec<WorstSample>,
    /// What was drawn that the value goes with beyond what chance explains, the strongest first.
    pub influences: Vec<Influence>,
}

/// A sample to look at more closely.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstSample {
    /// Its number.
    pub sample: u64,
    /// Its value; absent where the flight ended before there was one.
    pub value: Option<f64>,
    /// What flies it again, with a full report.
    pub command: String,
    /// What was drawn for it.
    pub drawn: Vec<DrawnValue>,
}

/// A drawn number that a value goes with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Influence {
    /// The drawn number.
    pub quantity: String,
    /// Spearman's rank correlation with the value (–).
    pub rank_correlation: f64,
}

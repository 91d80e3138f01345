//! One sample in one case: a row of the results.

use serde::{Deserialize, Serialize};
use wrasse_mission::Mission;
use wrasse_rehearsal::{End, SampleOutcome};

/// What came of one sample in one case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of the case.
    pub case: usize,
    /// Number of the sample.
    pub sample: u64,
    /// What was drawn, in the order of the dispersed quantities and in their units.
    pub deviations: Vec<f64>,
    /// The value that each requirement is about, in its unit; absent where there is none, or none that
    /// is finite.
    pub values: Vec<Option<f64>>,
    /// Whether each requirement holds.
    pub holds: Vec<bool>,
    /// How it ended.
    pub end: End,
    /// Whether its books of momentum and energy close.
    pub closes: bool,
    /// It came to its end, its books close, and all requirements hold.
    pub passed: bool,
}

impl Row {
    /// Whether it is of a case of this mission, as far as its columns tell.
    pub(crate) fn fits(&self, mission: &Mission) -> bool {
        self.case < mission.cases.len()
            && self.deviations.len() == mission.cases[self.case].dispersed().len()
            && self.values.len() == mission.cases[self.case].requirements.len()
            && self.holds.len() == self.values.len()
    }
    pub(crate) fn of(case: usize, outcome: SampleOutcome) -> Self {
        let value = |value: Option<f64>| value.filter(|x| x.is_finite());
        Self {
            case,
            sample: outcome.sample,
            deviations: outcome.deviations,
            values: outcome.verdicts.iter().map(|v| value(v.value)).collect(),
            holds: outcome.verdicts.iter().map(|v| v.pass).collect(),
            end: outcome.end,
            closes: outcome.closes,
            passed: outcome.passed,
        }
    }
}

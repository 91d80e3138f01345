//! A checked mission: ready to be planned and flown.

use crate::toml::study::{ClaimIs, StudyFile};
use wrasse_document::Complaint;
use wrasse_rehearsal::Case;

/// A mission file, checked.
#[derive(Debug, Clone)]
pub struct Mission {
    /// Its name: results go to `out/NAME`.
    pub name: String,
    /// What it is for.
    pub summary: String,
    /// The file, as given.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Values that were laid over it, as the command line gave them.
    pub settings: Vec<String>,
    /// The document with them in its one form, without the keys that change nothing of what is flown.
    pub(crate) canonical: String,
    /// Seed of everything random.
    pub seed: u64,
    /// What `wrasse size` makes of the cases.
    pub study: Option<Study>,
    /// Warnings about the file: it can be flown, but is worth a second look.
    pub remarks: Vec<Complaint>,
    /// The cases: one, or one for each combination that is compared.
    pub cases: Vec<Case>,
}

/// What `wrasse size` makes of the cases of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The claim that is examined.
    pub claim: String,
    /// What it says, if verdicts can be held against it.
    pub claim_is: Option<ClaimIs>,
    /// Name of the compared axis whose rows are tasks, if there is one.
    pub tasks: Option<String>,
    /// Name of the compared axis whose rows are sets of actuators.
    pub sets: String,
    /// The row of that axis that is ideal.
    pub reference: String,
    /// Tasks that are flown with every set.
    pub closed_loop: Vec<String>,
    /// Most mass that a set may have (kg).
    pub mass_limit_kg: Option<f64>,
    /// Most power that a set may take (W).
    pub power_limit_w: Option<f64>,
}

impl Study {
    pub(crate) fn of(file: &StudyFile) -> Self {
        Self {
            claim: file.claim.clone(),
            claim_is: file.claim_is,
            tasks: file.tasks.clone(),
            sets: file.sets.clone(),
            reference: file.reference.clone(),
            closed_loop: file.closed_loop.clone(),
            mass_limit_kg: file.mass_limit_kg,
            power_limit_w: file.power_limit_w,
        }
    }
}

impl Mission {
    /// The mission that a sample of a seed flies: [`run`](crate::run) shows all of it.
    #[must_use]
    pub fn sampled(&self, seed: u64, sample: u64) -> Self {
        let mut mission = self.clone();
        mission.seed = seed;
        mission.cases = self.cases.iter().map(|case| case.sampled(seed, sample)).collect();
        let drawn = self.cases[0].drawn(seed, sample).join(", ");
        mission.summary = format!("{} Sample {sample} of seed {seed}: {drawn}.", self.summary);
        mission
    }
}

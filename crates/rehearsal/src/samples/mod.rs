//! Samples of a mission: cases whose dispersed quantities were drawn, flown for their verdicts only.
//!
//! A sample is the same to the last bit whether it is flown here, beside others, or by
//! [`run_case`](crate::run_case) with all that a report shows.

pub(crate) mod dispersion;
mod sampled_case;
mod variation;

use crate::case::Case;
use crate::flight_loop::{Judge, fly};
use crate::notices::overlap::Overlaps;
use crate::outcome::ledger::ledger;
use crate::outcome::{End, Verdict};
use crate::plan::{Plan, plan};
use crate::signals::quantity::Statistics;
use crate::signals::requirement::Requirement;
use crate::signals::watch::Watch;
use crate::simulation::Simulation;
use dispersion::draws;
use std::borrow::Cow;

/// What came of a sample.
#[derive(Debug, Clone)]
pub struct SampleOutcome {
    /// Its number.
    pub sample: u64,
    /// What was drawn: deviations from what the files say, in the order and the units of
    /// [`Case::dispersed`].
    pub deviations: Vec<f64>,
    /// How it ended.
    pub end: End,
    /// Whether its books of momentum and energy close.
    pub closes: bool,
    /// It came to its end, its books close, tool and loads stayed outside the bus, and all requirements
    /// hold.
    pub passed: bool,
    /// Requirements and their verdicts, in the order of the file.
    pub verdicts: Vec<Verdict>,
}

/// What all samples of a case have in common.
#[derive(Debug)]
pub struct SamplePlan<'c> {
    case: &'c Case,
    /// The plan, where nothing that is drawn is known to the laws as they plan.
    plan: Option<Plan>,
    /// Numbers of the quantities that are required.
    watched: Vec<usize>,
}

impl Case {
    /// What a sample draws anew, with units: `payload.module.mass_kg`.
    pub fn dispersed(&self) -> Vec<&str> {
        self.dispersions.iter().map(|d| d.name.as_str()).collect()
    }

    /// What a sample draws anew: the values of the files, with their units. What a sample deviates is added
    /// to them.
    pub fn nominal(&self) -> Vec<(f64, &'static str)> {
        self.dispersions.iter().map(|d| (d.nominal, d.unit)).collect()
    }

    /// The requirements, not yet answered.
    pub fn required(&self) -> Vec<Verdict> {
        self.requirements.iter().map(Requirement::unanswered).collect()
    }

    /// What a sample of a seed drew, a sentence for each quantity.
    pub fn drawn(&self, seed: u64, sample: u64) -> Vec<String> {
        let (_, sizes) = draws(&self.dispersions, seed, sample);
        let drawn = self.dispersions.iter().zip(sizes).map(|(d, x)| {
            let value = d.nominal + x;
            format!("{} is {value:.6} {} ({x:+.5})", d.name, d.unit)
        });
        drawn.collect()
    }
}

/// What can be prepared for all samples of a case.
pub fn plan_samples(case: &Case) -> SamplePlan<'_> {
    let mut watched: Vec<usize> = case.requirements.iter().map(|r| r.quantity).collect();
    // Two requirements of one quantity: it counts once.
    watched.sort_unstable();
    watched.dedup();
    // The planning sees what the laws believe and where everything is; of the rest it knows nothing.
    let is_seen = case.dispersions.iter().any(|d| d.known || !d.target.can_be_known());
    SamplePlan { case, plan: (!is_seen).then(|| plan(case)), watched }
}

/// What a flight for its verdicts comes to.
struct Flown {
    end: End,
    statistics: Statistics,
    /// Whether its books close.
    closes: bool,
    /// Whether tool and loads stayed outside the bus.
    stays_outside: bool,
}

/// A sample that was drawn and planned.
struct Prepared<'p> {
    sample: u64,
    deviations: Vec<f64>,
    case: Case,
    plan: Cow<'p, Plan>,
}

impl<'p> Prepared<'p> {
    fn new(planned: &'p SamplePlan<'_>, seed: u64, sample: u64) -> Self {
        let case = planned.case.sampled(seed, sample);
        let (_, deviations) = draws(&planned.case.dispersions, seed, sample);
        let plan = match &planned.plan {
            Some(plan) => Cow::Borrowed(plan),
            None => Cow::Owned(plan(&case)),
        };
        Self { sample, deviations, case, plan }
    }
    fn flown(self, planned: &SamplePlan<'_>) -> SampleOutcome {
        if let Some(end) = self.plan.blocked.clone() {
            let verdicts = self.case.requirements.iter().map(Requirement::unanswered).collect();
            let Self { sample, deviations, .. } = self;
            return SampleOutcome {
                sample,
                deviations,
                end,
                closes: true,
                passed: false,
                verdicts,
            };
        }
        let flown = fly_for_verdicts(&self.case, planned);
        self.judged(flown)
    }
    fn judged(self, flown: Flown) -> SampleOutcome {
        let Flown { end, statistics, closes, stays_outside } = flown;
        let Self { sample, deviations, case, .. } = self;
        let verdicts: Vec<_> = case.requirements.iter().map(|r| r.verdict(&statistics)).collect();
        let completed = matches!(end, End::Completed);
        let passed = completed && closes && stays_outside && verdicts.iter().all(|v| v.pass);
        SampleOutcome { sample, deviations, end, closes, passed, verdicts }
    }
}

/// Fly one sample of a seed.
pub fn fly_sample(planned: &SamplePlan<'_>, seed: u64, sample: u64) -> SampleOutcome {
    Prepared::new(planned, seed, sample).flown(planned)
}

/// Fly a case, and look only at what is required: how it ended, what was seen, and whether the ledger
/// closes.
fn fly_for_verdicts(case: &Case, planned: &SamplePlan<'_>) -> Flown {
    let mut flight = Simulation::new(case);
    let watch = Watch::of(case, planned.watched.clone());
    let mut judge = Judge { watch, overlaps: Overlaps::default() };
    let end = fly(&mut flight, &mut judge);
    let closes = ledger(flight.plant().ledger(), case.base).closes;
    let stays_outside = case.overlap_verdicts(&judge.overlaps).is_empty();
    Flown { end, statistics: judge.watch.finish().0, closes, stays_outside }
}

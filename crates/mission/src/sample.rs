//! Samples of a mission: cases whose dispersed quantities were drawn, flown for their verdicts only.
//!
//! A sample is the same to the last bit whether it is flown here, beside others, or by
//! [`run`](crate::run) with all that a report shows.

use crate::books::ledger;
use crate::dispersion::draws;
use crate::flight::Flight;
use crate::mission::{Case, Mission};
use crate::observe::{Track, Truth, observe};
use crate::outcome::{End, Verdict};
use crate::plan::{Plan, plan};
use crate::quantity::Watch;
use crate::requirement::Requirement;
use crate::signals::Needs;
use std::borrow::Cow;
use std::fmt::Write;

/// What came of a sample.
#[derive(Debug, Clone)]
pub struct SampleOutcome {
    /// Its number.
    pub sample: u64,
    /// What was drawn: deviations from what the files say, in the order and the units of
    /// [`Mission::dispersed`].
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
pub struct SamplePlan<'m> {
    pub(crate) case: &'m Case,
    /// The plan, where nothing that is drawn is known to the laws as they plan.
    plan: Option<Plan>,
    pub(crate) needs: Needs,
    /// Numbers of the quantities that are required.
    pub(crate) watched: Vec<usize>,
}

impl Mission {
    /// What a sample draws anew in a case, with units: `payload.module.mass_kg`.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn dispersed(&self, case: usize) -> Vec<&str> {
        self.cases[case].dispersions.iter().map(|d| d.name.as_str()).collect()
    }

    /// What a sample draws anew in a case: the values of the files, with their units. What a sample
    /// deviates is added to them.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn nominal(&self, case: usize) -> Vec<(f64, &'static str)> {
        self.cases[case].dispersions.iter().map(|d| (d.nominal, d.unit)).collect()
    }

    /// Number of requirements of a case.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn requirement_count(&self, case: usize) -> usize {
        self.cases[case].requirements.len()
    }

    /// The requirements of a case, not yet answered.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn required(&self, case: usize) -> Vec<Verdict> {
        self.cases[case].requirements.iter().map(Requirement::unanswered).collect()
    }

    /// A number that another mission, as far as it decides what comes of a sample, all but surely does
    /// not have. Names, words and places of files do not count.
    pub fn fingerprint(&self) -> u64 {
        let mut print = Fingerprint(FNV_OFFSET);
        for case in &self.cases {
            let Case { vehicle: v, labels, start, payloads, base, turning, equipment: e, .. } =
                case;
            // It swallows all: nothing can fail.
            let _ = write!(print, "{:?}", (v.robot, &v.limits, &v.frames, v.attitude_actuator));
            let _ = write!(print, "{:?}", (labels, start, payloads, base, turning));
            let _ = write!(print, "{:?}", (e.actuators, e.wheel_speed, e.gimbal_angle));
            let Case { sensors, measures_wrench, failures, wrenches, stepper, torque, .. } = case;
            let _ = write!(print, "{:?}", (sensors, measures_wrench, failures, wrenches));
            let _ = write!(print, "{:?}", (stepper, torque, &case.setup, &case.phases));
            let _ = write!(print, "{:?}", (&case.dispersions, &case.requirements));
        }
        print.0
    }

    /// The mission that a sample of a seed flies: [`run`](crate::run) shows all of it.
    #[must_use]
    pub fn sampled(&self, seed: u64, sample: u64) -> Self {
        let mut mission = self.clone();
        mission.seed = seed;
        mission.cases = self.cases.iter().map(|case| case.sampled(seed, sample)).collect();
        let case = &self.cases[0];
        let (_, sizes) = draws(&case.dispersions, seed, sample);
        let drawn = case.dispersions.iter().zip(sizes).map(|(d, x)| {
            let value = d.nominal + x;
            format!("{} is {value:.6} {} ({x:+.5})", d.name, d.unit)
        });
        let drawn: Vec<String> = drawn.collect();
        mission.summary =
            format!("{} Sample {sample} of seed {seed}: {}.", self.summary, drawn.join(", "));
        mission
    }
}

/// Fowler, Noll and Vo's hash, version 1a, of what is written to it.
struct Fingerprint(u64);

const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(FNV_PRIME);
        }
        Ok(())
    }
}

/// What can be prepared for all samples of a case.
///
/// # Panics
/// If there is no case of this number.
pub fn plan_samples(mission: &Mission, case: usize) -> SamplePlan<'_> {
    let case = &mission.cases[case];
    let mut watched: Vec<usize> = case.requirements.iter().map(Requirement::quantity).collect();
    // Two requirements of one quantity: it counts once.
    watched.sort_unstable();
    watched.dedup();
    // The planning sees what the laws believe and where everything is; of the rest it knows nothing.
    let is_seen = case.dispersions.iter().any(|d| d.known || !d.target.can_be_known());
    SamplePlan { case, plan: (!is_seen).then(|| plan(case)), needs: Needs::of(&watched), watched }
}

/// What a flight for its verdicts comes to.
struct Flown {
    end: End,
    watch: Watch,
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
        let flown = fly_for_verdicts(&self.case, &self.plan, planned);
        self.judged(flown)
    }
    fn judged(self, flown: Flown) -> SampleOutcome {
        let Flown { end, watch, closes, stays_outside } = flown;
        let Self { sample, deviations, case, .. } = self;
        let verdicts: Vec<_> = case.requirements.iter().map(|r| r.verdict(&watch)).collect();
        let completed = matches!(end, End::Completed);
        let passed = completed && closes && stays_outside && verdicts.iter().all(|v| v.pass);
        SampleOutcome { sample, deviations, end, closes, passed, verdicts }
    }
}

/// Fly one sample of a seed.
pub fn fly_sample(planned: &SamplePlan<'_>, seed: u64, sample: u64) -> SampleOutcome {
    Prepared::new(planned, seed, sample).flown(planned)
}

/// Fly a case as planned, and look only at what is required: how it ended, what was seen, and whether
/// the books close.
fn fly_for_verdicts(case: &Case, plan: &Plan, planned: &SamplePlan<'_>) -> Flown {
    let mut flight = Flight::new(case, case.stepper, false);
    let mut watch = Watch::new(case.quantities.clone(), case.phases.len());
    let mut books = flight.world.open_ledger();
    let mut track = Track::default();
    let mut end = End::Completed;
    for period in 0..plan.periods {
        let command = match flight.next_period() {
            Ok(command) => command,
            Err(stop) => {
                end = stop;
                break;
            }
        };
        track.follow(&command, &flight.computer, &flight.world.quat_NB());
        flight.world.update_ledger(&mut books);
        let (error, needs) = (flight.estimate_error, planned.needs);
        let truth = Truth::of(&flight.world, needs);
        let jacobian = || flight.computer.task_jacobian();
        let seen = observe(case, &truth, &command, &track, error, needs, &jacobian);
        watch.add_only(&planned.watched, command.phase, &seen.values);
        flight.look_for_overlap(&seen, period == 0);
        if let Some(stop) = flight.grip(&command) {
            end = stop;
            break;
        }
        flight.world.update_ledger(&mut books);
    }
    let closes = ledger(&books, case.base).closes;
    let stays_outside = case.overlap_verdicts(&flight.overlaps).is_empty();
    Flown { end, watch, closes, stays_outside }
}

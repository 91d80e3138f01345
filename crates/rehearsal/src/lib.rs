//! A case is planned, flown by its flight computer in a world, and judged.
//!
//! [`Case`] is all that goes in, as plain data; [`Simulation`] is one flight of it, a control period at a time;
//! [`CaseOutcome`] is what is left behind.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::format_push_string, reason = "`text += &format!(…)` reads as what it does")]

mod applied_wrench;
mod case;
mod case_world;
mod coast;
pub mod figures;
mod flight_loop;
mod gripping;
mod notices;
mod outcome;
mod plan;
mod run;
mod sampled_loops;
mod samples;
mod sensing;
mod signals;
mod simulation;
mod true_plant;

pub use applied_wrench::AppliedWrench;
pub use case::{
    AttitudeActuation, Believed, Case, FailureCase, PayloadCase, PayloadStart, Setting, StepCase,
};
pub use coast::{COAST_SEED, Coast, coast};
pub use flight_loop::fly;
pub use notices::overlap::looked_at;
pub use outcome::{
    CaseOutcome, Channel, DemandSample, End, Event, EventKind, Ledger, Metric, PlanLine, Snapshot,
    SnapshotBox, Telemetry, Verdict,
};
pub use plan::step_cycles::cycle_without_attempts;
pub use run::{RunOptions, run_case};
pub use sampled_loops::{REMARK_BELOW, SampledLoop, sampled_loops};
pub use samples::dispersion::{Dispersion, Distribution, Target};
pub use samples::{SampleOutcome, SamplePlan, fly_sample, plan_samples};
pub use signals::quantity::{Kind, Quantity, Statistic, Statistics, measured_in};
pub use signals::requirement::{Comparison, Requirement};
pub use signals::tool_signals::watched_tools;
pub use signals::watch::Watch;
pub use signals::{Needs, quantities};
pub use simulation::{Observer, Plant, Simulation};
pub use true_plant::TruePlant;
pub use wrasse_world::{Account, Booking, Bookings, Source};

//! A mission file puts a flight computer into a world, plans, runs and judges.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::format_push_string, reason = "`text += &format!(…)` reads as what it does")]

mod advice;
mod applied_wrench;
mod arm_shape;
mod as_flown;
mod asked;
mod base_format;
mod books;
mod case_world;
mod dead_band;
mod dispersible;
mod dispersion;
mod dispersion_format;
mod figures;
mod flight;
mod fly;
mod folder_name;
mod format;
mod gripping;
mod limits_passed;
mod mission;
mod observe;
mod other_postures;
mod outcome;
mod overlap;
mod phase_format;
mod picture;
mod plan;
mod quantity;
mod read_base;
mod read_dispersions;
mod read_mission;
mod read_payload;
mod read_phase;
mod read_setup;
mod reading;
mod requirement;
mod run;
mod sample;
mod sampled_case;
mod sampled_loops;
mod sampling;
mod saturations;
mod sensing;
mod signals;
mod solid_shape;
mod telemetry;
mod telling;
mod variation;

pub use as_flown::Setting;
pub use base_format::ClaimIs;
pub use mission::{Mission, Study};
pub use outcome::{
    CaseOutcome, Channel, DemandSample, End, Event, EventKind, Ledger, Metric, Outcome, PlanLine,
    ProvenanceRow, Snapshot, SnapshotBox, Telemetry, VehicleCard, Verdict,
};
pub use read_mission::{mission_schema, read_mission};
pub use run::{Progress, RunOptions, run, run_case};
pub use sample::{SampleOutcome, SamplePlan, fly_sample, plan_samples};
pub use sampled_loops::SampledLoop;
pub use wrasse_world::{Account, Booking, Bookings, Source};

//! A mission file puts a flight computer into a world, plans, runs and judges.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod applied_wrench;
mod arm_shape;
mod base_format;
mod books;
mod case_world;
mod dead_band;
mod fly;
mod format;
mod limits_passed;
mod mission;
mod observe;
mod outcome;
mod phase_format;
mod picture;
mod plan;
mod quantity;
mod read_base;
mod read_mission;
mod read_payload;
mod read_phase;
mod read_setup;
mod reading;
mod requirement;
mod run;
mod sampling;
mod saturations;
mod sensing;
mod telemetry;

pub use base_format::ClaimIs;
pub use mission::{Mission, Study};
pub use outcome::{
    CaseOutcome, Channel, DemandSample, End, Event, EventKind, Ledger, Metric, Outcome, PlanLine,
    ProvenanceRow, Snapshot, SnapshotBox, Telemetry, VehicleCard, Verdict,
};
pub use read_mission::{mission_schema, read_mission};
pub use run::{Progress, RunOptions, run, run_case};

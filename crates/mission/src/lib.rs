//! A mission file puts a flight computer into a world, plans, runs and judges.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod outcome;

pub use outcome::{
    CaseOutcome, Channel, End, Event, Ledger, Metric, Outcome, PlanLine, ProvenanceRow, Snapshot,
    SnapshotBox, Telemetry, VehicleCard, Verdict,
};

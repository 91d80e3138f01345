//! Sizing: what a task asks of the base, and which actuators can give it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::format_push_string, reason = "`text += &format!(…)` reads as what it does")]

mod bounds;
mod capability;
mod demand;
mod envelope;
mod findings;
mod flights;
mod hand_check;
mod judgement;
mod outcome;
mod own_units;
mod sets;
mod size;
mod study;
mod study_table;

pub use bounds::Bounds;
pub use capability::Capability;
pub use demand::Demand;
pub use envelope::{
    Facet, Mesh, Piece, Solid, SteeringPath, SteeringReach, ThrusterTorque, facets, first_outside,
    least_flow, singular_surfaces, steering_path, steering_reach, thruster_torque,
};
pub use judgement::{Answer, Judgement, judge};
pub use outcome::{
    Finding, Flown, HandCheck, SetCard, SetKind, SetVerdict, StudyOutcome, TaskOutcome,
};
pub use sets::Catalogue;
pub use size::size;
pub use study::{Study, read_study, study_in};
pub use study_table::study_complaints;

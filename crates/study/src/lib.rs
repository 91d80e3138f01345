//! Sizing: what a task asks of the base, and which actuators can give it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod capability;
mod demand;
mod envelope;
mod judgement;

pub use capability::{Capability, Reach};
pub use demand::Demand;
pub use envelope::{
    Facet, Mesh, Piece, Solid, SteeringPath, SteeringReach, ThrusterTorque, facets, first_outside,
    least_flow, singular_surfaces, steering_path, steering_reach, thruster_torque,
};
pub use judgement::{Answer, Both, Judgement, judge};

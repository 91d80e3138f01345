//! What a set of actuators can hold and give: momentum and torque as solids, singular surfaces,
//! thrusters.

mod directions;
mod facets;
mod leaving;
#[cfg(test)]
pub(crate) mod pyramid;
mod singular_surface;
mod solid;
mod steering_reach;
mod thruster_torque;

pub use facets::{Facet, facets};
pub use leaving::first_outside;
pub use singular_surface::{Mesh, singular_surfaces};
pub use solid::{Piece, Solid};
pub use steering_reach::{SteeringPath, SteeringReach, steering_path, steering_reach};
pub use thruster_torque::{ThrusterTorque, least_flow, thruster_torque};

//! Contact: shapes that push each other where they overlap. A compliant law at each place where two shapes
//! meet, with the same force at the same point on both.

mod account;
mod coupling;
mod friction;
mod law;
mod mobility;
mod normal_force;
mod pair;
mod peak;
mod restitution;
mod stepping;
mod touching;
mod uniform_disc;

pub use account::{ContactEnergy, ContactEvent, ContactRecord};
pub use coupling::Contact;
pub use friction::FrictionForce;
pub use law::{Bristle, BristleDamping, ContactLaw, FrictionLaw};
pub use normal_force::NormalForce;
pub use pair::{Curvature, PairRefused, law_of_pair};
pub use restitution::{LEAST_RESTITUTION, damping_number, restitution_at};
pub use touching::ContactAccuracy;
pub(crate) use touching::Touching;
pub use uniform_disc::uniform_disc_friction;

//! Whether what a file says can be, and whether it is believed.

mod equipment_on_base;
mod physical;
mod plausible;
mod regular;
mod spanning;
mod torque_cone;
mod tree;

pub use equipment_on_base::check_equipment;
pub(crate) use physical::{
    check_body, check_joint, check_numbers, check_single_links, is_rounded, principal_moments,
};
pub(crate) use plausible::{doubt_joint, doubt_mass, doubt_matter};
pub(crate) use regular::{Regularity, regularity};
pub(crate) use spanning::check_spanning;
pub(crate) use tree::{Edge, Tree, tree};

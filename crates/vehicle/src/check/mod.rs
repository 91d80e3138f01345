//! Whether what a file says can be, and whether it is believed.

mod drawn;
mod equipment_on_base;
mod physical;
mod plausible;
mod principal;
mod regular;
mod shape_against_inertia;
mod spanning;
mod torque_cone;
mod tree;

pub(crate) use drawn::Drawn;
pub use equipment_on_base::check_equipment;
pub(crate) use physical::{
    check_body, check_joint, check_numbers, check_single_links, is_rounded, principal_moments,
};
pub(crate) use plausible::{
    OSMIUM, TWO_TURNS, doubt_joint, doubt_mass, doubt_matter, ellipsoid_density,
};
pub(crate) use principal::{
    PrincipalAxis, angle_between, axis_in_words, long_axis, principal_axes,
};
pub(crate) use regular::{Regularity, postures, regularity, travel_or_usual};
pub(crate) use shape_against_inertia::doubt_against_shape;
pub(crate) use spanning::check_spanning;
pub(crate) use tree::{Edge, Tree, tree};

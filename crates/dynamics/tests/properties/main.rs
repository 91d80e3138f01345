//! Laws of mechanics and identities of the theory, on random trees. `--nocapture` prints how well
//! each one holds.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

mod in_time;
mod measure;

mod barycentric_laws;
mod equivalence_laws;
mod forward_dynamics_derivatives_laws;
mod forward_dynamics_laws;
mod generalized_jacobian_laws;
mod inverse_dynamics_derivatives_laws;
mod inverse_dynamics_laws;
mod kinematics_laws;
mod mass_matrix_laws;
mod momentum_laws;
mod null_space_laws;
mod operational_inertia_laws;
mod reaction_laws;
mod reduced_inertia_laws;

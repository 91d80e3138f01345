//! Rigid-body dynamics of a free-flying robot: one file per algorithm. No heap, no `std`.
//!
//! A robot is a tree: a free-flying base and any number of arms. Generalized velocity is
//! `[w_NB_B; v_NB_B; q̇]`, generalized force `[torque; force; τ]`. There is no gravity.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod attitude_held_jacobian;
mod barycentric_vectors;
mod base_response;
mod cholesky;
mod composite_inertia;
mod configuration;
mod energy;
mod factorization;
mod forward_dynamics;
mod forward_dynamics_derivatives;
mod generalized_jacobian;
mod inverse_dynamics;
mod inverse_dynamics_derivatives;
mod inverse_mass_matrix;
mod jacobian;
mod joint_axes;
mod kinematics;
mod link_rows;
mod mass_matrix;
mod momentum;
mod operational_inertia;
mod outside;
mod posture;
mod printed_reaction;
mod reaction;
mod reaction_null_space;
mod reduced_inertia;
mod robot;
mod side_by_side;
mod tree;

pub use attitude_held_jacobian::attitude_held_jacobian;
pub use barycentric_vectors::{barycentric_vectors, virtual_manipulator};
pub use base_response::{BaseResponse, base_response, base_response_rate};
pub use cholesky::Cholesky;
pub use composite_inertia::{BaseRows, CompositeInertia, compose};
pub use configuration::{Configuration, configure};
pub use energy::kinetic_energy;
pub use factorization::Factorization;
pub use forward_dynamics::{
    BaseMode, Dynamics, ForwardDynamics, JointDrive, accelerate, driven_dynamics, forward_dynamics,
};
pub use forward_dynamics_derivatives::{ForwardDynamicsDerivatives, forward_dynamics_derivatives};
pub use generalized_jacobian::{generalized_columns, generalized_jacobian, velocity_from_momentum};
pub use inverse_dynamics::{
    InverseDynamics, bias_force, drive, drive_configuration, inverse_dynamics,
};
pub use inverse_dynamics_derivatives::{
    BaseColumns, InverseDynamicsDerivatives, JointColumns, inverse_dynamics_derivatives,
};
pub use inverse_mass_matrix::{InverseMassMatrix, inverse_mass_matrix};
pub use jacobian::{Jacobian, bias_acceleration, jacobian, jacobian_columns};
pub use kinematics::{Kinematics, kinematics};
pub use mass_matrix::{MassMatrix, base_rows, fill, mass_matrix};
pub use momentum::{
    Momentum, MomentumMatrix, base_twist, momentum, momentum_columns, momentum_matrix,
};
pub use operational_inertia::{factorize, inverse_operational_inertia, operational_inertia};
pub use outside::Outside;
pub use posture::{Posture, place};
pub use printed_reaction::{PrintedReaction, printed_reaction};
pub use reaction::{attitude_torque, mount_reaction};
pub use reaction_null_space::{angular_momentum_per_rate, reaction_null_space};
pub use reduced_inertia::{ReducedDynamics, attitude_held_dynamics, free_floating_dynamics};
pub use robot::{
    BodyId, Frame, Generalized, GeneralizedForce, GeneralizedVelocity, Joint, JointKind,
    MassProperties, PerBody, Robot, RobotError, State,
};

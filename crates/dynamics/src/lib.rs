//! Rigid-body dynamics of a free-flying robot: one file per algorithm. No heap, no `std`.
//!
//! A robot is a tree: a free-flying base and any number of arms. Generalized velocity is
//! `[w_NB_B; v_NB_B; q̇]`, generalized force `[torque; force; τ]`. There is no gravity.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod robot;

pub use robot::{
    BodyId, Frame, Generalized, GeneralizedForce, GeneralizedVelocity, Joint, JointKind, Payload,
    PerBody, Robot, RobotError, State,
};

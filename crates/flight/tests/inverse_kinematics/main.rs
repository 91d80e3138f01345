//! Inverse kinematics: what a solve says is what forward kinematics finds, computed the other way.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod arms;
mod attitude_held;
mod closed_form;
mod damped_least_squares;

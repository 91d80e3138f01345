//! Contact against closed forms, laws and cases of others.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod bodies;
mod cases_of_others;
mod friction;
mod grasped;
mod impacts;
mod momentum;

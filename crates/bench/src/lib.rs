//! What is timed: the vehicles, their states, and the kernels over any scalar.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod kernels;
mod subjects;

pub use kernels::{BATCHES, KERNELS, Places, Quantity};
pub use subjects::{Moment, STATES, Subject, subject, widened};

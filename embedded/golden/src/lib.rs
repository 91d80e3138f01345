//! Golden control periods: the same source on the host and on the flight processor.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod atlas_class;
mod atlas_class_two_arms;
mod period;
mod random;
mod report;
mod run;

pub use period::{STATES, Start, Subject, numbers, one_arm, two_arms};
pub use report::{INSTRUCTIONS_PER_TICK, Machine};
pub use run::{Number, run};

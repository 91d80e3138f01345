//! What tests of several crates share.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod one_system;

pub use one_system::{OneSystem, OneSystemSetup};

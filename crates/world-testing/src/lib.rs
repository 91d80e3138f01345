//! What tests and measurements of the world share. It knows the world, so what flies must not know it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod one_system;

pub use one_system::{OneSystem, OneSystemSetup};

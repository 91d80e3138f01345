//! Steering laws against closed forms, laws and independent routes.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod gyros;
mod pulse_modulation;
mod thrusters;
mod wheels;

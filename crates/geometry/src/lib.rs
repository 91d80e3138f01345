//! Shapes of bodies: how far a point is from them, and where two of them meet.
//!
//! A shape stands about its own frame; where that frame is, the caller says. Distances are positive between
//! shapes that are apart and negative where they overlap; normals point out of the second shape, towards
//! the first.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod feeler;
mod patch;
mod profile;
mod shape;
mod surface;

pub use patch::{MOST_PLACES, Meeting, Patch};
pub use shape::Shape;
pub use surface::{Nearest, nearest};

//! Shapes of bodies: how far they are from each other, and where they meet.
//!
//! A shape stands about its own frame; where that frame is, the caller says. Distances are positive between
//! shapes that are apart and negative where they overlap; normals point out of the second shape, towards
//! the first.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod gap;
mod patch;
mod shape;
mod surface;

pub use gap::{Gap, gap};
pub use patch::{Meeting, Patch};
pub use shape::Shape;
pub use surface::{Nearest, nearest};

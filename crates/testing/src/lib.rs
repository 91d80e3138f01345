//! What tests of several crates share. It knows neither the world nor what flies: each may test with it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

pub mod arms;
mod counting_allocator;
mod numbers;
mod page;
pub mod random_robot;
mod worst;

pub use counting_allocator::{Counting, allocations};
pub use numbers::{Numbers, gap, gap_at, size};
pub use page::Page;
pub use worst::{Worst, larger, largest, smaller};

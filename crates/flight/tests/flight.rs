//! All tests of what flies, in one program: what they share is a module among others.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod allocation;
mod estimation;
mod inverse_kinematics;
mod laws;
mod robustness;
mod trajectory;

use wrasse_testing::Counting;

/// It counts for each thread alone, so that tests beside each other do not see each other's calls.
#[global_allocator]
static ALLOCATOR: Counting = Counting;

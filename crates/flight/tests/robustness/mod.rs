//! What must hold whatever comes in.

mod extreme_numbers;
mod no_allocation;

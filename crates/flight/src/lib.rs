//! What would fly: guidance, inverse kinematics, arm and attitude control. No heap, no `std`.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

pub mod trajectory;

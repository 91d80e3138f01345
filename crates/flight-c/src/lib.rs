//! The control period for flight software in C: plain structs in, plain structs out, no heap.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod robot_table;

pub use robot_table::{
    WrasseBody, WrasseFrame, WrasseJoint, WrasseLink, frame_from_table, robot_from_tables,
};

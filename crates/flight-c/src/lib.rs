//! The control period for flight software in C: plain structs in, plain structs out, no heap.
//!
//! `include/wrasse_flight.h` is made from this crate. The library for a target with an operating system
//! or without: `cargo rustc -p wrasse-flight-c --profile flight --crate-type staticlib --features
//! panic-handler`.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(non_camel_case_types, reason = "constants of an enum in C carry their prefix")]

mod boundary;
mod complaint;
mod fault;
mod laws_table;
#[cfg(feature = "panic-handler")]
mod panic_handler;
mod period_data;
mod robot_table;

pub use boundary::{
    WRASSE_FLIGHT_WORDS, WrasseFlight, wrasse_flight_period, wrasse_flight_set_up,
    wrasse_status_text,
};
pub use complaint::{WrasseComplaint, WrasseStatus};
pub use laws_table::{
    WRASSE_FEEDFORWARD_EXACT, WRASSE_FEEDFORWARD_NONE, WRASSE_LAW_ATTITUDE_HELD,
    WRASSE_LAW_FREE_FLOATING, WRASSE_LAW_TERRESTRIAL, WRASSE_MEASURE_BASE, WRASSE_MEASURE_NOTHING,
    WRASSE_TASK_POSE, WRASSE_TASK_POSITION, WrasseLaws,
};
pub use period_data::{
    WRASSE_AXES_BASE, WRASSE_AXES_INERTIAL, WRASSE_REFERENCE_COAST, WRASSE_REFERENCE_JOINTS,
    WRASSE_REFERENCE_STILL, WRASSE_REFERENCE_TOOL, WrasseArmReference, WrasseControlOutput,
    WrasseSensed,
};
pub use robot_table::{
    WRASSE_JOINTS, WrasseBody, WrasseFrame, WrasseJoint, WrasseLink, frame_from_table,
    robot_from_tables,
};

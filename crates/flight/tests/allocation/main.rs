//! Steering laws against closed forms, laws and independent routes.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

#[path = "../inverse_kinematics/arms.rs"]
#[allow(dead_code, reason = "the inverse kinematics asks more of the same arms")]
mod arms;
#[path = "../../../dynamics/tests/random_robot/mod.rs"]
#[allow(dead_code, reason = "the dynamics asks more of the same trees")]
mod random_robot;

mod allocator;
mod allocator_limits;
mod bench;
mod cmgs;
mod desaturation;
#[path = "../../../mission/tests/figures/mod.rs"]
mod figures;
mod momentum_error;
mod pulse_modulation;
mod thrusters;
mod unload_by_posture;
mod wheels;

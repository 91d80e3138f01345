//! The flight laws, each against a second route: forward dynamics, momentum summed over the bodies,
//! finite differences, closed forms.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

#[path = "../inverse_kinematics/arms.rs"]
#[allow(dead_code, reason = "the inverse kinematics asks more of the same arms")]
mod arms;
#[path = "../../../dynamics/tests/random_robot/mod.rs"]
#[allow(dead_code, reason = "the dynamics asks more of the same trees")]
mod random_robot;
#[path = "../spanning_states/mod.rs"]
#[allow(dead_code, reason = "the example asks more of the same states")]
mod spanning_states;

mod attitude_control;
mod checked_period;
mod computed_torque;
mod computer;
mod computer_outcomes;
mod control_period;
mod coupling_inertia;
mod dual_route;
mod feedforward;
mod flights;
mod postures;
mod resolved_motion;
mod singular_postures;
mod tool_pose;
mod tool_wrench;
mod worst;

//! The flight laws, each against a second route: forward dynamics, momentum summed over the bodies,
//! finite differences, closed forms.

mod attitude_control;
mod base_control;
mod checked_period;
mod computed_torque;
mod computer;
mod control_period;
mod coupling_inertia;
mod dual_route;
mod feedforward;
pub(crate) mod flights;
mod postures;
mod resolved_motion;
mod singular_postures;
mod spanning_states;
mod tool_pose;
mod tool_wrench;

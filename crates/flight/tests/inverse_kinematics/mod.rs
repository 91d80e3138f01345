//! Inverse kinematics: what a solve says is what forward kinematics finds, computed the other way.

mod attitude_held;
mod closed_form;
mod damped_least_squares;

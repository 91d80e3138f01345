//! Steering laws against closed forms, laws and independent routes.

mod allocator;
mod allocator_limits;
pub(crate) mod bench;
mod cmgs;
mod desaturation;
mod momentum_error;
mod published_programs;
mod pulse_modulation;
mod thrusters;
mod unload_by_posture;
mod wheels;

//! The flight computer on its way: set-points that join, beliefs that keep what their law keeps.

mod beliefs;
mod efforts;
mod outcomes;
mod set_points;
mod tours;

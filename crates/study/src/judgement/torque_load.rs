//! Torque that is asked for, over torque there is.

use crate::bounds::Bounds;
use crate::capability::Capability;
use crate::demand::Demand;
use wrasse_spatial::Vec3;

/// A reach along a vector; endless along none.
pub(super) fn along(v: Vec3<f64>, reach: impl Fn(Vec3<f64>) -> Bounds<f64>) -> Bounds<f64> {
    let size = v.norm();
    if size > 0.0 { reach(v * (1.0 / size)) } else { Bounds::equal(f64::INFINITY) }
}

/// Size over reach: nothing asks nothing, and what cannot be had is infinitely too much.
pub(super) fn load(v: Vec3<f64>, reach: impl Fn(Vec3<f64>) -> f64) -> f64 {
    let size = v.norm();
    if size > 0.0 { size / reach(v * (1.0 / size)) } else { 0.0 }
}

/// Largest torque of a demand over the torque there is with the gimbals at their best (–).
pub(super) fn torque_load(demand: &Demand, capability: &Capability) -> f64 {
    let loads = demand.torque_B.iter().map(|t| load(*t, |d| capability.torque_along(d).best));
    loads.fold(0.0, f64::max)
}

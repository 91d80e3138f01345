//! When a demand leaves the momentum envelope.

use super::bisection::bisect;
use crate::capability::Capability;
use crate::demand::Demand;
use crate::envelope::first_outside;
use wrasse_spatial::Vec3;

/// Longer than this (s) is never.
const LONGEST: f64 = 1e12;

/// Momentum gathered every second after the end of a task under load (N·m·s/s). A motion of the
/// vehicle's own ends at rest; a push from outside may go on.
pub(super) fn sustained_load(demand: &Demand, own_motion: bool) -> Option<Vec3<f64>> {
    if own_motion { None } else { demand.sustained() }
}

/// Time of saturation (s): when the demand leaves the momentum envelope, on and on under a
/// `sustained` load after its end (N·m·s/s). None if never.
pub(super) fn saturation_time(
    demand: &Demand,
    sustained: Option<Vec3<f64>>,
    capability: &Capability,
) -> Option<f64> {
    if capability.is_unbounded() {
        return None;
    }
    let envelope = &capability.momentum;
    let outside = first_outside(&demand.time, &demand.momentum_B, |h| envelope.load(h));
    outside.or_else(|| {
        let (rate, held) = (sustained?, *demand.momentum_B.last()?);
        let is_outside = |after: f64| envelope.load(held + rate * after) > 1.0;
        let mut after = 1.0;
        while !is_outside(after) {
            after *= 2.0;
            // NaN is never outside.
            if after > LONGEST {
                return None;
            }
        }
        Some(demand.time.last()? + bisect(0.0, after, is_outside))
    })
}

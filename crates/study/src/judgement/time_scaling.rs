//! Time scaling: by which factor a motion must be slower for a set to suffice.

use super::bisection::bisect;
use super::hybrid_split::HybridSplit;
use super::pseudo_inverse_run::PseudoInverseRun;
use super::saturation::saturation_time;
use crate::bounds::Bounds;
use crate::capability::Capability;
use crate::demand::Demand;

/// Slower than this is never.
const SLOWEST: f64 = 1e4;

/// The least factors by which a motion must be slower; none where no factor helps. `torque_load`: of the
/// motion as it is, with the best steering (–).
pub(super) fn time_scaling(
    torque_load: f64,
    demand: &Demand,
    capability: &Capability,
) -> Bounds<Option<f64>> {
    let best = with_best_steering(torque_load, demand, capability);
    let plain = best.and_then(|best| with_pseudo_inverse(best, demand, capability));
    Bounds { plain, best }
}

fn with_best_steering(torque_load: f64, demand: &Demand, capability: &Capability) -> Option<f64> {
    let momentum_load = if capability.is_unbounded() || capability.is_hybrid() {
        0.0
    } else {
        demand.momentum_B.iter().map(|h| capability.momentum.load(*h)).fold(0.0, f64::max)
    };
    let factor = torque_load.sqrt().max(momentum_load).max(1.0);
    if !capability.is_hybrid() {
        return (factor <= SLOWEST).then_some(factor);
    }
    // The slower, the more of it the couples take.
    least_factor(factor, |factor| {
        let slow = demand.time_scaled(factor);
        let stored = HybridSplit::of(&slow, true, capability).stored;
        saturation_time(&stored, None, capability).is_none()
    })
}

/// No less than with the best steering.
fn with_pseudo_inverse(best: f64, demand: &Demand, capability: &Capability) -> Option<f64> {
    if capability.cmgs.is_empty() {
        return Some(best);
    }
    least_factor(best, |factor| {
        let slow = demand.time_scaled(factor);
        let stored = HybridSplit::of(&slow, true, capability).stored;
        let run = PseudoInverseRun::follow(&slow, &stored, None, capability);
        run.saturates.is_none() && run.torque_load.is_none_or(|load| load <= 1.0)
    })
}

/// The least factor from `least` on that suffices, by bisection.
fn least_factor(least: f64, suffices: impl Fn(f64) -> bool) -> Option<f64> {
    if suffices(least) {
        return (least <= SLOWEST).then_some(least);
    }
    let mut factor = 2.0 * least;
    while !suffices(factor) {
        factor *= 2.0;
        if factor.is_nan() || factor > SLOWEST {
            return None;
        }
    }
    Some(bisect(0.5 * factor, factor, suffices))
}

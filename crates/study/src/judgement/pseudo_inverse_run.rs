//! CMGs steered by the pseudo-inverse along a demand: their load, and how far they get.

use super::torque_load::load;
use crate::capability::Capability;
use crate::demand::Demand;
use crate::envelope::{SteeringPath, steering_path, steering_reach};
use wrasse_spatial::Vec3;

/// What comes of pseudo-inverse steering along a demand.
pub(super) struct PseudoInverseRun {
    /// Largest torque over what the gimbals can give where they are then (–); none without CMGs.
    pub(super) torque_load: Option<f64>,
    /// Time of saturation (s): when the steering gets no further.
    pub(super) saturates: Option<f64>,
}

impl PseudoInverseRun {
    /// `stored`: what wheels and CMGs hold of the demand; `sustained`: the load after its end
    /// (N·m·s/s).
    pub(super) fn follow(
        demand: &Demand,
        stored: &Demand,
        sustained: Option<Vec3<f64>>,
        capability: &Capability,
    ) -> Self {
        let Capability { cmgs, gimbal_angle, .. } = capability;
        if cmgs.is_empty() {
            return Self { torque_load: None, saturates: None };
        }
        let path = steering_path(cmgs, gimbal_angle, &cmg_momentum(stored, capability));
        let asked = path.angles.iter().zip(&demand.torque_B);
        let loads =
            asked.map(|(angles, torque)| load(*torque, |d| capability.torque_at(angles, d)));
        let torque_load = Some(loads.fold(0.0, f64::max));
        Self { torque_load, saturates: saturation_time(demand, sustained, capability, &path) }
    }
}

/// Momentum that is left to the CMGs: wheels take what they can of the torque, until they are full.
fn cmg_momentum(stored: &Demand, capability: &Capability) -> Vec<Vec3<f64>> {
    let Capability { wheel_torque, wheel_momentum, .. } = capability;
    if wheel_momentum.is_empty() {
        return stored.momentum_B.clone();
    }
    let rest = stored.residual(|d| wheel_torque.radius(d));
    let both = stored.momentum_B.iter().zip(&rest.momentum_B);
    both.map(|(all, rest)| {
        let wheels = *all - *rest;
        *all - wheels * (1.0 / wheel_momentum.load(wheels).max(1.0))
    })
    .collect()
}

/// When steering along a path gets no further (s), on and on for a task that ends under load.
fn saturation_time(
    demand: &Demand,
    sustained: Option<Vec3<f64>>,
    capability: &Capability,
    path: &SteeringPath,
) -> Option<f64> {
    let count = path.angles.len();
    if let Some(share) = path.stopped {
        let to = demand.time[count];
        let from = count.checked_sub(1).map_or(to, |k| demand.time[k]);
        return Some(from + share * (to - from));
    }
    let (rate, angles) = (sustained?, path.angles.last()?);
    let left = steering_reach(&capability.cmgs, angles, rate * (1.0 / rate.norm())).momentum;
    Some(demand.time.last()? + left / rate.norm())
}

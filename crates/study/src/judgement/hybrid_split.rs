//! A demand split between thrusters and what stores momentum.

use super::saturation::{saturation_time, sustained_load};
use crate::capability::Capability;
use crate::demand::Demand;

/// The two parts of a demand.
pub(super) struct HybridSplit {
    /// What wheels and CMGs have to store.
    pub(super) stored: Demand,
    /// What thrusters have to give.
    pub(super) by_thrusters: Demand,
}

impl HybridSplit {
    /// Beside wheels and CMGs that hold all of the momentum, thrusters give what torque is missing. Else
    /// they take all that they can, and the others the rest.
    pub(super) fn of(demand: &Demand, own_motion: bool, capability: &Capability) -> Self {
        if !capability.is_hybrid() {
            return Self { stored: demand.clone(), by_thrusters: demand.clone() };
        }
        let sustained = sustained_load(demand, own_motion);
        if saturation_time(demand, sustained, capability).is_none() {
            let by_thrusters = demand.residual(|d| capability.torque.radius(d));
            return Self { stored: demand.clone(), by_thrusters };
        }
        let stored = demand.residual(|d| capability.couple(d));
        let torques = demand.torque_B.iter().zip(&stored.torque_B);
        let torque_B = torques.map(|(all, stored)| *all - *stored).collect();
        Self { stored, by_thrusters: Demand { torque_B, ..demand.clone() } }
    }
}

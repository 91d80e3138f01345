//! Propellant that thrusters take for a demand.

use crate::capability::Capability;
use crate::demand::Demand;
use crate::envelope::least_flow;
use wrasse_spatial::Vec3;

/// Propellant for the torque of a task (kg), and for the force that keeps the base in place if asked.
pub(super) fn fuel(demand: &Demand, capability: &Capability, in_place: bool) -> Option<f64> {
    let Capability { thrusters, p_BScm_B, .. } = capability;
    if thrusters.is_empty() {
        return None;
    }
    let flow = |(torque, force): (&Vec3<f64>, &Vec3<f64>)| {
        let force = if in_place { *force } else { Vec3::zero() };
        let couple = least_flow(thrusters, *p_BScm_B, *torque, Some(force));
        // A set that makes no couples turns the base with what force comes of it.
        let alone = || least_flow(thrusters, *p_BScm_B, *torque, None);
        if in_place { couple } else { couple.or_else(alone) }
    };
    let flows: Option<Vec<f64>> = demand.torque_B.iter().zip(&demand.force_B).map(flow).collect();
    let flows = flows?;
    let spans = demand.time.windows(2).zip(flows.windows(2));
    Some(spans.map(|(t, f)| 0.5 * (f[0] + f[1]) * (t[1] - t[0])).sum())
}

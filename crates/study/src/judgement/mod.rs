//! One task against one set of actuators: torque, momentum, time of saturation, time scaling, fuel.

mod bisection;
mod fuel;
mod hybrid_split;
mod pseudo_inverse_run;
mod saturation;
#[cfg(test)]
mod tests;
mod time_scaling;
mod torque_load;

use crate::bounds::Bounds;
use crate::capability::Capability;
use crate::demand::Demand;
use fuel::fuel;
use hybrid_split::HybridSplit;
use pseudo_inverse_run::PseudoInverseRun;
use saturation::{saturation_time, sustained_load};
use serde::Serialize;
use time_scaling::time_scaling;
use torque_load::{along, torque_load};

/// Whether a set suffices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// It does.
    Yes,
    /// Not ruled out, but needs steering that starts from good gimbal angles, or avoids or escapes
    /// singularities.
    WithSteering,
    /// It does not, whatever steers it.
    No,
}

impl Answer {
    /// From whether a set suffices with pseudo-inverse steering, and with the best.
    fn of(suffices: Bounds<bool>) -> Self {
        match suffices {
            Bounds { best: false, .. } => Self::No,
            Bounds { plain: false, .. } => Self::WithSteering,
            _ => Self::Yes,
        }
    }
}

/// How a task stands to a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// Whether the torque can be given.
    pub torque: Answer,
    /// Whether the momentum can be held while the task lasts.
    pub momentum: Answer,
    /// Whether the tank holds the propellant; yes if none is said to be needed, or no tank is given.
    pub propellant: Answer,
    /// Largest torque that is asked for, over what the set can give then (–).
    pub torque_load: Bounds<f64>,
    /// Torque that the set can give along the peak of the demand (N·m).
    pub torque_there: Bounds<f64>,
    /// Momentum that the set can hold along the peak of the demand (N·m·s).
    pub momentum_there: Bounds<f64>,
    /// Time of saturation (s), on and on for a task that ends under load.
    pub saturates: Bounds<Option<f64>>,
    /// Factor by which the task must be slower for the set to suffice; none for a task that is not the
    /// vehicle's own motion, or where no factor helps.
    pub time_scaling: Bounds<Option<f64>>,
    /// Propellant of the thrusters for the torque alone (kg).
    pub fuel: Option<f64>,
    /// Propellant of the thrusters for the torque and for the force that keeps the base in place (kg).
    pub fuel_in_place: Option<f64>,
}

/// How a demand stands to a set. `own_motion`: it comes from the vehicle's own motion, which can be done
/// more slowly.
pub fn judge(demand: &Demand, capability: &Capability, own_motion: bool) -> Judgement {
    let demand = demand.thinned();
    let HybridSplit { stored, by_thrusters } = HybridSplit::of(&demand, own_motion, capability);
    let sustained = sustained_load(&stored, own_motion);
    let run = PseudoInverseRun::follow(&demand, &stored, sustained, capability);
    let best = torque_load(&demand, capability);
    let torque_load = Bounds { plain: run.torque_load.unwrap_or(best), best };
    let best = saturation_time(&stored, sustained, capability);
    let no_cmgs = capability.cmgs.is_empty() || capability.is_unbounded();
    let saturates = Bounds { plain: if no_cmgs { best } else { run.saturates }, best };
    let end = demand.time.last().copied().unwrap_or_default();
    let fuel_alone = fuel(&by_thrusters, capability, false);
    let too_much = fuel_alone.zip(capability.propellant).is_some_and(|(fuel, tank)| fuel > tank);
    Judgement {
        torque: Answer::of(torque_load.map(|load| load <= 1.0)),
        momentum: Answer::of(saturates.map(|at| at.is_none_or(|at| at > end))),
        propellant: Answer::of(Bounds::equal(!too_much)),
        torque_load,
        torque_there: along(demand.peak_torque(), |d| capability.torque_along(d)),
        momentum_there: along(demand.peak_momentum(), |d| capability.momentum_along(d)),
        saturates,
        time_scaling: if own_motion {
            time_scaling(torque_load.best, &demand, capability)
        } else {
            Bounds::equal(None)
        },
        fuel: fuel_alone,
        fuel_in_place: fuel(&by_thrusters, capability, true),
    }
}

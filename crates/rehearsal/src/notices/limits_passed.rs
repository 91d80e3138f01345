//! Limits that the truth passed: travel, rate and effort of joints, and what a held attitude asks of
//! an actuator that is not simulated.

use crate::case::Case;
use crate::signals::CMG_SINGULARITY;
use crate::signals::observe::Observation;
use wrasse_world::BaseAttitude;

/// A limit that was passed: said once in each phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Passed {
    Travel(usize),
    Rate(usize),
    Effort(usize),
    HeldTorque(usize),
    HeldMomentum(usize),
    TorqueMissing,
    ForceMissing,
    Blinded,
    ReadingRefused,
    EstimatorRestarted,
    NoPostureUnloading,
    DeadBand,
    Singular,
}

/// A little more than round-off: what is kept to the last digit was not passed.
const SLACK: f64 = 1.0 + 1e-9;

/// det(A Aᵀ) (–) below which CMGs count as singular: the pyramid at zero angles has 1.33, a setting a few
/// degrees from a singular one less than this.
const SINGULAR: f64 = 0.01;

/// All limits that are passed now, each with a sentence.
pub(crate) fn limits_passed(case: &Case, seen: &Observation) -> Vec<(Passed, String)> {
    let mut passed = vec![];
    for (j, limits) in case.vehicle.limits.iter().enumerate() {
        let name = case.joint_name(j);
        let (q, v, effort) = (seen.state.q[j], seen.state.v[j], seen.dynamics.force.joints[j]);
        if let Some((lower, upper)) = limits.travel
            && !(lower - 1e-9..=upper + 1e-9).contains(&q)
        {
            let text = format!(
                "joint {name} beyond its travel: {}, from {} to {}",
                case.position_text(j, q),
                case.position_text(j, lower),
                case.position_text(j, upper)
            );
            passed.push((Passed::Travel(j), text));
        }
        if let Some(limit) = limits.rate.filter(|limit| v.abs() > limit * SLACK) {
            let (found, limit) = (case.rate_text(j, v), case.rate_text(j, limit));
            let text = format!("joint {name} faster than its limit of {limit}: {found}");
            passed.push((Passed::Rate(j), text));
        }
        if let Some(limit) = limits.effort.filter(|limit| effort.abs() > limit * SLACK) {
            let (found, limit) = (case.effort_text(j, effort), case.effort_text(j, limit));
            let text = format!("joint {name} needs more than its drive has: {found} of {limit}");
            passed.push((Passed::Effort(j), text));
        }
    }
    let distance = seen.values[CMG_SINGULARITY];
    if distance < SINGULAR {
        let text = format!(
            "the CMGs are all but singular, det(A Aᵀ) is {distance:.4}: torque about one axis takes high \
             gimbal rates or cannot be given"
        );
        passed.push((Passed::Singular, text));
    }
    let Some(actuator) = case.vehicle.attitude_actuator.filter(|_| case.base == BaseAttitude::Held)
    else {
        return passed;
    };
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let torque = seen.torque_B.to_array()[axis];
        if torque.abs() > actuator.torque_limit {
            let limit = actuator.torque_limit;
            let text = format!(
                "holding the attitude takes {torque:.3} N·m about {name}, the actuator has {limit} N·m"
            );
            passed.push((Passed::HeldTorque(axis), text));
        }
        let stored = seen.stored_B.to_array()[axis];
        if stored.abs() > actuator.momentum_limit {
            let limit = actuator.momentum_limit;
            let text = format!(
                "holding the attitude stores {stored:.3} N·m·s about {name}, the actuator holds {limit} \
                 N·m·s"
            );
            passed.push((Passed::HeldMomentum(axis), text));
        }
    }
    passed
}

//! What is asked of drives and actuators, whatever their limits leave of it. A use that saw only what was
//! given could never pass its limit, and no requirement of it could fail.

use crate::case::AttitudeActuation;
use crate::case::Case;
use crate::case_world::CaseWorld;
use crate::signals::observe::Observation;
use std::array::from_fn;
use wrasse_flight::Command;
use wrasse_hardware::{ActuatorReadings, CMGS};
use wrasse_spatial::Vec3;
use wrasse_vehicle::JOINTS;
use wrasse_world::BaseAttitude;

/// What is asked of the joints' drives and of whatever turns the base.
pub(crate) struct ActuatorDemand {
    /// Of each joint (N·m or N): what the law asks of a drive of torque; what it takes to move the
    /// others as they are moved.
    pub(crate) efforts: [f64; JOINTS],
    /// Of each joint (rad/s or m/s): what the way asks, or what the joint does where that is more.
    pub(crate) rates: [f64; JOINTS],
    /// Torque on the base that is asked for and not given (N·m, base axes).
    pub(crate) torque_cut_B: Vec3<f64>,
}

impl ActuatorDemand {
    pub(crate) fn of(
        case: &Case,
        command: &Command<f64, JOINTS>,
        world: &CaseWorld,
        seen: &Observation,
    ) -> Self {
        let (rates, flown) = (&seen.state.v, &seen.dynamics.force.joints);
        let set_points = &command.set_points;
        Self {
            efforts: from_fn(
                |j| if case.torque[j] { command.effort_commanded[j] } else { flown[j] },
            ),
            rates: from_fn(|j| larger(rates[j], set_points[j].rate / command.rate_share)),
            torque_cut_B: torque_cut(case, command, world),
        }
    }
}

fn torque_cut(case: &Case, command: &Command<f64, JOINTS>, world: &CaseWorld) -> Vec3<f64> {
    match case.actuation {
        AttitudeActuation::Fitted => command.allocation.missing.torque,
        AttitudeActuation::Ideal(_) if case.base == BaseAttitude::Controlled => {
            command.attitude_torque_B - world.actuator_torque_B()
        }
        AttitudeActuation::Ideal(_) => Vec3::zero(),
    }
}

/// Speed of each wheel (rad/s), or the one that it would have by now had it given what is missing about
/// its axis, where that is more; with the limit.
pub(crate) fn wheel_speeds(
    case: &Case,
    cut_B: Vec3<f64>,
    readings: &ActuatorReadings<f64>,
) -> impl Iterator<Item = (f64, f64)> {
    let period = case.period();
    let each = case.equipment.actuators.wheels.iter().zip(readings.wheel_speed);
    each.map(move |(wheel, speed)| {
        // The bodies feel the opposite of what the wheel takes up.
        let asked = speed - wheel.axis_B.dot(cut_B) * period / wheel.inertia;
        (larger(speed, asked), wheel.speed_limit)
    })
}

/// Rate of each gimbal (rad/s): the one that it is told and what its CMG would have to add to give what
/// is missing about its torque axis, or the one that it has where that is more; with the limit.
pub(crate) fn gimbal_rates(
    case: &Case,
    command: &Command<f64, JOINTS>,
    cut_B: Vec3<f64>,
    readings: &ActuatorReadings<f64>,
) -> impl Iterator<Item = (f64, f64)> {
    let (told, angles, rates) =
        (command.actuators.gimbal_rate, readings.gimbal_angle, readings.gimbal_rate);
    case.equipment.actuators.cmgs.iter().enumerate().take(CMGS).map(move |(i, cmg)| {
        let asked = told[i] - cmg.torque_axis(angles[i]).dot(cut_B) / cmg.momentum;
        (larger(rates[i], asked), cmg.rate_limit)
    })
}

/// The one that is farther from zero; what is not a number is farthest.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a.abs() >= b.abs() { a } else { b }
}

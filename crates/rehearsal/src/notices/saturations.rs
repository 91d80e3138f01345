//! Limits that cut commands: said when it begins and, for wheels, CMGs and thrusters, summed up at
//! the end.

use crate::case::Case;
use wrasse_flight::Command;
use wrasse_hardware::{ActuatorReadings, Actuators};
use wrasse_vehicle::{Equipment, JOINTS};
use wrasse_world::Saturation;

/// Torque (N·m) or force (N), and share of what is wanted, above which what is missing is told.
pub(crate) const MISSED: f64 = 0.01;

/// What is said of missing torque.
const UNGIVEN: &str = "the actuators could not give all of the torque that was wanted";

/// How long a limit was met, and what that did.
#[derive(Debug, Clone, Copy)]
struct Met {
    /// `None`: torque was missing, whatever was at its limit.
    limit: Option<Saturation>,
    first: f64,
    periods: u32,
    /// Largest torque that was missing meanwhile (N·m), largest turn of the base (rad).
    missing: f64,
    turned: f64,
}

/// Limits of the equipment that were met in a flight.
#[derive(Debug, Default)]
pub(crate) struct EquipmentLimits {
    met: Vec<Met>,
}

impl EquipmentLimits {
    /// Note a period that begins at `time` (s) in which these limits were met, while `missing` (N·m) of
    /// the wanted torque was missing and the base stood `turned` (rad) from where it began.
    pub(crate) fn note(&mut self, cut: &[Saturation], time: f64, missing: f64, turned: f64) {
        let limits = cut.iter().copied().filter(|limit| is_of_equipment(*limit)).map(Some);
        for limit in limits.chain((missing > MISSED).then_some(None)) {
            let at = self.met.iter().position(|met| met.limit == limit).unwrap_or_else(|| {
                let met = Met { limit, first: time, periods: 0, missing: 0.0, turned: 0.0 };
                self.met.push(met);
                self.met.len() - 1
            });
            let met = &mut self.met[at];
            met.periods += 1;
            met.missing = met.missing.max(missing);
            met.turned = met.turned.max(turned);
        }
    }

    /// One sentence for each limit that was met.
    pub(crate) fn summary(&self, case: &Case) -> Vec<String> {
        let each = self.met.iter().map(|met| {
            format!(
                "in all {:.2} s, the first time at {:.2} s: {}; meanwhile up to {:.3} N·m of the wanted \
                 torque was missing, and the base stood up to {:.3} deg off",
                f64::from(met.periods) * case.period(),
                met.first,
                met.limit.map_or(UNGIVEN.into(), |limit| describe(case, limit)),
                met.missing,
                met.turned.to_degrees()
            )
        });
        each.collect()
    }
}

/// Units that the steering itself keeps at their limits in this command, while torque is missing.
pub(crate) fn at_limits(
    case: &Case,
    command: &Command<f64, JOINTS>,
    readings: &ActuatorReadings<f64>,
) -> Vec<Saturation> {
    let Actuators { wheels, cmgs, .. } = &case.equipment.actuators;
    let told = &command.actuators;
    let mut met = vec![];
    if command.allocation.missing.torque.norm() <= 1e-9 {
        return met;
    }
    for (i, wheel) in wheels.iter().enumerate() {
        if told.wheel_torque[i].abs() >= wheel.torque_limit * NEARLY {
            met.push(Saturation::WheelTorque(i));
        }
        // The steering brings a wheel to its limit within a period, and no further.
        let speed = readings.wheel_speed[i];
        let ends = speed + told.wheel_torque[i] * case.period() / wheel.inertia;
        if speed.abs().max(ends.abs()) >= wheel.speed_limit * NEARLY {
            met.push(Saturation::WheelSpeed(i));
        }
    }
    for (i, cmg) in cmgs.iter().enumerate() {
        if told.gimbal_rate[i].abs() >= cmg.rate_limit * NEARLY {
            met.push(Saturation::GimbalRate(i));
        }
    }
    met
}

/// Share of a limit from which on it counts as met.
const NEARLY: f64 = 1.0 - 1e-6;

/// Whether a limit is one of wheels, CMGs or thrusters.
fn is_of_equipment(limit: Saturation) -> bool {
    !matches!(
        limit,
        Saturation::JointEffort(_)
            | Saturation::ActuatorTorque(_)
            | Saturation::ActuatorMomentum(_)
    )
}

/// A limit in words.
pub(crate) fn describe(case: &Case, limit: Saturation) -> String {
    let axis = |i: usize| ["x", "y", "z"][i.min(2)];
    let ideal = case.vehicle.attitude_actuator;
    match limit {
        Saturation::JointEffort(j) => {
            let limit = case.effort_text(j, case.vehicle.limits[j].effort.unwrap_or(f64::NAN));
            format!("drive of joint {} at its limit of {limit}", case.joint_name(j))
        }
        Saturation::ActuatorTorque(i) => {
            let limit = ideal.map_or(f64::NAN, |a| a.torque_limit);
            format!("attitude actuator at its torque limit of {limit} N·m about {}", axis(i))
        }
        Saturation::ActuatorMomentum(i) => {
            let limit = ideal.map_or(f64::NAN, |a| a.momentum_limit);
            format!("attitude actuator full: {limit} N·m·s about {}", axis(i))
        }
        of_equipment => describe_unit(&case.equipment, of_equipment),
    }
}

/// A limit of a wheel, CMG or thruster in words.
fn describe_unit(equipment: &Equipment, limit: Saturation) -> String {
    let Equipment { actuators, wheel_names, cmg_names, thruster_names, .. } = equipment;
    let name = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
    let per_minute = |w: f64| w * 30.0 / std::f64::consts::PI;
    match limit {
        Saturation::WheelTorque(i) => format!(
            "wheel {} at its torque limit of {:.4} N·m",
            name(wheel_names, i),
            actuators.wheels[i].torque_limit
        ),
        Saturation::WheelSpeed(i) => format!(
            "wheel {} at its speed limit of {:.0} rpm: it takes up no more momentum",
            name(wheel_names, i),
            per_minute(actuators.wheels[i].speed_limit)
        ),
        Saturation::GimbalRate(i) => format!(
            "CMG {} at its gimbal rate limit of {:.2} deg/s",
            name(cmg_names, i),
            actuators.cmgs[i].rate_limit.to_degrees()
        ),
        Saturation::GimbalMotor(i) => format!(
            "CMG {} at the limit of its gimbal motor, {:.3} N·m",
            name(cmg_names, i),
            actuators.cmgs[i].motor_limit
        ),
        Saturation::PulseTooShort(i) => format!(
            "thruster {} was told to open for less than {:.3} s and stayed shut",
            name(thruster_names, i),
            actuators.thrusters[i].minimum_on_time
        ),
        Saturation::TankEmpty => "the tank is empty: thrusters give nothing".into(),
        other => format!("{other:?}"),
    }
}

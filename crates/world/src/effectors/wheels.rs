//! Reaction wheels as they behave.
//!
//! The state of a wheel is its momentum about its own axis as seen from inertial space,
//! `h = J (Ω + a·w)`: it changes only by what motor and bearing give, however the base turns. Its
//! inertia about its axis is therefore not part of the base's.

use super::{Effector, Load, MotorTorques, PeriodCommand, Stage};
use crate::command::Saturation;
use crate::failure::Failure;
use crate::source::Source;
use wrasse_dynamics::MassProperties;
use wrasse_hardware::{ActuatorReadings, List, ReactionWheel, WHEELS};
use wrasse_spatial::{SpatialInertia, Sym3, Vec3};

/// Speed at which Coulomb friction has 0.7 of its value (rad/s). Below it falls evenly to none at rest,
/// so that a wheel can pass through rest without a jump that no step resolves.
const FRICTION_FADES_BELOW: f64 = 0.5;

/// The wheels of the base.
#[derive(Debug, Clone)]
pub(crate) struct Wheels {
    list: List<ReactionWheel<f64>, WHEELS>,
    /// What each motor gives in this period (N·m).
    motor: [f64; WHEELS],
    dead: [bool; WHEELS],
}

impl Wheels {
    pub(crate) fn new(list: &List<ReactionWheel<f64>, WHEELS>) -> Self {
        Self { list: *list, motor: [0.0; WHEELS], dead: [false; WHEELS] }
    }
    /// Momentum about its axis (N·m·s) of each wheel at a speed against the base (rad/s).
    pub(crate) fn momenta<'a>(
        &'a self,
        speed: &'a [f64; WHEELS],
        w_NB_B: Vec3<f64>,
    ) -> impl Iterator<Item = f64> + 'a {
        let each = self.list.iter().zip(speed);
        each.map(move |(wheel, speed)| wheel.inertia * (speed + wheel.axis_B.dot(w_NB_B)))
    }
    /// Each wheel with its momentum (N·m·s) and its speed against the base (rad/s).
    fn each<'a>(
        &'a self,
        own: &'a [f64],
        w_NB_B: Vec3<f64>,
    ) -> impl Iterator<Item = (usize, &'a ReactionWheel<f64>, f64, f64)> + 'a {
        self.list.iter().zip(own).enumerate().map(move |(i, (wheel, &h))| {
            (i, wheel, h, h / wheel.inertia - wheel.axis_B.dot(w_NB_B))
        })
    }
    /// Set the motor of a wheel that turns at a speed (rad/s) for a period (s), within what it can. What
    /// is not a number asks for nothing.
    fn set_motor(
        &mut self,
        i: usize,
        (wanted, speed): (f64, f64),
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        let wheel = &self.list[i];
        let wanted = if wanted.is_nan() { 0.0 } else { wanted };
        let rounded = match wheel.torque_step {
            step if step > 0.0 => (wanted / step).round() * step,
            _ => wanted,
        };
        let torque = rounded.max(-wheel.torque_limit).min(wheel.torque_limit);
        if torque != rounded {
            cut.push(Saturation::WheelTorque(i));
        }
        // It may reach ± its limit, not pass it. Friction is counted as it is now, the turn of the
        // base not at all: what is too much by that is braked in the next period.
        let drag = friction(wheel, speed);
        let lowest = drag - (wheel.speed_limit + speed) * wheel.inertia / period;
        let highest = drag + (wheel.speed_limit - speed) * wheel.inertia / period;
        let held = torque.max(lowest).min(highest);
        self.motor[i] = held.max(-wheel.torque_limit).min(wheel.torque_limit);
        if self.motor[i] != torque {
            cut.push(Saturation::WheelSpeed(i));
        }
    }
}

impl<const J: usize> Effector<J> for Wheels {
    fn source(&self) -> Source {
        Source::Wheels
    }
    /// Momentum of each about its own axis, as seen from inertial space (N·m·s).
    fn variables(&self) -> Vec<String> {
        (0..self.list.len()).map(|i| format!("momentum of wheel {i}")).collect()
    }
    /// What they hold turns with the base: the bodies feel `-ḣ - w × h`.
    fn act(&self, at: &Stage<'_, J>, own: &[f64], load: &mut Load<'_, J>, rates: &mut [f64]) {
        let w = at.state.V_NB_B.angular;
        for (i, wheel, h, speed) in self.each(own, w) {
            rates[i] = self.motor[i] - friction(wheel, speed);
            load.internal_B -= wheel.axis_B * rates[i] + w.cross(wheel.axis_B * h);
        }
    }
    fn stored_momentum_B(&self, own: &[f64], each: &mut dyn FnMut(Vec3<f64>)) {
        self.list.iter().zip(own).for_each(|(wheel, &h)| each(wheel.axis_B * h));
    }
    /// What the base lacks where the wheels count for themselves: their inertia about their axes.
    fn mass_properties(&self) -> Option<MassProperties<f64>> {
        let taken = self.list.iter().fold(Sym3::zero(), |sum, wheel| {
            let a = wheel.axis_B;
            sum - Sym3::symmetric_part(&a.outer(a)).scaled(wheel.inertia)
        });
        let M_F_F = SpatialInertia { rotational: taken, ..SpatialInertia::zero() };
        Some(MassProperties { M_F_F, I_parts_F: taken })
    }
    fn command(&mut self, told: &PeriodCommand<'_>, own: &[f64], cut: &mut Vec<Saturation>) {
        for i in 0..self.list.len() {
            if self.dead[i] {
                continue;
            }
            let wheel = &self.list[i];
            let speed = own[i] / wheel.inertia - wheel.axis_B.dot(told.w_NB_B);
            self.set_motor(i, (told.actuators.wheel_torque[i], speed), told.period, cut);
        }
    }
    fn read(&self, own: &[f64], w_NB_B: Vec3<f64>, readings: &mut ActuatorReadings<f64>) {
        self.each(own, w_NB_B).for_each(|(i, _, _, speed)| readings.wheel_speed[i] = speed);
    }
    fn motor_torques(&self, _: &[f64], _: (Vec3<f64>, Vec3<f64>), motors: &mut MotorTorques) {
        (0..self.list.len()).for_each(|i| motors.wheel[i] = self.motor[i]);
    }
    /// The motor of a wheel gives nothing from now on.
    fn fail(&mut self, failure: Failure, _own: &mut [f64]) -> Option<Vec3<f64>> {
        if let Failure::Wheel(i) = failure
            && i < self.list.len()
        {
            (self.dead[i], self.motor[i]) = (true, 0.0);
        }
        None
    }
}

/// Torque that the bearing takes from a wheel at a speed (N·m).
fn friction(wheel: &ReactionWheel<f64>, speed: f64) -> f64 {
    let whole = libm::sqrt(speed * speed + FRICTION_FADES_BELOW * FRICTION_FADES_BELOW);
    wheel.coulomb * (speed / whole) + wheel.viscous * speed
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_hardware::ActuatorCommand;
    use wrasse_spatial::vec3;

    /// Against the largest negative torque, which a clamp makes of it; the wheel beside it goes on.
    #[test]
    fn a_torque_that_is_not_a_number_is_none_and_leaves_the_other_wheels_alone() {
        let wheel = ReactionWheel {
            axis_B: vec3(1.0, 0.0, 0.0),
            inertia: 0.1,
            torque_limit: 0.2,
            speed_limit: 600.0,
            ..Default::default()
        };
        for torque_step in [0.0, 0.01] {
            let mut wheels = Wheels::new(&List::new(&[ReactionWheel { torque_step, ..wheel }; 2]));
            let (mut actuators, mut cut) = (ActuatorCommand::default(), vec![]);
            (actuators.wheel_torque[0], actuators.wheel_torque[1]) = (f64::NAN, 0.1);
            let (w_NB_B, is_fed) = (Vec3::zero(), false);
            let told =
                PeriodCommand { actuators: &actuators, w_NB_B, gone: 0.0, period: 0.1, is_fed };
            Effector::<1>::command(&mut wheels, &told, &[0.0; 2], &mut cut);
            assert_eq!(wheels.motor[0], 0.0);
            assert!((wheels.motor[1] - 0.1).abs() < 1e-16, "{}", wheels.motor[1]);
            assert!(cut.is_empty(), "{cut:?}");
        }
    }
}

//! Single-gimbal control moment gyros as they behave.
//!
//! Rotor and gimbal are part of the base's matter, in the base's inertia; what is counted here is
//! what they have beside it: the rotor's momentum along its spin axis, and that of the turning gimbal
//! along the gimbal axis. Rotor and gimbal count as round about the gimbal axis, so that turning the
//! gimbal does not change the inertia of the base.

use super::{Effector, Load, MotorTorques, PeriodCommand, Stage};
use crate::command::Saturation;
use crate::failure::Failure;
use crate::source::Source;
use wrasse_hardware::{ActuatorReadings, CMGS, ControlMomentGyro, List};
use wrasse_spatial::Vec3;

/// The control moment gyros of the base.
#[derive(Debug, Clone)]
pub(crate) struct Cmgs {
    list: List<ControlMomentGyro<f64>, CMGS>,
    /// Rate that each gimbal should have in this period (rad/s).
    wanted: [f64; CMGS],
    /// Torque that each motor would need to do as it is told as the period begins (N·m).
    needed: [f64; CMGS],
    stuck: [bool; CMGS],
}

impl Cmgs {
    pub(crate) fn new(list: &List<ControlMomentGyro<f64>, CMGS>) -> Self {
        Self { list: *list, wanted: [0.0; CMGS], needed: [0.0; CMGS], stuck: [false; CMGS] }
    }
    /// Angles (rad) and rates (rad/s) of the gimbals.
    fn split<'a>(&self, own: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        own.split_at(self.list.len().min(own.len()))
    }
    /// Each CMG with angle and rate of its gimbal.
    fn each<'a>(
        &'a self,
        own: &'a [f64],
    ) -> impl Iterator<Item = (usize, &'a ControlMomentGyro<f64>, f64, f64)> + 'a {
        let (angles, rates) = self.split(own);
        let all = self.list.iter().zip(angles).zip(rates).enumerate();
        all.map(|(i, ((cmg, &angle), &rate))| (i, cmg, angle, rate))
    }
    /// Acceleration of a gimbal against the base (rad/s²): what its servo wants, as far as its motor
    /// can. The base's own angular acceleration is left out of what the motor can: it is a thousandth
    /// of the gimbal's.
    fn acceleration(&self, i: usize, (angle, rate): (f64, f64), w_NB_B: Vec3<f64>) -> f64 {
        if self.stuck[i] {
            return 0.0;
        }
        let cmg = &self.list[i];
        let load = load(cmg, angle, w_NB_B);
        let lowest = (-cmg.motor_limit - load) / cmg.gimbal_inertia;
        let highest = (cmg.motor_limit - load) / cmg.gimbal_inertia;
        self.servo(i, rate).max(lowest).min(highest)
    }
    /// What the servo asks of a gimbal (rad/s²).
    fn servo(&self, i: usize, rate: f64) -> f64 {
        if self.stuck[i] {
            return 0.0;
        }
        let cmg = &self.list[i];
        let wanted = cmg.servo_bandwidth * (self.wanted[i] - rate);
        wanted.max(-cmg.acceleration_limit).min(cmg.acceleration_limit)
    }
}

impl<const J: usize> Effector<J> for Cmgs {
    fn source(&self) -> Source {
        Source::Cmgs
    }
    /// Angle of each gimbal (rad), then their rates (rad/s).
    fn variables(&self) -> Vec<String> {
        let all = 0..self.list.len();
        let angles = all.clone().map(|i| format!("angle of gimbal {i}"));
        angles.chain(all.map(|i| format!("rate of gimbal {i}"))).collect()
    }
    /// What they hold turns with the base: the bodies feel `-ḣ - w × h`.
    fn act(&self, at: &Stage<'_, J>, own: &[f64], load: &mut Load<'_, J>, rates: &mut [f64]) {
        let (w, n) = (at.state.V_NB_B.angular, self.list.len());
        for (i, cmg, angle, rate) in self.each(own) {
            let acceleration = self.acceleration(i, (angle, rate), w);
            (rates[i], rates[n + i]) = (rate, acceleration);
            let change = cmg.torque_axis(angle) * (cmg.momentum * rate)
                + cmg.gimbal_axis_B * (cmg.gimbal_inertia * acceleration);
            load.internal_B -= change + w.cross(momentum_B(cmg, angle, rate));
        }
    }
    fn stored_momentum_B(&self, own: &[f64], each: &mut dyn FnMut(Vec3<f64>)) {
        self.each(own).for_each(|(_, cmg, angle, rate)| each(momentum_B(cmg, angle, rate)));
    }
    /// The rates of the gimbals for a period, each within its limit, and whose motor cannot follow. What
    /// is not a number asks for none.
    fn command(&mut self, told: &PeriodCommand<'_>, own: &[f64], cut: &mut Vec<Saturation>) {
        for (i, cmg) in self.list.iter().enumerate() {
            let wanted = told.actuators.gimbal_rate[i];
            let wanted = if wanted.is_nan() { 0.0 } else { wanted };
            self.wanted[i] = wanted.max(-cmg.rate_limit).min(cmg.rate_limit);
            if self.wanted[i] != wanted && !self.stuck[i] {
                cut.push(Saturation::GimbalRate(i));
            }
        }
        let mut needed = [0.0; CMGS];
        for (i, cmg, angle, rate) in self.each(own) {
            let servo = self.servo(i, rate);
            if self.acceleration(i, (angle, rate), told.w_NB_B) != servo {
                cut.push(Saturation::GimbalMotor(i));
            }
            if !self.stuck[i] {
                needed[i] = cmg.gimbal_inertia * servo + load(cmg, angle, told.w_NB_B);
            }
        }
        self.needed = needed;
    }
    fn read(&self, own: &[f64], _w_NB_B: Vec3<f64>, readings: &mut ActuatorReadings<f64>) {
        for (i, _, angle, rate) in self.each(own) {
            (readings.gimbal_angle[i], readings.gimbal_rate[i]) = (angle, rate);
        }
    }
    /// Torque of each gimbal's motor: `I (δ̈ + g·ẇ) + g·(w × h s)`. None where it is stuck.
    fn motor_torques(
        &self,
        own: &[f64],
        (w_NB_B, wdot_NB_B): (Vec3<f64>, Vec3<f64>),
        motors: &mut MotorTorques,
    ) {
        motors.gimbal_needed = self.needed;
        for (i, cmg, angle, rate) in self.each(own).filter(|(i, ..)| !self.stuck[*i]) {
            let acceleration = self.acceleration(i, (angle, rate), w_NB_B);
            let turned = acceleration + cmg.gimbal_axis_B.dot(wdot_NB_B);
            motors.gimbal[i] = cmg.gimbal_inertia * turned + load(cmg, angle, w_NB_B);
        }
    }
    /// A gimbal stands still from now on: the impulse of its jam is what it had.
    fn fail(&mut self, failure: Failure, own: &mut [f64]) -> Option<Vec3<f64>> {
        let Failure::Gimbal(i) = failure else { return None };
        let n = self.list.len();
        if i >= n {
            return None;
        }
        self.stuck[i] = true;
        let rate = std::mem::take(&mut own[n + i]);
        Some(self.list[i].gimbal_axis_B * (self.list[i].gimbal_inertia * rate))
    }
}

/// Momentum of a CMG beside the base's, base axes (N·m·s): `h s(δ) + I δ̇ g`.
fn momentum_B(cmg: &ControlMomentGyro<f64>, angle: f64, rate: f64) -> Vec3<f64> {
    cmg.spin_axis(angle) * cmg.momentum + cmg.gimbal_axis_B * (cmg.gimbal_inertia * rate)
}

/// Torque (N·m) by which the motor carries the rotor along with a base that turns: `g·(w × h s)`.
fn load(cmg: &ControlMomentGyro<f64>, angle: f64, w_NB_B: Vec3<f64>) -> f64 {
    cmg.gimbal_axis_B.dot(w_NB_B.cross(cmg.spin_axis(angle))) * cmg.momentum
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_hardware::ActuatorCommand;
    use wrasse_spatial::vec3;

    /// Against the largest negative rate, which a clamp makes of it; the gimbal beside it goes on.
    #[test]
    fn a_rate_that_is_not_a_number_is_none_and_leaves_the_other_gimbals_alone() {
        let cmg = ControlMomentGyro {
            gimbal_axis_B: vec3(0.0, 0.0, 1.0),
            spin_axis_B: vec3(1.0, 0.0, 0.0),
            momentum: 10.0,
            rate_limit: 1.0,
            acceleration_limit: 10.0,
            servo_bandwidth: 50.0,
            motor_limit: 20.0,
            gimbal_inertia: 0.1,
        };
        let mut cmgs = Cmgs::new(&List::new(&[cmg; 2]));
        let (mut actuators, mut cut) = (ActuatorCommand::default(), vec![]);
        (actuators.gimbal_rate[0], actuators.gimbal_rate[1]) = (f64::NAN, 0.1);
        let (w_NB_B, is_fed) = (Vec3::zero(), false);
        let told = PeriodCommand { actuators: &actuators, w_NB_B, gone: 0.0, period: 0.1, is_fed };
        Effector::<1>::command(&mut cmgs, &told, &[0.0; 4], &mut cut);
        assert_eq!(cmgs.wanted[..2], [0.0, 0.1]);
        assert!(cut.is_empty(), "{cut:?}");
    }
}

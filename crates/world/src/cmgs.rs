//! Single-gimbal control moment gyros as they behave.
//!
//! Rotor and gimbal are part of the base's matter, in the base's inertia; what is counted here is
//! what they have beside it: the rotor's momentum along its spin axis, and that of the turning gimbal
//! along the gimbal axis. Rotor and gimbal count as round about the gimbal axis, so that turning the
//! gimbal does not change the inertia of the base.

use crate::command::Saturation;
use wrasse_hardware::{CMGS, ControlMomentGyro, List};
use wrasse_spatial::Vec3;

/// The CMGs of the base.
#[derive(Debug, Clone)]
pub(crate) struct Cmgs {
    list: List<ControlMomentGyro<f64>, CMGS>,
    /// Rate that each gimbal should have in this period (rad/s).
    wanted: [f64; CMGS],
    /// Torque that each motor would need to do as it is told as the period begins (N·m).
    motor_asked: [f64; CMGS],
    stuck: [bool; CMGS],
}

impl Cmgs {
    pub(crate) fn new(list: &List<ControlMomentGyro<f64>, CMGS>) -> Self {
        Self { list: *list, wanted: [0.0; CMGS], motor_asked: [0.0; CMGS], stuck: [false; CMGS] }
    }
    pub(crate) fn count(&self) -> usize {
        self.list.len()
    }
    /// Momentum of each CMG beside the base's, base axes (N·m·s): `h s(δ) + I δ̇ g`.
    pub(crate) fn apart_B(
        &self,
        angle: [f64; CMGS],
        rate: [f64; CMGS],
    ) -> impl Iterator<Item = Vec3<f64>> {
        self.list.iter().zip(angle).zip(rate).map(|((cmg, angle), rate)| {
            cmg.spin_axis(angle) * cmg.momentum + cmg.gimbal_axis_B * (cmg.gimbal_inertia * rate)
        })
    }
    /// Momentum of all together, base axes (N·m·s).
    pub(crate) fn together_B(&self, angle: [f64; CMGS], rate: [f64; CMGS]) -> Vec3<f64> {
        self.apart_B(angle, rate).fold(Vec3::zero(), |sum, h| sum + h)
    }
    /// How fast that changes as seen from the base (N·m).
    pub(crate) fn change_B(
        &self,
        angle: [f64; CMGS],
        rate: [f64; CMGS],
        acceleration: &[f64; CMGS],
    ) -> Vec3<f64> {
        let mut change = Vec3::zero();
        for (i, cmg) in self.list.iter().enumerate() {
            change += cmg.torque_axis(angle[i]) * (cmg.momentum * rate[i])
                + cmg.gimbal_axis_B * (cmg.gimbal_inertia * acceleration[i]);
        }
        change
    }
    /// Acceleration of each gimbal against the base (rad/s²): what its servo wants, as far as its
    /// motor can. The base's own angular acceleration is left out of what the motor can: it is a
    /// thousandth of the gimbal's.
    pub(crate) fn accelerations(
        &self,
        angle: &[f64; CMGS],
        rate: &[f64; CMGS],
        w_NB_B: Vec3<f64>,
    ) -> [f64; CMGS] {
        self.each(|i, cmg| {
            let load = load(cmg, angle[i], w_NB_B);
            let lowest = (-cmg.motor_limit - load) / cmg.gimbal_inertia;
            let highest = (cmg.motor_limit - load) / cmg.gimbal_inertia;
            self.servo(i, cmg, rate[i]).max(lowest).min(highest)
        })
    }
    /// Torque of each gimbal's motor (N·m): `I (δ̈ + g·ẇ) + g·(w × h s)`. None where it is stuck.
    pub(crate) fn motor_torques(
        &self,
        angle: &[f64; CMGS],
        acceleration: &[f64; CMGS],
        w_NB_B: Vec3<f64>,
        wdot_NB_B: Vec3<f64>,
    ) -> [f64; CMGS] {
        self.each(|i, cmg| {
            let turned = acceleration[i] + cmg.gimbal_axis_B.dot(wdot_NB_B);
            cmg.gimbal_inertia * turned + load(cmg, angle[i], w_NB_B)
        })
    }
    /// Set the rates for a period, each within its limit; say whose motor cannot follow. What is not a
    /// number asks for none.
    pub(crate) fn command(
        &mut self,
        wanted: &[f64; CMGS],
        angle: &[f64; CMGS],
        rate: &[f64; CMGS],
        w_NB_B: Vec3<f64>,
        cut: &mut Vec<Saturation>,
    ) {
        for (i, cmg) in self.list.iter().enumerate() {
            let wanted = if wanted[i].is_nan() { 0.0 } else { wanted[i] };
            self.wanted[i] = wanted.max(-cmg.rate_limit).min(cmg.rate_limit);
            if self.wanted[i] != wanted && !self.stuck[i] {
                cut.push(Saturation::GimbalRate(i));
            }
        }
        let found = self.accelerations(angle, rate, w_NB_B);
        let servo = self.each(|i, cmg| self.servo(i, cmg, rate[i]));
        let behind = (0..self.list.len()).filter(|&i| found[i] != servo[i]);
        cut.extend(behind.map(Saturation::GimbalMotor));
        self.motor_asked =
            self.each(|i, cmg| cmg.gimbal_inertia * servo[i] + load(cmg, angle[i], w_NB_B));
    }
    /// Torque that each motor would need to do as it was told (N·m), whatever it can give, as the period
    /// began; the base's own angular acceleration is left out.
    pub(crate) fn motor_asked(&self) -> [f64; CMGS] {
        self.motor_asked
    }
    /// A gimbal stands still from now on; the angular impulse that its jam gives the base at the rate
    /// that it had, base axes (N·m·s).
    pub(crate) fn jam(&mut self, i: usize, rate: f64) -> Vec3<f64> {
        self.stuck[i] = true;
        self.list[i].gimbal_axis_B * (self.list[i].gimbal_inertia * rate)
    }
    /// What the servo asks of a gimbal (rad/s²).
    fn servo(&self, i: usize, cmg: &ControlMomentGyro<f64>, rate: f64) -> f64 {
        let wanted = cmg.servo_bandwidth * (self.wanted[i] - rate);
        wanted.max(-cmg.acceleration_limit).min(cmg.acceleration_limit)
    }
    /// Something of each gimbal that is not stuck.
    fn each(&self, f: impl Fn(usize, &ControlMomentGyro<f64>) -> f64) -> [f64; CMGS] {
        let mut all = [0.0; CMGS];
        for (i, cmg) in self.list.iter().enumerate().filter(|(i, _)| !self.stuck[*i]) {
            all[i] = f(i, cmg);
        }
        all
    }
}

/// Torque (N·m) by which the motor carries the rotor along with a base that turns: `g·(w × h s)`.
fn load(cmg: &ControlMomentGyro<f64>, angle: f64, w_NB_B: Vec3<f64>) -> f64 {
    cmg.gimbal_axis_B.dot(w_NB_B.cross(cmg.spin_axis(angle))) * cmg.momentum
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let (mut wanted, mut cut) = ([0.0; CMGS], vec![]);
        (wanted[0], wanted[1]) = (f64::NAN, 0.1);
        let still = [0.0; CMGS];
        cmgs.command(&wanted, &still, &still, Vec3::zero(), &mut cut);
        assert_eq!(cmgs.wanted[..2], [0.0, 0.1]);
        assert!(cut.is_empty(), "{cut:?}");
    }
}

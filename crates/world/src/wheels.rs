//! Reaction wheels as they behave.
//!
//! The state of a wheel is its momentum about its own axis as seen from inertial space,
//! `h = J (Ω + a·w)`: it changes only by what motor and bearing give, however the base turns. Its
//! inertia about its axis is therefore not part of the base's.

use crate::command::Saturation;
use wrasse_dynamics::MassProperties;
use wrasse_hardware::{List, ReactionWheel, WHEELS};
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
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
    /// What the base lacks where the wheels count for themselves: their inertia about their axes.
    pub(crate) fn taken_from_base(&self) -> MassProperties<f64> {
        let taken = self.list.iter().fold(Sym3::zero(), |sum, wheel| {
            let (J, a) = (wheel.inertia, wheel.axis_B);
            sum - Sym3::symmetric_part(&a.outer(a)).scaled(J)
        });
        let M_F_F = SpatialInertia { rotational: taken, ..SpatialInertia::zero() };
        MassProperties { M_F_F, I_parts_F: taken }
    }
    /// Momentum about its axis (N·m·s) of each wheel at a speed against the base (rad/s).
    pub(crate) fn momenta(&self, speed: &[f64; WHEELS], w_NB_B: Vec3<f64>) -> [f64; WHEELS] {
        self.each(|i, wheel| wheel.inertia * (speed[i] + wheel.axis_B.dot(w_NB_B)))
    }
    /// Speed of each wheel against the base (rad/s).
    pub(crate) fn speeds(&self, momenta: &[f64; WHEELS], w_NB_B: Vec3<f64>) -> [f64; WHEELS] {
        self.each(|i, wheel| momenta[i] / wheel.inertia - wheel.axis_B.dot(w_NB_B))
    }
    /// All together, base axes: momenta (N·m·s), or torques on the wheels (N·m).
    pub(crate) fn together_B(&self, of_each: &[f64; WHEELS]) -> Vec3<f64> {
        let each = self.list.iter().zip(of_each);
        each.fold(Vec3::zero(), |sum, (wheel, &h)| sum + wheel.axis_B * h)
    }
    /// Momentum of each wheel as a vector, base axes (N·m·s).
    pub(crate) fn apart_B(&self, momenta: [f64; WHEELS]) -> impl Iterator<Item = Vec3<f64>> {
        self.list.iter().zip(momenta).map(|(wheel, h)| wheel.axis_B * h)
    }
    /// Torque of motor and bearing on each wheel (N·m).
    pub(crate) fn torques(&self, momenta: &[f64; WHEELS], w_NB_B: Vec3<f64>) -> [f64; WHEELS] {
        let speed = self.speeds(momenta, w_NB_B);
        self.each(|i, wheel| self.motor[i] - friction(wheel, speed[i]))
    }
    /// Set the motors for a period (s), each within what it can. What is not a number asks for nothing.
    pub(crate) fn command(
        &mut self,
        wanted: &[f64; WHEELS],
        speed: &[f64; WHEELS],
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        for (i, wheel) in self.list.iter().enumerate() {
            if self.dead[i] {
                continue;
            }
            let wanted = if wanted[i].is_nan() { 0.0 } else { wanted[i] };
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
            let drag = friction(wheel, speed[i]);
            let lowest = drag - (wheel.speed_limit + speed[i]) * wheel.inertia / period;
            let highest = drag + (wheel.speed_limit - speed[i]) * wheel.inertia / period;
            let held = torque.max(lowest).min(highest);
            self.motor[i] = held.max(-wheel.torque_limit).min(wheel.torque_limit);
            if self.motor[i] != torque {
                cut.push(Saturation::WheelSpeed(i));
            }
        }
    }
    /// The motor of a wheel gives nothing from now on.
    pub(crate) fn break_motor(&mut self, i: usize) {
        if i < self.list.len() {
            (self.dead[i], self.motor[i]) = (true, 0.0);
        }
    }
    fn each(&self, f: impl Fn(usize, &ReactionWheel<f64>) -> f64) -> [f64; WHEELS] {
        let mut all = [0.0; WHEELS];
        all.iter_mut().zip(self.list.iter()).enumerate().for_each(|(i, (to, w))| *to = f(i, w));
        all
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
            let (mut wanted, mut cut) = ([0.0; WHEELS], vec![]);
            (wanted[0], wanted[1]) = (f64::NAN, 0.1);
            wheels.command(&wanted, &[0.0; WHEELS], 0.1, &mut cut);
            assert_eq!(wheels.motor[0], 0.0);
            assert!((wheels.motor[1] - 0.1).abs() < 1e-16, "{}", wheels.motor[1]);
            assert!(cut.is_empty(), "{cut:?}");
        }
    }
}

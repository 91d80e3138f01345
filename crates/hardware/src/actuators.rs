//! All actuators of a base together: what they are, what they are told, what they say.

use crate::cmg::{CMGS, ControlMomentGyro};
use crate::list::List;
use crate::thruster::{THRUSTERS, Tank, Thruster};
use crate::wheel::{ReactionWheel, WHEELS};
use wrasse_spatial::{Real, Vec3};

/// What turns and moves the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuators<T> {
    /// Reaction wheels.
    pub wheels: List<ReactionWheel<T>, WHEELS>,
    /// Control moment gyros.
    pub cmgs: List<ControlMomentGyro<T>, CMGS>,
    /// Thrusters.
    pub thrusters: List<Thruster<T>, THRUSTERS>,
    /// The tank of the thrusters; without one they never run dry and nothing grows lighter.
    pub tank: Option<Tank<T>>,
}

impl<T: Real> Default for Actuators<T> {
    /// None at all.
    fn default() -> Self {
        Self { wheels: List::empty(), cmgs: List::empty(), thrusters: List::empty(), tank: None }
    }
}

impl<T: Real> Actuators<T> {
    /// Whether there is none at all.
    pub fn is_empty(&self) -> bool {
        self.wheels.is_empty() && self.cmgs.is_empty() && self.thrusters.is_empty()
    }
    /// Momentum of the rotors of the CMGs at gimbal angles (rad), base axes (N·m·s).
    pub fn cmg_momentum(&self, angles: &[T; CMGS]) -> Vec3<T> {
        let each = self.cmgs.iter().zip(angles);
        each.fold(Vec3::zero(), |h, (cmg, &angle)| h + cmg.spin_axis(angle) * cmg.momentum)
    }
    /// Momentum of the wheels against the base at speeds (rad/s), base axes (N·m·s).
    pub fn wheel_momentum(&self, speeds: &[T; WHEELS]) -> Vec3<T> {
        let each = self.wheels.iter().zip(speeds);
        each.fold(Vec3::zero(), |h, (wheel, &speed)| h + wheel.axis_B * (wheel.inertia * speed))
    }
}

impl Actuators<f64> {
    /// The same actuators over another scalar.
    pub fn cast<T: Real>(&self) -> Actuators<T> {
        Actuators {
            wheels: self.wheels.map(ReactionWheel::cast),
            cmgs: self.cmgs.map(ControlMomentGyro::cast),
            thrusters: self.thrusters.map(Thruster::cast),
            tank: self.tank.as_ref().map(Tank::cast),
        }
    }
}

/// What the actuators are told for the coming control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorCommand<T> {
    /// Torque of each wheel's motor on its wheel (N·m).
    pub wheel_torque: [T; WHEELS],
    /// Rate of each gimbal (rad/s).
    pub gimbal_rate: [T; CMGS],
    /// How long each thruster is open, from the start of the period (s). Open for the whole period: it
    /// does not shut at its end.
    pub thruster_on: [T; THRUSTERS],
}

/// What the actuators say of themselves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorReadings<T> {
    /// Speed of each wheel against the base (rad/s).
    pub wheel_speed: [T; WHEELS],
    /// Angle of each gimbal (rad).
    pub gimbal_angle: [T; CMGS],
    /// Rate of each gimbal (rad/s).
    pub gimbal_rate: [T; CMGS],
    /// Propellant left (kg).
    pub propellant: T,
}

impl<T: Real> Default for ActuatorCommand<T> {
    /// Nothing is told to do anything.
    fn default() -> Self {
        let o = T::zero();
        Self { wheel_torque: [o; WHEELS], gimbal_rate: [o; CMGS], thruster_on: [o; THRUSTERS] }
    }
}

impl<T: Real> Default for ActuatorReadings<T> {
    /// All stand still at zero; the tank is empty.
    fn default() -> Self {
        let o = T::zero();
        Self {
            wheel_speed: [o; WHEELS],
            gimbal_angle: [o; CMGS],
            gimbal_rate: [o; CMGS],
            propellant: o,
        }
    }
}

//! What a system is made of.

use wrasse_dynamics::{BaseMode, Frame, MassProperties, Robot, State};
use wrasse_hardware::{
    Actuators, AttitudeActuator, CMGS, JointLimits, SetPointMotion, Slosh, WHEELS,
};

/// What becomes of the base's attitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BaseAttitude {
    /// Held exactly; the torque that this takes is recorded as the actuator's. Whatever holds it, the
    /// vehicle weighs the same: units and propellant are part of it.
    Held,
    /// Turned by the ideal actuator as it is commanded, within its limits.
    Controlled,
    /// Nothing acts on it but the arm.
    Free,
}

impl BaseAttitude {
    /// What holds the base.
    pub(crate) fn mode(self) -> BaseMode {
        match self {
            Self::Held => BaseMode::AttitudeHeld,
            Self::Free | Self::Controlled => BaseMode::Free,
        }
    }
}

/// What drives a joint for the current control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive<T = f64> {
    /// Follows the set-points exactly, whatever it takes.
    Follow(SetPointMotion<T>),
    /// A torque (N·m) or force (N), constant over the period.
    Effort(T),
}

/// The wheels, CMGs and thrusters of the base, and how they stand at the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Equipment {
    /// What they are.
    pub actuators: Actuators<f64>,
    /// Speed of each wheel against the base (rad/s).
    pub wheel_speed: [f64; WHEELS],
    /// Angle of each gimbal (rad); its rate is zero.
    pub gimbal_angle: [f64; CMGS],
    /// How the propellant swings in the tank, if there is one; `None`: it does not.
    pub slosh: Option<Slosh>,
    /// Seed of the thrusters' noise.
    pub seed: u64,
}

/// What a system is made of.
#[derive(Debug, Clone)]
pub struct SystemSetup<'a, const J: usize> {
    /// The vehicle, with nothing in its grip.
    pub robot: &'a Robot<f64, J>,
    /// Limits of its joints, in the robot's order.
    pub limits: &'a [JointLimits<f64>],
    /// The ideal attitude actuator, if it has one.
    pub actuator: Option<AttitudeActuator<f64>>,
    /// Wheels, CMGs, thrusters. Where the attitude is held they are matter that does nothing: wheels
    /// keep their speeds, gimbals their angles, and thrusters stay shut.
    pub equipment: Equipment,
    /// What becomes of the base's attitude.
    pub base: BaseAttitude,
    /// State at the start.
    pub start: State<f64, J>,
    /// Payloads held from the start: where, and what.
    pub held: &'a [(Frame<f64>, MassProperties<f64>)],
}

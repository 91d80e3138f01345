//! What a world is made of.

use crate::stepper::Stepper;
use wrasse_dynamics::{Frame, Kinematics, MassProperties, PerBody, Robot, State};
use wrasse_hardware::{Actuators, AttitudeActuator, CMGS, JointLimits, SetPointMotion, WHEELS};
use wrasse_spatial::SpatialForce;

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

/// What drives a joint for the current control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive<T = f64> {
    /// Follows the set-points exactly, whatever it takes.
    Follow(SetPointMotion<T>),
    /// A torque (N·m) or force (N), constant over the period.
    Effort(T),
}

/// An instant that a wrench from outside is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Time (s).
    pub time: f64,
    /// A time inside the stretch between two bends to which the instant belongs (s): at a bend itself
    /// it tells before from after.
    pub within: f64,
}

/// A wrench from outside on each body at its origin, in its axes, as a function of the instant and of
/// how the bodies stand and move then.
pub type OutsideWrench<const J: usize> =
    Box<dyn Fn(Instant, &Kinematics<'_, f64, J>) -> PerBody<SpatialForce<f64>, J> + Send + Sync>;

/// The wheels, CMGs and thrusters of the base, and how they stand at the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Equipment {
    /// What they are.
    pub actuators: Actuators<f64>,
    /// Speed of each wheel against the base (rad/s).
    pub wheel_speed: [f64; WHEELS],
    /// Angle of each gimbal (rad); its rate is zero.
    pub gimbal_angle: [f64; CMGS],
    /// Seed of the thrusters' noise.
    pub seed: u64,
}

/// What a world is made of.
#[derive(Debug, Clone)]
pub struct WorldSetup<'a, const J: usize> {
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
    /// How the motion is integrated.
    pub stepper: Stepper,
    /// State at the start.
    pub start: State<f64, J>,
    /// Payloads held from the start: where, and what.
    pub held: &'a [(Frame<f64>, MassProperties<f64>)],
}

//! The door between what flies and the rest: plain data in, plain data out, once per control period.

use crate::trajectory::ToolMotion;
use wrasse_dynamics::State;
use wrasse_hardware::SetPoint;
use wrasse_spatial::Vec3;

/// What the sensors say at the start of a control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensed<T, const J: usize> {
    /// Pose and twist of the base, joint positions and rates, as measured.
    pub state: State<T, J>,
}

/// What the actuators are told for the coming control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command<T, const J: usize> {
    /// Where each joint should be at the end of the period.
    pub set_points: [SetPoint<T>; J],
    /// Torque (N·m) or force (N) of each joint over the period, by the computed-torque law.
    pub effort: [T; J],
    /// Torque of the attitude actuator on the base over the period, base axes (N·m).
    pub attitude_torque_B: Vec3<T>,
    /// What the grip should do now.
    pub grip: Option<Grip>,
    /// Number of the phase that this period belongs to; the number of phases when all are done.
    pub phase: usize,
    /// Where the tool should be at the end of the period.
    pub reference: ToolMotion<T>,
    /// The axes that the reference is in.
    pub axes: Axes,
}

/// What a grip can be told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grip {
    /// Grasp the payload of this number.
    Grasp(usize),
    /// Let go of the payload of this number.
    Release(usize),
}

/// Axes that a target is fixed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Inertial space.
    Inertial,
    /// The base, wherever it goes.
    Base,
}

//! The interface between what flies and the rest: plain data in, plain data out, once per control period.

use crate::allocation::{AllocationReport, NoPostureUnloading};
use crate::executive::StepEnd;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::State;
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, SetPoint, TrackerReading};
use wrasse_spatial::{Pose, Real, SpatialForce, SpatialVelocity, Vec3};

/// What the sensors say at the start of a control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensed<T, const J: usize> {
    /// Of the base.
    pub base: BaseReading<T>,
    /// Of the joints.
    pub joints: JointReading<T, J>,
    /// What the actuators of the base say of themselves.
    pub actuators: ActuatorReadings<T>,
    /// What pushes at the tool, at its origin in its axes (N·m, N), by a force-torque sensor.
    pub tool_wrench_E: Option<SpatialForce<T>>,
    /// What became of what the grip was told last, in the first period behind that.
    pub grip: Option<GripAnswer>,
}

/// What a grip says of what it was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripAnswer {
    /// It was done.
    Done,
    /// It could not be done.
    Refused,
}

/// What is known of the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BaseReading<T> {
    /// Pose and twist, by perfect sensors.
    Known(Pose<T>, SpatialVelocity<T>),
    /// What a gyro and a star tracker say, and a relative navigation whose errors do not matter here.
    Felt {
        /// Rate by the gyro, base axes (rad/s).
        rate_B: Vec3<T>,
        /// What the star tracker says, when it does.
        tracker: Option<TrackerReading<T>>,
        /// Origin of the base, inertial axes (m).
        p_NB_N: Vec3<T>,
        /// Its velocity, inertial axes (m/s).
        v_NB_N: Vec3<T>,
    },
}

/// What is known of the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointReading<T, const J: usize> {
    /// Positions (rad or m) and rates (rad/s or m/s), by perfect sensors.
    Known([T; J], [T; J]),
    /// Positions by encoders (rad or m).
    Encoders([T; J]),
}

impl<T: Real, const J: usize> Sensed<T, J> {
    /// What perfect sensors say of a state.
    pub fn perfect(state: &State<T, J>, actuators: ActuatorReadings<T>) -> Self {
        Self {
            base: BaseReading::Known(state.X_NB, state.V_NB_B),
            joints: JointReading::Known(state.q, state.v),
            actuators,
            tool_wrench_E: None,
            grip: None,
        }
    }
}

/// Commands of the actuators for the coming control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command<T, const J: usize> {
    /// Where each joint should be at the end of the period.
    pub set_points: [SetPoint<T>; J],
    /// Torque (N·m) or force (N) of each joint over the period, by the computed-torque law, within
    /// the limits of the drives.
    pub effort: [T; J],
    /// The same before limits.
    pub effort_commanded: [T; J],
    /// Share of the rates that the tool's way asks of the joints which their rate limits leave (–).
    pub rate_share: T,
    /// Torque that the base should feel over the period, base axes (N·m): the command of an
    /// ideal actuator, and the demand on the allocation.
    pub attitude_torque_B: Vec3<T>,
    /// Commands of wheels, CMGs and thrusters.
    pub actuators: ActuatorCommand<T>,
    /// What the allocation can give of the demand.
    pub allocation: AllocationReport<T>,
    /// Why no change of posture unloads the base, where that is the phase.
    pub no_posture_unloading: Option<NoPostureUnloading<T>>,
    /// What the grip should do now.
    pub grip: Option<Grip>,
    /// Number of the step that this period belongs to; the number of steps when all are done.
    pub phase: usize,
    /// Whether that step begins with it.
    pub begins: bool,
    /// The step that ended before it, and why.
    pub ended: Option<(usize, StepEnd<T>)>,
    /// A step that would have begun with it, had its attempts not been used up.
    pub exhausted: Option<usize>,
    /// Where the tool should be at the end of the period.
    pub reference: ToolMotion<T>,
    /// The axes that the reference is in.
    pub axes: Axes,
}

/// Commands of a grip.
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

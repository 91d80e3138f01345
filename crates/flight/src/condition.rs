//! Conditions that end a step, from what the flight computer knows.

use crate::interface::Axes;
use wrasse_dynamics::{Frame, JointKind, Robot, State, kinematics};
use wrasse_hardware::{ActuatorReadings, Actuators};
use wrasse_spatial::{Pose, Quat, Scalar, SpatialForce};

/// What ends a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition<T> {
    /// The motions of all arms are over.
    Done,
    /// So much time has passed since it began (s).
    Elapsed(T),
    /// The tools are where their motions end, as the sensors have it: within a distance (m) and an angle
    /// (rad).
    Reached {
        /// (m)
        distance: T,
        /// (rad)
        angle: T,
    },
    /// A quantity is beyond a bound, in SI.
    Beyond {
        /// The quantity.
        signal: SensedSignal,
        /// Whether it has to be above the bound, else below it.
        above: bool,
        /// The bound.
        bound: T,
    },
}

/// A quantity that the flight computer knows from its sensors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensedSignal {
    /// Distance of the tool from its reference (m).
    ToolPositionError,
    /// Angle of the tool from its reference (rad).
    ToolAttitudeError,
    /// Force at the tool, by its sensor (N).
    ToolForce,
    /// Torque at the tool, by its sensor (N·m).
    ToolTorque,
    /// Angle of the base from the attitude that is kept (rad).
    BaseAttitudeError,
    /// How fast the base turns (rad/s).
    BaseTurnSpeed,
    /// How fast the fastest joint turns (rad/s).
    JointTurnSpeed,
    /// Momentum in wheels and CMGs (N·m·s).
    StoredMomentum,
    /// Propellant that is left (kg).
    Propellant,
}

/// What a condition is judged by.
pub(crate) struct Known<'a, T, const J: usize> {
    pub(crate) robot: &'a Robot<T, J>,
    /// As it is sensed or estimated.
    pub(crate) state: &'a State<T, J>,
    /// The first arm's tool, where it should be now, and the axes of that.
    pub(crate) tool: &'a Frame<T>,
    pub(crate) reference: (Pose<T>, Axes),
    pub(crate) tool_wrench_E: Option<SpatialForce<T>>,
    /// Attitude that the base is to keep.
    pub(crate) quat_ND: Quat<T>,
    pub(crate) actuators: Option<Actuators<T>>,
    pub(crate) readings: &'a ActuatorReadings<T>,
}

impl<T: Scalar, const J: usize> Known<'_, T, J> {
    /// Distance (m) and angle (rad) of a tool from a pose in these axes.
    pub(crate) fn tool_error(&self, tool: &Frame<T>, (X, axes): (Pose<T>, Axes)) -> (T, T) {
        let X_NE = kinematics(self.robot, self.state).pose(tool);
        let seen = match axes {
            Axes::Inertial => X_NE,
            Axes::Base => self.state.X_NB.inverse() * X_NE,
        };
        let turned = Quat::from_matrix(&(X.rotation * seen.rotation.transpose())).log();
        ((X.translation - seen.translation).norm(), turned.norm())
    }

    /// Value of a quantity, in SI; `None` where no sensor knows it.
    pub(crate) fn value(&self, signal: SensedSignal) -> Option<T> {
        let error = || self.tool_error(self.tool, self.reference);
        Some(match signal {
            SensedSignal::ToolPositionError => error().0,
            SensedSignal::ToolAttitudeError => error().1,
            SensedSignal::ToolForce => self.tool_wrench_E?.force.norm(),
            SensedSignal::ToolTorque => self.tool_wrench_E?.torque.norm(),
            SensedSignal::BaseAttitudeError => {
                let quat_NB = Quat::from_matrix(&self.state.X_NB.rotation);
                (self.quat_ND.conjugate() * quat_NB).log().norm()
            }
            SensedSignal::BaseTurnSpeed => self.state.V_NB_B.angular.norm(),
            SensedSignal::JointTurnSpeed => {
                let turning = |j: &usize| self.robot.joint(*j).kind == JointKind::Revolute;
                let turns = self.robot.joints().filter(turning);
                let rates = turns.map(|j| self.state.v[j].abs());
                rates.fold(T::zero(), T::max)
            }
            SensedSignal::StoredMomentum => {
                let (actuators, readings) = (self.actuators.as_ref()?, self.readings);
                let wheels = actuators.wheel_momentum(&readings.wheel_speed);
                (actuators.cmg_momentum(&readings.gimbal_angle) + wheels).norm()
            }
            SensedSignal::Propellant => {
                self.actuators.as_ref()?.tank.as_ref()?;
                self.readings.propellant
            }
        })
    }

    /// Whether a quantity is beyond a bound; what nobody knows is not.
    pub(crate) fn is_beyond(&self, signal: SensedSignal, above: bool, bound: T) -> bool {
        self.value(signal).is_some_and(|x| if above { x > bound } else { x < bound })
    }
}

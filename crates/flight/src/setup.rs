//! How a flight computer is set up.

use crate::allocation::AllocationSetup;
use crate::law::{Feedforward, Measurement, Tuning};
use crate::navigation::NavigationSetup;
use crate::resolved_motion::{Assignment, JointUse};
use wrasse_dynamics::Frame;
use wrasse_hardware::{AttitudeActuator, Follower, JointLimits, List};
use wrasse_spatial::{Pose, Quat, Real};

/// How a flight computer is set up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup<T, const J: usize> {
    /// Task and law of the arm; its axes are those of the current phase.
    pub assignment: Assignment<T>,
    /// How the joints may be used.
    pub joints: JointUse<T, J>,
    /// How the base is controlled.
    pub base: BaseControlSetup<T>,
    /// What the sensors are.
    pub navigation: NavigationSetup<T>,
    /// What the guidance measures.
    pub measurement: Measurement,
    /// Numbers of the laws.
    pub tuning: Tuning<T>,
    /// Limits of the joints.
    pub limits: [JointLimits<T>; J],
    /// Joints whose drives follow their set-points whatever it takes: no loop is closed over them here.
    pub position_driven: [bool; J],
    /// Joints without a drive: what a law asks of one is asked of its leader.
    pub followers: List<Follower<T>, J>,
}

impl<const J: usize> Setup<f64, J> {
    /// The same setup over another scalar, without estimators, allocation and position hold: those decide.
    pub fn bare<T: Real>(&self) -> Setup<T, J> {
        let c = T::from_f64;
        let Assignment { tool, axes, task, law, damped_below } = self.assignment;
        let tool = Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) };
        let quat = self.base.quat_ND;
        let quat_ND = Quat::new(c(quat.w), c(quat.x), c(quat.y), c(quat.z));
        let (use_, tuning) = (&self.joints, &self.tuning);
        Setup {
            assignment: Assignment { tool, axes, task, law, damped_below: c(damped_below) },
            joints: JointUse {
                gain: c(use_.gain),
                gain_rate: c(use_.gain_rate),
                posture: use_.posture.map(c),
                rate_limit: use_.rate_limit.map(c),
            },
            base: BaseControlSetup::ideal(self.base.feedforward, quat_ND),
            navigation: NavigationSetup::perfect(),
            measurement: self.measurement,
            tuning: Tuning {
                period: c(tuning.period),
                tool_gain: c(tuning.tool_gain),
                joint_bandwidth: c(tuning.joint_bandwidth),
                joint_damping: c(tuning.joint_damping),
                attitude_bandwidth: c(tuning.attitude_bandwidth),
                attitude_damping: c(tuning.attitude_damping),
            },
            position_driven: self.position_driven,
            followers: self.followers.map(Follower::from_f64),
            limits: self.limits.map(|l| JointLimits {
                travel: l.travel.map(|(lower, upper)| (c(lower), c(upper))),
                rate: l.rate.map(c),
                effort: l.effort.map(c),
            }),
        }
    }
}

/// How the centre of mass of the system is kept where it was at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionHold<T> {
    /// Bandwidth of the loop (rad/s).
    pub bandwidth: T,
    /// Damping ratio of the loop (–).
    pub damping: T,
}

/// How the base is controlled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseControlSetup<T> {
    /// Feedforward of the arm's motion to the attitude control.
    pub feedforward: Feedforward,
    /// Attitude that is kept.
    pub quat_ND: Quat<T>,
    /// Whether and how the centre of mass is kept in its place.
    pub position_hold: Option<PositionHold<T>>,
    /// What turns the base.
    pub actuation: Actuation<T>,
}

/// What turns the base, as far as the flight computer is concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Actuation<T> {
    /// Nothing that it commands: the base floats, or is held by something else.
    None,
    /// An ideal actuator, within limits if it has them.
    Ideal(Option<AttitudeActuator<T>>),
    /// Wheels, CMGs and thrusters, and how torque is allocated to them.
    Fitted(AllocationSetup<T>),
}

impl<T> Actuation<T> {
    /// The actuators and how torque is allocated to them, if there are any.
    pub fn allocation(&self) -> Option<&AllocationSetup<T>> {
        match self {
            Self::Fitted(setup) => Some(setup),
            Self::None | Self::Ideal(_) => None,
        }
    }

    /// Whether a torque is given in the period in which it is wanted. Thrusters alone give pulses, and
    /// those when the lag of their modulation lets them.
    pub(crate) fn answers_at_once(&self) -> bool {
        self.allocation().is_none_or(|setup| {
            let actuators = &setup.actuators;
            !actuators.wheels.is_empty() || !actuators.cmgs.is_empty()
        })
    }
}

impl<T: Real> BaseControlSetup<T> {
    /// The attitude `quat_ND` kept by an ideal actuator without limits; the base goes where the arm
    /// pushes it.
    pub fn ideal(feedforward: Feedforward, quat_ND: Quat<T>) -> Self {
        Self { feedforward, quat_ND, position_hold: None, actuation: Actuation::Ideal(None) }
    }
}

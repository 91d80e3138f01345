//! The laws and their numbers, as C knows them.

use crate::complaint::{Refused, choice, each, finite, unit};
use crate::robot_table::WRASSE_JOINTS;
use wrasse_dynamics::Frame;
use wrasse_flight::{
    ArmLaw, Assignment, Axes, BaseControlSetup, Feedforward, JointUse, Measurement,
    NavigationSetup, Setup, Task, Tuning,
};
use wrasse_hardware::JointLimits;
use wrasse_spatial::Quat;

/// The arm's law takes the base for bolted to the ground.
pub const WRASSE_LAW_TERRESTRIAL: i32 = 0;
/// The arm's law takes the base's attitude for held and its translation for free.
pub const WRASSE_LAW_ATTITUDE_HELD: i32 = 1;
/// The arm's law takes the base for free to turn and to translate.
pub const WRASSE_LAW_FREE_FLOATING: i32 = 2;

/// Position and orientation of the tool count.
pub const WRASSE_TASK_POSE: i32 = 0;
/// Only the position of the tool counts.
pub const WRASSE_TASK_POSITION: i32 = 1;

/// The attitude control is not told of the arm's motion.
pub const WRASSE_FEEDFORWARD_NONE: i32 = 0;
/// The attitude control is told the exact torque that the arm's motion takes.
pub const WRASSE_FEEDFORWARD_EXACT: i32 = 1;

/// After the start the guidance integrates its own model.
pub const WRASSE_MEASURE_NOTHING: i32 = 0;
/// The guidance takes pose and twist of the base from the sensors, each period.
pub const WRASSE_MEASURE_BASE: i32 = 1;

/// The laws and their numbers. Elements of joints that the robot does not have are not read.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrasseLaws {
    /// One of `WRASSE_LAW_...`.
    pub law: i32,
    /// One of `WRASSE_TASK_...`.
    pub task: i32,
    /// One of `WRASSE_FEEDFORWARD_...`.
    pub feedforward: i32,
    /// One of `WRASSE_MEASURE_...`.
    pub measurement: i32,
    /// Control period (s).
    pub period: f64,
    /// How fast the guidance takes back a tool error (1/s).
    pub tool_gain: f64,
    /// Bandwidth of the joint loops (rad/s); zero: feedforward only.
    pub joint_bandwidth: f64,
    /// Damping ratio of the joint loops (–).
    pub joint_damping: f64,
    /// Bandwidth of the attitude loop (rad/s); zero: feedforward only.
    pub attitude_bandwidth: f64,
    /// Damping ratio of the attitude loop (–).
    pub attitude_damping: f64,
    /// Singular value below which the inverse of the arm's Jacobian is damped (m/rad, –).
    pub damped_below: f64,
    /// Attitude that the base keeps: quaternion w, x, y, z from base axes to inertial axes (–).
    pub kept_attitude: [f64; 4],
    /// Posture towards which the freedom that the task leaves is used (rad or m).
    pub posture: [f64; WRASSE_JOINTS],
    /// Largest rate of each joint (rad/s or m/s).
    pub rate_limit: [f64; WRASSE_JOINTS],
    /// Largest torque or force of each joint (N·m or N); zero for none.
    pub effort_limit: [f64; WRASSE_JOINTS],
}

impl WrasseLaws {
    fn check(&self, links: usize) -> Result<(), Refused> {
        let (positive, not_negative) = (|x: f64| x > 0.0, |x: f64| x >= 0.0);
        let (above, from) = (c"a number above zero", c"zero or more");
        each(c"WrasseLaws.period", &[self.period], above, positive)?;
        each(c"WrasseLaws.damped_below", &[self.damped_below], above, positive)?;
        each(c"WrasseLaws.tool_gain", &[self.tool_gain], from, not_negative)?;
        each(c"WrasseLaws.joint_bandwidth", &[self.joint_bandwidth], from, not_negative)?;
        each(c"WrasseLaws.joint_damping", &[self.joint_damping], from, not_negative)?;
        each(c"WrasseLaws.attitude_bandwidth", &[self.attitude_bandwidth], from, not_negative)?;
        each(c"WrasseLaws.attitude_damping", &[self.attitude_damping], from, not_negative)?;
        unit(c"WrasseLaws.kept_attitude", &self.kept_attitude)?;
        finite(c"WrasseLaws.posture", first(&self.posture, links))?;
        each(c"WrasseLaws.rate_limit", first(&self.rate_limit, links), above, positive)?;
        each(c"WrasseLaws.effort_limit", first(&self.effort_limit, links), from, not_negative)
    }

    /// The set-up of the flight crate for a robot of so many links.
    pub(crate) fn setup(
        &self,
        tool: Frame<f64>,
        links: usize,
    ) -> Result<Setup<f64, WRASSE_JOINTS>, Refused> {
        self.check(links)?;
        let laws = [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating];
        let (tasks, feedforwards) =
            ([Task::Pose, Task::Position], [Feedforward::None, Feedforward::Exact]);
        let measurements = [Measurement::None, Measurement::Base];
        let [w, x, y, z] = self.kept_attitude;
        let feedforward = choice(c"WrasseLaws.feedforward", self.feedforward, feedforwards)?;
        let effort = |limit: f64| (limit > 0.0).then_some(limit);
        Ok(Setup {
            assignment: Assignment {
                tool,
                axes: Axes::Inertial,
                task: choice(c"WrasseLaws.task", self.task, tasks)?,
                law: choice(c"WrasseLaws.law", self.law, laws)?,
                damped_below: self.damped_below,
            },
            joints: JointUse {
                gain: 0.0,
                gain_rate: 0.0,
                posture: self.posture,
                rate_limit: self.rate_limit,
            },
            base: BaseControlSetup::ideal(feedforward, Quat::new(w, x, y, z).normalized()),
            navigation: NavigationSetup::perfect(),
            measurement: choice(c"WrasseLaws.measurement", self.measurement, measurements)?,
            tuning: Tuning {
                period: self.period,
                tool_gain: self.tool_gain,
                joint_bandwidth: self.joint_bandwidth,
                joint_damping: self.joint_damping,
                attitude_bandwidth: self.attitude_bandwidth,
                attitude_damping: self.attitude_damping,
            },
            limits: self
                .effort_limit
                .map(|limit| JointLimits { effort: effort(limit), ..JointLimits::default() }),
        })
    }
}

/// The elements of the joints that there are.
pub(crate) fn first(all: &[f64; WRASSE_JOINTS], links: usize) -> &[f64] {
    all.get(..links).unwrap_or(all)
}

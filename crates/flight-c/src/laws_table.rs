//! The laws and their numbers, as C knows them.

use crate::complaint::{Refused, choice, each, unit};
use crate::robot_table::WRASSE_JOINTS;
use wrasse_dynamics::Frame;
use wrasse_flight::{
    ArmLaw, Assignment, Axes, BaseControlSetup, Feedforward, JointUse, Measurement,
    NavigationSetup, Setup, Task, Tuning,
};
use wrasse_hardware::{JointLimits, List};
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

/// The arm's motion is not fed forward to the attitude control.
pub const WRASSE_FEEDFORWARD_NONE: i32 = 0;
/// The exact torque that the arm's motion takes is fed forward to the attitude control.
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
    /// Control period (s), between 1e-5 and 100.
    pub period: f64,
    /// How fast the guidance takes back a tool error (1/s), between 0 and 1e5; its product with the
    /// period is below 1.
    pub tool_gain: f64,
    /// Bandwidth of the joint loops (rad/s), between 0 and 1e5; zero: feedforward only. With b its
    /// product with the period and d the damping ratio, b d + b b / 4 is below 1.
    pub joint_bandwidth: f64,
    /// Damping ratio of the joint loops (–), between 0 and 1e3.
    pub joint_damping: f64,
    /// Bandwidth of the attitude loop (rad/s), between 0 and 1e5; zero: feedforward only. Its product
    /// with the damping ratio and the period is below 1.
    pub attitude_bandwidth: f64,
    /// Damping ratio of the attitude loop (–), between 0 and 1e3.
    pub attitude_damping: f64,
    /// Singular value below which the inverse of the arm's Jacobian is damped (m/rad, –), between 1e-9
    /// and 1e3.
    pub damped_below: f64,
    /// Attitude that the base keeps: quaternion w, x, y, z from base axes to inertial axes (–).
    pub kept_attitude: [f64; 4],
    /// Posture towards which the freedom that the task leaves is used (rad or m), between -1e6 and 1e6.
    pub posture: [f64; WRASSE_JOINTS],
    /// Largest rate of each joint (rad/s or m/s), between 1e-9 and 100.
    pub rate_limit: [f64; WRASSE_JOINTS],
    /// Largest torque or force of each joint (N·m or N), between 1e-9 and 1e9; zero for none.
    pub effort_limit: [f64; WRASSE_JOINTS],
}

impl WrasseLaws {
    fn check(&self, links: usize) -> Result<(), Refused> {
        let damping = |x: f64| (0.0..=1e3).contains(&x);
        let from = c"between 0 and 1e3";
        let (period, bandwidth) = (self.period, c"between 0 and 1e5");
        let fast = |x: f64| (0.0..=1e5).contains(&x);
        each(c"WrasseLaws.period", &[period], c"between 1e-5 and 100", |x| {
            (1e-5..=100.0).contains(&x)
        })?;
        each(c"WrasseLaws.damped_below", &[self.damped_below], c"between 1e-9 and 1e3", |x| {
            (1e-9..=1e3).contains(&x)
        })?;
        each(c"WrasseLaws.tool_gain", &[self.tool_gain], bandwidth, fast)?;
        each(c"WrasseLaws.joint_bandwidth", &[self.joint_bandwidth], bandwidth, fast)?;
        each(c"WrasseLaws.joint_damping", &[self.joint_damping], from, damping)?;
        each(c"WrasseLaws.attitude_bandwidth", &[self.attitude_bandwidth], bandwidth, fast)?;
        each(c"WrasseLaws.attitude_damping", &[self.attitude_damping], from, damping)?;
        self.check_rates()?;
        unit(c"WrasseLaws.kept_attitude", &self.kept_attitude)?;
        each(c"WrasseLaws.posture", first(&self.posture, links), c"between -1e6 and 1e6", |x| {
            x.abs() <= 1e6
        })?;
        let rates = first(&self.rate_limit, links);
        each(c"WrasseLaws.rate_limit", rates, c"between 1e-9 and 100", |x| {
            (1e-9..=100.0).contains(&x)
        })?;
        let efforts = first(&self.effort_limit, links);
        each(c"WrasseLaws.effort_limit", efforts, c"zero, or between 1e-9 and 1e9", |x| {
            x == 0.0 || (1e-9..=1e9).contains(&x)
        })
    }

    /// No loop is faster than its period allows: beyond these bounds an error grows from one period to
    /// the next, even of a single body.
    fn check_rates(&self) -> Result<(), Refused> {
        let h = self.period;
        each(
            c"WrasseLaws.tool_gain, times period",
            &[self.tool_gain * h],
            c"below 1: a lower gain or a shorter period",
            |x| x < 1.0,
        )?;
        // The torque looks half a period ahead, which shifts the bound by the second term.
        let joints = self.joint_bandwidth * h;
        each(
            c"WrasseLaws.joint_bandwidth: b d + b b / 4, with b = it times period, d = joint_damping",
            &[joints * self.joint_damping + joints * joints / 4.0],
            c"below 1: a lower bandwidth or a shorter period",
            |x| x < 1.0,
        )?;
        each(
            c"WrasseLaws.attitude_bandwidth, times attitude_damping and period",
            &[self.attitude_bandwidth * self.attitude_damping * h],
            c"below 1: a lower bandwidth or a shorter period",
            |x| x < 1.0,
        )
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
            position_driven: [false; WRASSE_JOINTS],
            followers: List::empty(),
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

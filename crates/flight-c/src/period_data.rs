//! What goes into a control period and what comes out, as C knows it.

use crate::complaint::{ONLY, Refused, WrasseStatus, choice, refused, unit};
use crate::robot_table::{WRASSE_JOINTS, vector};
use wrasse_dynamics::State;
use wrasse_flight::trajectory::{JointSetPoint, ToolMotion};
use wrasse_flight::{ArmReference, Axes, ControlOutput};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity};

/// The tool follows a motion.
pub const WRASSE_REFERENCE_TOOL: i32 = 0;
/// The joints follow a motion.
pub const WRASSE_REFERENCE_JOINTS: i32 = 1;
/// The joints stand still where they were sent last.
pub const WRASSE_REFERENCE_STILL: i32 = 2;
/// Nothing is driven.
pub const WRASSE_REFERENCE_COAST: i32 = 3;

/// The tool's motion is in inertial axes.
pub const WRASSE_AXES_INERTIAL: i32 = 0;
/// The tool's motion is relative to the base, in its axes.
pub const WRASSE_AXES_BASE: i32 = 1;

/// What the sensors say at the start of a period. A number beyond its bounds is refused; elements of
/// joints that the robot does not have are not read.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrasseSensed {
    /// Attitude of the base: quaternion w, x, y, z from base axes to inertial axes (–), its squares
    /// summing to 1 within 1e-5.
    pub attitude: [f64; 4],
    /// Origin of the base, inertial axes (m), between -1e6 and 1e6.
    pub position: [f64; 3],
    /// Rate of the base, base axes (rad/s), between -10 and 10.
    pub angular_velocity: [f64; 3],
    /// Velocity of the base's origin, base axes (m/s), between -100 and 100.
    pub velocity: [f64; 3],
    /// Joint positions (rad or m), between -1e6 and 1e6.
    pub joint_position: [f64; WRASSE_JOINTS],
    /// Joint rates (rad/s or m/s), between -100 and 100.
    pub joint_rate: [f64; WRASSE_JOINTS],
    /// 1 if the wrench at the tool is measured, 0 if not.
    pub wrench_measured: i32,
    /// That wrench at the tool's origin, tool axes: torque (N·m), then force (N), between -1e6 and 1e6.
    pub wrench: [f64; 6],
}

/// Reference of the arm at the end of a period.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrasseArmReference {
    /// One of `WRASSE_REFERENCE_...`.
    pub kind: i32,
    /// One of `WRASSE_AXES_...`; for the tool.
    pub axes: i32,
    /// Where the tool should be (m), between -1e6 and 1e6.
    pub tool_position: [f64; 3],
    /// How it should be turned: quaternion w, x, y, z from tool axes to the axes of the motion (–),
    /// its squares summing to 1 within 1e-5.
    pub tool_attitude: [f64; 4],
    /// Its velocity: angular (rad/s), between -10 and 10, then linear (m/s), between -100 and 100.
    pub tool_velocity: [f64; 6],
    /// Time derivative of that (rad/s², m/s²), between -100 and 100.
    pub tool_acceleration: [f64; 6],
    /// Drift towards the posture of the laws (1/s), between -10 and 10; zero for joint rates of
    /// least norm.
    pub posture_gain: f64,
    /// How fast that gain changes (1/s²), between -100 and 100.
    pub posture_gain_rate: f64,
    /// Where the joints should be (rad or m), between -1e6 and 1e6.
    pub joint_position: [f64; WRASSE_JOINTS],
    /// Their rates (rad/s or m/s), between -100 and 100.
    pub joint_rate: [f64; WRASSE_JOINTS],
    /// Their accelerations (rad/s² or m/s²), between -1e4 and 1e4.
    pub joint_acceleration: [f64; WRASSE_JOINTS],
}

/// Commands of the actuators for the period.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrasseControlOutput {
    /// Where each joint should be at its end (rad or m).
    pub joint_position: [f64; WRASSE_JOINTS],
    /// Rates there (rad/s or m/s).
    pub joint_rate: [f64; WRASSE_JOINTS],
    /// Accelerations there (rad/s² or m/s²).
    pub joint_acceleration: [f64; WRASSE_JOINTS],
    /// Torque or force of each joint over the period (N·m or N).
    pub effort: [f64; WRASSE_JOINTS],
    /// Torque that the base should feel over the period, base axes (N·m).
    pub attitude_torque: [f64; 3],
    /// Force that is known to be needed against a push at the tool, base axes (N).
    pub force_ahead: [f64; 3],
}

fn rotated(attitude: [f64; 4], position: [f64; 3]) -> Pose<f64> {
    let [w, x, y, z] = attitude;
    Pose::from_quat(Quat::new(w, x, y, z).normalized(), vector(position))
}

fn twist([a, b, c, d, e, f]: [f64; 6]) -> SpatialVelocity<f64> {
    SpatialVelocity::new(vector([a, b, c]), vector([d, e, f]))
}

/// Joint numbers, those of joints that are not there set to zero.
fn joints(all: &[f64; WRASSE_JOINTS], links: usize) -> [f64; WRASSE_JOINTS] {
    let mut kept = *all;
    kept.iter_mut().skip(links).for_each(|x| *x = 0.0);
    kept
}

impl WrasseSensed {
    /// The state of a robot of so many links, and the push at its tool. The period holds its numbers
    /// against their bounds.
    pub(crate) fn read(
        &self,
        links: usize,
    ) -> Result<(State<f64, WRASSE_JOINTS>, Option<SpatialForce<f64>>), Refused> {
        unit(c"WrasseSensed.attitude", &self.attitude).map_err(Refused::of_reading)?;
        let measured =
            choice(c"WrasseSensed.wrench_measured", self.wrench_measured, [false, true])?;
        let state = State {
            X_NB: rotated(self.attitude, self.position),
            V_NB_B: SpatialVelocity::new(vector(self.angular_velocity), vector(self.velocity)),
            q: joints(&self.joint_position, links),
            v: joints(&self.joint_rate, links),
        };
        let [a, b, c, d, e, f] = self.wrench;
        let push = SpatialForce::new(vector([a, b, c]), vector([d, e, f]));
        Ok((state, measured.then_some(push)))
    }
}

impl WrasseArmReference {
    /// The reference of a robot of so many links. The period holds its numbers against their bounds.
    pub(crate) fn read(&self, links: usize) -> Result<ArmReference<f64, WRASSE_JOINTS>, Refused> {
        match self.kind {
            WRASSE_REFERENCE_TOOL => self.tool(),
            WRASSE_REFERENCE_JOINTS => Ok(ArmReference::Joints(JointSetPoint {
                q: joints(&self.joint_position, links),
                v: joints(&self.joint_rate, links),
                vdot: joints(&self.joint_acceleration, links),
            })),
            WRASSE_REFERENCE_STILL => Ok(ArmReference::Still),
            WRASSE_REFERENCE_COAST => Ok(ArmReference::Coast),
            _ => {
                let (status, found) = (WrasseStatus::WRASSE_UNKNOWN_CHOICE, f64::from(self.kind));
                Err(refused(
                    status,
                    c"WrasseArmReference.kind",
                    ONLY,
                    found,
                    c"one of its constants",
                ))
            }
        }
    }

    fn tool(&self) -> Result<ArmReference<f64, WRASSE_JOINTS>, Refused> {
        let axes = choice(c"WrasseArmReference.axes", self.axes, [Axes::Inertial, Axes::Base])?;
        unit(c"WrasseArmReference.tool_attitude", &self.tool_attitude)?;
        Ok(ArmReference::Tool {
            reference: ToolMotion {
                X_NE: rotated(self.tool_attitude, self.tool_position),
                V_NE_N: twist(self.tool_velocity),
                Vdot_NE_N: twist(self.tool_acceleration),
            },
            axes,
            gain: self.posture_gain,
            gain_rate: self.posture_gain_rate,
        })
    }
}

impl WrasseControlOutput {
    /// The output of a period.
    pub(crate) fn from_output(output: &ControlOutput<f64, WRASSE_JOINTS>) -> Self {
        Self {
            joint_position: output.set_points.map(|s| s.position),
            joint_rate: output.set_points.map(|s| s.rate),
            joint_acceleration: output.set_points.map(|s| s.acceleration),
            effort: output.effort,
            attitude_torque: output.attitude_torque_B.to_array(),
            force_ahead: output.ahead_force_B.to_array(),
        }
    }
}

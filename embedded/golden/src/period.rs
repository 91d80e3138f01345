//! The control period that both sides run, and the states it is run on.

use crate::random::Random;
use crate::{atlas_class, atlas_class_two_arms};
use core::array;
use wrasse_dynamics::{Frame, Robot, State, kinematics};
use wrasse_flight::trajectory::ToolMotion;
use wrasse_flight::{
    ArmLaw, ArmReference, Assignment, Axes, BaseControlSetup, ControlOutput, Feedforward, JointUse,
    Measurement, NavigationSetup, PeriodMemory, Setup, Task, Tuning, control_period,
};
use wrasse_flight_c::{WrasseBody, WrasseFrame, WrasseLink, frame_from_table, robot_from_tables};
use wrasse_hardware::{JointLimits, List};
use wrasse_spatial::{Pose, Quat, Real, Scalar, SpatialVelocity, Vec3};

/// How many states each subject is run on.
pub const STATES: u32 = 1000;

/// Travel of each joint to either side (rad).
const TRAVEL: f64 = 3.05;

/// A vehicle and its laws.
#[derive(Debug)]
pub struct Subject<T, const J: usize> {
    /// The robot.
    pub robot: Robot<T, J>,
    /// Its laws; the tool is that of the first arm.
    pub setup: Setup<T, J>,
}

/// Where a period starts, and what it is asked for.
#[derive(Debug, Clone)]
pub struct Start<T, const J: usize> {
    /// What the sensors say.
    pub state: State<T, J>,
    memory: PeriodMemory<T, J>,
    asked: ArmReference<T, J>,
}

/// One arm of seven joints; nothing if its table is no robot, or has not the room.
pub fn one_arm<T: Scalar, const J: usize>(law: ArmLaw) -> Option<Subject<T, J>> {
    use atlas_class::{BASE, LINKS, TOOL};
    subject(&BASE, &LINKS, &TOOL, law)
}

/// Two arms of seven joints.
pub fn two_arms<T: Scalar, const J: usize>(law: ArmLaw) -> Option<Subject<T, J>> {
    use atlas_class_two_arms::{BASE, LINKS, TOOL};
    subject(&BASE, &LINKS, &TOOL, law)
}

fn subject<T: Scalar, const J: usize>(
    base: &WrasseBody,
    links: &[WrasseLink],
    tool: &WrasseFrame,
    law: ArmLaw,
) -> Option<Subject<T, J>> {
    let robot = robot_from_tables(base, links).ok()?;
    Some(Subject { robot, setup: setup(law, frame_from_table(tool)) })
}

/// Base measured each period, exact feedforward, limits on joint rates and torques.
fn setup<T: Real, const J: usize>(law: ArmLaw, tool: Frame<T>) -> Setup<T, J> {
    let c = T::from_f64;
    Setup {
        assignment: Assignment {
            tool,
            axes: Axes::Inertial,
            task: Task::Pose,
            law,
            damped_below: c(0.02),
        },
        joints: JointUse {
            gain: c(0.1),
            gain_rate: c(0.0),
            posture: [c(0.3); J],
            rate_limit: [c(0.2); J],
        },
        base: BaseControlSetup::ideal(Feedforward::Exact, Quat::identity()),
        navigation: NavigationSetup::perfect(),
        measurement: Measurement::Base,
        tuning: Tuning {
            period: c(0.01),
            tool_gain: c(2.0),
            joint_bandwidth: c(10.0),
            joint_damping: c(1.0),
            attitude_bandwidth: c(0.3),
            attitude_damping: c(1.0),
        },
        limits: [JointLimits { effort: Some(c(500.0)), ..JointLimits::default() }; J],
        position_driven: [false; J],
        followers: List::empty(),
    }
}

fn vector<T: Real>(random: &mut Random, limit: f64) -> Vec3<T> {
    Vec3::from_array(array::from_fn(|_| T::from_f64(random.within(limit))))
}

fn twist<T: Real>(random: &mut Random, limit: f64) -> SpatialVelocity<T> {
    SpatialVelocity::new(vector(random, limit), vector(random, limit))
}

/// Postures that span the travel: six of ten are singular, next to singular, or at its ends.
fn posture<const J: usize>(number: u32, random: &mut Random) -> [f64; J] {
    let mut q: [f64; J] = array::from_fn(|_| random.within(TRAVEL));
    for (j, q) in q.iter_mut().enumerate() {
        let elbow = j % 7 == 3;
        let wrist = j % 7 == 5;
        let shoulder = j % 7 == 1;
        match number % 10 {
            0 if elbow => *q = 0.0,
            1 if wrist => *q = 0.0,
            2 if shoulder || wrist => *q = 0.0,
            3 => *q = 0.0,
            4 if elbow || wrist => *q *= 1e-3,
            5 => *q = if *q < 0.0 { -TRAVEL } else { TRAVEL },
            _ => {}
        }
    }
    q
}

impl<T: Real, const J: usize> Subject<T, J> {
    /// The state of this number, after a first period that only looks around; the tool is asked to go
    /// on beside where it is.
    pub fn start(&self, number: u32) -> Start<T, J> {
        let mut random = Random::new(number);
        let state = State {
            X_NB: Pose::from_quat(Quat::exp(vector(&mut random, 1.5)), vector(&mut random, 3.0)),
            V_NB_B: twist(&mut random, 0.01),
            q: posture(number, &mut random).map(T::from_f64),
            v: array::from_fn(|_| T::from_f64(random.within(0.05))),
        };
        let mut memory = PeriodMemory::new();
        control_period(&self.robot, &self.setup, &mut memory, &state, &ArmReference::Still, None);
        let mut X_NE = kinematics(&self.robot, &state).pose(&self.setup.assignment.tool);
        X_NE.translation += vector(&mut random, 0.01);
        let (V_NE_N, Vdot_NE_N) = (twist(&mut random, 0.1), twist(&mut random, 0.1));
        let reference = ToolMotion { X_NE, V_NE_N, Vdot_NE_N };
        let (gain, gain_rate) = (T::from_f64(0.1), T::from_f64(0.2));
        Start {
            state,
            memory,
            asked: ArmReference::Tool { reference, axes: Axes::Inertial, gain, gain_rate },
        }
    }

    /// One control period: what the tool is asked for, from what is sensed to the torques.
    #[inline(never)]
    pub fn period(&self, start: &mut Start<T, J>) -> ControlOutput<T, J> {
        let Start { state, memory, asked } = start;
        control_period(&self.robot, &self.setup, memory, state, asked, None)
    }
}

/// Each number that a period tells.
pub fn numbers<T: Real, const J: usize>(told: &ControlOutput<T, J>) -> impl Iterator<Item = T> {
    let points = told.set_points.map(|p| [p.position, p.rate, p.acceleration]);
    let base = told.attitude_torque_B.to_array();
    points.into_iter().flatten().chain(told.effort).chain(base)
}

//! The control period that both sides run, and the states it is run on.

use crate::random::Random;
use crate::{atlas_class, atlas_class_two_arms};
use wrasse_dynamics::{Frame, Robot, State};
use wrasse_flight::{
    ArmLaw, Assignment, Axes, Belief, Feedforward, JointUse, Task, Tuning, attitude_torque,
    computed_torque, feedforward_torque, joint_rates,
};
use wrasse_flight_c::{WrasseBody, WrasseFrame, WrasseLink, frame_from_table, robot_from_tables};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Pose, Quat, Real, SpatialForce, SpatialVelocity, Vec3};

/// How many states each subject is run on.
pub const STATES: u32 = 1000;

/// A vehicle and a law.
#[derive(Debug)]
pub struct Subject<T, const J: usize> {
    /// The robot.
    pub robot: Robot<T, J>,
    /// Its tool, at the end of the first arm.
    pub tool: Frame<T>,
    law: ArmLaw,
}

/// Where a period starts, and what it is asked for.
#[derive(Debug)]
pub struct Start<T, const J: usize> {
    /// What the sensors say.
    pub state: State<T, J>,
    wanted: SpatialVelocity<T>,
}

/// What a period gives.
#[derive(Debug)]
pub struct Given<T, const J: usize> {
    qdot: [T; J],
    effort: [T; J],
    feedforward: Vec3<T>,
    attitude: Vec3<T>,
}

fn subject<T: Real, const J: usize>(
    base: &WrasseBody,
    links: &[WrasseLink],
    tool: &WrasseFrame,
    law: ArmLaw,
) -> Option<Subject<T, J>> {
    let robot = robot_from_tables(base, links).ok()?;
    Some(Subject { robot, tool: frame_from_table(tool), law })
}

/// One arm of seven joints; nothing if its table is no robot.
pub fn one_arm<T: Real>(law: ArmLaw) -> Option<Subject<T, 7>> {
    use atlas_class::{BASE, LINKS, TOOL};
    subject(&BASE, &LINKS, &TOOL, law)
}

/// Two arms of seven joints.
pub fn two_arms<T: Real>(law: ArmLaw) -> Option<Subject<T, 14>> {
    use atlas_class_two_arms::{BASE, LINKS, TOOL};
    subject(&BASE, &LINKS, &TOOL, law)
}

fn vector<T: Real>(random: &mut Random, limit: f64) -> Vec3<T> {
    Vec3::from_array(core::array::from_fn(|_| T::from_f64(random.within(limit))))
}

impl<T: Real, const J: usize> Subject<T, J> {
    /// The state of this number.
    pub fn start(&self, number: u32) -> Start<T, J> {
        let mut random = Random::new(number);
        let turn = vector(&mut random, 1.0);
        let state = State {
            X_NB: Pose::from_quat(Quat::exp(turn), vector(&mut random, 5.0)),
            V_NB_B: SpatialVelocity::new(vector(&mut random, 0.01), vector(&mut random, 0.02)),
            q: core::array::from_fn(|_| T::from_f64(random.within(3.0))),
            v: core::array::from_fn(|_| T::from_f64(random.within(0.2))),
        };
        let wanted = SpatialVelocity::new(vector(&mut random, 0.05), vector(&mut random, 0.1));
        Start { state, wanted }
    }

    /// One control period.
    #[inline(never)]
    pub fn period(&self, start: &Start<T, J>) -> Given<T, J> {
        let c = T::from_f64;
        let to = Assignment {
            tool: self.tool,
            axes: Axes::Inertial,
            task: Task::Pose,
            law: self.law,
            damped_below: c(0.02),
        };
        let joints = JointUse {
            gain: c(0.0),
            gain_rate: c(0.0),
            posture: [c(0.0); J],
            rate_limit: [c(0.5); J],
        };
        let tuning = Tuning {
            period: c(0.01),
            tool_gain: c(1.0),
            joint_bandwidth: c(5.0),
            joint_damping: c(0.7),
            attitude_bandwidth: c(0.3),
            attitude_damping: c(0.7),
        };
        let belief = Belief { X_NB: start.state.X_NB, q: start.state.q, h_Scm_N: SpatialForce::zero() };
        let rates = joint_rates(&self.robot, &to, &belief, &start.wanted, &joints);
        let mut now = [SetPoint::default(); J];
        for j in 0..J {
            now[j] = SetPoint { position: start.state.q[j], rate: rates.qdot[j], acceleration: c(0.1) };
        }
        let acceleration = [c(0.1); J];
        let effort = computed_torque(&self.robot, self.law, &tuning, &start.state, &now, &acceleration);
        let feedforward = feedforward_torque(&self.robot, Feedforward::Exact, &now);
        let I = wrasse_spatial::Sym3::diagonal(c(1.0), c(1.0), c(1.0));
        let attitude = attitude_torque(
            &tuning,
            &I,
            &Quat::identity(),
            start.state.V_NB_B.angular,
            &Quat::identity(),
        );
        Given { qdot: rates.qdot, effort, feedforward, attitude }
    }
}

impl<T: Real, const J: usize> Given<T, J> {
    /// Each number that came out.
    pub fn numbers(&self) -> impl Iterator<Item = T> + '_ {
        let vectors = [self.feedforward, self.attitude];
        let vectors = vectors.into_iter().flat_map(Vec3::to_array);
        self.qdot.into_iter().chain(self.effort).chain(vectors)
    }
}

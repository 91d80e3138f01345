//! A servicer with one or two arms of seven joints, in 1,000 states that span what it can do: anywhere
//! in its travel, at the ends of it, in singular postures and next to them.

use std::f64::consts::PI;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State, kinematics};
use wrasse_flight::trajectory::ToolMotion;
use wrasse_flight::{
    ArmLaw, ArmReference, Assignment, Axes, BaseControlSetup, ControlOutput, Feedforward, JointUse,
    Measurement, NavigationSetup, PeriodMemory, Setup, Task, Tuning, control_period,
};
use wrasse_hardware::{JointLimits, List};
use wrasse_spatial::{Mat3, Pose, Quat, Real, SpatialMomentum, SpatialVelocity, Sym3, Vec3, vec3};

/// How many states there are.
pub(crate) const STATES: usize = 1000;
/// Travel of each joint to either side (rad).
const TRAVEL: f64 = 0.97 * PI;
/// Joints of one arm.
const ARM: usize = 7;

/// Numbers that are spread evenly, the same every time.
struct Spread(u64);

impl Spread {
    /// Between -1 and 1.
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64) / ((1_u64 << 52) as f64) - 1.0
    }
    fn vector(&mut self, size: f64) -> Vec3<f64> {
        vec3(self.next(), self.next(), self.next()) * size
    }
    fn twist(&mut self, size: f64) -> SpatialVelocity<f64> {
        SpatialVelocity::new(self.vector(size), self.vector(size))
    }
}

/// A bus of 1500 kg with `J / 7` arms, and the tool of the first of them.
pub(crate) fn servicer<const J: usize>() -> (Robot<f64, J>, Frame<f64>) {
    let bus = MassProperties::from_central(
        1500.0,
        vec3(0.02, -0.01, 0.05),
        Sym3::diagonal(640.0, 725.0, 725.0),
    );
    let mut links = vec![];
    for arm in 0..J / ARM {
        let side = if arm == 0 { 0.5 } else { -0.5 };
        links.extend(arm_links(arm * ARM, vec3(0.9, side, 0.0)));
    }
    let X_BF = Pose::new(Mat3::identity(), vec3(0.2, 0.0, 0.0));
    let tool = Frame { body: BodyId::Link(ARM - 1), X_BF };
    (Robot::new(bus, &links).expect("parents come first"), tool)
}

/// Shoulder x, y, x, elbow y, wrist x, y, x, with 0.45, 0.40 and 0.20 m between them and the tool.
fn arm_links(first: usize, mount: Vec3<f64>) -> Vec<(Joint<f64>, MassProperties<f64>)> {
    let (o, x, y) = (Vec3::zero(), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
    // From the joint before (m), axis, mass (kg), centre of mass along x (m), inertias (kg·m²).
    let rows = [
        (mount, x, 10.0, 0.0, 0.018, 0.021),
        (o, y, 10.0, 0.05, 0.018, 0.021),
        (o, x, 8.0, 0.225, 0.0144, 0.1422),
        (vec3(0.45, 0.0, 0.0), y, 8.0, 0.05, 0.0144, 0.0168),
        (o, x, 6.0, 0.2, 0.0108, 0.0854),
        (vec3(0.4, 0.0, 0.0), y, 6.0, 0.03, 0.0108, 0.0104),
        (o, x, 8.0, 0.1, 0.0144, 0.0339),
    ];
    let mut links = vec![];
    for (i, (p, axis, mass, cm, along, across)) in rows.into_iter().enumerate() {
        let parent = if i == 0 { BodyId::Base } else { BodyId::Link(first + i - 1) };
        let joint = Joint::new(parent, JointKind::Revolute, Pose::new(Mat3::identity(), p), axis);
        let I = Sym3::diagonal(along, across, across);
        links.push((joint, MassProperties::from_central(mass, vec3(cm, 0.0, 0.0), I)));
    }
    links
}

/// Laws for it: base measured each period, exact feedforward, limits on joint rates and torques.
pub(crate) fn setup<const J: usize>(law: ArmLaw, tool: Frame<f64>) -> Setup<f64, J> {
    Setup {
        assignment: Assignment {
            tool,
            axes: Axes::Inertial,
            task: Task::Pose,
            law,
            damped_below: 0.02,
        },
        joints: JointUse { gain: 0.1, gain_rate: 0.0, posture: [0.3; J], rate_limit: [0.2; J] },
        base: BaseControlSetup::ideal(Feedforward::Exact, Quat::identity()),
        navigation: NavigationSetup::perfect(),
        measurement: Measurement::Base,
        tuning: Tuning {
            period: 0.01,
            tool_gain: 2.0,
            joint_bandwidth: 10.0,
            joint_damping: 1.0,
            attitude_bandwidth: 0.3,
            attitude_damping: 1.0,
        },
        limits: [JointLimits { effort: Some(500.0), ..JointLimits::default() }; J],
        position_driven: [false; J],
        followers: List::empty(),
    }
}

/// The states, always the same ones.
pub(crate) fn states<const J: usize>() -> Vec<State<f64, J>> {
    let mut spread = Spread(20_040_901);
    (0..STATES).map(|k| state(k, &mut spread)).collect()
}

fn state<const J: usize>(k: usize, spread: &mut Spread) -> State<f64, J> {
    let mut q: [f64; J] = std::array::from_fn(|_| spread.next() * TRAVEL);
    match k % 10 {
        // Stretched or folded elbow, aligned wrist, aligned shoulder, and all of it.
        0 => q[3] = 0.0,
        1 => q[5] = 0.0,
        2 => (q[1], q[5]) = (0.0, 0.0),
        3 => q = [0.0; J],
        // Next to that.
        4 => (q[3], q[5]) = (1e-6 * q[3], 1e-3 * q[5]),
        // At the ends of the travel.
        5 => q = q.map(|q| TRAVEL * q.signum()),
        _ => {}
    }
    State {
        X_NB: Pose::from_quat(Quat::exp(spread.vector(2.0)), spread.vector(3.0)),
        V_NB_B: spread.twist(0.01),
        q,
        v: std::array::from_fn(|_| 0.05 * spread.next()),
    }
}

/// The second control period in a state: the first one only looks around.
pub(crate) struct Period<const J: usize> {
    memory: PeriodMemory<f64, J>,
    state: State<f64, J>,
    asked: ArmReference<f64, J>,
}

impl<const J: usize> Period<J> {
    /// The tool is asked to go on beside where it is.
    pub(crate) fn new(
        robot: &Robot<f64, J>,
        setup: &Setup<f64, J>,
        state: State<f64, J>,
        k: usize,
    ) -> Self {
        let mut memory = PeriodMemory::new();
        control_period(robot, setup, &mut memory, &state, &ArmReference::Still, None);
        let mut spread = Spread(k as u64);
        let mut X_NE = kinematics(robot, &state).pose(&setup.assignment.tool);
        X_NE.translation += spread.vector(0.01);
        let reference =
            ToolMotion { X_NE, V_NE_N: spread.twist(0.1), Vdot_NE_N: spread.twist(0.1) };
        let asked =
            ArmReference::Tool { reference, axes: Axes::Inertial, gain: 0.1, gain_rate: 0.2 };
        Self { memory, state, asked }
    }
    /// The vehicle as it is believed to move after the period.
    pub(crate) fn believed_state(&self) -> State<f64, J> {
        self.memory.believed_state()
    }
    /// The momentum that it is believed to have.
    pub(crate) fn believed_momentum(&self) -> SpatialMomentum<f64> {
        self.memory.belief.h_Scm_N
    }
    /// Flies both periods over another scalar, from the same numbers.
    pub(crate) fn flown_in<T: Real>(
        &self,
        robot: &Robot<f64, J>,
        setup: &Setup<f64, J>,
    ) -> ControlOutput<T, J> {
        let ArmReference::Tool { reference, axes, gain, gain_rate } = self.asked else {
            panic!("the tool is asked for")
        };
        let (robot, setup, c) = (robot.cast(), setup.bare(), T::from_f64);
        let twist = |V: SpatialVelocity<f64>| SpatialVelocity::from_array(V.to_array().map(c));
        let state = State {
            X_NB: Pose::from_f64(&self.state.X_NB),
            V_NB_B: twist(self.state.V_NB_B),
            q: self.state.q.map(c),
            v: self.state.v.map(c),
        };
        let reference = ToolMotion {
            X_NE: Pose::from_f64(&reference.X_NE),
            V_NE_N: twist(reference.V_NE_N),
            Vdot_NE_N: twist(reference.Vdot_NE_N),
        };
        let asked = ArmReference::Tool { reference, axes, gain: c(gain), gain_rate: c(gain_rate) };
        let mut memory = PeriodMemory::new();
        control_period(&robot, &setup, &mut memory, &state, &ArmReference::Still, None);
        control_period(&robot, &setup, &mut memory, &state, &asked, None)
    }
    /// Flies it.
    pub(crate) fn fly(
        &mut self,
        robot: &Robot<f64, J>,
        setup: &Setup<f64, J>,
    ) -> ControlOutput<f64, J> {
        control_period(robot, setup, &mut self.memory, &self.state, &self.asked, None)
    }
}

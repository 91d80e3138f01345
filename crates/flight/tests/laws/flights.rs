//! Flights of the ATLAS-class servicer, with everything sensed as the computer believes it.

use wrasse_dynamics::{Robot, State};
use wrasse_flight::{
    ArmLaw, Assignment, Axes, BadPhase, BaseControlSetup, Command, Feedforward, FlightComputer,
    JointUse, Measurement, NavigationSetup, Phase, Sensed, Setup, Target, Task, Timing, Tuning,
};
use wrasse_hardware::{ActuatorReadings, JointLimits, List};
use wrasse_spatial::{Pose, Quat, Real, Scalar, SpatialVelocity, Vec3, vec3};
use wrasse_testing::arms::{atlas_class, cube};

/// Control period (s).
pub(crate) const PERIOD: f64 = 0.01;

/// The servicer with 200 kg in its grip.
pub(crate) fn robot() -> Robot<f64, 7> {
    let (robot, tool) = atlas_class();
    robot.with_payload(&tool, &cube(200.0, vec3(0.0, 0.1, -0.2)))
}

/// Somewhere in space, with the arm ready to go sideways, turning and drifting.
pub(crate) fn drifting() -> State<f64, 7> {
    let q =
        [10.310_339, -35.907_342, -34.307_017, 107.791_591, -19.778_032, -77.655_586, 23.013_652];
    State {
        X_NB: Pose::from_quat(Quat::exp(vec3(0.2, -0.4, 0.3)), vec3(1.0, 2.0, -0.5)),
        V_NB_B: SpatialVelocity::from_array([0.002, -0.001, 0.0015, 0.003, 0.002, -0.004]),
        q: q.map(f64::to_radians),
        v: [0.0; 7],
    }
}

/// The same at rest.
pub(crate) fn at_rest() -> State<f64, 7> {
    State { V_NB_B: SpatialVelocity::zero(), ..drifting() }
}

/// The usual numbers, by this law.
pub(crate) fn setup<T: Scalar>(law: ArmLaw, measurement: Measurement) -> Setup<T, 7> {
    let c = T::from_f64;
    let (_, tool) = atlas_class();
    Setup {
        assignment: Assignment {
            tool: wrasse_dynamics::Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) },
            axes: Axes::Inertial,
            task: Task::Pose,
            law,
            damped_below: c(0.02),
        },
        joints: JointUse {
            gain: c(0.0),
            gain_rate: c(0.0),
            posture: [c(0.0); 7],
            rate_limit: [c(1e3); 7],
        },
        base: BaseControlSetup::ideal(Feedforward::Exact, Quat::identity()),
        navigation: NavigationSetup::perfect(),
        measurement,
        tuning: Tuning {
            period: c(PERIOD),
            tool_gain: c(2.0),
            joint_bandwidth: c(10.0),
            joint_damping: c(1.0),
            attitude_bandwidth: c(0.3),
            attitude_damping: c(1.0),
        },
        limits: [JointLimits::default(); 7],
        position_driven: [false; 7],
        followers: List::empty(),
    }
}

/// The tool goes aside by 0.2 m and turns by 0.2 rad on the way.
pub(crate) fn aside<T: Real>(axes: Axes, duration: T) -> Phase<T, 7> {
    let target = Target::By {
        displacement: Vec3::from_f64(vec3(0.05, 0.2, -0.03)),
        turn: Vec3::from_f64(vec3(0.0, 0.2, 0.1)),
    };
    Phase::MoveTool { target, axes, timing: Timing::Duration(duration) }
}

/// A computer, and what its sensors say at the start.
pub(crate) struct Flight<T, const J: usize> {
    pub(crate) computer: FlightComputer<T, J>,
    start: Option<State<T, J>>,
}

impl Flight<f64, 7> {
    pub(crate) fn new(
        setup: &Setup<f64, 7>,
        start: State<f64, 7>,
        phases: &[Phase<f64, 7>],
    ) -> Self {
        Self { computer: FlightComputer::new(*setup, &robot(), phases), start: Some(start) }
    }
}

impl<T: Scalar, const J: usize> Flight<T, J> {
    pub(crate) fn with(computer: FlightComputer<T, J>, start: State<T, J>) -> Self {
        Self { computer, start: Some(start) }
    }
    /// What the computer believes, or the start.
    pub(crate) fn state(&self) -> State<T, J> {
        self.start.unwrap_or_else(|| self.computer.believed_state())
    }
    /// One period, sensed as believed.
    pub(crate) fn step(&mut self) -> Result<Command<T, J>, BadPhase<T>> {
        let sensed = Sensed::perfect(&self.state(), ActuatorReadings::default());
        self.start = None;
        self.computer.step(&sensed)
    }
    /// All periods until the phases are done.
    pub(crate) fn fly_on(&mut self) -> Vec<Command<T, J>> {
        let mut commands = vec![];
        while !self.computer.done() {
            assert!(commands.len() < 10_000, "it never ends");
            commands.push(self.step().unwrap());
        }
        commands
    }
}

//! The flight computer: which phase, where the tool should be, what the actuators are told.

use crate::base_control::{BaseControl, BaseControlSetup};
use crate::control_period::{Asked, PeriodMemory, at_rest, momentum_of};
use crate::door::{Axes, Command, Grip, Sensed};
use crate::law::{Measurement, Tuning};
use crate::navigation::{Navigation, NavigationSetup};
use crate::phase::{Held, JointTarget, Path, Phase};
use crate::resolved_motion::{Assignment, Belief, JointUse};
use crate::sequence::{BadPhase, NoWay, Sequence};
use crate::steering::{NoRelief, ReliefUse, ToolTask, Unit, posture_relief};
use crate::tool_pose::joints_for_tool;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Robot, State, kinematics};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Scalar, SpatialForce};

/// Time in which joints take up the rates that relieve the base (s).
const RELIEF_APPROACH: f64 = 0.5;

/// How a flight computer is set up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup<T, const J: usize> {
    /// What is asked of the arm; its axes are those of the current phase.
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
}

/// What flies: one call per control period.
///
/// It decides what is asked: phases, estimates, steering. [`control_period`](crate::control_period)
/// turns that into set-points and torques.
#[derive(Debug, Clone)]
pub struct FlightComputer<T, const J: usize> {
    pub(crate) setup: Setup<T, J>,
    pub(crate) robot: Robot<T, J>,
    pub(crate) navigation: Navigation<T, J>,
    base_control: BaseControl<T>,
    pub(crate) sequence: Sequence<T, J>,
    pub(crate) path: Path<T, J>,
    pub(crate) memory: PeriodMemory<T, J>,
    /// Why the posture cannot relieve the base, if it was asked to.
    no_relief: Option<NoRelief<T>>,
}

impl<T: Scalar, const J: usize> FlightComputer<T, J> {
    /// A computer for this robot (with what it holds at the start) and these phases; those beyond
    /// [`PHASES`](crate::PHASES) are left out.
    pub fn new(setup: Setup<T, J>, robot: &Robot<f64, J>, phases: &[Phase<T, J>]) -> Self {
        Self {
            setup,
            robot: robot.cast(),
            navigation: Navigation::new(&setup.navigation),
            base_control: BaseControl::new(setup.base),
            sequence: Sequence::new(phases),
            path: Path::Still(Held::Joints),
            memory: PeriodMemory::new(),
            no_relief: None,
        }
    }

    /// One control period: from what the sensors say to what the actuators are told.
    ///
    /// # Errors
    /// If a phase begins whose numbers describe no motion.
    pub fn step(&mut self, sensed: &Sensed<T, J>) -> Result<Command<T, J>, BadPhase<T>> {
        let period = self.setup.tuning.period;
        let state = self.navigation.estimate(sensed, &self.memory.acceleration, period);
        self.memory.look(&self.robot, &self.setup, &state);
        let mut grip = None;
        if self.sequence.is_over() {
            let begun = self.begin_next();
            let phase = self.sequence.number();
            grip = begun.map_err(|reason| BadPhase { phase, reason })?;
        }
        let elapsed = self.sequence.tick();
        let asked = self.asked(T::from_f64(f64::from(elapsed)) * period, sensed);
        let push = sensed.tool_wrench_E.as_ref();
        let told = self.memory.act(&self.robot, &self.setup, &state, &asked, push);
        let steered = match asked {
            Asked::Coast => self.base_control.rest(),
            _ => self.base_control.command(
                &self.robot,
                &self.setup.tuning,
                &told,
                &state,
                &sensed.actuators,
            ),
        };
        Ok(Command {
            set_points: told.set_points,
            effort: told.effort,
            attitude_torque_B: told.attitude_torque_B,
            actuators: steered.command,
            steering: steered.report,
            no_relief: self.no_relief,
            grip,
            phase: self.sequence.number(),
            reference: self.memory.reference,
            axes: self.memory.axes,
        })
    }

    /// Pose of the tool as it is believed to be.
    pub(crate) fn believed_tool(&self, axes: Axes) -> Pose<T> {
        let belief = &self.memory.belief;
        let X_NB = match axes {
            Axes::Inertial => belief.X_NB,
            Axes::Base => Pose::identity(),
        };
        let state = State { X_NB, q: belief.q, ..State::default() };
        kinematics(&self.robot, &state).pose(&self.setup.assignment.tool)
    }

    /// Begin the next phase; what it tells the grip.
    fn begin_next(&mut self) -> Result<Option<Grip>, NoWay<T>> {
        let period = self.setup.tuning.period;
        let mut grip = None;
        let (path, duration) = match self.sequence.next() {
            None => {
                self.path = Path::Still(Held::Joints);
                return Ok(None);
            }
            Some(Phase::MoveTool { target, axes, timing }) => {
                let from = self.believed_tool(axes);
                let line = timing.line(from, target.from(&from))?;
                (Path::Line(line, axes), line.duration())
            }
            Some(Phase::MoveJoints { to, timing }) => {
                let way = timing.way(self.memory.belief.q, self.joint_target(to)?)?;
                (Path::Joints(way), way.duration())
            }
            Some(Phase::Hold { what, duration }) => (Path::Still(what), duration),
            Some(Phase::Relieve { task, gain, duration }) => {
                (Path::Relief { task, gain }, duration)
            }
            Some(Phase::Grip(told)) => {
                grip = Some(told);
                (Path::Still(Held::Joints), period)
            }
        };
        self.path = path;
        self.sequence.lasts(duration, period)?;
        Ok(grip)
    }

    /// Joint positions (rad or m) to go to.
    fn joint_target(&self, to: JointTarget<T, J>) -> Result<[T; J], NoWay<T>> {
        let q = self.memory.belief.q;
        match to {
            JointTarget::Positions(to) => Ok(core::array::from_fn(|j| to[j].unwrap_or(q[j]))),
            JointTarget::Tool(X, axes) => {
                let (tool, law) = (&self.setup.assignment.tool, self.setup.assignment.law);
                let state = State { X_NB: self.memory.belief.X_NB, q, ..State::default() };
                joints_for_tool(&self.robot, tool, &state, &X, axes, law, &self.setup.limits)
                    .map_err(NoWay::Unreachable)
            }
        }
    }

    /// What is asked of the arm at time `t` (s) of the phase.
    fn asked(&mut self, t: T, sensed: &Sensed<T, J>) -> Asked<T, J> {
        self.no_relief = None;
        match self.path {
            Path::Line(line, axes) => self.on_tool(line.at(t), axes, t),
            Path::Still(Held::Tool) => {
                self.on_tool(at_rest(self.memory.reference.X_NE), self.memory.axes, t)
            }
            Path::Joints(path) => Asked::Joints(path.at(t)),
            Path::Relief { task, gain } => {
                let F_E = sensed.tool_wrench_E.unwrap_or_default();
                let (qdot, qddot) = self.relieve(task, gain, t, &F_E);
                Asked::Rates { qdot, qddot }
            }
            Path::Still(Held::Joints) => Asked::Still,
            Path::Still(Held::Nothing) => Asked::Coast,
        }
    }

    /// The tool on a motion, at time `t` (s) of the phase: the drift to the posture comes and goes as
    /// the speed of a quintic does, `30 s² (1 - s)²`, for rates that jumped would ask for any torque.
    fn on_tool(&self, reference: ToolMotion<T>, axes: Axes, t: T) -> Asked<T, J> {
        let (c, gain) = (T::from_f64, self.setup.joints.gain);
        let duration = self.sequence.duration(self.setup.tuning.period);
        let s = t / duration;
        let rest = T::one() - s;
        Asked::Tool {
            reference,
            axes,
            gain: gain * c(30.0) * s * s * rest * rest,
            gain_rate: gain * c(60.0) * s * rest * (rest - s) / duration,
        }
    }

    /// Joint rates and accelerations at time `t` (s) that lower what the push at the tool asks of the
    /// base: what would be best is approached, and left in time before the phase ends, for rates that
    /// jumped would ask for any torque.
    fn relieve(
        &mut self,
        task: ToolTask,
        gain: T,
        t: T,
        F_E: &SpatialForce<T>,
    ) -> ([T; J], [T; J]) {
        let period = self.setup.tuning.period;
        let Belief { X_NB, q, .. } = self.memory.predicted(&self.robot, period);
        let state = State { X_NB, q, ..self.believed_state() };
        let approach = T::from_f64(RELIEF_APPROACH);
        let left = self.sequence.duration(period) - t;
        let k = kinematics(&self.robot, &state);
        let R_NE = k.pose(self.tool()).rotation;
        let F_N = SpatialForce::new(R_NE * F_E.torque, R_NE * F_E.force);
        let joints = ReliefUse { task, gain, rate_limit: self.setup.joints.rate_limit };
        let mut best = [T::zero(); J];
        match posture_relief(&k, self.tool(), &F_N, &joints) {
            Ok(relief) if left > approach * T::from_f64(6.0) => best = relief.qdot,
            Ok(_) => {}
            Err(reason) => self.no_relief = Some(reason),
        }
        let (mut qdot, mut qddot) = (state.v, [T::zero(); J]);
        for j in self.robot.joints() {
            qddot[j] = (best[j] - qdot[j]) / approach;
            qdot[j] += qddot[j] * period;
        }
        (qdot, qddot)
    }

    /// Do without a unit of the base's equipment from now on.
    pub fn isolate(&mut self, unit: Unit) {
        self.base_control.isolate(unit);
    }

    /// The robot has taken hold of something, or let go: what it is from now on.
    pub fn robot_changed(&mut self, robot: &Robot<f64, J>) {
        self.robot = robot.cast();
        let believed = self.believed_state();
        self.memory.belief.h_Scm_N = momentum_of(&self.robot, &believed);
    }
}

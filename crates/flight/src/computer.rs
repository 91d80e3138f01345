//! The flight computer: which phase, where the tool should be, what the actuators are told.

use crate::base_control::{BaseControl, BaseControlSetup};
use crate::computed_torque::computed_torque;
use crate::door::{Axes, Command, Grip, Sensed};
use crate::feedforward::feedforward_torque;
use crate::law::{ArmLaw, Measurement, Tuning};
use crate::navigation::{Navigation, NavigationSetup};
use crate::phase::{Held, JointTarget, Path, Phase};
use crate::resolved_motion::{
    Assignment, Belief, JointUse, Resolved, ResolvedMotion, WantedMotion, answered_motion,
    answered_twist, moved_on, resolved_motion,
};
use crate::sequence::{BadPhase, NoWay, Sequence};
use crate::steering::{NoRelief, ReliefUse, Steered, ToolTask, Unit, posture_relief};
use crate::tool_pose::joints_for_tool;
use crate::tool_wrench::against_tool_wrench;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Robot, State, kinematics, mass_matrix, momentum};
use wrasse_hardware::{JointLimits, SetPoint, SetPointMotion};
use wrasse_spatial::{
    Dual, Pose, Quat, Scalar, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3,
};

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
#[derive(Debug, Clone)]
pub struct FlightComputer<T, const J: usize> {
    pub(crate) setup: Setup<T, J>,
    pub(crate) robot: Robot<T, J>,
    dual_robot: Robot<Dual<T>, J>,
    pub(crate) navigation: Navigation<T, J>,
    base_control: BaseControl<T>,
    pub(crate) sequence: Sequence<T, J>,
    pub(crate) path: Path<T, J>,
    /// Whether the sensors were read once.
    started: bool,
    pub(crate) belief: Belief<T, J>,
    /// Set-points and motion at the start of the coming period.
    now: [SetPoint<T>; J],
    pub(crate) motion: ResolvedMotion<T, J>,
    /// Measured twist of the base less the one that the law believed in (rad/s, m/s).
    surprise: SpatialVelocity<T>,
    pub(crate) reference: ToolMotion<T>,
    pub(crate) axes: Axes,
    /// Mean joint acceleration that was asked for over the last period (rad/s² or m/s²).
    acceleration: [T; J],
    /// What pushes at the tool, at its origin in its axes, if that is felt.
    tool_wrench_E: Option<SpatialForce<T>>,
    /// Why the posture cannot relieve the base, if it was asked to.
    no_relief: Option<NoRelief<T>>,
}

impl<T: Scalar, const J: usize> FlightComputer<T, J> {
    /// A computer for this robot (with what it holds at the start) and these phases; those beyond
    /// [`PHASES`](crate::PHASES) are left out.
    pub fn new(setup: Setup<T, J>, robot: &Robot<f64, J>, phases: &[Phase<T, J>]) -> Self {
        let rest = Resolved { qdot: [T::zero(); J], V_NB_B: SpatialVelocity::zero() };
        Self {
            setup,
            robot: robot.cast(),
            dual_robot: robot.cast(),
            navigation: Navigation::new(&setup.navigation),
            base_control: BaseControl::new(setup.base),
            sequence: Sequence::new(phases),
            path: Path::Still(Held::Joints),
            started: false,
            belief: Belief {
                X_NB: Pose::identity(),
                q: [T::zero(); J],
                h_Scm_N: SpatialMomentum::zero(),
            },
            now: [SetPoint::default(); J],
            motion: ResolvedMotion {
                rate: rest,
                qddot: [T::zero(); J],
                A_NB_B: SpatialVelocity::zero(),
            },
            surprise: SpatialVelocity::zero(),
            reference: ToolMotion {
                X_NE: Pose::identity(),
                V_NE_N: SpatialVelocity::zero(),
                Vdot_NE_N: SpatialVelocity::zero(),
            },
            axes: Axes::Inertial,
            acceleration: [T::zero(); J],
            tool_wrench_E: None,
            no_relief: None,
        }
    }

    /// One control period: from what the sensors say to what the actuators are told.
    ///
    /// # Errors
    /// If a phase begins whose numbers describe no motion.
    pub fn step(&mut self, sensed: &Sensed<T, J>) -> Result<Command<T, J>, BadPhase<T>> {
        let period = self.setup.tuning.period;
        let state = self.navigation.estimate(sensed, &self.acceleration, period);
        self.look(&state);
        (self.tool_wrench_E, self.no_relief) = (sensed.tool_wrench_E, None);
        let mut grip = None;
        if self.sequence.is_over() {
            let begun = self.begin_next();
            let phase = self.sequence.number();
            grip = begun.map_err(|reason| BadPhase { phase, reason })?;
        }
        let elapsed = self.sequence.tick();
        let (from, began) = (self.belief, self.motion);
        self.predict(period);
        self.follow(T::from_f64(f64::from(elapsed)) * period);
        self.correct(&from, &began, period);
        let mut next = [SetPoint::default(); J];
        for j in self.robot.joints() {
            next[j] = SetPoint {
                position: self.belief.q[j],
                rate: self.motion.rate.qdot[j],
                acceleration: self.motion.qddot[j],
            };
        }
        let mut command = self.command_between(&state, sensed, &next);
        command.grip = grip;
        self.now = next;
        Ok(command)
    }

    /// Take from the sensors what the laws may take.
    fn look(&mut self, sensed: &State<T, J>) {
        let measured = self.setup.measurement == Measurement::Base;
        if measured || !self.started {
            self.belief.X_NB = sensed.X_NB;
            self.belief.h_Scm_N = momentum_of(&self.robot, sensed);
        }
        let coasting = matches!(self.path, Path::Still(Held::Nothing));
        if !self.started || coasting {
            self.start_from(sensed);
        }
        if measured {
            self.surprise = sensed.V_NB_B - self.motion.rate.V_NB_B;
            self.motion.rate.V_NB_B = sensed.V_NB_B;
        }
    }

    /// Begin where the joints are, with the base moving as the law says: at the start, and as long
    /// as nothing drives them.
    fn start_from(&mut self, sensed: &State<T, J>) {
        self.started = true;
        self.belief.q = sensed.q;
        for j in self.robot.joints() {
            self.now[j] = SetPoint { position: sensed.q[j], rate: sensed.v[j], ..self.now[j] };
        }
        self.motion = self.answer(&sensed.v, &[T::zero(); J]);
        self.reference = at_rest(self.believed_tool(Axes::Inertial));
    }

    /// How the base is believed to answer joint motion.
    fn answer(&self, qdot: &[T; J], qddot: &[T; J]) -> ResolvedMotion<T, J> {
        let law = self.setup.assignment.law;
        answered_motion(&self.robot, &self.dual_robot, law, &self.belief, qdot, qddot)
    }

    /// Pose of the tool as it is believed to be.
    pub(crate) fn believed_tool(&self, axes: Axes) -> Pose<T> {
        let X_NB = match axes {
            Axes::Inertial => self.belief.X_NB,
            Axes::Base => Pose::identity(),
        };
        let state = State { X_NB, q: self.belief.q, ..State::default() };
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
                let way = timing.way(self.belief.q, self.joint_target(to)?)?;
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
        let q = self.belief.q;
        match to {
            JointTarget::Positions(to) => Ok(core::array::from_fn(|j| to[j].unwrap_or(q[j]))),
            JointTarget::Tool(X, axes) => {
                let (tool, law) = (&self.setup.assignment.tool, self.setup.assignment.law);
                let state = State { X_NB: self.belief.X_NB, q, ..State::default() };
                joints_for_tool(&self.robot, tool, &state, &X, axes, law, &self.setup.limits)
                    .map_err(NoWay::Unreachable)
            }
        }
    }

    /// Where the vehicle is believed to be one period on, first from its motion now alone.
    fn predict(&mut self, period: T) {
        let half = T::from_f64(0.5) * period;
        for j in self.robot.joints() {
            let mean = self.motion.rate.qdot[j] + self.motion.qddot[j] * half;
            self.belief.q[j] += mean * period;
        }
        let mean = self.motion.rate.V_NB_B + self.motion.A_NB_B * half;
        self.belief.X_NB = moved_on(&self.belief.X_NB, &mean, period);
    }

    /// The same again once the motion at the end is known too: `Δ = h (v₀ + v₁)/2 + h² (a₀ - a₁)/12`,
    /// of fourth order in the joints, where it is what joins the set-points without a wiggle; of second
    /// order in a base that turns about a changing axis.
    fn correct(&mut self, from: &Belief<T, J>, began: &ResolvedMotion<T, J>, period: T) {
        let (half, twelfth) = (T::from_f64(0.5), T::from_f64(1.0 / 12.0) * period);
        let ended = self.motion;
        if self.follows_tool() {
            for j in self.robot.joints() {
                let mean = (began.rate.qdot[j] + ended.rate.qdot[j]) * half
                    + (began.qddot[j] - ended.qddot[j]) * twelfth;
                self.belief.q[j] = from.q[j] + mean * period;
            }
        }
        let mean = (began.rate.V_NB_B + ended.rate.V_NB_B) * half
            + (began.A_NB_B - ended.A_NB_B) * twelfth;
        self.belief.X_NB = moved_on(&from.X_NB, &mean, period);
        // The joints are not quite where they were when the base's answer was worked out.
        let law = self.setup.assignment.law;
        self.motion.rate.V_NB_B =
            answered_twist(&self.robot, law, &self.belief, &self.motion.rate.qdot);
    }

    /// Joint motion at time `t` (s) of the path.
    fn follow(&mut self, t: T) {
        let still = [T::zero(); J];
        match self.path {
            Path::Line(line, axes) => {
                (self.reference, self.axes) = (line.at(t), axes);
                self.follow_tool(t);
            }
            Path::Still(Held::Tool) => {
                self.reference = at_rest(self.reference.X_NE);
                self.follow_tool(t);
            }
            Path::Joints(path) => {
                let at = path.at(t);
                self.belief.q = at.q;
                self.motion = self.answer(&at.v, &at.vdot);
                self.axes = Axes::Inertial;
                self.reference = at_rest(self.believed_tool(Axes::Inertial));
            }
            Path::Relief { task, gain } => {
                let (qdot, qddot) = self.relieve(task, gain, t);
                self.motion = self.answer(&qdot, &qddot);
                self.axes = Axes::Inertial;
                self.reference = at_rest(self.believed_tool(Axes::Inertial));
            }
            Path::Still(Held::Joints) => {
                self.belief.q = self.now.map(|s| s.position);
                self.motion = self.answer(&still, &still);
            }
            Path::Still(Held::Nothing) => {
                let rates = self.motion.rate.qdot;
                self.motion = self.answer(&rates, &still);
            }
        }
    }

    /// Joint rates and accelerations at time `t` (s) that lower what the push at the tool asks of the
    /// base: what would be best is approached, and left in time before the phase ends, for rates that
    /// jumped would ask for any torque.
    fn relieve(&mut self, task: ToolTask, gain: T, t: T) -> ([T; J], [T; J]) {
        let (state, period) = (self.believed_state(), self.setup.tuning.period);
        let approach = T::from_f64(RELIEF_APPROACH);
        let left = self.sequence.duration(period) - t;
        let k = kinematics(&self.robot, &state);
        let R_NE = k.pose(self.tool()).rotation;
        let F_E = self.tool_wrench_E.unwrap_or_default();
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

    /// How the joints may be used at time `t` (s) of the phase: the drift to the posture comes and
    /// goes as the speed of a quintic does, `30 s² (1 - s)²`, for rates that jumped would ask for any
    /// torque.
    fn joint_use(&self, t: T) -> JointUse<T, J> {
        let (c, gain) = (T::from_f64, self.setup.joints.gain);
        let duration = self.sequence.duration(self.setup.tuning.period);
        let s = t / duration;
        let rest = T::one() - s;
        JointUse {
            gain: gain * c(30.0) * s * s * rest * rest,
            gain_rate: gain * c(60.0) * s * rest * (rest - s) / duration,
            ..self.setup.joints
        }
    }

    /// Joint motion that keeps the tool on its reference, at time `t` (s) of the phase.
    fn follow_tool(&mut self, t: T) {
        let X = self.believed_tool(self.axes);
        let R_error = self.reference.X_NE.rotation * X.rotation.transpose();
        let error = SpatialVelocity::new(
            Quat::from_matrix(&R_error).log(),
            self.reference.X_NE.translation - X.translation,
        );
        let back = self.setup.tuning.tool_gain;
        let wanted = WantedMotion {
            V_NE: self.reference.V_NE_N + error * back,
            // The error dies out as it is told to, but for what the law did not expect of the base.
            Vdot_NE: self.reference.Vdot_NE_N - (error * back + self.surprise_at_tool(&X)) * back,
        };
        let to = Assignment { axes: self.axes, ..self.setup.assignment };
        self.motion = resolved_motion(
            &self.robot,
            &self.dual_robot,
            &to,
            &self.belief,
            &wanted,
            &self.joint_use(t),
        );
    }

    /// Twist of the tool, at `X`, that the law did not expect.
    fn surprise_at_tool(&self, X_NE: &Pose<T>) -> SpatialVelocity<T> {
        let X_NB = &self.belief.X_NB;
        match self.axes {
            Axes::Base => SpatialVelocity::zero(),
            Axes::Inertial => SpatialVelocity::new(
                X_NB.rotation * self.surprise.angular,
                X_NB.rotation * self.surprise.linear,
            )
            .shifted_by(X_NE.translation - X_NB.translation),
        }
    }

    /// What the actuators are told between two sets of set-points.
    fn command_between(
        &mut self,
        state: &State<T, J>,
        sensed: &Sensed<T, J>,
        next: &[SetPoint<T>; J],
    ) -> Command<T, J> {
        let tuning = self.setup.tuning;
        let half = T::from_f64(0.5);
        // Torques are constant over the period: those of its middle are right on average.
        let (mut middle, mut ahead) = (self.now, *state);
        let mut acceleration = [T::zero(); J];
        for j in self.robot.joints() {
            let blend = SetPointMotion::between(self.now[j], next[j], tuning.period);
            middle[j] = blend.at(tuning.period * half);
            acceleration[j] = (next[j].rate - self.now[j].rate) / tuning.period;
            let gain = acceleration[j] * tuning.period * half;
            ahead.q[j] += (state.v[j] + gain * half) * tuning.period * half;
            ahead.v[j] += gain;
        }
        self.acceleration = acceleration;
        self.acceleration = acceleration;
        let coasting = matches!(self.path, Path::Still(Held::Nothing));
        let (mut effort, mut attitude_torque_B) = ([T::zero(); J], Vec3::zero());
        let mut steered = Steered::nothing();
        if coasting {
            self.base_control.rest();
        } else {
            let (law, robot) = (self.setup.assignment.law, &self.robot);
            effort = computed_torque(robot, law, &tuning, &ahead, &middle, &acceleration);
            let reaction_B = feedforward_torque(robot, self.setup.base.feedforward, &middle);
            let mut ahead_B = SpatialForce::new(reaction_B, Vec3::zero());
            if let Some(F_E) = &self.tool_wrench_E {
                let tool = &self.setup.assignment.tool;
                // A base that is held in its place stands as if it were bolted down.
                let held = self.base_control.holds_position();
                let law = if held { ArmLaw::Terrestrial } else { law };
                let (against, on_base_B) = against_tool_wrench(robot, law, tool, state, F_E);
                for j in robot.joints() {
                    effort[j] += against[j];
                }
                ahead_B += on_base_B;
            }
            let M_B = self.locked_inertia();
            (attitude_torque_B, steered) = self.base_control.command(
                &self.robot,
                &tuning,
                &M_B,
                state,
                &ahead_B,
                &sensed.actuators,
            );
        }
        Command {
            set_points: *next,
            effort: self.within_limits(effort),
            attitude_torque_B,
            actuators: steered.command,
            steering: steered.report,
            no_relief: self.no_relief,
            grip: None,
            phase: self.sequence.number(),
            reference: self.reference,
            axes: self.axes,
        }
    }

    /// Inertia of the whole system with joints locked, as it is believed to be.
    fn locked_inertia(&self) -> SpatialInertia<T> {
        let state = State { q: self.belief.q, ..State::default() };
        mass_matrix(&kinematics(&self.robot, &state)).M_bb
    }

    /// All torques scaled so that none passes its limit: a drive that saturated alone would let the
    /// others throw the arm off its way.
    fn within_limits(&self, effort: [T; J]) -> [T; J] {
        let mut share = T::one();
        for j in self.robot.joints() {
            if let Some(limit) = self.setup.limits[j].effort {
                share = share.min(limit / limit.max(effort[j].abs()));
            }
        }
        effort.map(|tau| tau * share)
    }

    /// Do without a unit of the base's equipment from now on.
    pub fn isolate(&mut self, unit: Unit) {
        self.base_control.isolate(unit);
    }

    /// The robot has taken hold of something, or let go: what it is from now on.
    pub fn robot_changed(&mut self, robot: &Robot<f64, J>) {
        self.robot = robot.cast();
        self.dual_robot = robot.cast();
        let believed = self.believed_state();
        self.belief.h_Scm_N = momentum_of(&self.robot, &believed);
    }
}

/// A tool that stays where it is.
fn at_rest<T: Scalar>(X_NE: Pose<T>) -> ToolMotion<T> {
    let zero = SpatialVelocity::zero();
    ToolMotion { X_NE, V_NE_N: zero, Vdot_NE_N: zero }
}

/// Total momentum about the system's centre of mass, inertial axes.
fn momentum_of<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    state: &State<T, J>,
) -> SpatialMomentum<T> {
    let h = momentum(&kinematics(robot, state));
    SpatialMomentum::new(h.angular, h.linear)
}

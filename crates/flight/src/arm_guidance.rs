//! References of one arm: the path of its task. It decides, so it takes single numbers.

use crate::allocation::{NoPostureUnloading, PostureUnloadingUse, ToolTask, unload_by_posture};
use crate::carried_rates::{CarriedRates, FADE, to_rest};
use crate::clock::{Clock, NoWay};
use crate::control_period::{ArmReference, PeriodMemory, at_rest};
use crate::interface::{Axes, Grip};
use crate::phase::{Held, JointTarget, Path, Phase};
use crate::resolved_motion::{Assignment, Belief};
use crate::setup::Setup;
use crate::tool_pose::joints_for_tool;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Frame, Robot, State, kinematics};
use wrasse_spatial::{Pose, Quat, Scalar, SpatialForce};

/// Time in which joints take up the rates that unload the base (s).
const UNLOADING_APPROACH: f64 = 0.5;

/// What one arm does, and how far it has come with it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmGuidance<T, const J: usize> {
    pub(crate) path: Path<T, J>,
    clock: Clock,
    /// What the joints' motion at the start of the task adds to the path.
    carried: Option<CarriedRates<T, J>>,
    /// The tool's motion once the joints have come to rest, where it is to come to rest too.
    drift: Option<ToolMotion<T>>,
    /// Whether the task still has to begin, once the joints have come to rest.
    waits: bool,
    /// The tool that was guided last.
    tool: Option<Frame<T>>,
    /// Why no change of posture unloads the base, if the task is for that.
    pub(crate) no_posture_unloading: Option<NoPostureUnloading<T>>,
}

/// A robot, how it is controlled, and what its control periods remember.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GuidanceContext<'a, T, const J: usize> {
    /// The robot with what it holds.
    pub(crate) robot: &'a Robot<T, J>,
    /// How it is controlled.
    pub(crate) setup: &'a Setup<T, J>,
    /// What the control periods remember.
    pub(crate) memory: &'a PeriodMemory<T, J>,
    /// Tool, law and task of the arm.
    pub(crate) assignment: &'a Assignment<T>,
    /// The joints that the arm moves.
    pub(crate) joints: &'a [bool; J],
    /// Where the tool should be now, and the axes of that.
    pub(crate) reference: (Pose<T>, Axes),
}

impl<T: Scalar, const J: usize> ArmGuidance<T, J> {
    /// Joints that stand.
    pub(crate) fn new() -> Self {
        Self {
            path: Path::Still(Held::Joints),
            clock: Clock::default(),
            carried: None,
            drift: None,
            waits: false,
            tool: None,
            no_posture_unloading: None,
        }
    }

    /// Whether the task moves the tool along a line, or keeps it in its place.
    pub(crate) fn follows_tool(&self) -> bool {
        matches!(self.path, Path::Line(..) | Path::Still(Held::Tool))
    }

    /// Whether the task is done.
    pub(crate) fn is_over(&self) -> bool {
        self.clock.is_over() && !self.waits
    }

    /// Whether the joints have come to rest, and the task that waited for that has to begin.
    pub(crate) fn may_begin(&self) -> bool {
        self.clock.is_over() && self.waits
    }

    /// Where the tool is to be in the end, and the axes of that.
    pub(crate) fn end(&self, context: &GuidanceContext<'_, T, J>) -> (Pose<T>, Axes) {
        match self.path {
            Path::Line(line, axes) => (line.at(line.duration()).X_NE, axes),
            Path::Joints(way) => {
                let state = State { q: way.at(way.duration()).q, ..State::default() };
                (kinematics(context.robot, &state).pose(&context.assignment.tool), Axes::Base)
            }
            _ => context.reference,
        }
    }

    /// The reference of the coming period. `F_E` is what pushes at the tool, at its origin in its
    /// axes (N·m, N).
    pub(crate) fn next(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
        F_E: &SpatialForce<T>,
    ) -> ArmReference<T, J> {
        let t = T::from_f64(f64::from(self.clock.tick())) * context.setup.tuning.period;
        self.reference_at(context, t, F_E)
    }

    /// Stand still from now on.
    pub(crate) fn stand(&mut self) {
        (self.path, self.carried, self.waits) = (Path::Still(Held::Joints), None, false);
        self.clock = Clock::default();
    }

    /// Begin a task, or the one that waits; what it tells the grip.
    ///
    /// # Errors
    /// If its numbers describe no motion.
    pub(crate) fn begin(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
        motion: &Phase<T, J>,
    ) -> Result<Option<Grip>, NoWay<T>> {
        let period = context.setup.tuning.period;
        let waited = core::mem::take(&mut self.waits);
        self.carried = self.carried_into(context, motion).filter(|_| !waited);
        self.drift = None;
        self.tool = Some(context.assignment.tool);
        if let (Phase::MoveTool { .. }, Some(_)) = (motion, self.carried) {
            // A line of the tool begins at rest.
            (self.waits, self.path) = (true, Path::Still(Held::Tool));
            self.clock.begin(T::from_f64(2.0 * FADE), period)?;
            return Ok(None);
        }
        let mut grip = None;
        let (path, duration) = match *motion {
            Phase::MoveTool { target, axes, timing } => {
                let from = context.believed_tool(axes);
                let line = timing.line(from, &target)?;
                (Path::Line(line, axes), line.duration())
            }
            Phase::MoveJoints { to, timing } => {
                let way = timing.way(context.memory.belief.q, joint_target(context, to)?)?;
                self.carried = self.carried.map(|carried| carried.within(way.duration()));
                (Path::Joints(way), way.duration())
            }
            Phase::Hold { what, duration } => (Path::Still(what), duration),
            Phase::UnloadByPosture { task, gain, duration } => {
                (Path::PostureUnloading { task, gain }, duration)
            }
            Phase::Grip { action, keep } => {
                grip = Some(action);
                (Path::Still(keep), period)
            }
        };
        self.path = path;
        self.clock.begin(duration, period)?;
        Ok(grip)
    }

    /// The joints' motion as a phase begins, where its path does not go on with it: that of a tool goes
    /// on with that of a tool, and unloading by posture begins with the rates that there are.
    fn carried_into(
        &self,
        context: &GuidanceContext<'_, T, J>,
        phase: &Phase<T, J>,
    ) -> Option<CarriedRates<T, J>> {
        let goes_on = match phase {
            Phase::MoveTool { .. }
            | Phase::Hold { what: Held::Tool, .. }
            | Phase::Grip { keep: Held::Tool, .. } => {
                self.follows_tool() && self.tool == Some(context.assignment.tool)
            }
            Phase::UnloadByPosture { .. }
            | Phase::Hold { what: Held::Nothing, .. }
            | Phase::Grip { keep: Held::Nothing, .. } => true,
            _ => false,
        };
        let (q, rates) = (context.memory.belief.q, context.memory.motion.rate.qdot);
        let own = |j: usize| if context.joints[j] { rates[j] } else { T::zero() };
        let v = core::array::from_fn(own);
        if goes_on { None } else { CarriedRates::of(q, v) }
    }

    /// The arm's reference at time `t` (s) of the phase.
    fn reference_at(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
        t: T,
        F_E: &SpatialForce<T>,
    ) -> ArmReference<T, J> {
        self.no_posture_unloading = None;
        let slow = T::from_f64(2.0 * FADE);
        let carried = self.carried.filter(|carried| !carried.are_gone(t));
        match (self.path, carried) {
            (Path::Line(line, axes), _) => self.on_tool(context, line.at(t), axes, t),
            (Path::Still(Held::Nothing), _) => ArmReference::Coast,
            (Path::Still(_), Some(carried)) => ArmReference::Joints(carried.to_rest(t)),
            (Path::Still(Held::Tool), None) if self.carried.is_some() && t <= slow => {
                let reference = self.tool_to_rest(context, t);
                self.on_tool(context, reference, Axes::Inertial, t)
            }
            (Path::Still(Held::Tool), None) => {
                self.on_tool(context, at_rest(context.reference.0), context.reference.1, t)
            }
            (Path::Still(Held::Joints), None) => ArmReference::Still,
            (Path::Joints(path), None) => ArmReference::Joints(path.at(t)),
            (Path::Joints(path), Some(carried)) => {
                ArmReference::Joints(carried.beside(&path.at(t), t))
            }
            (Path::PostureUnloading { task, gain }, _) => {
                let (qdot, qddot) = self.unload_by_posture(context, task, gain, t, F_E);
                ArmReference::Rates { qdot, qddot }
            }
        }
    }

    /// Joints that stand carry the tool on with a base that moves: at time `t` (s) of the phase, on its
    /// way to rest in inertial space.
    fn tool_to_rest(&mut self, context: &GuidanceContext<'_, T, J>, t: T) -> ToolMotion<T> {
        let fade = T::from_f64(FADE);
        let drift = *self.drift.get_or_insert_with(|| {
            let state = context.memory.believed_state();
            let k = kinematics(context.robot, &state);
            let (X_NE, V_NE_N) =
                (k.pose(&context.assignment.tool), k.velocity(&context.assignment.tool));
            ToolMotion { V_NE_N, ..at_rest(X_NE) }
        });
        let (rate, way, acceleration) = to_rest((t - fade) / fade);
        let (V, way) = (drift.V_NE_N, way * fade);
        let turn = Quat::exp(V.angular * way).to_matrix();
        ToolMotion {
            X_NE: Pose::new(turn * drift.X_NE.rotation, drift.X_NE.translation + V.linear * way),
            V_NE_N: V * rate,
            Vdot_NE_N: V * (acceleration / fade),
        }
    }

    /// The tool on a motion, at time `t` (s) of the phase: the drift to the posture comes and goes as
    /// the speed of a quintic does, `30 s² (1 - s)²`, for rates that jumped would ask for any torque.
    fn on_tool(
        &self,
        context: &GuidanceContext<'_, T, J>,
        reference: ToolMotion<T>,
        axes: Axes,
        t: T,
    ) -> ArmReference<T, J> {
        let (c, gain) = (T::from_f64, context.setup.joints.gain);
        let duration = self.clock.duration(context.setup.tuning.period);
        // Behind its end there is none.
        let s = (t / duration).min(T::one());
        let rest = T::one() - s;
        ArmReference::Tool {
            reference,
            axes,
            gain: gain * c(30.0) * s * s * rest * rest,
            gain_rate: gain * c(60.0) * s * rest * (rest - s) / duration,
        }
    }

    /// Joint rates and accelerations at time `t` (s) that lower the momentum that the push at the tool
    /// puts into the base: the best rates are approached, and left in time before the phase ends, for
    /// rates that jumped would ask for any torque.
    fn unload_by_posture(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
        task: ToolTask,
        gain: T,
        t: T,
        F_E: &SpatialForce<T>,
    ) -> ([T; J], [T; J]) {
        let period = context.setup.tuning.period;
        let Belief { X_NB, q, .. } = context.memory.predicted(context.robot, period);
        let state = State { X_NB, q, ..context.memory.believed_state() };
        let approach = T::from_f64(UNLOADING_APPROACH);
        let left = self.clock.duration(period) - t;
        let k = kinematics(context.robot, &state);
        let R_NE = k.pose(&context.assignment.tool).rotation;
        let F_N = SpatialForce::new(R_NE * F_E.torque, R_NE * F_E.force);
        let joints =
            PostureUnloadingUse { task, gain, rate_limit: context.setup.joints.rate_limit };
        let mut best = [T::zero(); J];
        match unload_by_posture(&k, &context.assignment.tool, &F_N, &joints) {
            Ok(unloading) if left > approach * T::from_f64(6.0) => best = unloading.qdot,
            Ok(_) => {}
            Err(reason) => self.no_posture_unloading = Some(reason),
        }
        let (mut qdot, mut qddot) = (state.v, [T::zero(); J]);
        for j in context.robot.joints() {
            qddot[j] = (best[j] - qdot[j]) / approach;
            qdot[j] += qddot[j] * period;
        }
        (qdot, qddot)
    }
}

impl<T: Scalar, const J: usize> GuidanceContext<'_, T, J> {
    /// Pose of the tool as it is believed to be.
    pub(crate) fn believed_tool(&self, axes: Axes) -> Pose<T> {
        let belief = &self.memory.belief;
        let X_NB = match axes {
            Axes::Inertial => belief.X_NB,
            Axes::Base => Pose::identity(),
        };
        let state = State { X_NB, q: belief.q, ..State::default() };
        kinematics(self.robot, &state).pose(&self.assignment.tool)
    }
}

/// Joint positions (rad or m) to go to.
fn joint_target<T: Scalar, const J: usize>(
    context: &GuidanceContext<'_, T, J>,
    to: JointTarget<T, J>,
) -> Result<[T; J], NoWay<T>> {
    let q = context.memory.belief.q;
    match to {
        JointTarget::Positions(to) => Ok(core::array::from_fn(|j| to[j].unwrap_or(q[j]))),
        JointTarget::By(by) => {
            Ok(core::array::from_fn(|j| by[j].map_or(q[j], |amount| q[j] + amount)))
        }
        JointTarget::Tool(X, axes) => {
            let (tool, law) = (&context.assignment.tool, context.assignment.law);
            let state = State { X_NB: context.memory.belief.X_NB, q, ..State::default() };
            joints_for_tool(context.robot, tool, &state, &X, axes, law, &context.setup.limits)
                .map_err(NoWay::Unreachable)
        }
    }
}

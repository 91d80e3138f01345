//! References of the arm: phases one after the other, and the path of the current one. It decides, so
//! it takes single numbers.

use crate::allocation::{NoPostureUnloading, PostureUnloadingUse, ToolTask, unload_by_posture};
use crate::carried_rates::{CarriedRates, FADE, to_rest};
use crate::control_period::{ArmReference, PeriodMemory, at_rest};
use crate::interface::{Axes, Grip};
use crate::phase::{Held, JointTarget, Path, Phase};
use crate::resolved_motion::Belief;
use crate::sequence::{BadPhase, NoWay, Sequence};
use crate::setup::Setup;
use crate::tool_pose::joints_for_tool;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Robot, State, kinematics};
use wrasse_spatial::{Pose, Quat, Scalar, SpatialForce};

/// Time in which joints take up the rates that unload the base (s).
const UNLOADING_APPROACH: f64 = 0.5;

/// Phases and path.
#[derive(Debug, Clone, Copy)]
pub struct Guidance<T, const J: usize> {
    pub(crate) sequence: Sequence<T, J>,
    pub(crate) path: Path<T, J>,
    /// What the joints' motion at the start of the phase adds to the path.
    carried: Option<CarriedRates<T, J>>,
    /// The tool's motion once the joints have come to rest, where it is to come to rest too.
    drift: Option<ToolMotion<T>>,
    /// Whether the phase still has to begin, once the joints have come to rest.
    waits: bool,
    /// Why no change of posture unloads the base, if the phase is for that.
    pub(crate) no_posture_unloading: Option<NoPostureUnloading<T>>,
}

/// A robot, how it is controlled, and what its control periods remember.
#[derive(Debug, Clone, Copy)]
pub struct GuidanceContext<'a, T, const J: usize> {
    /// The robot with what it holds.
    pub robot: &'a Robot<T, J>,
    /// How it is controlled.
    pub setup: &'a Setup<T, J>,
    /// What the control periods remember.
    pub memory: &'a PeriodMemory<T, J>,
}

impl<T: Scalar, const J: usize> Guidance<T, J> {
    /// These phases; those beyond [`PHASES`](crate::PHASES) are left out.
    pub fn new(phases: &[Phase<T, J>]) -> Self {
        let path = Path::Still(Held::Joints);
        Self {
            sequence: Sequence::new(phases),
            path,
            carried: None,
            drift: None,
            waits: false,
            no_posture_unloading: None,
        }
    }

    /// Number of the current phase: that of the phases when all are done.
    pub fn phase(&self) -> usize {
        self.sequence.number()
    }

    /// Whether the current phase moves the tool along a line, or keeps it in its place.
    pub fn follows_tool(&self) -> bool {
        matches!(self.path, Path::Line(..) | Path::Still(Held::Tool))
    }

    /// Whether all phases are done.
    pub fn is_done(&self) -> bool {
        self.sequence.is_done() && !self.waits
    }

    /// Before each period, once the memory has looked: begins the next phase if the last is over. What
    /// it tells the grip.
    ///
    /// # Errors
    /// If a phase begins whose numbers describe no motion.
    pub fn begin(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
    ) -> Result<Option<Grip>, BadPhase<T>> {
        if !self.sequence.is_over() {
            return Ok(None);
        }
        let begun = self.begin_next(context);
        begun.map_err(|reason| BadPhase { phase: self.phase(), reason })
    }

    /// The reference of the coming period. `F_E` is what pushes at the tool, at its origin in its
    /// axes (N·m, N).
    pub fn next(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
        F_E: &SpatialForce<T>,
    ) -> ArmReference<T, J> {
        let t = T::from_f64(f64::from(self.sequence.tick())) * context.setup.tuning.period;
        self.reference_at(context, t, F_E)
    }

    /// Begin the next phase, or the one that waits; what it tells the grip.
    fn begin_next(
        &mut self,
        context: &GuidanceContext<'_, T, J>,
    ) -> Result<Option<Grip>, NoWay<T>> {
        let period = context.setup.tuning.period;
        let waited = core::mem::take(&mut self.waits);
        let next = if waited { self.sequence.again() } else { self.sequence.next() };
        let Some(phase) = next else {
            (self.path, self.carried) = (Path::Still(Held::Joints), None);
            return Ok(None);
        };
        self.carried = self.carried_into(context, &phase).filter(|_| !waited);
        self.drift = None;
        if let (Phase::MoveTool { .. }, Some(_)) = (phase, self.carried) {
            // A line of the tool begins at rest.
            (self.waits, self.path) = (true, Path::Still(Held::Tool));
            self.sequence.lasts(T::from_f64(2.0 * FADE), period)?;
            return Ok(None);
        }
        let mut grip = None;
        let (path, duration) = match phase {
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
        self.sequence.lasts(duration, period)?;
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
            | Phase::Grip { keep: Held::Tool, .. } => self.follows_tool(),
            Phase::UnloadByPosture { .. }
            | Phase::Hold { what: Held::Nothing, .. }
            | Phase::Grip { keep: Held::Nothing, .. } => true,
            _ => false,
        };
        let (q, v) = (context.memory.belief.q, context.memory.motion.rate.qdot);
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
            (Path::Still(Held::Tool), None) => self.on_tool(
                context,
                at_rest(context.memory.reference.X_NE),
                context.memory.axes,
                t,
            ),
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
            let (X_NE, V_NE_N) = (
                k.pose(&context.setup.assignment.tool),
                k.velocity(&context.setup.assignment.tool),
            );
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
        let duration = self.sequence.duration(context.setup.tuning.period);
        let s = t / duration;
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
        let left = self.sequence.duration(period) - t;
        let k = kinematics(context.robot, &state);
        let R_NE = k.pose(&context.setup.assignment.tool).rotation;
        let F_N = SpatialForce::new(R_NE * F_E.torque, R_NE * F_E.force);
        let joints =
            PostureUnloadingUse { task, gain, rate_limit: context.setup.joints.rate_limit };
        let mut best = [T::zero(); J];
        match unload_by_posture(&k, &context.setup.assignment.tool, &F_N, &joints) {
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
        kinematics(self.robot, &state).pose(&self.setup.assignment.tool)
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
        JointTarget::Tool(X, axes) => {
            let (tool, law) = (&context.setup.assignment.tool, context.setup.assignment.law);
            let state = State { X_NB: context.memory.belief.X_NB, q, ..State::default() };
            joints_for_tool(context.robot, tool, &state, &X, axes, law, &context.setup.limits)
                .map_err(NoWay::Unreachable)
        }
    }
}

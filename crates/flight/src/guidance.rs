//! What is asked of the arm: phases one after the other, and the path of the current one. It decides, so
//! it takes single numbers.

use crate::carried_rates::{CarriedRates, FADE, to_rest};
use crate::computer::Setup;
use crate::control_period::{Asked, PeriodMemory, at_rest};
use crate::door::{Axes, Grip};
use crate::phase::{Held, JointTarget, Path, Phase};
use crate::resolved_motion::Belief;
use crate::sequence::{BadPhase, NoWay, Sequence};
use crate::steering::{NoRelief, ReliefUse, ToolTask, posture_relief};
use crate::tool_pose::joints_for_tool;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Robot, State, kinematics};
use wrasse_spatial::{Pose, Quat, Scalar, SpatialForce};

/// Time in which joints take up the rates that relieve the base (s).
const RELIEF_APPROACH: f64 = 0.5;

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
    /// Why the posture cannot relieve the base, if it was asked to.
    pub(crate) no_relief: Option<NoRelief<T>>,
}

/// A robot, how it is controlled, and what its control periods remember.
#[derive(Debug, Clone, Copy)]
pub struct Guided<'a, T, const J: usize> {
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
            no_relief: None,
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
    pub fn begin(&mut self, of: &Guided<'_, T, J>) -> Result<Option<Grip>, BadPhase<T>> {
        if !self.sequence.is_over() {
            return Ok(None);
        }
        let begun = self.begin_next(of);
        begun.map_err(|reason| BadPhase { phase: self.phase(), reason })
    }

    /// What is asked of the period that comes. `F_E` is what pushes at the tool, at its origin in its
    /// axes (N·m, N).
    pub fn next(&mut self, of: &Guided<'_, T, J>, F_E: &SpatialForce<T>) -> Asked<T, J> {
        let t = T::from_f64(f64::from(self.sequence.tick())) * of.setup.tuning.period;
        self.asked(of, t, F_E)
    }

    /// Begin the next phase, or the one that waits; what it tells the grip.
    fn begin_next(&mut self, of: &Guided<'_, T, J>) -> Result<Option<Grip>, NoWay<T>> {
        let period = of.setup.tuning.period;
        let waited = core::mem::take(&mut self.waits);
        let next = if waited { self.sequence.again() } else { self.sequence.next() };
        let Some(phase) = next else {
            (self.path, self.carried) = (Path::Still(Held::Joints), None);
            return Ok(None);
        };
        self.carried = self.carried_into(of, &phase).filter(|_| !waited);
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
                let from = of.believed_tool(axes);
                let line = timing.line(from, &target)?;
                (Path::Line(line, axes), line.duration())
            }
            Phase::MoveJoints { to, timing } => {
                let way = timing.way(of.memory.belief.q, joint_target(of, to)?)?;
                self.carried = self.carried.map(|carried| carried.within(way.duration()));
                (Path::Joints(way), way.duration())
            }
            Phase::Hold { what, duration } => (Path::Still(what), duration),
            Phase::Relieve { task, gain, duration } => (Path::Relief { task, gain }, duration),
            Phase::Grip { told, keep } => {
                grip = Some(told);
                (Path::Still(keep), period)
            }
        };
        self.path = path;
        self.sequence.lasts(duration, period)?;
        Ok(grip)
    }

    /// The joints' motion as a phase begins, where its path does not go on with it: that of a tool goes
    /// on with that of a tool, and what relieves the base begins with the rates that there are.
    fn carried_into(
        &self,
        of: &Guided<'_, T, J>,
        phase: &Phase<T, J>,
    ) -> Option<CarriedRates<T, J>> {
        let goes_on = match phase {
            Phase::MoveTool { .. }
            | Phase::Hold { what: Held::Tool, .. }
            | Phase::Grip { keep: Held::Tool, .. } => self.follows_tool(),
            Phase::Relieve { .. }
            | Phase::Hold { what: Held::Nothing, .. }
            | Phase::Grip { keep: Held::Nothing, .. } => true,
            _ => false,
        };
        let (q, v) = (of.memory.belief.q, of.memory.motion.rate.qdot);
        if goes_on { None } else { CarriedRates::of(q, v) }
    }

    /// What is asked of the arm at time `t` (s) of the phase.
    fn asked(&mut self, of: &Guided<'_, T, J>, t: T, F_E: &SpatialForce<T>) -> Asked<T, J> {
        self.no_relief = None;
        let slow = T::from_f64(2.0 * FADE);
        let carried = self.carried.filter(|carried| !carried.are_gone(t));
        match (self.path, carried) {
            (Path::Line(line, axes), _) => self.on_tool(of, line.at(t), axes, t),
            (Path::Still(Held::Nothing), _) => Asked::Coast,
            (Path::Still(_), Some(carried)) => Asked::Joints(carried.to_rest(t)),
            (Path::Still(Held::Tool), None) if self.carried.is_some() && t <= slow => {
                let reference = self.tool_to_rest(of, t);
                self.on_tool(of, reference, Axes::Inertial, t)
            }
            (Path::Still(Held::Tool), None) => {
                self.on_tool(of, at_rest(of.memory.reference.X_NE), of.memory.axes, t)
            }
            (Path::Still(Held::Joints), None) => Asked::Still,
            (Path::Joints(path), None) => Asked::Joints(path.at(t)),
            (Path::Joints(path), Some(carried)) => Asked::Joints(carried.beside(&path.at(t), t)),
            (Path::Relief { task, gain }, _) => {
                let (qdot, qddot) = self.relieve(of, task, gain, t, F_E);
                Asked::Rates { qdot, qddot }
            }
        }
    }

    /// Joints that stand carry the tool on with a base that moves: at time `t` (s) of the phase, on its
    /// way to rest in inertial space.
    fn tool_to_rest(&mut self, of: &Guided<'_, T, J>, t: T) -> ToolMotion<T> {
        let fade = T::from_f64(FADE);
        let drift = *self.drift.get_or_insert_with(|| {
            let state = of.memory.believed_state();
            let k = kinematics(of.robot, &state);
            let (X_NE, V_NE_N) =
                (k.pose(&of.setup.assignment.tool), k.velocity(&of.setup.assignment.tool));
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
        of: &Guided<'_, T, J>,
        reference: ToolMotion<T>,
        axes: Axes,
        t: T,
    ) -> Asked<T, J> {
        let (c, gain) = (T::from_f64, of.setup.joints.gain);
        let duration = self.sequence.duration(of.setup.tuning.period);
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
        of: &Guided<'_, T, J>,
        task: ToolTask,
        gain: T,
        t: T,
        F_E: &SpatialForce<T>,
    ) -> ([T; J], [T; J]) {
        let period = of.setup.tuning.period;
        let Belief { X_NB, q, .. } = of.memory.predicted(of.robot, period);
        let state = State { X_NB, q, ..of.memory.believed_state() };
        let approach = T::from_f64(RELIEF_APPROACH);
        let left = self.sequence.duration(period) - t;
        let k = kinematics(of.robot, &state);
        let R_NE = k.pose(&of.setup.assignment.tool).rotation;
        let F_N = SpatialForce::new(R_NE * F_E.torque, R_NE * F_E.force);
        let joints = ReliefUse { task, gain, rate_limit: of.setup.joints.rate_limit };
        let mut best = [T::zero(); J];
        match posture_relief(&k, &of.setup.assignment.tool, &F_N, &joints) {
            Ok(relief) if left > approach * T::from_f64(6.0) => best = relief.qdot,
            Ok(_) => {}
            Err(reason) => self.no_relief = Some(reason),
        }
        let (mut qdot, mut qddot) = (state.v, [T::zero(); J]);
        for j in of.robot.joints() {
            qddot[j] = (best[j] - qdot[j]) / approach;
            qdot[j] += qddot[j] * period;
        }
        (qdot, qddot)
    }
}

impl<T: Scalar, const J: usize> Guided<'_, T, J> {
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
    of: &Guided<'_, T, J>,
    to: JointTarget<T, J>,
) -> Result<[T; J], NoWay<T>> {
    let q = of.memory.belief.q;
    match to {
        JointTarget::Positions(to) => Ok(core::array::from_fn(|j| to[j].unwrap_or(q[j]))),
        JointTarget::Tool(X, axes) => {
            let (tool, law) = (&of.setup.assignment.tool, of.setup.assignment.law);
            let state = State { X_NB: of.memory.belief.X_NB, q, ..State::default() };
            joints_for_tool(of.robot, tool, &state, &X, axes, law, &of.setup.limits)
                .map_err(NoWay::Unreachable)
        }
    }
}

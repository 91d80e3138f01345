//! The executive: which step of a mission is under way, what ends it, and what its arms do.

use crate::arm_guidance::{ArmGuidance, GuidanceContext};
use crate::clock::{BadPhase, NoWay, whole_periods};
use crate::condition::{Condition, Known};
use crate::control_period::{ArmReference, PeriodMemory, at_rest};
use crate::interface::{Axes, Grip, GripAnswer};
use crate::phase::{Held, Phase};
use crate::resolved_motion::{Assignment, carrying};
use crate::setup::Setup;
use crate::step::{ARMS, ArmTask, Next, STEPS, Step};
use crate::trajectory::ToolMotion;
use wrasse_dynamics::{Frame, Robot};
use wrasse_spatial::{Pose, Scalar, SpatialForce};

/// What ended a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepEnd<T> {
    /// Its condition held.
    Met,
    /// Its time was up before.
    Timeout,
    /// The grip could not do what it was told.
    Refused,
    /// It could not begin.
    Blocked(NoWay<T>),
}

/// What the executive decides as a period begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Decision<T> {
    /// The step that has just ended, and why.
    pub(crate) ended: Option<(usize, StepEnd<T>)>,
    /// Whether a step begins.
    pub(crate) begins: bool,
    /// What the grip should do.
    pub(crate) grip: Option<Grip>,
    /// A step that would have begun, had its attempts not been used up.
    pub(crate) exhausted: Option<usize>,
}

/// Steps, and what the arms do in the current one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Executive<T, const J: usize> {
    steps: [Option<Step<T, J>>; STEPS],
    /// How many there are.
    count: usize,
    /// How often each has begun.
    begun: [u32; STEPS],
    /// Number of the current step, once the first has begun; that of the steps behind the last.
    current: Option<usize>,
    /// Periods since the step began.
    elapsed: u32,
    /// Why the current step could not begin.
    blocked: Option<NoWay<T>>,
    /// Tool, law and task where a step names none.
    default: Assignment<T>,
    /// Conditions on what cannot be foreseen hold at the timeout: for planning.
    pub(crate) plans: bool,
    pub(crate) arms: [ArmState<T, J>; ARMS],
    /// Joints that belong to no arm at work.
    pub(crate) others: ArmState<T, J>,
    /// The tool whose grip acts.
    pub(crate) gripping: Frame<T>,
}

/// One arm at work.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmState<T, const J: usize> {
    pub(crate) guidance: ArmGuidance<T, J>,
    pub(crate) assignment: Assignment<T>,
    /// Joints that it moves.
    pub(crate) joints: [bool; J],
    /// Where its tool should be, and the axes of that; `None` where its joints are guided.
    pub(crate) reference: Option<(ToolMotion<T>, Axes)>,
    /// Whether it has a task in the current step.
    pub(crate) works: bool,
}

impl<T: Scalar, const J: usize> ArmState<T, J> {
    fn new(assignment: Assignment<T>) -> Self {
        let guidance = ArmGuidance::new();
        Self { guidance, assignment, joints: [true; J], reference: None, works: false }
    }

    /// What the guidance of this arm looks at.
    pub(crate) fn context<'a>(
        &'a self,
        robot: &'a Robot<T, J>,
        setup: &'a Setup<T, J>,
        memory: &'a PeriodMemory<T, J>,
    ) -> GuidanceContext<'a, T, J> {
        let (assignment, joints) = (&self.assignment, &self.joints);
        let mut context = GuidanceContext {
            robot,
            setup,
            memory,
            assignment,
            joints,
            reference: (Pose::identity(), Axes::Inertial),
        };
        context.reference = match self.reference {
            Some((motion, axes)) => (motion.X_NE, axes),
            None => (context.believed_tool(Axes::Inertial), Axes::Inertial),
        };
        context
    }
}

impl<T: Scalar, const J: usize> Executive<T, J> {
    /// These steps; those beyond [`STEPS`] are left out.
    pub(crate) fn new(steps: impl Iterator<Item = Step<T, J>>, default: Assignment<T>) -> Self {
        let mut list = [None; STEPS];
        let mut count = 0;
        for (to, step) in list.iter_mut().zip(steps) {
            *to = Some(step);
            count += 1;
        }
        let mut arms = [ArmState::new(default); ARMS];
        // Whatever comes first goes on with what its tool begins with.
        arms[0].works = true;
        Self {
            steps: list,
            count,
            begun: [0; STEPS],
            current: None,
            elapsed: 0,
            blocked: None,
            default,
            plans: false,
            arms,
            others: ArmState::new(default),
            gripping: default.tool,
        }
    }

    /// Number of the current step: that of the steps when all are done.
    pub(crate) fn number(&self) -> usize {
        self.current.unwrap_or(0)
    }

    fn step(&self) -> Option<&Step<T, J>> {
        self.steps.get(self.current?)?.as_ref()
    }

    /// Whether a step that is under way goes somewhere else after a fault: its end is not known before.
    pub(crate) fn handles_faults(&self) -> bool {
        self.step().is_some_and(|step| step.on_fault.is_some())
    }

    /// Whether several arms work at once.
    pub(crate) fn has_several_arms(&self) -> bool {
        self.step().is_some_and(Step::has_several_arms)
    }

    /// Whether all steps are done, as far as that is known before the sensors are read again.
    pub(crate) fn is_done(&self, period: T) -> bool {
        let (Some(current), Some(step)) = (self.current, self.step()) else {
            return self.current.is_some();
        };
        let ends = |next: Next| next.after(current, self.count).is_none();
        let waits_for_grip = step.has_grip() && step.on_fault.is_some();
        if self.blocked.is_some() || waits_for_grip || !ends(step.then) {
            return false;
        }
        let times_out = step.timeout.is_some_and(|time| self.is_up(time, period));
        match step.until {
            _ if times_out && ends(step.on_fault.unwrap_or(step.then)) => true,
            Condition::Done => self.arms_are_over(),
            Condition::Elapsed(time) => self.is_up(time, period),
            Condition::Reached { .. } | Condition::Beyond { .. } => false,
        }
    }

    /// Whether so much time has passed since the step began (s), in whole periods of `period` (s).
    fn is_up(&self, time: T, period: T) -> bool {
        self.elapsed >= whole_periods((time / period).to_f64() - 1e-9)
    }

    fn arms_are_over(&self) -> bool {
        self.arms.iter().filter(|arm| arm.works).all(|arm| arm.guidance.is_over())
    }

    /// As a period begins, once the memory has looked: ends the step if it is over, and begins what
    /// comes next.
    ///
    /// # Errors
    /// If a step cannot begin, and says nothing for that.
    pub(crate) fn begin(
        &mut self,
        (robot, setup): (&Robot<T, J>, &mut Setup<T, J>),
        memory: &mut PeriodMemory<T, J>,
        known: &Known<'_, T, J>,
        answer: Option<GripAnswer>,
    ) -> Result<Decision<T>, BadPhase<T>> {
        let nothing = Decision { ended: None, begins: false, grip: None, exhausted: None };
        let Some(current) = self.current else {
            return self.enter((self.count > 0).then_some(0), (robot, setup), memory, nothing);
        };
        let Some(end) = self.step_end((robot, setup), memory, known, answer) else {
            self.begin_waiting(robot, setup, memory)
                .map_err(|reason| BadPhase { phase: current, reason })?;
            return Ok(nothing);
        };
        let next = self.step().map_or(Next::End, |step| match end {
            StepEnd::Met => step.then,
            _ => step.on_fault.unwrap_or(step.then),
        });
        let decision = Decision { ended: Some((current, end)), ..nothing };
        self.enter(next.after(current, self.count), (robot, setup), memory, decision)
    }

    /// What ends the current step now; `None` if it goes on, or all are done.
    fn step_end(
        &self,
        (robot, setup): (&Robot<T, J>, &Setup<T, J>),
        memory: &PeriodMemory<T, J>,
        known: &Known<'_, T, J>,
        answer: Option<GripAnswer>,
    ) -> Option<StepEnd<T>> {
        let step = self.step()?;
        if let Some(reason) = self.blocked {
            return Some(StepEnd::Blocked(reason));
        }
        if answer == Some(GripAnswer::Refused) && step.has_grip() {
            return Some(StepEnd::Refused);
        }
        let is_up = |time: T| self.is_up(time, setup.tuning.period);
        let times_out = step.timeout.is_some_and(is_up);
        let met = match step.until {
            Condition::Done => self.arms_are_over(),
            Condition::Elapsed(time) => is_up(time),
            Condition::Reached { distance, angle } => {
                self.arms.iter().filter(|arm| arm.works).all(|arm| {
                    let end = arm.guidance.end(&arm.context(robot, setup, memory));
                    let (off, turned) = known.tool_error(&arm.assignment.tool, end);
                    off <= distance && turned <= angle
                })
            }
            Condition::Beyond { .. } if self.plans => times_out,
            Condition::Beyond { signal, above, bound } => known.is_beyond(signal, above, bound),
        };
        if met { Some(StepEnd::Met) } else { times_out.then_some(StepEnd::Timeout) }
    }

    /// Begin a step, or what comes instead of it; `None` is the end.
    fn enter(
        &mut self,
        to: Option<usize>,
        (robot, setup): (&Robot<T, J>, &mut Setup<T, J>),
        memory: &mut PeriodMemory<T, J>,
        mut decision: Decision<T>,
    ) -> Result<Decision<T>, BadPhase<T>> {
        let Some(number) = self.not_exhausted(to, &mut decision)? else {
            self.current = Some(self.count);
            self.arms.iter_mut().for_each(|arm| arm.guidance.stand());
            self.arms.iter_mut().skip(1).for_each(|arm| arm.works = false);
            return Ok(decision);
        };
        (self.current, self.elapsed, self.blocked) = (Some(number), 0, None);
        let Some(step) = self.steps[number] else { return Ok(decision) };
        self.assign(&step, (robot, setup), memory);
        decision.begins = true;
        match self.begin_tasks(&step, (robot, setup), memory) {
            Ok(grip) => decision.grip = grip,
            Err(reason) if step.on_fault.is_some() => {
                self.blocked = Some(reason);
                self.arms.iter_mut().for_each(|arm| arm.guidance.stand());
            }
            Err(reason) => return Err(BadPhase { phase: number, reason }),
        }
        Ok(decision)
    }

    /// The step to begin: this one, or what comes instead of it where it has begun as often as it may.
    fn not_exhausted(
        &mut self,
        mut to: Option<usize>,
        decision: &mut Decision<T>,
    ) -> Result<Option<usize>, BadPhase<T>> {
        // Each may send on to the next, none twice.
        for _ in 0..=STEPS {
            let Some(number) = to else { return Ok(None) };
            let Some(step) = &self.steps[number] else { return Ok(None) };
            let Some(most) = step.attempts.filter(|&most| self.begun[number] >= most) else {
                self.begun[number] = self.begun[number].saturating_add(1);
                return Ok(Some(number));
            };
            decision.exhausted = Some(number);
            let exhausted = BadPhase { phase: number, reason: NoWay::Exhausted(most) };
            to = step.on_exhausted.ok_or(exhausted)?.after(number, self.count);
        }
        Err(BadPhase { phase: self.number(), reason: NoWay::Exhausted(0) })
    }

    /// Gives each arm its tool, law, task and joints.
    fn assign(
        &mut self,
        step: &Step<T, J>,
        (robot, setup): (&Robot<T, J>, &mut Setup<T, J>),
        memory: &mut PeriodMemory<T, J>,
    ) {
        let before = self.arms;
        let several = step.has_several_arms();
        let mut free = [true; J];
        for (arm, task) in self.arms.iter_mut().zip(&step.tasks) {
            arm.works = task.is_some();
            let Some(ArmTask { assignment, .. }) = task else { continue };
            arm.assignment = assignment.unwrap_or(self.default);
            let tool = arm.assignment.tool;
            let same = before.iter().find(|b| b.works && b.assignment.tool == tool);
            (arm.reference, arm.guidance) = same
                .map_or((None, ArmGuidance::new()), |before| (before.reference, before.guidance));
            if several {
                let carries = carrying(robot, tool.body);
                arm.joints = core::array::from_fn(|j| carries[j] && free[j]);
                (0..J).for_each(|j| free[j] = free[j] && !carries[j]);
            } else {
                arm.joints = [true; J];
            }
        }
        (self.others.joints, self.others.works) = (free, several);
        let first = self.arms[0].assignment;
        if setup.assignment.law != first.law {
            memory.robot_changed(robot, first.law);
        }
        if setup.assignment.tool != first.tool {
            let (X, axes) = self.arms[0].context(robot, setup, memory).reference;
            (memory.reference, memory.axes) = (at_rest(X), axes);
            self.arms[0].reference = Some((memory.reference, axes));
        }
        setup.assignment = first;
    }

    /// Begins the tasks of all arms; what the grip is told.
    fn begin_tasks(
        &mut self,
        step: &Step<T, J>,
        (robot, setup): (&Robot<T, J>, &Setup<T, J>),
        memory: &PeriodMemory<T, J>,
    ) -> Result<Option<Grip>, NoWay<T>> {
        let mut grip = None;
        for (arm, task) in self.arms.iter_mut().zip(&step.tasks) {
            let Some(task) = task else { continue };
            let mut guidance = arm.guidance;
            let told = guidance.begin(&arm.context(robot, setup, memory), &task.motion)?;
            arm.guidance = guidance;
            if told.is_some() && grip.is_none() {
                (grip, self.gripping) = (told, arm.assignment.tool);
            }
        }
        if self.others.works {
            let rest = Phase::Hold { what: Held::Joints, duration: T::zero() };
            let mut guidance = ArmGuidance::new();
            guidance.begin(&self.others.context(robot, setup, memory), &rest)?;
            self.others.guidance = guidance;
        }
        Ok(grip)
    }

    /// Begins the tasks that waited for their joints to come to rest.
    fn begin_waiting(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        memory: &PeriodMemory<T, J>,
    ) -> Result<(), NoWay<T>> {
        let Some(Step { tasks, .. }) = self.step().copied() else { return Ok(()) };
        for (arm, task) in self.arms.iter_mut().zip(&tasks) {
            let Some(task) = task.as_ref().filter(|_| arm.guidance.may_begin()) else { continue };
            let mut guidance = arm.guidance;
            guidance.begin(&arm.context(robot, setup, memory), &task.motion)?;
            arm.guidance = guidance;
        }
        Ok(())
    }

    /// Reference of the coming period, and the share of their rates that the rate limits leave (–) where
    /// several arms work. `F_E` is what pushes at the first tool, at its origin in its axes (N·m, N).
    pub(crate) fn next(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        memory: &PeriodMemory<T, J>,
        F_E: &SpatialForce<T>,
    ) -> (ArmReference<T, J>, Option<T>) {
        self.elapsed = self.elapsed.saturating_add(1);
        let mut references = [ArmReference::Still; ARMS + 1];
        let all = self.arms.iter_mut().chain([&mut self.others]);
        for ((k, arm), to) in all.enumerate().zip(&mut references) {
            // Where all are done the first arm stands.
            if k > 0 && !arm.works {
                continue;
            }
            let mut guidance = arm.guidance;
            *to = guidance.next(&arm.context(robot, setup, memory), F_E);
            arm.guidance = guidance;
        }
        if !self.has_several_arms() {
            return (references[0], None);
        }
        let (way, share) = self.combined((robot, setup), memory, &references);
        (ArmReference::Joints(way), Some(share))
    }
}

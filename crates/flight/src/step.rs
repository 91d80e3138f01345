//! Steps of a mission: what each arm does, until when, and what comes next.

use crate::condition::Condition;
use crate::phase::Phase;
use crate::resolved_motion::Assignment;
use wrasse_spatial::Scalar;

/// Most steps of one mission.
pub const STEPS: usize = 32;

/// Most arms that work at once.
pub const ARMS: usize = 3;

/// One step: it ends when its condition holds, or at its timeout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T, const J: usize> {
    /// What each arm does, at least one; the first is the one that the readings of a force-torque sensor
    /// belong to.
    pub tasks: [Option<ArmTask<T, J>>; ARMS],
    /// When it ends.
    pub until: Condition<T>,
    /// How long it may last (s); without one until its condition holds.
    pub timeout: Option<T>,
    /// What comes next.
    pub then: Next,
    /// What comes next after a fault (a timeout, a motion that cannot begin, a grasp that is refused); the
    /// same as without one if there is none, but what cannot begin ends the mission then.
    pub on_fault: Option<Next>,
    /// How often it may begin; as often as it is reached if there is none.
    pub attempts: Option<u32>,
    /// What comes instead of it once its attempts are used up; the mission ends there if there is none.
    pub on_exhausted: Option<Next>,
}

/// What comes after a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// The next step of the list, or the end after the last.
    InOrder,
    /// The step of this number.
    Step(usize),
    /// The end of the mission.
    End,
}

/// What one arm does in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmTask<T, const J: usize> {
    /// Its motion.
    pub motion: Phase<T, J>,
    /// Its tool, law and the part of the tool's motion that counts; those of the
    /// [setup](crate::Setup) if there is none. Axes are those of the motion.
    pub assignment: Option<Assignment<T>>,
}

impl<T, const J: usize> Step<T, J> {
    /// One arm's motion to its end, and then the next step.
    pub fn new(task: ArmTask<T, J>) -> Self {
        Self {
            tasks: [Some(task), None, None],
            until: Condition::Done,
            timeout: None,
            then: Next::InOrder,
            on_fault: None,
            attempts: None,
            on_exhausted: None,
        }
    }
}

impl<T: Scalar, const J: usize> Step<T, J> {
    /// What the arms do.
    pub fn tasks(&self) -> impl Iterator<Item = &ArmTask<T, J>> {
        self.tasks.iter().flatten()
    }

    /// Whether a grip takes or lets go of something in it.
    pub(crate) fn has_grip(&self) -> bool {
        self.tasks().any(|task| matches!(task.motion, Phase::Grip { .. }))
    }

    /// Whether several arms work at once.
    pub(crate) fn has_several_arms(&self) -> bool {
        self.tasks().count() > 1
    }
}

impl<T, const J: usize> From<Phase<T, J>> for Step<T, J> {
    fn from(motion: Phase<T, J>) -> Self {
        Self::new(ArmTask { motion, assignment: None })
    }
}

impl Next {
    /// Number of the step that follows the one of this number in a list of so many; `None` is the end.
    pub fn after(self, step: usize, steps: usize) -> Option<usize> {
        let next = match self {
            Self::InOrder => step + 1,
            Self::Step(next) => next,
            Self::End => steps,
        };
        (next < steps).then_some(next)
    }
}

//! A wrench that is applied from outside, as a course over time.

use super::{Effector, Load, Stage};
use crate::source::Source;
use std::fmt;
use wrasse_dynamics::{Kinematics, PerBody};
use wrasse_spatial::SpatialForce;

/// An instant that an applied wrench is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Time (s).
    pub time: f64,
    /// A time inside the stretch between two breakpoints to which the instant belongs (s): at a
    /// breakpoint itself it tells before from after.
    pub within: f64,
}

/// A wrench on each body at its origin, in its axes (N·m, N), as a function of the instant and of how
/// the bodies stand and move then.
pub type Course<const J: usize> =
    Box<dyn Fn(Instant, &Kinematics<'_, f64, J>) -> PerBody<SpatialForce<f64>, J> + Send + Sync>;

/// A wrench from outside.
pub struct AppliedWrench<const J: usize> {
    /// Its course.
    pub course: Course<J>,
    /// Times at which it jumps, or changes otherwise than smoothly (s).
    pub breakpoints: Vec<f64>,
}

impl<const J: usize> AppliedWrench<J> {
    /// With this course, not smooth at these times (s).
    pub fn new(course: Course<J>, breakpoints: &[f64]) -> Self {
        Self { course, breakpoints: breakpoints.to_vec() }
    }
}

impl<const J: usize> fmt::Debug for AppliedWrench<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AppliedWrench")
            .field("breakpoints", &self.breakpoints)
            .finish_non_exhaustive()
    }
}

impl<const J: usize> Effector<J> for AppliedWrench<J> {
    fn source(&self) -> Source {
        Source::Applied
    }
    fn acts_on_held_base(&self) -> bool {
        true
    }
    fn sees_links(&self) -> bool {
        true
    }
    fn act(&self, at: &Stage<'_, J>, _own: &[f64], load: &mut Load<'_, J>, _rates: &mut [f64]) {
        let Some(k) = at.k else { return };
        let (time, within) = (at.period_start + at.t, at.period_start + at.within);
        let wrenches = (self.course)(Instant { time, within }, k);
        for body in k.robot.bodies() {
            load.push(k, body, &wrenches[body]);
        }
    }
    fn breakpoints(&self, period_start: f64, (from, to): (f64, f64), each: &mut dyn FnMut(f64)) {
        // One at an end of the period, but for the rounding of sums of periods, is none in it.
        let near = 1e-9 * (to - from);
        let into = self.breakpoints.iter().map(|time| time - period_start);
        into.filter(|t| *t > from + near && *t < to - near).for_each(each);
    }
}

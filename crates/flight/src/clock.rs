//! How long a motion takes, counted in control periods.

use crate::tool_pose::Unreachable;
use crate::trajectory::BadNumbers;
use wrasse_spatial::Scalar;

/// A step that cannot begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadPhase<T> {
    /// Number of the step.
    pub phase: usize,
    /// Why.
    pub reason: NoWay<T>,
}

/// Why there is no way to go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoWay<T> {
    /// Its numbers describe no motion.
    Numbers(BadNumbers),
    /// No joint positions bring the tool to its pose.
    Unreachable(Unreachable<T>),
    /// It would take longer than any mission.
    TooLong {
        /// How long (s).
        duration: T,
        /// How long a phase may be (s).
        longest: T,
    },
    /// It has begun as often as it may.
    Exhausted(u32),
}

impl<T> From<BadNumbers> for NoWay<T> {
    fn from(numbers: BadNumbers) -> Self {
        Self::Numbers(numbers)
    }
}

/// Longest phase, and longest mission (control periods): ten days at 100 Hz, a guard against typing
/// errors.
pub const LONGEST: u32 = 86_400_000;

/// Periods since a motion began, and of all of it.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Clock {
    elapsed: u32,
    length: u32,
}

impl Clock {
    /// Whether the motion is over, or none has begun.
    pub(crate) fn is_over(self) -> bool {
        self.elapsed >= self.length
    }
    /// Say how long the motion that now begins lasts (s), in periods of `period` (s).
    pub(crate) fn begin<T: Scalar>(&mut self, duration: T, period: T) -> Result<(), NoWay<T>> {
        let count = (duration / period).to_f64() - 1e-9;
        if count > f64::from(LONGEST) {
            let longest = T::from_f64(f64::from(LONGEST)) * period;
            return Err(NoWay::TooLong { duration, longest });
        }
        (self.elapsed, self.length) = (0, whole_periods(count));
        Ok(())
    }
    /// How long the current motion lasts (s), in whole periods of `period` (s).
    pub(crate) fn duration<T: Scalar>(self, period: T) -> T {
        T::from_f64(f64::from(self.length)) * period
    }
    /// One period on; how many since the motion began.
    pub(crate) fn tick(&mut self) -> u32 {
        self.elapsed = self.elapsed.saturating_add(1);
        self.elapsed
    }
}

/// A number of periods, rounded up, at least one. The cast saturates; of what is no number it is one.
pub(crate) fn whole_periods(count: f64) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "rounds up")]
    let whole = count.max(0.0) as u32;
    if f64::from(whole) < count { whole.saturating_add(1) } else { whole.max(1) }
}

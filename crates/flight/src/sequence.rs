//! Phases one after the other, counted in control periods.

use crate::phase::{PHASES, Phase};
use crate::tool_pose::Unreachable;
use crate::trajectory::BadNumbers;
use wrasse_spatial::Scalar;

/// A phase that cannot begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadPhase<T> {
    /// Number of the phase.
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
}
impl<T> From<BadNumbers> for NoWay<T> {
    fn from(numbers: BadNumbers) -> Self {
        Self::Numbers(numbers)
    }
}

/// Longest phase, and longest mission (control periods): ten days at 100 Hz, a guard against typing
/// errors.
pub const LONGEST: u32 = 86_400_000;

/// Where in its phases the computer is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sequence<T, const J: usize> {
    phases: [Option<Phase<T, J>>; PHASES],
    /// Number of the current phase, once the first has begun.
    current: Option<usize>,
    /// Periods since the current phase began, and of all of it.
    elapsed: u32,
    length: u32,
}

impl<T: Scalar, const J: usize> Sequence<T, J> {
    /// These phases; those beyond [`PHASES`] are left out.
    pub(crate) fn new(phases: &[Phase<T, J>]) -> Self {
        let mut list = [None; PHASES];
        list.iter_mut().zip(phases).for_each(|(to, from)| *to = Some(*from));
        Self { phases: list, current: None, elapsed: 0, length: 0 }
    }
    fn at(&self, phase: usize) -> Option<Phase<T, J>> {
        self.phases.get(phase).copied().flatten()
    }
    /// Number of the current phase: that of the phases when all are done.
    pub(crate) fn number(&self) -> usize {
        self.current.unwrap_or(0)
    }
    /// Whether the current phase is over, or none has begun.
    pub(crate) fn is_over(&self) -> bool {
        self.elapsed >= self.length
    }
    /// Whether all phases are done.
    pub(crate) fn is_done(&self) -> bool {
        self.current.is_some_and(|current| {
            self.at(current).is_none() || (self.at(current + 1).is_none() && self.is_over())
        })
    }
    /// The next phase; `None` from the last one on, for ever.
    pub(crate) fn next(&mut self) -> Option<Phase<T, J>> {
        let next = self.current.map_or(0, |current| (current + 1).min(PHASES));
        (self.current, self.elapsed, self.length) = (Some(next), 0, u32::MAX);
        self.at(next)
    }
    /// The current phase once more, from its start.
    pub(crate) fn again(&mut self) -> Option<Phase<T, J>> {
        (self.elapsed, self.length) = (0, u32::MAX);
        self.at(self.number())
    }
    /// Say how long the phase that just began lasts (s), in periods of `period` (s).
    pub(crate) fn lasts(&mut self, duration: T, period: T) -> Result<(), NoWay<T>> {
        let count = (duration / period).to_f64() - 1e-9;
        if count > f64::from(LONGEST) {
            let longest = T::from_f64(f64::from(LONGEST)) * period;
            return Err(NoWay::TooLong { duration, longest });
        }
        // The cast saturates; a NaN duration was refused before.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "rounds up")]
        let whole = count.max(0.0) as u32;
        self.length = if f64::from(whole) < count { whole + 1 } else { whole.max(1) };
        Ok(())
    }
    /// How long the current phase lasts (s), in whole periods of `period` (s).
    pub(crate) fn duration(&self, period: T) -> T {
        T::from_f64(f64::from(self.length)) * period
    }
    /// One period on; how many since the phase began.
    pub(crate) fn tick(&mut self) -> u32 {
        self.elapsed = self.elapsed.saturating_add(1);
        self.elapsed
    }
}

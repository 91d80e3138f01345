//! Limits of a motion, and what is wrong with numbers that cannot describe one.

use core::fmt;
use wrasse_spatial::Scalar;

/// What a motion may not exceed: per coordinate of a joint, of a path, or of a fraction of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionLimits<T> {
    /// Largest speed (m/s, rad/s, or 1/s).
    pub speed: T,
    /// Largest acceleration (per s²).
    pub acceleration: T,
    /// Largest jerk (per s³).
    pub jerk: T,
}

impl<T: Scalar> MotionLimits<T> {
    /// Limits of the fraction of a way of this length (> 0) that keep these limits along the way.
    #[must_use]
    pub fn of_fraction(&self, length: T) -> Self {
        let per = T::one() / length;
        Self {
            speed: self.speed * per,
            acceleration: self.acceleration * per,
            jerk: self.jerk * per,
        }
    }
    /// The tighter of each.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self {
            speed: self.speed.min(other.speed),
            acceleration: self.acceleration.min(other.acceleration),
            jerk: self.jerk.min(other.jerk),
        }
    }
    /// Each limit as a number that must be positive.
    pub(super) fn checked(&self) -> [Option<BadNumber>; 3] {
        [
            BadNumber::unless_positive(Quantity::SpeedLimit, self.speed),
            BadNumber::unless_positive(Quantity::AccelerationLimit, self.acceleration),
            BadNumber::unless_positive(Quantity::JerkLimit, self.jerk),
        ]
    }
}

/// A number of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Length of a path (m, rad or –).
    Length,
    /// Time from start to end (s).
    Duration,
    /// Largest speed (per s).
    SpeedLimit,
    /// Largest acceleration (per s²).
    AccelerationLimit,
    /// Largest jerk (per s³).
    JerkLimit,
    /// Way from the first to the last position (m, rad).
    Way,
    /// Relative rotation of two poses: the sum of its matrix is shown (–).
    Rotation,
}

/// What a number should have been.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Expected {
    /// A finite number.
    Finite,
    /// A finite number, zero or above.
    FiniteNotNegative,
    /// A finite number above zero.
    FinitePositive,
    /// Above zero, because start and end differ.
    PositiveSinceTheEndsDiffer,
}

/// A number that cannot describe a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadNumber {
    /// What it should be.
    pub quantity: Quantity,
    /// The joint it belongs to, where it belongs to one.
    pub joint: Option<u16>,
    /// What was found, in the unit of the quantity.
    pub found: f64,
    /// What was expected.
    pub expected: Expected,
}

impl BadNumber {
    /// Complaint unless it is good.
    pub(super) fn unless<T: Scalar>(
        good: bool,
        quantity: Quantity,
        found: T,
        expected: Expected,
    ) -> Option<Self> {
        (!good).then(|| Self { quantity, joint: None, found: found.to_f64(), expected })
    }
    /// Complaint unless the number is finite and above zero.
    pub(super) fn unless_positive<T: Scalar>(quantity: Quantity, x: T) -> Option<Self> {
        Self::unless(x.is_finite() && x > T::zero(), quantity, x, Expected::FinitePositive)
    }
    /// Complaint unless the number is finite and not below zero.
    pub(super) fn unless_length<T: Scalar>(quantity: Quantity, x: T) -> Option<Self> {
        Self::unless(x.is_finite() && x >= T::zero(), quantity, x, Expected::FiniteNotNegative)
    }
    /// Complaint unless the number is finite.
    pub(super) fn unless_finite<T: Scalar>(quantity: Quantity, x: T) -> Option<Self> {
        Self::unless(x.is_finite(), quantity, x, Expected::Finite)
    }
    /// The same, of a joint.
    pub(super) fn of_joint(self, j: usize) -> Self {
        Self { joint: u16::try_from(j).ok(), ..self }
    }
}

impl fmt::Display for BadNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let quantity = match self.quantity {
            Quantity::Length => "length of the path",
            Quantity::Duration => "duration (s)",
            Quantity::SpeedLimit => "speed limit",
            Quantity::AccelerationLimit => "acceleration limit",
            Quantity::JerkLimit => "jerk limit",
            Quantity::Way => "way from start to end",
            Quantity::Rotation => "relative rotation (sum of its matrix)",
        };
        let expected = match self.expected {
            Expected::Finite => "a finite number",
            Expected::FiniteNotNegative => "a finite number, zero or above",
            Expected::FinitePositive => "a finite number above zero",
            Expected::PositiveSinceTheEndsDiffer => "above zero, since start and end differ",
        };
        write!(f, "{quantity}")?;
        if let Some(j) = self.joint {
            write!(f, " of joint {j}")?;
        }
        write!(f, ": found {}, expected {expected}", self.found)
    }
}

/// Every number of a motion that is not what it should be: at least one, at most four.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BadNumbers([Option<BadNumber>; 4]);

impl BadNumbers {
    /// `Ok` if there is no complaint.
    pub(super) fn none_of<const N: usize>(found: [Option<BadNumber>; N]) -> Result<(), Self> {
        let mut all = [None; 4];
        for (slot, complaint) in all.iter_mut().zip(found.into_iter().flatten()) {
            *slot = Some(complaint);
        }
        if all[0].is_some() { Err(Self(all)) } else { Ok(()) }
    }
    /// The complaints, in the order of the arguments.
    pub fn iter(&self) -> impl Iterator<Item = &BadNumber> {
        self.0.iter().flatten()
    }
}

impl fmt::Display for BadNumbers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, complaint) in self.iter().enumerate() {
            write!(f, "{}{complaint}", if k > 0 { "; " } else { "" })?;
        }
        Ok(())
    }
}
impl core::error::Error for BadNumbers {}

//! How far along a path, when: one of the shapes a motion can have.

use super::{BadNumbers, Motion, MotionLimits, Quintic, SCurve};
use wrasse_spatial::{Real, Scalar};

/// Progress along a path of some length, from rest to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Profile<T> {
    /// Polynomial of degree five in time.
    Quintic(Quintic<T>),
    /// Bounded jerk: the shortest under three limits.
    SCurve(SCurve<T>),
}

/// Which kind of profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProfileShape {
    /// Polynomial of degree five in time.
    Quintic,
    /// Bounded jerk.
    SCurve,
}

impl<T: Scalar> Profile<T> {
    /// The shortest profile of this shape over `length` (m, rad or –) that keeps the limits.
    ///
    /// # Errors
    /// If a limit is not positive and finite, or the length is negative or not finite.
    pub fn within(
        shape: ProfileShape,
        length: T,
        limits: &MotionLimits<T>,
    ) -> Result<Self, BadNumbers> {
        Ok(match shape {
            ProfileShape::Quintic => Self::Quintic(Quintic::from_limits(length, limits)?),
            ProfileShape::SCurve => Self::SCurve(SCurve::new(length, limits)?),
        })
    }
}

impl<T: Real> Profile<T> {
    /// Progress at time `t` (s) from the start; at rest before it and after the end.
    pub fn at(&self, t: T) -> Motion<T> {
        match self {
            Self::Quintic(profile) => profile.at(t),
            Self::SCurve(profile) => profile.at(t),
        }
    }
    /// Time from rest to rest (s).
    pub fn duration(&self) -> T {
        match self {
            Self::Quintic(profile) => profile.duration(),
            Self::SCurve(profile) => profile.duration(),
        }
    }
    /// Length of the path (m, rad or –).
    pub fn length(&self) -> T {
        match self {
            Self::Quintic(profile) => profile.length(),
            Self::SCurve(profile) => profile.length(),
        }
    }
    /// Progress as a fraction of the path; zero on a path without length.
    pub fn fraction_at(&self, t: T) -> Motion<T> {
        let length = self.length();
        let per = T::select(T::zero().lt(length), T::one() / length, T::zero());
        let motion = self.at(t);
        Motion {
            // The quotient, not the product: it is exactly one at the end.
            position: T::select(T::zero().lt(length), motion.position / length, T::zero()),
            velocity: motion.velocity * per,
            acceleration: motion.acceleration * per,
        }
    }
}

//! Joints from one posture to another, all on one profile.

use super::{
    BadNumber, BadNumbers, Expected, Motion, MotionLimits, Profile, ProfileShape, Quantity, Quintic,
};
use wrasse_spatial::{Real, Scalar};

/// What the joints should do at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSetPoint<T, const J: usize> {
    /// Positions (rad or m).
    pub q: [T; J],
    /// Rates (rad/s or m/s).
    pub v: [T; J],
    /// Accelerations (rad/s² or m/s²).
    pub vdot: [T; J],
}

impl<T: Real, const J: usize> JointSetPoint<T, J> {
    /// At rest in a posture.
    pub fn at_rest(q: [T; J]) -> Self {
        Self { q, v: [T::zero(); J], vdot: [T::zero(); J] }
    }
    fn of_motions(motion: impl Fn(usize) -> Motion<T>) -> Self {
        let mut set_point = Self::at_rest([T::zero(); J]);
        for j in 0..J {
            let Motion { position, velocity, acceleration } = motion(j);
            set_point.q[j] = position;
            set_point.v[j] = velocity;
            set_point.vdot[j] = acceleration;
        }
        set_point
    }
}

/// All joints from rest to rest on one profile: they start and end together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMove<T, const J: usize> {
    from: [T; J],
    to: [T; J],
    profile: Profile<T>,
}

impl<T: Scalar, const J: usize> JointMove<T, J> {
    /// From one posture to another; the profile may be over any length, its fraction is what counts.
    ///
    /// # Errors
    /// If a position is not finite, or the profile has no length although the postures differ.
    pub fn new(from: [T; J], to: [T; J], profile: Profile<T>) -> Result<Self, BadNumbers> {
        let stuck = from != to && profile.length() <= T::zero();
        BadNumbers::none_of([
            bad_displacement(&from, &to),
            BadNumber::unless(
                !stuck,
                Quantity::Length,
                profile.length(),
                Expected::PositiveSinceTheEndsDiffer,
            ),
        ])?;
        Ok(Self { from, to, profile })
    }
    /// The shortest synchronised move of this shape under the limits of each joint: for each of
    /// speed, acceleration and jerk, the joint that needs longest decides.
    ///
    /// # Errors
    /// If a position is not finite, or a limit not positive and finite.
    pub fn within(
        from: [T; J],
        to: [T; J],
        shape: ProfileShape,
        limits: &[MotionLimits<T>; J],
    ) -> Result<Self, BadNumbers> {
        BadNumbers::none_of([bad_displacement(&from, &to)])?;
        let mut common: Option<MotionLimits<T>> = None;
        for j in 0..J {
            let bad = limits[j].checked().map(|bad| bad.map(|bad| bad.of_joint(j)));
            BadNumbers::none_of(bad)?;
            let travel = (to[j] - from[j]).abs();
            if travel > T::zero() {
                let own = limits[j].of_fraction(travel);
                common = Some(common.map_or(own, |others| others.and(&own)));
            }
        }
        let profile = match common {
            Some(limits) => Profile::within(shape, T::one(), &limits)?,
            None => Profile::Quintic(Quintic::new(T::zero(), T::zero())?),
        };
        Ok(Self { from, to, profile })
    }
}

/// Complaint if a joint has no finite way to go.
fn bad_displacement<T: Scalar, const J: usize>(from: &[T; J], to: &[T; J]) -> Option<BadNumber> {
    let bad = |j: usize| {
        BadNumber::unless_finite(Quantity::Way, to[j] - from[j]).map(|bad| bad.of_joint(j))
    };
    (0..J).find_map(bad)
}

impl<T: Real, const J: usize> JointMove<T, J> {
    /// The joints' motion at time `t` (s) from the start; at rest before it and after the end.
    pub fn at(&self, t: T) -> JointSetPoint<T, J> {
        let along = self.profile.fraction_at(t);
        JointSetPoint::of_motions(|j| {
            let way = self.to[j] - self.from[j];
            Motion {
                position: self.from[j] + way * along.position,
                velocity: way * along.velocity,
                acceleration: way * along.acceleration,
            }
        })
    }
    /// Time from rest to rest (s).
    pub fn duration(&self) -> T {
        self.profile.duration()
    }
    /// Progress of all joints.
    pub fn profile(&self) -> &Profile<T> {
        &self.profile
    }
}

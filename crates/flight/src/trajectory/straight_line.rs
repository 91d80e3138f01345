//! The tool on a straight line, its orientation on the geodesic: one parameter runs both.

use super::{BadNumber, BadNumbers, Expected, MotionLimits, Profile, ProfileShape, Quantity};
use wrasse_spatial::{Pose, Quat, Real, Scalar, SpatialVelocity, Vec3};

/// A move of the tool frame E from one pose to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightLine<T> {
    X_NE0: Pose<T>,
    /// From the first to the last position, N axes (m).
    displacement_N: Vec3<T>,
    /// Rotation vector from the first to the last orientation, axes of E at the start (rad).
    turn_E0: Vec3<T>,
    profile: Profile<T>,
}

/// Where the tool should be and how it should move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolMotion<T> {
    /// Pose.
    pub X_NE: Pose<T>,
    /// Velocity of the tool's origin, N axes (rad/s, m/s).
    pub V_NE_N: SpatialVelocity<T>,
    /// Time derivative of the components of `V_NE_N` (rad/s², m/s²): its linear part is the
    /// classical acceleration of the origin, not the spatial one.
    pub Vdot_NE_N: SpatialVelocity<T>,
}

/// What lies between the two ends of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolWay<T> {
    /// From the first to the last position, N axes (m).
    pub displacement_N: Vec3<T>,
    /// Rotation vector from the first to the last orientation, N axes (rad): of any number of turns.
    pub turn_N: Vec3<T>,
}

impl<T: Scalar> ToolWay<T> {
    /// Between two poses, turning on the shorter way.
    pub fn between(X_NE0: &Pose<T>, X_NE1: &Pose<T>) -> Self {
        let R_E0E1 = X_NE0.rotation.transpose() * X_NE1.rotation;
        Self {
            displacement_N: X_NE1.translation - X_NE0.translation,
            turn_N: X_NE0.rotation * Quat::from_matrix(&R_E0E1).log(),
        }
    }
    /// The same, if its numbers are finite; errors if they are not.
    fn finite(&self) -> Result<(), BadNumbers> {
        BadNumbers::none_of([
            BadNumber::unless_finite(Quantity::Way, self.displacement_N.norm()),
            BadNumber::unless_finite(Quantity::Rotation, self.turn_N.norm()),
        ])
    }
}

impl<T: Scalar> StraightLine<T> {
    /// From `X_NE0` to `X_NE1`; the profile may be over any length, its fraction is what counts.
    ///
    /// # Errors
    /// If a pose is not finite, or the profile has no length although the poses differ.
    pub fn new(X_NE0: Pose<T>, X_NE1: Pose<T>, profile: Profile<T>) -> Result<Self, BadNumbers> {
        Self::along(X_NE0, &ToolWay::between(&X_NE0, &X_NE1), profile)
    }
    /// From `X_NE0` this way.
    ///
    /// # Errors
    /// If the way is not finite, or the profile has no length although the way has one.
    pub fn along(
        X_NE0: Pose<T>,
        way: &ToolWay<T>,
        profile: Profile<T>,
    ) -> Result<Self, BadNumbers> {
        way.finite()?;
        let moves = *way != ToolWay { displacement_N: Vec3::zero(), turn_N: Vec3::zero() };
        let stuck = moves && profile.length() <= T::zero();
        let expected = Expected::PositiveSinceTheEndsDiffer;
        BadNumbers::none_of([BadNumber::unless(
            !stuck,
            Quantity::Length,
            profile.length(),
            expected,
        )])?;
        Ok(Self::of(X_NE0, way, profile))
    }
    /// The shortest move of this shape under limits of the position (m) and of the turn (rad).
    ///
    /// # Errors
    /// If a pose is not finite or a limit not positive and finite.
    pub fn within(
        X_NE0: Pose<T>,
        X_NE1: Pose<T>,
        shape: ProfileShape,
        linear: &MotionLimits<T>,
        angular: &MotionLimits<T>,
    ) -> Result<Self, BadNumbers> {
        Self::along_within(X_NE0, &ToolWay::between(&X_NE0, &X_NE1), shape, linear, angular)
    }
    /// The same from `X_NE0` this way.
    ///
    /// # Errors
    /// If the way is not finite or a limit not positive and finite.
    pub fn along_within(
        X_NE0: Pose<T>,
        way: &ToolWay<T>,
        shape: ProfileShape,
        linear: &MotionLimits<T>,
        angular: &MotionLimits<T>,
    ) -> Result<Self, BadNumbers> {
        way.finite()?;
        // Bad limits are complained of even where they would not count.
        let distance = way.displacement_N.norm();
        let along = Profile::within(shape, distance, linear)?;
        let angle = way.turn_N.norm();
        let about = Profile::within(shape, angle, angular)?;
        let profile = match (distance > T::zero(), angle > T::zero()) {
            (true, true) => {
                let both = linear.of_fraction(distance).and(&angular.of_fraction(angle));
                Profile::within(shape, T::one(), &both)?
            }
            (false, true) => about,
            _ => along,
        };
        Ok(Self::of(X_NE0, way, profile))
    }
    fn of(X_NE0: Pose<T>, way: &ToolWay<T>, profile: Profile<T>) -> Self {
        let turn_E0 = X_NE0.rotation.transpose_mul(way.turn_N);
        Self { X_NE0, displacement_N: way.displacement_N, turn_E0, profile }
    }
}

impl<T: Real> StraightLine<T> {
    /// The tool's motion at time `t` (s) from the start; at rest before it and after the end.
    pub fn at(&self, t: T) -> ToolMotion<T> {
        let along = self.profile.fraction_at(t);
        let R_N0 = self.X_NE0.rotation;
        let turn = Quat::exp(self.turn_E0 * along.position).to_matrix();
        // The axis of the turn stands still in N, so rate and acceleration keep its direction.
        let turn_N = R_N0 * self.turn_E0;
        let way = SpatialVelocity::new(turn_N, self.displacement_N);
        ToolMotion {
            X_NE: Pose::new(
                R_N0 * turn,
                self.X_NE0.translation + self.displacement_N * along.position,
            ),
            V_NE_N: way * along.velocity,
            Vdot_NE_N: way * along.acceleration,
        }
    }
    /// Time from rest to rest (s).
    pub fn duration(&self) -> T {
        self.profile.duration()
    }
    /// Distance between the two positions (m).
    pub fn distance(&self) -> T {
        self.displacement_N.norm()
    }
    /// Angle between the two orientations (rad).
    pub fn angle(&self) -> T {
        self.turn_E0.norm()
    }
    /// Progress along the line.
    pub fn profile(&self) -> &Profile<T> {
        &self.profile
    }
}

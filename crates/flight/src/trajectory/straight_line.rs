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

impl<T: Scalar> StraightLine<T> {
    /// From `X_NE0` to `X_NE1`; the profile may be over any length, its fraction is what counts.
    ///
    /// # Errors
    /// If a pose is not finite, or the profile has no length although the poses differ.
    pub fn new(X_NE0: Pose<T>, X_NE1: Pose<T>, profile: Profile<T>) -> Result<Self, BadNumbers> {
        let (displacement_N, turn_E0) = between(&X_NE0, &X_NE1)?;
        let stuck = X_NE0 != X_NE1 && profile.length() <= T::zero();
        let expected = Expected::PositiveSinceTheEndsDiffer;
        BadNumbers::none_of([BadNumber::unless(
            !stuck,
            Quantity::Length,
            profile.length(),
            expected,
        )])?;
        Ok(Self { X_NE0, displacement_N, turn_E0, profile })
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
        let (displacement_N, turn_E0) = between(&X_NE0, &X_NE1)?;
        // Bad limits are complained of even where they would not count.
        let distance = displacement_N.norm();
        let along = Profile::within(shape, distance, linear)?;
        let angle = turn_E0.norm();
        let about = Profile::within(shape, angle, angular)?;
        let profile = match (distance > T::zero(), angle > T::zero()) {
            (true, true) => {
                let both = linear.of_fraction(distance).and(&angular.of_fraction(angle));
                Profile::within(shape, T::one(), &both)?
            }
            (false, true) => about,
            _ => along,
        };
        Ok(Self { X_NE0, displacement_N, turn_E0, profile })
    }
}

/// Displacement (N axes, m) and rotation vector (axes of the first pose, rad) between two poses.
fn between<T: Scalar>(X_NE0: &Pose<T>, X_NE1: &Pose<T>) -> Result<(Vec3<T>, Vec3<T>), BadNumbers> {
    let displacement_N = X_NE1.translation - X_NE0.translation;
    let R_E0E1 = X_NE0.rotation.transpose() * X_NE1.rotation;
    let rows = R_E0E1.rows.map(|row| row.x + row.y + row.z);
    BadNumbers::none_of([
        BadNumber::unless_finite(Quantity::Way, displacement_N.norm()),
        BadNumber::unless_finite(Quantity::Rotation, rows[0] + rows[1] + rows[2]),
    ])?;
    Ok((displacement_N, Quat::from_matrix(&R_E0E1).log()))
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

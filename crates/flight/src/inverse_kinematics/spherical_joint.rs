//! Three axes through one point, neighbours at right angles: the angles of a rotation.

use super::precision::epsilon;
use wrasse_spatial::{Mat3, Quat, Scalar, Vec3};

/// Which of the two ways to bend a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The middle angle in [0, π] from the straight posture.
    Positive,
    /// The middle angle in [-π, 0].
    Negative,
}

impl Side {
    /// Both, positive first.
    pub const BOTH: [Self; 2] = [Self::Positive, Self::Negative];
    /// +1 or -1 (–).
    pub(super) fn sign<T: Scalar>(self) -> T {
        match self {
            Self::Positive => T::one(),
            Self::Negative => -T::one(),
        }
    }
}

/// Rotation about a unit axis (–) by an angle (rad).
pub(super) fn about<T: Scalar>(axis: Vec3<T>, angle: T) -> Mat3<T> {
    let (sine, cosine) = (angle * T::from_f64(0.5)).sin_cos();
    let v = axis * sine;
    Quat::new(cosine, v.x, v.y, v.z).to_matrix()
}

/// Three joints whose axes meet, in their zero posture: first ⟂ second ⟂ third.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SphericalJoint<T> {
    axes: [Vec3<T>; 3],
    /// Angle about the second axis from the first axis to the third (rad).
    bend_at_zero: T,
}

impl<T: Scalar> SphericalJoint<T> {
    /// From three unit axes.
    pub(super) fn new(axes: [Vec3<T>; 3]) -> Self {
        let [z1, z2, z3] = axes;
        let bend_at_zero = z3.dot(z2.cross(z1)).atan2(z3.dot(z1));
        Self { axes, bend_at_zero }
    }
    /// The rotation of what the third joint carries, `exp(z₁q₁) exp(z₂q₂) exp(z₃q₃)`.
    pub(super) fn rotation(&self, q: [T; 3]) -> Mat3<T> {
        let [z1, z2, z3] = self.axes;
        about(z1, q[0]) * about(z2, q[1]) * about(z3, q[2])
    }
    /// Angles (rad) that make the rotation `R`, and the sine of the angle between first and third
    /// axis. Where that is zero only the sum of first and third angle is given: the first is `held`.
    pub(super) fn angles(&self, R: &Mat3<T>, side: Side, held: T) -> ([T; 3], T) {
        let [z1, z2, z3] = self.axes;
        // R z₃ = cos β z₁ + sin β (cos q₁ z₂×z₁ + sin q₁ z₂), β = q₂ + bend at zero.
        let r = *R * z3;
        let (across, along) = (r.dot(z2), r.dot(z2.cross(z1)));
        let sine = (across * across + along * along).sqrt();
        let sign = side.sign::<T>();
        let straight = sine < T::from_f64(8.0) * epsilon();
        let q1 = if straight { held } else { (sign * across).atan2(sign * along) };
        let bend = (sign * sine).atan2(r.dot(z1));
        let q2 = bend - self.bend_at_zero;
        // What is left turns about the third axis: exact even where the first was free.
        let left = (about(z1, q1) * about(z2, q2)).transpose() * *R;
        let turned = left * z2;
        let q3 = turned.dot(z3.cross(z2)).atan2(turned.dot(z2));
        ([q1, q2, q3], sine)
    }
}

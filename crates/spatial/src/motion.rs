//! Spatial velocities and spatial forces: two kinds that do not mix.

use crate::{Real, Vec3};
use core::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Velocity of a body at a point: `V_NB_B = [w_NB_B; v_NB_B]`, angular part first.
///
/// The same kind carries Featherstone's spatial acceleration, which shifts like a velocity; it is not
/// the [classical](ClassicalAcceleration) acceleration of the point (that is `A.linear + w × v`).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpatialVelocity<T> {
    /// Angular velocity (rad/s).
    pub angular: Vec3<T>,
    /// Velocity of the point (m/s).
    pub linear: Vec3<T>,
}

/// Featherstone's spatial acceleration (rad/s², m/s²): the plain time derivative of the components
/// of a spatial velocity in body axes.
pub type SpatialAcceleration<T> = SpatialVelocity<T>;

/// Acceleration of a body at a point, as an observer in N measures it: the angular acceleration
/// (rad/s²), and the second derivative of the point's position (m/s²).
///
/// Its linear part differs from that of a [`SpatialAcceleration`] by `w × v`, so the two do not mix.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ClassicalAcceleration<T> {
    /// Angular acceleration (rad/s²).
    pub angular: Vec3<T>,
    /// Acceleration of the point (m/s²).
    pub linear: Vec3<T>,
}

impl<T: Real> ClassicalAcceleration<T> {
    /// Of a body with the twist `V`, from the time derivatives of its components in body axes.
    #[inline(always)]
    pub fn of_twist(V: &SpatialVelocity<T>, Vdot: &SpatialAcceleration<T>) -> Self {
        Self { angular: Vdot.angular, linear: Vdot.linear + V.angular.cross(V.linear) }
    }
    /// Time derivatives of the components of the twist `V` in body axes.
    #[inline(always)]
    pub fn twist_rate(&self, V: &SpatialVelocity<T>) -> SpatialAcceleration<T> {
        SpatialAcceleration::new(self.angular, self.linear - V.angular.cross(V.linear))
    }
    /// That of a point C that is fixed to the body, from the offset `p_BC` (m) and the body's turning
    /// rate `w` (rad/s).
    #[inline(always)]
    #[must_use]
    pub fn shifted_by(&self, p_BC: Vec3<T>, w: Vec3<T>) -> Self {
        let linear = self.linear + self.angular.cross(p_BC) + w.cross(w.cross(p_BC));
        Self { angular: self.angular, linear }
    }
}

/// Force on a body: `F_B_B = [torque about Bo; force]`, torque first.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpatialForce<T> {
    /// Torque about the point (N·m).
    pub torque: Vec3<T>,
    /// Force (N).
    pub force: Vec3<T>,
}

/// Spatial momentum `[angular about the point; linear]` (N·m·s, N·s): shifts like a force.
pub type SpatialMomentum<T> = SpatialForce<T>;

impl<T: Real> SpatialVelocity<T> {
    /// From its two parts, angular first.
    #[inline(always)]
    pub fn new(angular: Vec3<T>, linear: Vec3<T>) -> Self {
        Self { angular, linear }
    }
    /// At rest.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::default()
    }
    /// `V_AC_E` of a point C that is fixed to B, from the offset `p_BC_E` (m).
    #[inline(always)]
    #[must_use]
    pub fn shifted_by(&self, p_BC_E: Vec3<T>) -> Self {
        Self::new(self.angular, self.linear + self.angular.cross(p_BC_E))
    }
    /// `V × W`: rate of change of W when it is carried along with V. [Featherstone2008] ch. 2.
    ///
    /// [Featherstone2008]: crate::references::Featherstone2008
    #[inline(always)]
    #[must_use]
    pub fn cross(&self, W: &Self) -> Self {
        Self::new(
            self.angular.cross(W.angular),
            self.angular.cross(W.linear) + self.linear.cross(W.angular),
        )
    }
    /// `V ×* F`: rate of change of a force or momentum when it is carried along with V.
    #[inline(always)]
    pub fn cross_force(&self, F: &SpatialForce<T>) -> SpatialForce<T> {
        SpatialForce::new(
            self.angular.cross(F.torque) + self.linear.cross(F.force),
            self.angular.cross(F.force),
        )
    }
    /// Power (W) of a force on the same body, at the same point, in the same axes.
    #[inline(always)]
    pub fn power(&self, F: &SpatialForce<T>) -> T {
        self.angular.dot(F.torque) + self.linear.dot(F.force)
    }
    /// The six components, angular first.
    #[inline(always)]
    pub fn to_array(self) -> [T; 6] {
        let (a, l) = (self.angular, self.linear);
        [a.x, a.y, a.z, l.x, l.y, l.z]
    }
    /// From six components, angular first.
    #[inline(always)]
    pub fn from_array(a: [T; 6]) -> Self {
        Self::new(Vec3::from_array([a[0], a[1], a[2]]), Vec3::from_array([a[3], a[4], a[5]]))
    }
}

impl<T: Real> SpatialForce<T> {
    /// From its two parts, torque first.
    #[inline(always)]
    pub fn new(torque: Vec3<T>, force: Vec3<T>) -> Self {
        Self { torque, force }
    }
    /// No force.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::default()
    }
    /// The same force about a point C instead of B, from the offset `p_BC_E` (m).
    #[inline(always)]
    #[must_use]
    pub fn about(&self, p_BC_E: Vec3<T>) -> Self {
        Self::new(self.torque - p_BC_E.cross(self.force), self.force)
    }
    /// The six components, torque first.
    #[inline(always)]
    pub fn to_array(self) -> [T; 6] {
        let (t, f) = (self.torque, self.force);
        [t.x, t.y, t.z, f.x, f.y, f.z]
    }
    /// From six components, torque first.
    #[inline(always)]
    pub fn from_array(a: [T; 6]) -> Self {
        Self::new(Vec3::from_array([a[0], a[1], a[2]]), Vec3::from_array([a[3], a[4], a[5]]))
    }
}

macro_rules! six_vector {
    ($kind:ident, $top:ident, $bottom:ident) => {
        impl<T: Real> Add for $kind<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, b: Self) -> Self {
                Self::new(self.$top + b.$top, self.$bottom + b.$bottom)
            }
        }
        impl<T: Real> Sub for $kind<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, b: Self) -> Self {
                Self::new(self.$top - b.$top, self.$bottom - b.$bottom)
            }
        }
        impl<T: Real> Neg for $kind<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::new(-self.$top, -self.$bottom)
            }
        }
        impl<T: Real> Mul<T> for $kind<T> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, s: T) -> Self {
                Self::new(self.$top * s, self.$bottom * s)
            }
        }
        impl<T: Real> AddAssign for $kind<T> {
            #[inline(always)]
            fn add_assign(&mut self, b: Self) {
                *self = *self + b;
            }
        }
    };
}
six_vector!(SpatialVelocity, angular, linear);
six_vector!(SpatialForce, torque, force);

/// A velocity and a force are different kinds of thing; adding them does not compile.
///
/// ```compile_fail
/// use wrasse_spatial::{SpatialForce, SpatialVelocity};
/// let _ = SpatialVelocity::<f64>::zero() + SpatialForce::<f64>::zero();
/// ```
#[cfg(doctest)]
#[derive(Debug)]
pub struct KindsDoNotMix;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    fn twist() -> SpatialVelocity<f64> {
        SpatialVelocity::from_array([0.5, -1.0, 2.0, 3.0, 0.25, -1.5])
    }

    fn wrench() -> SpatialForce<f64> {
        SpatialForce::from_array([2.0, 1.0, -0.5, 4.0, -3.0, 1.5])
    }

    #[test]
    fn a_point_on_a_turning_body_moves_across_its_lever() {
        let about_z = SpatialVelocity::new(vec3(0.0, 0.0, 2.0), Vec3::zero());
        assert_eq!(about_z.shifted_by(vec3(3.0, 0.0, 0.0)).linear, vec3(0.0, 6.0, 0.0));
    }

    #[test]
    fn a_force_has_a_moment_about_a_point_beside_it() {
        let up_at_x = SpatialForce::new(Vec3::zero(), vec3(0.0, 0.0, 5.0));
        // Seen from a point 2 m along x, the force acts 2 m behind.
        assert_eq!(up_at_x.about(vec3(2.0, 0.0, 0.0)).torque, vec3(0.0, 10.0, 0.0));
    }

    #[test]
    fn power_does_not_depend_on_the_point() {
        let p = vec3(0.5, -2.0, 4.0);
        assert_eq!(twist().shifted_by(p).power(&wrench().about(p)), twist().power(&wrench()));
    }

    /// `(V × W)·F = -W·(V ×* F)`: the two cross products are each other's dual.
    #[test]
    fn the_power_of_a_carried_pair_is_constant() {
        let (V, W, F) =
            (twist(), SpatialVelocity::from_array([1.0, 2.0, -4.0, 0.5, 8.0, 3.0]), wrench());
        assert_eq!(V.cross(&W).power(&F), -W.power(&V.cross_force(&F)));
    }

    #[test]
    fn the_cross_product_by_hand() {
        let V = SpatialVelocity::new(vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0));
        let W = SpatialVelocity::new(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 2.0));
        // [z×x; z×2z + x×x] = [y; 0]
        assert_eq!(V.cross(&W).to_array(), [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        let F = SpatialForce::new(vec3(0.0, 1.0, 0.0), vec3(0.0, 3.0, 0.0));
        // [z×y + x×3y; z×3y] = [-x + 3z; -3x]
        assert_eq!(V.cross_force(&F).to_array(), [-1.0, 0.0, 3.0, -3.0, 0.0, 0.0]);
    }

    #[test]
    fn arrays_keep_the_angular_part_first() {
        let V = twist();
        assert_eq!(V.to_array()[..3], V.angular.to_array());
        assert_eq!(SpatialVelocity::from_array(V.to_array()), V);
        assert_eq!(SpatialForce::from_array(wrench().to_array()), wrench());
        assert_eq!(wrench().to_array()[..3], wrench().torque.to_array());
    }
}

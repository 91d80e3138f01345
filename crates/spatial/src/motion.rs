//! Spatial velocities and spatial forces: two kinds that do not mix.

use crate::{Real, Vec3};
use core::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Velocity of a body at a point: `V_NB_B = [w_NB_B; v_NB_B]`, angular part first.
///
/// The same kind carries Featherstone's spatial acceleration, which shifts like a velocity; it is
/// not the classical acceleration of the point (that is `A.linear + w × v`).
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

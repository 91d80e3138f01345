//! Vectors of three components.

use crate::{Mat3, Real};
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// A vector of three components in some axes, which the name of the variable says.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Vec3<T> {
    /// Along the first axis.
    pub x: T,
    /// Along the second axis.
    pub y: T,
    /// Along the third axis.
    pub z: T,
}

/// The vector (x, y, z).
#[inline(always)]
pub const fn vec3<T>(x: T, y: T, z: T) -> Vec3<T> {
    Vec3 { x, y, z }
}

impl<T: Real> Vec3<T> {
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        vec3(T::zero(), T::zero(), T::zero())
    }
    /// From an array (x, y, z).
    #[inline(always)]
    pub fn from_array(a: [T; 3]) -> Self {
        vec3(a[0], a[1], a[2])
    }
    /// As an array (x, y, z).
    #[inline(always)]
    pub fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
    /// Each component converted from `f64`.
    #[inline(always)]
    pub fn from_f64(a: Vec3<f64>) -> Self {
        vec3(T::from_f64(a.x), T::from_f64(a.y), T::from_f64(a.z))
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, b: Self) -> T {
        self.x * b.x + self.y * b.y + self.z * b.z
    }
    /// Vector product.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, b: Self) -> Self {
        vec3(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
    }
    /// Length.
    #[inline(always)]
    pub fn norm(self) -> T {
        self.dot(self).sqrt()
    }
    /// The cross matrix: `a.skew() * b == a.cross(b)`.
    #[inline(always)]
    pub fn skew(self) -> Mat3<T> {
        let o = T::zero();
        Mat3::from_rows(
            vec3(o, -self.z, self.y),
            vec3(self.z, o, -self.x),
            vec3(-self.y, self.x, o),
        )
    }
    /// The dyad `a bᵀ`.
    #[inline(always)]
    pub fn outer(self, b: Self) -> Mat3<T> {
        Mat3::from_rows(b * self.x, b * self.y, b * self.z)
    }
    /// Each component by a function.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U) -> Vec3<U> {
        vec3(f(self.x), f(self.y), f(self.z))
    }
}

impl<T: Real> Add for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        vec3(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}
impl<T: Real> Sub for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        vec3(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}
impl<T: Real> Mul<T> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        vec3(self.x * s, self.y * s, self.z * s)
    }
}
impl<T: Real> Neg for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}
impl<T: Real> AddAssign for Vec3<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
impl<T: Real> SubAssign for Vec3<T> {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_follow_the_right_hand() {
        let (x, y, z) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
        assert_eq!((x.cross(y), y.cross(z), z.cross(x)), (z, x, y));
        assert_eq!(vec3(1.0, 2.0, 3.0).dot(vec3(4.0, -5.0, 6.0)), 12.0);
        assert_eq!(vec3(2.0, -3.0, 6.0).norm(), 7.0);
    }

    #[test]
    fn the_cross_matrix_and_the_dyad_multiply_like_their_products() {
        let (a, b, c) = (vec3(1.0, 2.0, 3.0), vec3(-4.0, 5.0, 6.0), vec3(0.5, -7.0, 2.0));
        assert_eq!(a.skew() * b, a.cross(b));
        assert_eq!(a.outer(b) * c, a * b.dot(c));
    }

    #[test]
    fn assignments_add_and_take_away() {
        let (mut a, b) = (vec3(1.0, 2.0, 3.0), vec3(0.5, -1.0, 4.0));
        a += b;
        assert_eq!(a, vec3(1.5, 1.0, 7.0));
        a -= b;
        assert_eq!((a, -a), (vec3(1.0, 2.0, 3.0), vec3(-1.0, -2.0, -3.0)));
    }
}

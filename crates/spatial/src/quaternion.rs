//! Unit quaternions, named `w x y z`.

use crate::{Mat3, Real, Vec3, vec3};
use core::ops::Mul;

/// Unit quaternion `quat_NB`: turns B components into N components, like `R_NB`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs, reason = "the fields are the components they name")]
pub struct Quat<T> {
    pub w: T,
    pub x: T,
    pub y: T,
    pub z: T,
}

impl<T: Real> Default for Quat<T> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<T: Real> Quat<T> {
    /// From its components.
    #[inline(always)]
    pub fn new(w: T, x: T, y: T, z: T) -> Self {
        Self { w, x, y, z }
    }
    /// No rotation.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::new(T::one(), T::zero(), T::zero(), T::zero())
    }
    /// The vector part.
    #[inline(always)]
    pub fn vector(&self) -> Vec3<T> {
        vec3(self.x, self.y, self.z)
    }
    /// The inverse rotation.
    #[inline(always)]
    #[must_use]
    pub fn conjugate(&self) -> Self {
        Self::new(self.w, -self.x, -self.y, -self.z)
    }
    /// Length (–): 1 for a rotation.
    #[inline(always)]
    pub fn norm(&self) -> T {
        (self.w * self.w + self.vector().dot(self.vector())).sqrt()
    }
    /// Scaled to length 1.
    #[inline(always)]
    #[must_use]
    pub fn normalized(&self) -> Self {
        let s = T::one() / self.norm();
        Self::new(self.w * s, self.x * s, self.y * s, self.z * s)
    }
    /// Turn by the rotation vector `r` (rad): `exp(r/2)`.
    #[inline(always)]
    pub fn exp(r: Vec3<T>) -> Self {
        // sin(θ/2)/θ by its series near zero, where the quotient loses its meaning.
        let half = T::from_f64(0.5);
        let square = r.dot(r);
        let small = square.lt(T::from_f64(1e-8));
        let theta = T::select(small, T::one(), square).sqrt();
        let (s, c) = (theta * half).sin_cos();
        let ratio = T::select(small, half - square * T::from_f64(1.0 / 48.0), s / theta);
        let w = T::select(small, T::one() - square * T::from_f64(0.125), c);
        let v = r * ratio;
        Self::new(w, v.x, v.y, v.z)
    }
    /// Rotation matrix `R_NB` of a unit quaternion.
    #[inline(always)]
    pub fn to_matrix(&self) -> Mat3<T> {
        let (w, x, y, z) = (self.w, self.x, self.y, self.z);
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        let one = T::one();
        Mat3::from_rows(
            vec3(one - yy - zz, xy - wz, xz + wy),
            vec3(xy + wz, one - xx - zz, yz - wx),
            vec3(xz - wy, yz + wx, one - xx - yy),
        )
    }
}

impl<T: Real> Quat<T> {
    /// Rotation vector (rad, |r| ≤ π) of the shorter way: the inverse of [`exp`](Self::exp).
    #[inline(always)]
    pub fn log(&self) -> Vec3<T> {
        let side = T::select(self.w.lt(T::zero()), -T::one(), T::one());
        let (w, v) = (self.w * side, self.vector() * side);
        let (s, two) = (v.norm(), T::from_f64(2.0));
        // atan2(s, w)·2/s → 2/w as s → 0, with an error of s²·2/3.
        let small = s.lt(T::from_f64(1e-8));
        let divisor = T::select(small, T::one(), s);
        v * T::select(small, two / w, two * s.atan2(w) / divisor)
    }
    /// From a rotation matrix (Shepperd: the largest component first, so that nothing cancels).
    #[inline(always)]
    pub fn from_matrix(R: &Mat3<T>) -> Self {
        let [a, b, c] = R.rows;
        let one = T::one();
        // Four times the square of each component, and its products with the others.
        let squares = [
            one + (a.x + b.y + c.z),
            one + (a.x - b.y - c.z),
            one + (b.y - a.x - c.z),
            one + (c.z - a.x - b.y),
        ];
        let (x, y, z) = (c.y - b.z, a.z - c.x, b.x - a.y);
        let (xy, xz, yz) = (a.y + b.x, a.z + c.x, b.z + c.y);
        let by_component = [
            Self::new(squares[0], x, y, z),
            Self::new(x, squares[1], xy, xz),
            Self::new(y, xy, squares[2], yz),
            Self::new(z, xz, yz, squares[3]),
        ];
        let (mut q, mut largest) = (by_component[0], squares[0]);
        for i in 1..4 {
            let larger = largest.lt(squares[i]);
            largest = T::select(larger, squares[i], largest);
            q = Self::select(larger, &by_component[i], &q);
        }
        q.normalized()
    }
    #[inline(always)]
    fn select(mask: T::Mask, a: &Self, b: &Self) -> Self {
        Self::new(
            T::select(mask, a.w, b.w),
            T::select(mask, a.x, b.x),
            T::select(mask, a.y, b.y),
            T::select(mask, a.z, b.z),
        )
    }
}

impl<T: Real> Mul for Quat<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let (u, v) = (self.vector(), b.vector());
        let r = v * self.w + u * b.w + u.cross(v);
        Self::new(self.w * b.w - u.dot(v), r.x, r.y, r.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_testing::largest;

    #[test]
    fn log_undoes_exp_near_zero_and_near_half_a_turn() {
        for r in [vec3(1e-12, 0.0, -2e-12), vec3(0.3, -0.2, 0.5), vec3(1.8, -1.8, 1.8)] {
            let d = Quat::exp(r).log() - r;
            assert!(d.norm() < 1e-15, "{r:?} off by {}, measured 1e-16", d.norm());
        }
    }

    #[test]
    fn matrix_and_quaternion_agree_in_all_four_branches() {
        for r in
            [vec3(0.1, 0.2, -0.1), vec3(3.0, 0.1, 0.2), vec3(0.1, -3.0, 0.2), vec3(0.1, 0.2, 3.0)]
        {
            let q = Quat::exp(r);
            let back = Quat::from_matrix(&q.to_matrix());
            let d = (back * q.conjugate()).log();
            assert!(d.norm() < 1e-15, "measured 3e-17: {}", d.norm());
        }
    }

    #[test]
    fn quaternion_turns_x_to_y_for_a_quarter_turn_about_z() {
        let R = Quat::exp(vec3(0.0, 0.0, core::f64::consts::FRAC_PI_2)).to_matrix();
        let y = R * vec3(1.0, 0.0, 0.0);
        assert!((y - vec3(0.0, 1.0, 0.0)).norm() < 1e-15, "measured 2e-16: {y:?}");
    }

    /// Two turns, one after the other, by quaternions and by matrices. Measured 5e-16.
    #[test]
    fn the_product_turns_like_the_product_of_matrices() {
        let (a, b) = (Quat::exp(vec3(0.4, -1.1, 0.7)), Quat::exp(vec3(-0.9, 0.2, 1.3)));
        let off = (a * b).to_matrix() - a.to_matrix() * b.to_matrix();
        let worst = largest(off.rows.iter().map(|row| row.norm()));
        assert!(worst < 1e-15, "{worst:e}");
        assert!((a * a.conjugate()).log().norm() < 1e-16);
    }

    /// Series and closed form meet at 1e-4 rad: unit length on both sides, and the same turn.
    /// Measured 0.
    #[test]
    fn small_turns_join_the_others_without_a_step() {
        for theta in [0.999e-4_f64, 1.001e-4] {
            let q = Quat::exp(vec3(theta, 0.0, 0.0));
            let off = [q.x - (0.5 * theta).sin(), q.w - (0.5 * theta).cos()];
            assert!(off.iter().all(|off| off.abs() < 1e-16), "{off:?}");
        }
        assert_eq!(Quat::exp(Vec3::<f64>::zero()), Quat::identity());
    }

    /// The half turn is reached from both sides of the double cover..
    #[test]
    fn either_sign_has_the_same_rotation_vector() {
        let q = Quat::exp(vec3(0.3, -0.2, 0.5));
        let minus = Quat::new(-q.w, -q.x, -q.y, -q.z);
        assert_eq!(minus.log(), q.log());
        assert!(
            (Quat::new(2.0 * q.w, 2.0 * q.x, 2.0 * q.y, 2.0 * q.z).normalized().norm() - 1.0).abs()
                < 1e-15
        );
    }
}

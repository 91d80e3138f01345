//! Spatial inertia of a rigid body.

use crate::{Mat3, Real, SpatialForce, SpatialVelocity, Sym3, Vec3};
use core::ops::{Add, AddAssign, Mul};

/// Inertia `M_B_B` of a rigid body about Bo, in B axes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpatialInertia<T> {
    /// Mass (kg).
    pub mass: T,
    /// First moment `m p_BBcm_B` (kg·m).
    pub first_moment: Vec3<T>,
    /// Rotational inertia about Bo (kg·m²).
    pub rotational: Sym3<T>,
}

impl<T: Real> SpatialInertia<T> {
    /// No mass.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::default()
    }
    /// From mass (kg), centre of mass `p_BBcm_B` (m) and inertia about the centre of mass, in B
    /// axes (kg·m²).
    #[inline(always)]
    pub fn from_central(mass: T, p_BBcm_B: Vec3<T>, I_BBcm_B: Sym3<T>) -> Self {
        Self {
            mass,
            first_moment: p_BBcm_B * mass,
            rotational: I_BBcm_B + Sym3::of_point(mass, p_BBcm_B),
        }
    }
    /// `p_BBcm_B` (m); the mass must not be zero.
    #[inline(always)]
    pub fn centre_of_mass(&self) -> Vec3<T> {
        self.first_moment * (T::one() / self.mass)
    }
    /// Rotational inertia about the centre of mass (kg·m²); the mass must not be zero.
    #[inline(always)]
    pub fn central(&self) -> Sym3<T> {
        self.rotational - Sym3::of_point(self.mass, self.centre_of_mass())
    }
    /// The same body about a point C, from the offset `p_BC` in the same axes (m).
    #[inline(always)]
    #[must_use]
    pub fn about(&self, p_BC: Vec3<T>) -> Self {
        let (h, m) = (self.first_moment, self.mass);
        let rotational = self.rotational + Sym3::of_shift(-p_BC, h, m);
        Self { mass: m, first_moment: h - p_BC * m, rotational }
    }
    /// The same body in A axes, from `R_AB`.
    #[inline(always)]
    #[must_use]
    pub fn in_axes(&self, R_AB: &Mat3<T>) -> Self {
        Self {
            mass: self.mass,
            first_moment: *R_AB * self.first_moment,
            rotational: R_AB.congruence(self.rotational),
        }
    }
    /// Velocity that a momentum means, `M⁻¹ h`, about the same point and in the same axes.
    #[inline(always)]
    pub fn velocity_of(&self, h: &SpatialForce<T>) -> SpatialVelocity<T> {
        self.inverse().velocity_of(h)
    }
    /// `M⁻¹`, for many momenta; the mass must not be zero.
    #[inline(always)]
    pub fn inverse(&self) -> InverseInertia<T> {
        let per_mass = T::one() / self.mass;
        let p_cm = self.first_moment * per_mass;
        let central = self.rotational - Sym3::of_point(self.mass, p_cm);
        InverseInertia { per_mass, p_cm, per_central: central.inverse() }
    }
    /// Each element converted from `f64`.
    #[inline(always)]
    pub fn from_f64(M: &SpatialInertia<f64>) -> Self {
        Self {
            mass: T::from_f64(M.mass),
            first_moment: Vec3::from_f64(M.first_moment),
            rotational: Sym3::from_f64(M.rotational),
        }
    }
    /// The 6×6 matrix, angular rows and columns first.
    pub fn to_matrix(&self) -> [[T; 6]; 6] {
        let (m, h, I, o) = (self.mass, self.first_moment, self.rotational, T::zero());
        [
            [I.xx, I.xy, I.xz, o, -h.z, h.y],
            [I.xy, I.yy, I.yz, h.z, o, -h.x],
            [I.xz, I.yz, I.zz, -h.y, h.x, o],
            [o, h.z, -h.y, m, o, o],
            [-h.z, o, h.x, o, m, o],
            [h.y, -h.x, o, o, o, m],
        ]
    }
}

impl<T: Real> Mul<SpatialVelocity<T>> for SpatialInertia<T> {
    type Output = SpatialForce<T>;
    #[inline(always)]
    fn mul(self, V: SpatialVelocity<T>) -> SpatialForce<T> {
        let h = self.first_moment;
        SpatialForce::new(
            self.rotational * V.angular + h.cross(V.linear),
            V.linear * self.mass - h.cross(V.angular),
        )
    }
}
impl<T: Real> Add for SpatialInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self {
            mass: self.mass + b.mass,
            first_moment: self.first_moment + b.first_moment,
            rotational: self.rotational + b.rotational,
        }
    }
}
impl<T: Real> AddAssign for SpatialInertia<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

/// The inverse of a [`SpatialInertia`]: through the centre of mass the rotation and the translation
/// come apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseInertia<T> {
    /// One over the mass (1/kg).
    pub per_mass: T,
    /// Centre of mass (m).
    pub p_cm: Vec3<T>,
    /// Inverse of the rotational inertia about the centre of mass (1/(kg·m²)).
    pub per_central: Sym3<T>,
}

impl<T: Real> InverseInertia<T> {
    /// Velocity that a momentum means, about the same point and in the same axes.
    #[inline(always)]
    pub fn velocity_of(&self, h: &SpatialForce<T>) -> SpatialVelocity<T> {
        let w = self.per_central * (h.torque - self.p_cm.cross(h.force));
        SpatialVelocity::new(w, h.force * self.per_mass - w.cross(self.p_cm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    fn body() -> SpatialInertia<f64> {
        let I = Sym3 { xx: 3.0, xy: 0.2, xz: -0.1, yy: 4.0, yz: 0.3, zz: 5.0 };
        SpatialInertia::from_central(7.0, vec3(0.3, -0.5, 0.2), I)
    }

    #[test]
    fn shifting_to_the_centre_of_mass_gives_the_central_inertia() {
        let M = body();
        let at_cm = M.about(M.centre_of_mass());
        assert!(at_cm.first_moment.norm() < 1e-15, "measured 0");
        let d = at_cm.rotational - M.central();
        assert!(d.to_mat3().rows.iter().all(|r| r.norm() < 1e-14), "measured 0: {d:?}");
    }

    #[test]
    fn solve_inverts_the_product() {
        let V = SpatialVelocity::from_array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6]);
        let M = body();
        let d = (M.velocity_of(&(M * V)) - V).to_array();
        assert!(d.iter().all(|x| x.abs() < 1e-15), "measured 6e-17: {d:?}");
    }

    /// The matrix is the product, written out. Measured 0.
    #[test]
    fn the_matrix_gives_the_same_momentum() {
        let six = [0.1, -0.2, 0.3, 0.4, 0.5, -0.6];
        let by_rows = body().to_matrix().map(|row| (0..6).map(|c| row[c] * six[c]).sum::<f64>());
        let product = (body() * SpatialVelocity::from_array(six)).to_array();
        for (a, b) in by_rows.iter().zip(&product) {
            assert!((a - b).abs() < 1e-14, "{by_rows:?} {product:?}");
        }
    }
}

//! Spatial inertias: of a rigid body, and of a body with an articulated tree behind it.

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
        ArticulatedInertia::from_rigid(self).to_matrix()
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

/// Symmetric 6×6 inertia `[I H; Hᵀ M]` of a body that carries an articulated tree.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ArticulatedInertia<T> {
    /// Torque per angular acceleration (kg·m²).
    pub angular: Sym3<T>,
    /// Torque per linear acceleration (kg·m).
    pub coupling: Mat3<T>,
    /// Force per linear acceleration (kg).
    pub linear: Sym3<T>,
}

impl<T: Real> ArticulatedInertia<T> {
    /// Of a rigid body.
    #[inline(always)]
    pub fn from_rigid(M: &SpatialInertia<T>) -> Self {
        Self {
            angular: M.rotational,
            coupling: M.first_moment.skew(),
            linear: Sym3::diagonal(M.mass, M.mass, M.mass),
        }
    }
    /// `M - U Uᵀ s`: what is left when one direction of motion is free.
    #[inline(always)]
    #[must_use]
    pub fn without(&self, U: &SpatialForce<T>, s: T) -> Self {
        let (t, f) = (U.torque, U.force);
        Self {
            angular: self.angular - Sym3::dyad(t, s),
            coupling: self.coupling - t.outer(f * s),
            linear: self.linear - Sym3::dyad(f, s),
        }
    }
    /// In A axes, from `R_AB`.
    #[inline(always)]
    #[must_use]
    pub fn in_axes(&self, R_AB: &Mat3<T>) -> Self {
        Self {
            angular: R_AB.congruence(self.angular),
            coupling: *R_AB * self.coupling * R_AB.transpose(),
            linear: R_AB.congruence(self.linear),
        }
    }
    /// About a point C, from the offset `p_BC` in the same axes (m).
    #[inline(always)]
    #[must_use]
    pub fn about(&self, p_BC: Vec3<T>) -> Self {
        // v_B = v_C - p × w … in blocks: H_C = H - [p] M;  I_C = I - [p] Gᵀ - G [p]ᵀ, G = H - ½ [p] M.
        let [a, b, c] = self.linear.to_mat3().rows;
        let PM = Mat3::from_columns(p_BC.cross(a), p_BC.cross(b), p_BC.cross(c));
        let [x, y, z] = (self.coupling - PM.scaled(T::from_f64(0.5))).rows;
        let (u, v, w) = (p_BC.cross(x), p_BC.cross(y), p_BC.cross(z));
        // [p] Gᵀ has the columns p × (row of G).
        let moved = Sym3 {
            xx: u.x + u.x,
            xy: u.y + v.x,
            xz: u.z + w.x,
            yy: v.y + v.y,
            yz: v.z + w.y,
            zz: w.z + w.z,
        };
        Self { angular: self.angular - moved, coupling: self.coupling - PM, linear: self.linear }
    }
    /// `M⁻¹ F`: block elimination, linear part first.
    #[inline(always)]
    pub fn solve(&self, F: &SpatialForce<T>) -> SpatialVelocity<T> {
        // Columns of Y = M⁻¹ Hᵀ, then (I - H Y) α = τ - H M⁻¹ f.
        let [h0, h1, h2] = self.coupling.rows;
        let Y =
            Mat3::from_columns(self.linear.solve(h0), self.linear.solve(h1), self.linear.solve(h2));
        let schur = self.angular - Sym3::symmetric_part(&(self.coupling * Y));
        let a_free = self.linear.solve(F.force);
        let alpha = schur.solve(F.torque - self.coupling * a_free);
        SpatialVelocity::new(alpha, a_free - Y * alpha)
    }
    /// The 6×6 matrix, angular rows and columns first.
    pub fn to_matrix(&self) -> [[T; 6]; 6] {
        let (I, M) = (self.angular.to_mat3(), self.linear.to_mat3());
        let (H, Ht) = (self.coupling, self.coupling.transpose());
        let mut out = [[T::zero(); 6]; 6];
        for i in 0..3 {
            let top = (I.rows[i].to_array(), H.rows[i].to_array());
            let bottom = (Ht.rows[i].to_array(), M.rows[i].to_array());
            for k in 0..3 {
                (out[i][k], out[i][k + 3]) = (top.0[k], top.1[k]);
                (out[i + 3][k], out[i + 3][k + 3]) = (bottom.0[k], bottom.1[k]);
            }
        }
        out
    }
}

impl<T: Real> Mul<SpatialVelocity<T>> for ArticulatedInertia<T> {
    type Output = SpatialForce<T>;
    #[inline(always)]
    fn mul(self, V: SpatialVelocity<T>) -> SpatialForce<T> {
        SpatialForce::new(
            self.angular * V.angular + self.coupling * V.linear,
            self.coupling.transpose_mul(V.angular) + self.linear * V.linear,
        )
    }
}
impl<T: Real> Add for ArticulatedInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self {
            angular: self.angular + b.angular,
            coupling: self.coupling + b.coupling,
            linear: self.linear + b.linear,
        }
    }
}
impl<T: Real> AddAssign for ArticulatedInertia<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
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
    fn articulated_and_rigid_shift_alike() {
        let (M, p) = (body(), vec3(0.7, 0.1, -0.4));
        let (a, b) = (
            ArticulatedInertia::from_rigid(&M.about(p)).to_matrix(),
            ArticulatedInertia::from_rigid(&M).about(p).to_matrix(),
        );
        for i in 0..6 {
            for k in 0..6 {
                let off = (a[i][k] - b[i][k]).abs();
                assert!(off < 1e-14, "{i},{k} off by {off:e}, measured 9e-16");
            }
        }
    }

    #[test]
    fn solve_inverts_the_product() {
        let V = SpatialVelocity::from_array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6]);
        let M = body();
        for W in [
            M.velocity_of(&(M * V)),
            ArticulatedInertia::from_rigid(&M).solve(&(ArticulatedInertia::from_rigid(&M) * V)),
        ] {
            let d = (W - V).to_array();
            assert!(d.iter().all(|x| x.abs() < 1e-15), "measured 6e-17: {d:?}");
        }
    }
}

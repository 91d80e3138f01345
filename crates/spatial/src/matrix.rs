//! 3×3 matrices, general and symmetric.

use crate::{Real, Vec3, vec3};
use core::ops::{Add, AddAssign, Mul, Sub};

/// A 3×3 matrix, kept by rows. A rotation `R_NB` turns B components into N components.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Mat3<T> {
    /// The three rows.
    pub rows: [Vec3<T>; 3],
}

impl<T: Real> Mat3<T> {
    /// From its rows.
    #[inline(always)]
    pub fn from_rows(x: Vec3<T>, y: Vec3<T>, z: Vec3<T>) -> Self {
        Self { rows: [x, y, z] }
    }
    /// From its columns.
    #[inline(always)]
    pub fn from_columns(x: Vec3<T>, y: Vec3<T>, z: Vec3<T>) -> Self {
        Self::from_rows(x, y, z).transpose()
    }
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        let (o, i) = (T::zero(), T::one());
        Self::from_rows(vec3(i, o, o), vec3(o, i, o), vec3(o, o, i))
    }
    /// All zero.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { rows: [Vec3::zero(); 3] }
    }
    /// The transpose: for a rotation, its inverse.
    #[inline(always)]
    #[must_use]
    pub fn transpose(&self) -> Self {
        let [a, b, c] = self.rows;
        Self::from_rows(vec3(a.x, b.x, c.x), vec3(a.y, b.y, c.y), vec3(a.z, b.z, c.z))
    }
    /// `Mᵀ v`, without forming the transpose.
    #[inline(always)]
    pub fn transpose_mul(&self, v: Vec3<T>) -> Vec3<T> {
        let [a, b, c] = self.rows;
        a * v.x + b * v.y + c * v.z
    }
    /// The given column.
    #[inline(always)]
    pub fn column(&self, k: usize) -> Vec3<T> {
        self.transpose().rows[k]
    }
    /// `M s`, each element scaled.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, s: T) -> Self {
        let [a, b, c] = self.rows;
        Self::from_rows(a * s, b * s, c * s)
    }
    /// `R S Rᵀ` for a symmetric S.
    #[inline(always)]
    pub fn congruence(&self, S: Sym3<T>) -> Sym3<T> {
        let [a, b, c] = self.rows;
        let (sa, sb, sc) = (S * a, S * b, S * c);
        Sym3 {
            xx: a.dot(sa),
            xy: a.dot(sb),
            xz: a.dot(sc),
            yy: b.dot(sb),
            yz: b.dot(sc),
            zz: c.dot(sc),
        }
    }
    /// Each element converted from `f64`.
    #[inline(always)]
    pub fn from_f64(m: Mat3<f64>) -> Self {
        let [a, b, c] = m.rows;
        Self::from_rows(Vec3::from_f64(a), Vec3::from_f64(b), Vec3::from_f64(c))
    }
    /// Largest difference of `M Mᵀ` from the identity: zero for a rotation.
    pub fn orthogonality_error(&self) -> T {
        let E = *self * self.transpose() - Self::identity();
        E.rows.iter().flat_map(|r| r.to_array()).fold(T::zero(), |m, x| m.max(x.abs()))
    }
}

impl<T: Real> Mul<Vec3<T>> for Mat3<T> {
    type Output = Vec3<T>;
    #[inline(always)]
    fn mul(self, v: Vec3<T>) -> Vec3<T> {
        let [a, b, c] = self.rows;
        vec3(a.dot(v), b.dot(v), c.dot(v))
    }
}
impl<T: Real> Mul for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let [x, y, z] = self.rows;
        Self::from_rows(b.transpose_mul(x), b.transpose_mul(y), b.transpose_mul(z))
    }
}
impl<T: Real> Add for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let ([a0, a1, a2], [b0, b1, b2]) = (self.rows, b.rows);
        Self::from_rows(a0 + b0, a1 + b1, a2 + b2)
    }
}
impl<T: Real> Sub for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        let ([a0, a1, a2], [b0, b1, b2]) = (self.rows, b.rows);
        Self::from_rows(a0 - b0, a1 - b1, a2 - b2)
    }
}

/// A symmetric 3×3 matrix: the six elements that differ.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[allow(missing_docs, reason = "the fields are the elements they name")]
pub struct Sym3<T> {
    pub xx: T,
    pub xy: T,
    pub xz: T,
    pub yy: T,
    pub yz: T,
    pub zz: T,
}

impl<T: Real> Sym3<T> {
    /// All zero.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::default()
    }
    /// A diagonal matrix.
    #[inline(always)]
    pub fn diagonal(xx: T, yy: T, zz: T) -> Self {
        Self { xx, yy, zz, xy: T::zero(), xz: T::zero(), yz: T::zero() }
    }
    /// The symmetric part of a matrix, `(M + Mᵀ)/2`.
    #[inline(always)]
    pub fn symmetric_part(m: &Mat3<T>) -> Self {
        let ([a, b, c], half) = (m.rows, T::from_f64(0.5));
        Self {
            xx: a.x,
            xy: (a.y + b.x) * half,
            xz: (a.z + c.x) * half,
            yy: b.y,
            yz: (b.z + c.y) * half,
            zz: c.z,
        }
    }
    /// `m (|p|² 1 - p pᵀ)`: rotational inertia of a mass at p.
    #[inline(always)]
    pub fn of_point(m: T, p: Vec3<T>) -> Self {
        let q = p * m;
        Self {
            xx: p.y * q.y + p.z * q.z,
            xy: -(p.x * q.y),
            xz: -(p.x * q.z),
            yy: p.x * q.x + p.z * q.z,
            yz: -(p.y * q.z),
            zz: p.x * q.x + p.y * q.y,
        }
    }
    /// What a body's inertia about another point has more than that about its own, from the way `p` to
    /// its own point, its first moment `h` about that and its mass.
    ///
    /// With r from the other point = r + p:  `(p·g) 1 - ½ (p gᵀ + g pᵀ)`, `g = m p + 2 h`.
    #[inline(always)]
    pub fn of_shift(p: Vec3<T>, h: Vec3<T>, m: T) -> Self {
        let half = p * m * T::from_f64(0.5) + h;
        let g = half + half;
        let (x, y, z) = (p.x * g.x, p.y * g.y, p.z * g.z);
        Self {
            xx: y + z,
            xy: -(p.x * half.y + p.y * half.x),
            xz: -(p.x * half.z + p.z * half.x),
            yy: x + z,
            yz: -(p.y * half.z + p.z * half.y),
            zz: x + y,
        }
    }
    /// As a full matrix.
    #[inline(always)]
    pub fn to_mat3(self) -> Mat3<T> {
        Mat3::from_rows(
            vec3(self.xx, self.xy, self.xz),
            vec3(self.xy, self.yy, self.yz),
            vec3(self.xz, self.yz, self.zz),
        )
    }
    /// `S x = b` solved by `L D Lᵀ` without square roots. S must be positive definite.
    #[inline(always)]
    pub fn solve(&self, b: Vec3<T>) -> Vec3<T> {
        let d0 = T::one() / self.xx;
        let (l10, l20) = (self.xy * d0, self.xz * d0);
        let d1 = T::one() / (self.yy - l10 * self.xy);
        let yz = self.yz - l20 * self.xy;
        let l21 = yz * d1;
        let d2 = T::one() / (self.zz - l20 * self.xz - l21 * yz);
        let (y0, y1) = (b.x, b.y - l10 * b.x);
        let y2 = b.z - l20 * y0 - l21 * y1;
        let z = y2 * d2;
        let y = y1 * d1 - l21 * z;
        vec3(y0 * d0 - l10 * y - l20 * z, y, z)
    }
    /// `S⁻¹` of a positive definite S: its cofactors by its determinant, one division.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let cofactors = Self {
            xx: self.yy * self.zz - self.yz * self.yz,
            xy: self.xz * self.yz - self.xy * self.zz,
            xz: self.xy * self.yz - self.xz * self.yy,
            yy: self.xx * self.zz - self.xz * self.xz,
            yz: self.xy * self.xz - self.xx * self.yz,
            zz: self.xx * self.yy - self.xy * self.xy,
        };
        let determinant = self.xx * cofactors.xx + self.xy * cofactors.xy + self.xz * cofactors.xz;
        cofactors.scaled(T::one() / determinant)
    }
    /// `S s`, each element scaled.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, s: T) -> Self {
        Self {
            xx: self.xx * s,
            xy: self.xy * s,
            xz: self.xz * s,
            yy: self.yy * s,
            yz: self.yz * s,
            zz: self.zz * s,
        }
    }
    /// Each element converted from `f64`.
    #[inline(always)]
    pub fn from_f64(s: Sym3<f64>) -> Self {
        let t = T::from_f64;
        Self { xx: t(s.xx), xy: t(s.xy), xz: t(s.xz), yy: t(s.yy), yz: t(s.yz), zz: t(s.zz) }
    }
}

impl<T: Real> Mul<Vec3<T>> for Sym3<T> {
    type Output = Vec3<T>;
    #[inline(always)]
    fn mul(self, v: Vec3<T>) -> Vec3<T> {
        vec3(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }
}
impl<T: Real> Add for Sym3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self {
            xx: self.xx + b.xx,
            xy: self.xy + b.xy,
            xz: self.xz + b.xz,
            yy: self.yy + b.yy,
            yz: self.yz + b.yz,
            zz: self.zz + b.zz,
        }
    }
}
impl<T: Real> Sub for Sym3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + b.scaled(-T::one())
    }
}
impl<T: Real> AddAssign for Sym3<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn general() -> Mat3<f64> {
        Mat3::from_rows(vec3(1.0, 2.0, 3.0), vec3(-4.0, 5.0, 6.0), vec3(7.0, -8.0, 10.0))
    }

    fn definite() -> Sym3<f64> {
        Sym3 { xx: 3.0, xy: 0.5, xz: -1.0, yy: 4.0, yz: 0.75, zz: 5.0 }
    }

    #[test]
    fn rows_columns_and_products_agree_by_hand() {
        let (M, v) = (general(), vec3(1.0, -1.0, 2.0));
        assert_eq!(M * v, vec3(5.0, 3.0, 35.0));
        assert_eq!(M.transpose() * v, M.transpose_mul(v));
        assert_eq!(M.column(1), vec3(2.0, 5.0, -8.0));
        assert_eq!(Mat3::from_columns(M.column(0), M.column(1), M.column(2)), M);
        assert_eq!((M * M) * v, M * (M * v));
        assert_eq!(M + M - M.scaled(3.0), M.scaled(-1.0));
    }

    #[test]
    fn a_congruence_is_the_product_of_three() {
        let (M, S) = (general(), definite());
        assert_eq!(M.congruence(S).to_mat3(), M * S.to_mat3() * M.transpose());
    }

    #[test]
    fn a_symmetric_matrix_multiplies_like_the_full_one() {
        let (S, v) = (definite(), vec3(1.0, -2.0, 0.5));
        assert_eq!(S * v, S.to_mat3() * v);
        assert_eq!(Sym3::symmetric_part(&S.to_mat3()), S);
        let halves = general() + general().transpose();
        assert_eq!(Sym3::symmetric_part(&general()).to_mat3(), halves.scaled(0.5));
    }

    /// Round-off of one elimination. Measured 3e-16.
    #[test]
    fn the_solution_satisfies_the_equations() {
        let b = vec3(1.0, -2.0, 0.5);
        let rest = definite() * definite().solve(b) - b;
        assert!(rest.norm() < 1e-15, "{rest:?}");
    }

    /// `m [p]ᵀ[p]`, and by hand for a mass on an axis.
    #[test]
    fn a_point_mass_has_the_inertia_of_its_lever() {
        let (m, p) = (2.0, vec3(1.0, -3.0, 0.5));
        let cross = p.skew().transpose() * p.skew();
        assert_eq!(Sym3::of_point(m, p).to_mat3(), cross.scaled(m));
        assert_eq!(Sym3::of_point(2.0, vec3(0.0, 3.0, 0.0)), Sym3::diagonal(18.0, 0.0, 18.0));
    }

    #[test]
    fn only_a_rotation_is_orthogonal() {
        let quarter =
            Mat3::from_rows(vec3(0.0, -1.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0));
        assert_eq!(quarter.orthogonality_error(), 0.0);
        assert_eq!(quarter.scaled(2.0).orthogonality_error(), 3.0);
    }
}

//! The inverse of the mass matrix: accelerations per unit force.

use crate::{Generalized, GeneralizedForce, GeneralizedVelocity, MassMatrix};
use core::array;
use wrasse_spatial::{Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3, vec3};

/// `M⁻¹` in the blocks of [`MassMatrix`]; symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseMassMatrix<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Columns of the base block: the base's acceleration per unit wrench on it, torque first.
    pub A_bb: [SpatialVelocity<T>; 6],
    /// Columns of the coupling block: the base's acceleration per unit force of each joint.
    pub A_bj: [SpatialVelocity<T>; J],
    /// Joint block; rows and columns from the number of joints on are zero.
    pub A_jj: [[T; J]; J],
}

/// Inverse of the mass matrix: the base's block eliminated as a rigid body, the joints' by `L D Lᵀ`.
///
/// No branch is taken on a value: a mass matrix that is not positive definite gives numbers without
/// meaning.
///
/// # Source
/// G. Golub, C. Van Loan, *Matrix Computations*, 4th ed., Johns Hopkins, 2013, ch. 4.1.
#[inline(always)]
pub fn inverse_mass_matrix<T: Real, const J: usize>(
    M: &MassMatrix<T, J>,
) -> InverseMassMatrix<T, J> {
    let (n, locked) = (M.count.min(J), Locked::new(&M.M_bb));
    // 1. How the base recoils with joints moving at unit rate, and what is left for the joints.
    let mut recoil = [SpatialVelocity::zero(); J];
    let mut H = [[T::zero(); J]; J];
    for i in 0..n {
        recoil[i] = locked.velocity_of(&M.M_bj[i]);
        for j in 0..=i {
            H[i][j] = M.M_jj[i][j] - recoil[i].power(&M.M_bj[j]);
        }
    }
    // 2. The joints' block, and back to the base.
    let A_jj = inverse(&H, n);
    let mut A_bj = [SpatialVelocity::zero(); J];
    for j in 0..n {
        for i in 0..n {
            A_bj[j] += recoil[i] * -A_jj[i][j];
        }
    }
    let mut A_bb: [_; 6] = array::from_fn(|c| {
        let mut unit = [T::zero(); 6];
        unit[c] = T::one();
        locked.velocity_of(&SpatialForce::from_array(unit))
    });
    for j in 0..n {
        let recoil = recoil[j].to_array();
        for c in 0..6 {
            A_bb[c] += A_bj[j] * -recoil[c];
        }
    }
    InverseMassMatrix { count: n, A_bb, A_bj, A_jj }
}

impl<T: Real, const J: usize> InverseMassMatrix<T, J> {
    /// `M⁻¹ force`.
    #[inline(always)]
    pub fn times(&self, force: &GeneralizedForce<T, J>) -> GeneralizedVelocity<T, J> {
        let n = self.count.min(J);
        let mut found = Generalized { base: SpatialVelocity::zero(), joints: [T::zero(); J] };
        let six = force.base.to_array();
        for c in 0..6 {
            found.base += self.A_bb[c] * six[c];
        }
        for j in 0..n {
            found.base += self.A_bj[j] * force.joints[j];
            found.joints[j] = self.A_bj[j].power(&force.base);
            for i in 0..n {
                found.joints[j] += self.A_jj[j][i] * force.joints[i];
            }
        }
        found
    }
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.A_bb[column].to_array()[row],
            (None, Some(j)) => self.A_bj[j].to_array()[row],
            (Some(j), None) => self.A_bj[j].to_array()[column],
            (Some(i), Some(j)) => self.A_jj[i][j],
        }
    }
}

/// The whole system with its joints locked, ready to give the velocity of a momentum.
struct Locked<T> {
    per_mass: T,
    p_cm: Vec3<T>,
    /// Inverse of the inertia about the centre of mass.
    per_inertia: Sym3<T>,
}

impl<T: Real> Locked<T> {
    #[inline(always)]
    fn new(M: &SpatialInertia<T>) -> Self {
        let per_mass = T::one() / M.mass;
        let p_cm = M.first_moment * per_mass;
        let I = M.rotational - Sym3::of_point(M.mass, p_cm);
        let (o, i) = (T::zero(), T::one());
        let [x, y, z] = [vec3(i, o, o), vec3(o, i, o), vec3(o, o, i)].map(|unit| I.solve(unit));
        let per_inertia = Sym3 { xx: x.x, xy: x.y, xz: x.z, yy: y.y, yz: y.z, zz: z.z };
        Self { per_mass, p_cm, per_inertia }
    }
    #[inline(always)]
    fn velocity_of(&self, h: &SpatialForce<T>) -> SpatialVelocity<T> {
        // Through the centre of mass the rotation and the translation come apart.
        let w = self.per_inertia * (h.torque - self.p_cm.cross(h.force));
        SpatialVelocity::new(w, h.force * self.per_mass - w.cross(self.p_cm))
    }
}

/// Inverse of the leading `n`×`n` part of a symmetric matrix; only its lower triangle is read.
#[inline(always)]
fn inverse<T: Real, const J: usize>(H: &[[T; J]; J], n: usize) -> [[T; J]; J] {
    // H = L D Lᵀ. Row by row L, and X = L⁻¹; H⁻¹ is the sum of x xᵀ/d over the rows x of X.
    let (mut L, mut X) = ([[T::zero(); J]; J], [[T::zero(); J]; J]);
    let (mut per_pivot, mut found) = ([T::zero(); J], [[T::zero(); J]; J]);
    for i in 0..n.min(J) {
        let (mut pivot, mut scaled) = (H[i][i], [T::zero(); J]);
        for j in 0..i {
            let mut sum = H[i][j];
            for k in 0..j {
                sum -= scaled[k] * L[j][k];
            }
            scaled[j] = sum;
            L[i][j] = sum * per_pivot[j];
            pivot -= sum * L[i][j];
        }
        per_pivot[i] = T::one() / pivot;
        X[i][i] = T::one();
        for k in 0..i {
            let (above, row) = X.split_at_mut(i);
            for (x, y) in row[0].iter_mut().zip(&above[k][..=k]) {
                *x -= L[i][k] * *y;
            }
        }
        for r in 0..i + 1 {
            let x = X[i][r] * per_pivot[i];
            for (sum, y) in found[r].iter_mut().zip(&X[i][..=i]) {
                *sum += x * *y;
            }
        }
    }
    found
}

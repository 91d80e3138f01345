//! Poses: where a frame is and how it is turned.

use crate::{Mat3, Quat, Real, SpatialForce, SpatialInertia, SpatialVelocity, Vec3};
use core::ops::Mul;

/// Pose `X_PB` of a frame B measured in a frame P.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T> {
    /// `R_PB`: B components to P components.
    pub rotation: Mat3<T>,
    /// `p_PB_P`: from Po to Bo, in P axes (m).
    pub translation: Vec3<T>,
}

impl<T: Real> Default for Pose<T> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<T: Real> Pose<T> {
    /// From rotation `R_PB` and translation `p_PB_P` (m).
    #[inline(always)]
    pub fn new(R_PB: Mat3<T>, p_PB_P: Vec3<T>) -> Self {
        Self { rotation: R_PB, translation: p_PB_P }
    }
    /// The same frame.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::new(Mat3::identity(), Vec3::zero())
    }
    /// From an attitude quaternion `quat_PB` and a translation `p_PB_P` (m).
    #[inline(always)]
    pub fn from_quat(quat_PB: Quat<T>, p_PB_P: Vec3<T>) -> Self {
        Self::new(quat_PB.to_matrix(), p_PB_P)
    }
    /// `X_BP`.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let R_BP = self.rotation.transpose();
        Self::new(R_BP, -(R_BP * self.translation))
    }
    /// `p_PC_P` of a point from `p_BC_B` (m).
    #[inline(always)]
    pub fn point(&self, p_BC_B: Vec3<T>) -> Vec3<T> {
        self.translation + self.rotation * p_BC_B
    }
    /// `V_NBp_B` from `V_NP_P`: the parent's velocity, taken at Bo, in B axes.
    #[inline(always)]
    pub fn velocity_to_child(&self, V_NP_P: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let at_Bo = V_NP_P.shifted_by(self.translation);
        SpatialVelocity::new(
            self.rotation.transpose_mul(at_Bo.angular),
            self.rotation.transpose_mul(at_Bo.linear),
        )
    }
    /// `F_P_P` from `F_B_B`: a force on B, taken about Po, in P axes.
    #[inline(always)]
    pub fn force_to_parent(&self, F_B_B: &SpatialForce<T>) -> SpatialForce<T> {
        let f = self.rotation * F_B_B.force;
        SpatialForce::new(self.rotation * F_B_B.torque + self.translation.cross(f), f)
    }
    /// `F_B_B` from `F_P_P`: the inverse of [`force_to_parent`](Self::force_to_parent).
    #[inline(always)]
    pub fn force_to_child(&self, F_P_P: &SpatialForce<T>) -> SpatialForce<T> {
        let about_Bo = F_P_P.about(self.translation);
        SpatialForce::new(
            self.rotation.transpose_mul(about_Bo.torque),
            self.rotation.transpose_mul(about_Bo.force),
        )
    }
    /// `M_B_P` about Po in P axes, from `M_B_B` about Bo in B axes.
    #[inline(always)]
    pub fn inertia_to_parent(&self, M_B_B: &SpatialInertia<T>) -> SpatialInertia<T> {
        M_B_B.in_axes(&self.rotation).about(-self.translation)
    }
    /// Each element converted from `f64`.
    #[inline(always)]
    pub fn from_f64(X: &Pose<f64>) -> Self {
        Self::new(Mat3::from_f64(X.rotation), Vec3::from_f64(X.translation))
    }
}

impl<T: Real> Mul for Pose<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, X_BC: Self) -> Self {
        Self::new(self.rotation * X_BC.rotation, self.point(X_BC.translation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Sym3, vec3};

    fn X_PB() -> Pose<f64> {
        Pose::from_quat(Quat::exp(vec3(0.4, -1.1, 0.7)), vec3(1.0, -2.0, 0.5))
    }

    fn X_BC() -> Pose<f64> {
        Pose::from_quat(Quat::exp(vec3(-0.9, 0.2, 1.3)), vec3(-0.3, 0.8, 2.0))
    }

    fn twist() -> SpatialVelocity<f64> {
        SpatialVelocity::from_array([0.5, -1.0, 2.0, 3.0, 0.25, -1.5])
    }

    fn wrench() -> SpatialForce<f64> {
        SpatialForce::from_array([2.0, 1.0, -0.5, 4.0, -3.0, 1.5])
    }

    #[track_caller]
    fn close(a: &[f64], b: &[f64], tolerance: f64) {
        let worst = wrasse_testing::largest(a.iter().zip(b).map(|(x, y)| (x - y).abs()));
        assert!(worst <= tolerance, "off by {worst:e}: {a:?} {b:?}");
    }

    /// Round-off of two rotations. Measured 4e-16.
    #[test]
    fn a_pose_and_its_inverse_undo_each_other() {
        let X = X_PB() * X_PB().inverse();
        close(&X.translation.to_array(), &[0.0; 3], 1e-15);
        assert!((X.rotation - Mat3::identity()).rows.iter().all(|row| row.norm() < 1e-15));
    }

    /// Measured 2e-15.
    #[test]
    fn what_passes_two_poses_passes_their_product() {
        let (X_PC, p) = (X_PB() * X_BC(), vec3(0.3, 0.6, -0.9));
        let twice = X_BC().velocity_to_child(&X_PB().velocity_to_child(&twist()));
        close(&X_PC.velocity_to_child(&twist()).to_array(), &twice.to_array(), 1e-14);
        let twice = X_PB().force_to_parent(&X_BC().force_to_parent(&wrench()));
        close(&X_PC.force_to_parent(&wrench()).to_array(), &twice.to_array(), 1e-14);
        let twice = X_PB().point(X_BC().point(p));
        close(&X_PC.point(p).to_array(), &twice.to_array(), 1e-14);
    }

    /// Measured 9e-16.
    #[test]
    fn power_is_the_same_on_either_side_of_a_joint() {
        let in_child = X_PB().velocity_to_child(&twist()).power(&wrench());
        let in_parent = twist().power(&X_PB().force_to_parent(&wrench()));
        close(&[in_child], &[in_parent], 1e-14);
    }

    /// Measured 2e-15.
    #[test]
    fn a_force_goes_to_the_child_and_back() {
        let back = X_PB().force_to_parent(&X_PB().force_to_child(&wrench()));
        close(&back.to_array(), &wrench().to_array(), 1e-14);
    }

    /// Momentum and inertia take the same way: `X* (M V) = (X* M X⁻¹) X V`. Measured 3e-14
    /// on momenta of 150.
    #[test]
    fn inertia_seen_from_the_parent_gives_the_same_momentum() {
        let I = Sym3 { xx: 3.0, xy: 0.2, xz: -0.1, yy: 4.0, yz: 0.3, zz: 5.0 };
        let M_B = SpatialInertia::from_central(7.0, vec3(0.3, -0.5, 0.2), I);
        let h = X_PB().force_to_parent(&(M_B * X_PB().velocity_to_child(&twist())));
        let rigid = X_PB().inertia_to_parent(&M_B) * twist();
        close(&rigid.to_array(), &h.to_array(), 1e-13);
    }
}

//! Poses: where a frame is and how it is turned.

use crate::{
    ArticulatedInertia, Mat3, Quat, Real, SpatialForce, SpatialInertia, SpatialVelocity, Vec3,
};
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
    /// The same for an articulated inertia.
    #[inline(always)]
    pub fn articulated_to_parent(&self, M: &ArticulatedInertia<T>) -> ArticulatedInertia<T> {
        M.in_axes(&self.rotation).about(-self.translation)
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

//! The Jacobian of a frame and what its change adds to the acceleration.

use crate::robot::within;
use crate::{BodyId, Frame, Generalized, GeneralizedVelocity, JointKind, Kinematics, PerBody};
use core::array;
use wrasse_spatial::{Mat3, Real, SpatialAcceleration, SpatialVelocity, Vec3};

/// Columns of `J_V_NE_N`: twist of a frame's origin in inertial axes, for unit rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian<T, const J: usize> {
    /// How the base is turned, `R_NB`.
    pub R_NB: Mat3<T>,
    /// From the base's origin to the frame's, inertial axes (m).
    pub p_BE_N: Vec3<T>,
    /// Columns for the joints; zero off the path to the frame.
    pub joints: [SpatialVelocity<T>; J],
}

impl<T: Real, const J: usize> Jacobian<T, J> {
    /// `J_b V_NB_B`: the twist that the base's motion alone gives the frame.
    #[inline(always)]
    pub fn of_base(&self, V_NB_B: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let (w_N, v_N) = (self.R_NB * V_NB_B.angular, self.R_NB * V_NB_B.linear);
        SpatialVelocity::new(w_N, v_N).shifted_by(self.p_BE_N)
    }
    /// Columns for `[w_NB_B; v_NB_B]`.
    pub fn base(&self) -> [SpatialVelocity<T>; 6] {
        let unit = |c: usize| array::from_fn(|i| T::from_f64(f64::from(u8::from(i == c))));
        array::from_fn(|c| self.of_base(&SpatialVelocity::from_array(unit(c))))
    }
    /// `J ν`.
    #[inline(always)]
    pub fn times(&self, nu: &GeneralizedVelocity<T, J>) -> SpatialVelocity<T> {
        let mut V = self.of_base(&nu.base);
        for j in 0..J {
            V += self.joints[j] * nu.joints[j];
        }
        V
    }
}

/// Jacobian of a frame: `V_NE_N = J [w_NB_B; v_NB_B; q̇]`, at the frame's origin, inertial axes.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
#[inline(always)]
pub fn jacobian<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> Jacobian<T, J> {
    let (X_NB, X_NL) = (&k.state.X_NB, k.link_poses(&k.state.X_NB));
    let X_NC = frame.body.of(X_NB, &X_NL);
    let p_NE = X_NC.point(k.robot.in_link(frame.body, frame.X_BF.translation));
    let mut joints = [SpatialVelocity::zero(); J];
    let mut at = frame.body;
    while let BodyId::Link(j) = at {
        let j = within::<J>(j);
        // Twist of the link for unit rate, carried to E.
        let (link, X_NL) = (k.robot.link(j), &X_NL[j]);
        let axis_N = X_NL.rotation.column(2);
        joints[j] = match link.kind {
            JointKind::Revolute => {
                SpatialVelocity::new(axis_N, axis_N.cross(p_NE - X_NL.translation))
            }
            JointKind::Prismatic => SpatialVelocity::new(Vec3::zero(), axis_N),
        };
        at = link.parent;
    }
    Jacobian { R_NB: X_NB.rotation, p_BE_N: p_NE - X_NB.translation, joints }
}

/// `J̇ ν`: rate of `V_NE_N` (rad/s², m/s²) with all generalized accelerations zero.
///
/// This is the classical acceleration of the frame's origin: what an observer in N measures.
#[inline(always)]
pub fn bias_acceleration<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> SpatialAcceleration<T> {
    let A_NB_B = spatial_accelerations(k, &Generalized::default());
    let p_BE_B = frame.X_BF.translation;
    let A = A_NB_B[frame.body].shifted_by(p_BE_B);
    let V = k.V_NB_B(frame.body).shifted_by(p_BE_B);
    let R_NB = k.X_NB(frame.body).rotation;
    SpatialAcceleration::new(R_NB * A.angular, R_NB * (A.linear + V.angular.cross(V.linear)))
}

/// Spatial accelerations `A_NB_B` of all bodies for the generalized accelerations `ν̇`.
#[inline(always)]
pub(crate) fn spatial_accelerations<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
) -> PerBody<SpatialAcceleration<T>, J> {
    let (mut A_NB_B, V_NB_B): (PerBody<_, J>, _) = (PerBody::filled(nudot.base), k.twists());
    for j in k.robot.joints() {
        let joint = k.robot.joint(j);
        let VJ_B = joint.velocity(k.state.v[j]);
        A_NB_B.links[j] = k.X_PB(j).velocity_to_child(&A_NB_B[joint.parent])
            + joint.velocity(nudot.joints[j])
            + V_NB_B.links[j].cross(&VJ_B);
    }
    A_NB_B
}

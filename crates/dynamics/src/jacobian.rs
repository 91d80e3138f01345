//! The Jacobian of a frame and what its change adds to the acceleration.

use crate::{BodyId, Frame, Generalized, GeneralizedVelocity, Kinematics, PerBody};
use core::array;
use wrasse_spatial::{Real, SpatialAcceleration, SpatialVelocity};

/// Columns of `J_V_NE_N`: twist of a frame's origin in inertial axes, for unit rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian<T, const J: usize> {
    /// Columns for `[w_NB_B; v_NB_B]`.
    pub base: [SpatialVelocity<T>; 6],
    /// Columns for the joints; zero off the path to the frame.
    pub joints: [SpatialVelocity<T>; J],
}

impl<T: Real, const J: usize> Jacobian<T, J> {
    /// `J_b V_NB_B`: the twist that the base's motion alone gives the frame.
    #[inline(always)]
    pub fn of_base(&self, V_NB_B: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let rates = V_NB_B.to_array();
        let mut V = SpatialVelocity::zero();
        for k in 0..6 {
            V += self.base[k] * rates[k];
        }
        V
    }
    /// `J ν`.
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
pub fn jacobian<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> Jacobian<T, J> {
    let p_NE = k.pose(frame).translation;
    // Twist of a body for one of its own unit twists, carried to E and turned to inertial axes.
    let at_E = |body: BodyId, V_B: SpatialVelocity<T>| {
        let X_NB = &k.X_NB(body);
        let V = SpatialVelocity::new(X_NB.rotation * V_B.angular, X_NB.rotation * V_B.linear);
        V.shifted_by(p_NE - X_NB.translation)
    };
    let unit = |c: usize| {
        SpatialVelocity::from_array(array::from_fn(|i| T::from_f64(f64::from(u8::from(i == c)))))
    };
    let mut columns = Jacobian {
        base: array::from_fn(|c| at_E(BodyId::Base, unit(c))),
        joints: [SpatialVelocity::zero(); J],
    };
    for j in k.robot.path_to_base(frame.body) {
        columns.joints[j] = at_E(BodyId::Link(j), k.robot.joint(j).velocity(T::one()));
    }
    columns
}

/// `J̇ ν`: rate of `V_NE_N` (rad/s², m/s²) with all generalized accelerations zero.
///
/// This is the classical acceleration of the frame's origin: what an observer in N measures.
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
    let mut A_NB_B: PerBody<_, J> = PerBody::filled(nudot.base);
    for j in k.robot.joints() {
        let joint = k.robot.joint(j);
        let VJ_B = joint.velocity(k.state.v[j]);
        A_NB_B.links[j] = k.X_PB[j].velocity_to_child(&A_NB_B[joint.parent])
            + joint.velocity(nudot.joints[j])
            + k.V_NB_B(BodyId::Link(j)).cross(&VJ_B);
    }
    A_NB_B
}

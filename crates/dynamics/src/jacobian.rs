//! The Jacobian of a frame and what its change adds to the acceleration.

use crate::inverse_dynamics::{BaseMotion, accelerate};
use crate::momentum::in_all;
use crate::{
    BodyId, Frame, Generalized, GeneralizedVelocity, InverseDynamics, Kinematics, Posture, Robot,
};
use core::array;
use wrasse_spatial::{
    At, ClassicalAcceleration, Mat3, OneByOne, Real, Rows, SpatialVelocity, Vec3, groups, kernel,
};

/// Columns of `J_V_NE_N`: twist of a frame's origin in inertial axes, for unit rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian<T, const J: usize> {
    /// How the base is turned, `R_NB`.
    pub R_NB: Mat3<T>,
    /// From the base's origin to the frame's, inertial axes (m).
    pub p_BE_N: Vec3<T>,
    /// Columns for the joints; zero off the path to the frame.
    pub joints: SpatialVelocity<[T; J]>,
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
            V += self.joints.at(j) * nu.joints[j];
        }
        V
    }
}

/// Jacobian of a frame: `V_NE_N = J [w_NB_B; v_NB_B; q̇]`, at the frame's origin, inertial axes.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
#[inline]
pub fn jacobian<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> Jacobian<T, J> {
    let R_NB = k.state.X_NB.rotation;
    let mut J_frame = Jacobian { R_NB, p_BE_N: Vec3::zero(), joints: Rows::zero_rows() };
    jacobian_columns(k.robot, &k.posture, frame, &mut J_frame);
    J_frame
}

kernel! {
    /// [`jacobian`] of a frame on a base that is turned as the place says.
    pub fn jacobian_columns<L, T, J>(
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        frame: &Frame<T>,
        J_frame: &mut Jacobian<T, J>,
    ) {
        let p_BE_B = posture.pose(robot, frame).translation;
        J_frame.p_BE_N = J_frame.R_NB * p_BE_B;
        let (R, p_BE_B) = (in_all::<L>(&J_frame.R_NB), L::all3(p_BE_B));
        let carries = robot.way_to(frame.body);
        for i in groups::<L, J>(robot.joint_count()) {
            // Twist of each link on the way for unit rate, carried to E.
            let axis = posture.axis(i) * carries.at(i);
            let S = robot.links.subspace(i, axis).shifted_by(p_BE_B - posture.p_BL_B.at(i));
            J_frame.joints.put(i, SpatialVelocity::new(R * S.angular, R * S.linear));
        }
    }
}

/// `J̇ ν`: rate of `V_NE_N` (rad/s², m/s²) with all generalized accelerations zero: the acceleration of
/// the frame's origin that an observer in N measures.
#[inline]
pub fn bias_acceleration<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    frame: &Frame<T>,
) -> SpatialVelocity<T> {
    let (w, A) = accelerations(k, &Generalized::default(), frame.body);
    let R = k.posture.pose_of(k.robot, frame.body).rotation;
    let A = A.shifted_by(R * frame.X_BF.translation, w);
    let R_NB = k.state.X_NB.rotation;
    SpatialVelocity::new(R_NB * A.angular, R_NB * A.linear)
}

/// Turning rate (rad/s) and acceleration of a body at its origin, base axes, for the generalized
/// accelerations `ν̇`.
#[inline]
pub(crate) fn accelerations<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    body: BodyId,
) -> (Vec3<T>, ClassicalAcceleration<T>) {
    let base = BaseMotion::new(&k.state.V_NB_B, &nudot.base);
    let BodyId::Link(j) = body else { return (base.w, base.A) };
    let mut links = InverseDynamics::new();
    let joints = (&k.state.v, &nudot.joints);
    accelerate::<OneByOne<T>, J>(k.robot, &k.posture, &base, joints, &mut links);
    (links.w.at(j), links.A.at(j))
}

//! Poses and twists of all bodies, base to tips.

use crate::{BodyId, Frame, PerBody, Robot, State};
use wrasse_spatial::{Pose, Real, SpatialVelocity, Vec3};

/// Poses and twists of one robot in one state. It borrows both, so they cannot go stale.
#[derive(Debug, Clone)]
pub struct Kinematics<'a, T, const J: usize> {
    /// The robot.
    pub robot: &'a Robot<T, J>,
    /// Its state.
    pub state: &'a State<T, J>,
    pub(crate) X_PB: [Pose<T>; J],
    X_NB: PerBody<Pose<T>, J>,
    V_NB_B: PerBody<SpatialVelocity<T>, J>,
}

/// Poses and twists of all bodies.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
pub fn kinematics<'a, T: Real, const J: usize>(
    robot: &'a Robot<T, J>,
    state: &'a State<T, J>,
) -> Kinematics<'a, T, J> {
    let mut k = Kinematics {
        robot,
        state,
        X_PB: [Pose::identity(); J],
        X_NB: PerBody::filled(state.X_NB),
        V_NB_B: PerBody::filled(state.V_NB_B),
    };
    for j in robot.joints() {
        let joint = robot.joint(j);
        let X_PB = joint.X_PB(state.q[j]);
        k.X_NB.links[j] = k.X_NB[joint.parent] * X_PB;
        k.V_NB_B.links[j] =
            X_PB.velocity_to_child(&k.V_NB_B[joint.parent]) + joint.velocity(state.v[j]);
        k.X_PB[j] = X_PB;
    }
    k
}

impl<T: Real, const J: usize> Kinematics<'_, T, J> {
    /// Pose `X_NB` of a body.
    #[inline(always)]
    pub fn X_NB(&self, body: BodyId) -> Pose<T> {
        self.X_NB[body]
    }
    /// Twist `V_NB_B` of a body (rad/s, m/s).
    #[inline(always)]
    pub fn V_NB_B(&self, body: BodyId) -> SpatialVelocity<T> {
        self.V_NB_B[body]
    }
    /// Pose `X_NF` of a frame.
    #[inline(always)]
    pub fn pose(&self, frame: &Frame<T>) -> Pose<T> {
        self.X_NB[frame.body] * frame.X_BF
    }
    /// Twist `V_NF_N` of a frame, at its origin, in inertial axes.
    #[inline(always)]
    pub fn velocity(&self, frame: &Frame<T>) -> SpatialVelocity<T> {
        let V = self.V_NB_B[frame.body].shifted_by(frame.X_BF.translation);
        let R_NB = &self.X_NB[frame.body].rotation;
        SpatialVelocity::new(*R_NB * V.angular, *R_NB * V.linear)
    }
    /// Mass (kg) and centre of mass `p_NScm_N` (m) of the whole system.
    #[inline(always)]
    pub fn centre_of_mass(&self) -> (T, Vec3<T>) {
        let mut mass = T::zero();
        let mut moment = Vec3::zero();
        for body in self.robot.bodies() {
            let M = self.robot.inertia(body);
            mass += M.mass;
            moment +=
                self.X_NB[body].translation * M.mass + self.X_NB[body].rotation * M.first_moment;
        }
        (mass, moment * (T::one() / mass))
    }
    /// Origin of the joint `j` on its parent's side (at zero travel), `p_NF_N` (m).
    pub fn joint_origin(&self, j: usize) -> Vec3<T> {
        let joint = self.robot.joint(j);
        self.X_NB[joint.parent].point(joint.X_PB_zero.translation)
    }
}

//! Poses and turning rates of all bodies, base to tips.

use crate::robot::within;
use crate::{BodyId, Frame, PerBody, Robot, State};
use wrasse_spatial::{Mat3, Pose, Real, SpatialVelocity, Vec3};

/// Poses and twists of one robot in one state. It borrows both, so they cannot go stale.
///
/// Kept is what every algorithm needs: how each joint carries its body. Poses in inertial axes and
/// twists are worked out for those that ask.
#[derive(Debug, Clone)]
pub struct Kinematics<'a, T, const J: usize> {
    /// The robot.
    pub robot: &'a Robot<T, J>,
    /// Its state.
    pub state: &'a State<T, J>,
    /// By joint number.
    pub(crate) links: [Link<T>; J],
}

/// A link as its joint carries it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link<T> {
    /// `X_PB`.
    pub(crate) X_PB: Pose<T>,
    /// `w_NB_B` (rad/s).
    pub(crate) w_NB_B: Vec3<T>,
}

/// Poses and turning rates of all bodies.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
#[inline(always)]
pub fn kinematics<'a, T: Real, const J: usize>(
    robot: &'a Robot<T, J>,
    state: &'a State<T, J>,
) -> Kinematics<'a, T, J> {
    let still = Link { X_PB: Pose::new(Mat3::zero(), Vec3::zero()), w_NB_B: Vec3::zero() };
    let mut k = Kinematics { robot, state, links: [still; J] };
    let (sin, cos) = T::sin_cos_each(&state.q, robot.joint_count());
    for j in robot.joints() {
        let joint = robot.joint(j);
        let X_PB = joint.X_PB_turned(state.q[j], sin[j], cos[j]);
        let w_NP_P = match joint.parent {
            BodyId::Base => &state.V_NB_B.angular,
            BodyId::Link(p) => &k.links[within::<J>(p)].w_NB_B,
        };
        let w_NB_B = X_PB.rotation.transpose_mul(*w_NP_P) + joint.turning(state.v[j]);
        k.links[j] = Link { X_PB, w_NB_B };
    }
    k
}

impl<T: Real, const J: usize> Kinematics<'_, T, J> {
    /// Pose `X_NB` of a body.
    #[inline(always)]
    pub fn X_NB(&self, body: BodyId) -> Pose<T> {
        let (mut X, mut at) = (Pose::identity(), body);
        while let BodyId::Link(j) = at {
            X = self.links[within::<J>(j)].X_PB * X;
            at = self.robot.joint(j).parent;
        }
        self.state.X_NB * X
    }
    /// Poses `X_NB` of all bodies.
    #[inline(always)]
    pub fn poses(&self) -> PerBody<Pose<T>, J> {
        let mut X = PerBody::filled(self.state.X_NB);
        for j in self.robot.joints() {
            X.links[j] = X[self.robot.joint(j).parent] * self.links[j].X_PB;
        }
        X
    }
    /// Turning rate `w_NB_B` of a body (rad/s).
    #[inline(always)]
    pub fn w_NB_B(&self, body: BodyId) -> Vec3<T> {
        match body {
            BodyId::Base => self.state.V_NB_B.angular,
            BodyId::Link(j) => self.links[within::<J>(j)].w_NB_B,
        }
    }
    /// Twist `V_NB_B` of a body (rad/s, m/s).
    #[inline(always)]
    pub fn V_NB_B(&self, body: BodyId) -> SpatialVelocity<T> {
        match body {
            BodyId::Base => self.state.V_NB_B,
            BodyId::Link(_) => self.twists()[body],
        }
    }
    /// Twists `V_NB_B` of all bodies (rad/s, m/s).
    #[inline(always)]
    pub fn twists(&self) -> PerBody<SpatialVelocity<T>, J> {
        let mut V_NB_B = PerBody { base: self.state.V_NB_B, links: [self.state.V_NB_B; J] };
        for j in self.robot.joints() {
            let joint = self.robot.joint(j);
            let carried = self.links[j].X_PB.velocity_to_child(&V_NB_B[joint.parent]);
            V_NB_B.links[j] = carried + joint.velocity(self.state.v[j]);
        }
        V_NB_B
    }
    /// Pose `X_NF` of a frame.
    #[inline(always)]
    pub fn pose(&self, frame: &Frame<T>) -> Pose<T> {
        self.X_NB(frame.body) * frame.X_BF
    }
    /// Twist `V_NF_N` of a frame, at its origin, in inertial axes.
    #[inline(always)]
    pub fn velocity(&self, frame: &Frame<T>) -> SpatialVelocity<T> {
        let V = self.V_NB_B(frame.body).shifted_by(frame.X_BF.translation);
        let R_NB = self.X_NB(frame.body).rotation;
        SpatialVelocity::new(R_NB * V.angular, R_NB * V.linear)
    }
    /// Mass (kg) and centre of mass `p_NScm_N` (m) of the whole system.
    #[inline(always)]
    pub fn centre_of_mass(&self) -> (T, Vec3<T>) {
        let (mass, p_BScm_B) = self.centre_of_mass_B();
        (mass, self.state.X_NB.point(p_BScm_B))
    }
    /// Mass (kg) and centre of mass `p_BScm_B` (m) of the whole system, seen from the base.
    #[inline(always)]
    pub fn centre_of_mass_B(&self) -> (T, Vec3<T>) {
        // Mass and first moment of what each joint carries, tip to base.
        let mut carried: PerBody<_, J> = PerBody::filled((T::zero(), Vec3::zero()));
        for body in self.robot.bodies() {
            let M = self.robot.inertia(body);
            carried[body] = (M.mass, M.first_moment);
        }
        for j in self.robot.joints().rev() {
            let ((mass, moment), X_PB) = (carried.links[j], &self.links[j].X_PB);
            let parent = &mut carried[self.robot.joint(j).parent];
            parent.0 += mass;
            parent.1 += X_PB.rotation * moment + X_PB.translation * mass;
        }
        let (mass, moment_B) = carried.base;
        (mass, moment_B * (T::one() / mass))
    }
    /// Origin of the joint `j` on its parent's side (at zero travel), `p_NF_N` (m).
    pub fn joint_origin(&self, j: usize) -> Vec3<T> {
        let joint = self.robot.joint(j);
        self.X_NB(joint.parent).point(joint.X_PB_zero.translation)
    }
}

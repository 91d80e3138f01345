//! Poses and twists of all bodies in one state.

use crate::{BodyId, Configuration, Frame, PerBody, Posture, Robot, State, compose, place};
use wrasse_spatial::{At, Group, Mat3, OneByOne, Pose, Real, Rows, SpatialVelocity, Vec3};

/// How one robot is bent and moves in one state. It borrows both, so they cannot go stale.
#[derive(Debug, Clone)]
pub struct Kinematics<'a, T, const J: usize> {
    /// The robot.
    pub robot: &'a Robot<T, J>,
    /// Its state.
    pub state: &'a State<T, J>,
    /// Where its links are.
    pub posture: Posture<T, J>,
}

/// How a robot is bent in a state.
#[inline]
pub fn kinematics<'a, T: Real, const J: usize>(
    robot: &'a Robot<T, J>,
    state: &'a State<T, J>,
) -> Kinematics<'a, T, J> {
    let mut k = Kinematics { robot, state, posture: Posture::new() };
    place(robot, &state.q, &mut k.posture);
    k
}

impl<T: Real, const J: usize> Kinematics<'_, T, J> {
    /// Pose `X_PB` of the body that a joint carries, from the body it is mounted on.
    #[inline(always)]
    pub(crate) fn X_PB(&self, j: usize) -> Pose<T> {
        self.robot.joint(j).X_PB(self.state.q.at(j))
    }
    /// All that the joint positions give.
    pub fn configuration(&self) -> Configuration<T, J> {
        let mut configuration = Configuration { posture: self.posture, ..Configuration::new() };
        let Configuration { posture, composite, base } = &mut configuration;
        compose(self.robot, posture, composite, base);
        configuration
    }
    /// Pose `X_NB` of a body.
    #[inline(always)]
    pub fn X_NB(&self, body: BodyId) -> Pose<T> {
        self.state.X_NB * self.posture.pose_of(self.robot, body)
    }
    /// Poses `X_NB` of all bodies.
    #[inline(always)]
    pub fn poses(&self) -> PerBody<Pose<T>, J> {
        let mut X_NB = PerBody::filled(self.state.X_NB);
        for j in self.robot.joints() {
            X_NB.links[j] = self.X_NB(BodyId::Link(j));
        }
        X_NB
    }
    /// Twists of the links at their origins, base axes (rad/s, m/s).
    #[inline(always)]
    pub(crate) fn link_twists(&self) -> SpatialVelocity<[T; J]> {
        let mut V: SpatialVelocity<[T; J]> = Rows::zero_rows();
        let (robot, posture) = (self.robot, &self.posture);
        robot.base_to_tips(self.state.V_NB_B, &mut V, |j, V_P: SpatialVelocity<T>| {
            let S = robot.subspace_of(j, posture.axis_of(j));
            V_P.shifted_by(posture.p_PL_B.at(j)) + S * self.state.v.at(j)
        });
        V
    }
    /// Turning rate `w_NB_B` of a body (rad/s).
    #[inline(always)]
    pub fn w_NB_B(&self, body: BodyId) -> Vec3<T> {
        self.V_NB_B(body).angular
    }
    /// Twist `V_NB_B` of a body (rad/s, m/s).
    #[inline(always)]
    pub fn V_NB_B(&self, body: BodyId) -> SpatialVelocity<T> {
        match body {
            BodyId::Base => self.state.V_NB_B,
            BodyId::Link(j) => self.in_body(j, &self.link_twists().at(j)),
        }
    }
    /// Twists `V_NB_B` of all bodies (rad/s, m/s).
    #[inline(always)]
    pub fn twists(&self) -> PerBody<SpatialVelocity<T>, J> {
        let (mut V_NB_B, V) = (PerBody::filled(self.state.V_NB_B), self.link_twists());
        for j in self.robot.joints() {
            V_NB_B.links[j] = self.in_body(j, &V.at(j));
        }
        V_NB_B
    }
    /// A twist in base axes, in the axes of the body that a joint carries.
    #[inline(always)]
    pub(crate) fn in_body(&self, j: usize, V: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let R: Mat3<T> = self.posture.pose_of(self.robot, BodyId::Link(j)).rotation;
        SpatialVelocity::new(R.transpose_mul(V.angular), R.transpose_mul(V.linear))
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
        let (robot, posture) = (self.robot, &self.posture);
        let mut moment: Vec3<[T; J]> = Rows::zero_rows();
        for j in robot.joints() {
            let h: Vec3<T> = robot.links.M_L.first_moment.at(j);
            moment.put(j, posture.R_BL.at(j) * h);
        }
        let own = robot.inertia(BodyId::Base).first_moment;
        let moment_B = robot.tips_to_base(own, &mut moment, |j, h: Vec3<T>| {
            h + posture.p_PL_B.at(j) * robot.links.composite_mass.at(j)
        });
        (robot.mass(), moment_B * (T::one() / robot.mass()))
    }
    /// Origin of the joint `j` on its parent's side (at zero travel), `p_NF_N` (m).
    pub fn joint_origin(&self, j: usize) -> Vec3<T> {
        let joint = self.robot.joint(j);
        self.X_NB(joint.parent).point(joint.X_PB_zero.translation)
    }
}

impl<T: Real, const J: usize> Robot<T, J> {
    /// `R_LB`: from a body's axes to those that make its joint simple.
    #[inline(always)]
    pub(crate) fn R_LB(&self, j: usize) -> Mat3<T> {
        self.links.axes[crate::robot::within::<J>(j)].R_LB
    }
    /// The motion subspace `S` of a joint about its own origin, from its axis (–).
    #[inline(always)]
    pub(crate) fn subspace_of(&self, j: usize, axis: Vec3<T>) -> SpatialVelocity<T> {
        self.links.subspace(Group::<OneByOne<T>>::of(j), axis)
    }
    /// 1 for each joint between the base and a body (–).
    #[inline(always)]
    pub fn way_to(&self, body: BodyId) -> [T; J] {
        let (mut carries, mut at) = ([T::zero(); J], body);
        while let BodyId::Link(j) = at {
            carries.put(j, T::one());
            at = self.joint(j).parent;
        }
        carries
    }
}

//! How each joint carries its link, and what follows: poses and twists of all bodies.

use crate::robot::within;
use crate::{BodyId, Frame, Link, PerBody, Robot, Seat, State};
use wrasse_spatial::{Mat3, Pose, Real, SpatialVelocity, Turn, Vec3};

/// How one robot is bent in one state. It borrows both, so they cannot go stale.
///
/// Kept is what every algorithm needs: the sine and cosine of each joint. Poses and twists are worked
/// out for those that ask.
#[derive(Debug, Clone)]
pub struct Kinematics<'a, T, const J: usize> {
    /// The robot.
    pub robot: &'a Robot<T, J>,
    /// Its state.
    pub state: &'a State<T, J>,
    /// θ of each link.
    turns: [Turn<T>; J],
}

/// How a robot is bent in a state.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
#[inline(always)]
pub fn kinematics<'a, T: Real, const J: usize>(
    robot: &'a Robot<T, J>,
    state: &'a State<T, J>,
) -> Kinematics<'a, T, J> {
    let mut theta = [T::zero(); J];
    for j in robot.joints() {
        theta[j] = robot.link(j).theta(state.q[j]);
    }
    let (sin, cos) = T::sin_cos_each(&theta, robot.joint_count());
    let mut turns = [Turn::none(); J];
    for j in robot.joints() {
        turns[j] = Turn { sin: sin[j], cos: cos[j] };
    }
    Kinematics { robot, state, turns }
}

impl<'a, T: Real, const J: usize> Kinematics<'a, T, J> {
    /// As bent as it is, but placed and moving as another state says, whose joint positions must be
    /// the same: no sine is worked out twice.
    #[inline(always)]
    pub fn moving_as<'b>(&self, state: &'b State<T, J>) -> Kinematics<'b, T, J>
    where
        'a: 'b,
    {
        Kinematics { robot: self.robot, state, turns: self.turns }
    }
    /// A link on its parent.
    #[inline(always)]
    pub fn seat(&self, j: usize) -> Seat<'a, T> {
        let j = within::<J>(j);
        self.robot.link(j).seat(self.turns[j], self.state.q[j])
    }
    /// Poses `X_AL` of all links, seen from where the base is at `X_AB`.
    #[inline(always)]
    pub(crate) fn link_poses(&self, X_AB: &Pose<T>) -> [Pose<T>; J] {
        let mut X_AL = [*X_AB; J];
        for j in self.robot.joints() {
            X_AL[j] = self.seat(j).pose(self.robot.link(j).parent.of(X_AB, &X_AL));
        }
        X_AL
    }
    /// Twists `V_NL_L` of all links (rad/s, m/s).
    #[inline(always)]
    pub(crate) fn link_twists(&self) -> PerBody<SpatialVelocity<T>, J> {
        let mut V = PerBody::filled(self.state.V_NB_B);
        for j in self.robot.joints() {
            let link = self.robot.link(j);
            let carried = self.seat(j).velocity_to_link(&V[link.parent]);
            V.links[j] = carried + link.velocity(self.state.v[j]);
        }
        V
    }
    /// Pose `X_PB` of the body that a joint carries, from the body it is mounted on.
    #[inline(always)]
    pub(crate) fn X_PB(&self, j: usize) -> Pose<T> {
        let (link, seat) = (self.robot.link(j), self.seat(j));
        let R_BpP = match link.parent {
            BodyId::Base => Mat3::identity(),
            BodyId::Link(p) => self.robot.link(p).R_LB.transpose(),
        };
        Pose::new(seat.carried_by(&R_BpP) * link.R_LB, R_BpP * seat.p_PL_P)
    }
    /// Pose `X_NB` of a body.
    #[inline(always)]
    pub fn X_NB(&self, body: BodyId) -> Pose<T> {
        let (mut X, mut at) = (Pose::identity(), body);
        while let BodyId::Link(j) = at {
            X = self.X_PB(j) * X;
            at = self.robot.link(j).parent;
        }
        self.state.X_NB * X
    }
    /// Poses `X_NB` of all bodies.
    #[inline(always)]
    pub fn poses(&self) -> PerBody<Pose<T>, J> {
        let mut links = self.link_poses(&self.state.X_NB);
        for j in self.robot.joints() {
            links[j].rotation = links[j].rotation * self.robot.link(j).R_LB;
        }
        PerBody { base: self.state.X_NB, links }
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
            BodyId::Link(j) => self.robot.link(j).in_body(&self.link_twists()[body]),
        }
    }
    /// Twists `V_NB_B` of all bodies (rad/s, m/s).
    #[inline(always)]
    pub fn twists(&self) -> PerBody<SpatialVelocity<T>, J> {
        let mut V = self.link_twists();
        for j in self.robot.joints() {
            V.links[j] = self.robot.link(j).in_body(&V.links[j]);
        }
        V
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
            let M = self.robot.inertia_in_link(body);
            carried[body] = (M.mass, M.first_moment);
        }
        for j in self.robot.joints().rev() {
            let ((mass, moment), seat) = (carried.links[j], self.seat(j));
            let parent = &mut carried[self.robot.link(j).parent];
            parent.0 += mass;
            parent.1 += seat.to_parent(&moment) + seat.p_PL_P * mass;
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

impl<T: Real> Link<T> {
    /// A twist in the link's axes, in its body's.
    #[inline(always)]
    fn in_body(&self, V_L: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let R_LB = &self.R_LB;
        SpatialVelocity::new(R_LB.transpose_mul(V_L.angular), R_LB.transpose_mul(V_L.linear))
    }
}

//! The robot: a checked, immutable tree of bodies; its state; the vectors that go with it.

use crate::link_rows::LinkRows;
use core::fmt;
use core::ops::{Index, IndexMut, Range};
use wrasse_spatial::{
    Mat3, Pose, Real, Scalar, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3,
};

/// One of the robot's moving bodies. Links that are fixed to each other are one body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyId {
    /// The free-flying base.
    Base,
    /// The body that the joint of this number carries.
    Link(usize),
}

/// A frame fixed to a body: a tool, a mount, a grip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<T> {
    /// The body that carries it.
    pub body: BodyId,
    /// `X_BF`.
    pub X_BF: Pose<T>,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis (rad). A continuous joint is one without travel limits.
    Revolute,
    /// Slides along its axis (m).
    Prismatic,
}

/// A joint and where it sits on its parent body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint<T> {
    /// The body it is mounted on; a link parent has a smaller number.
    pub parent: BodyId,
    /// How it moves.
    pub kind: JointKind,
    /// `X_PB` at zero travel.
    pub X_PB_zero: Pose<T>,
    /// Unit axis, in the axes of the body that it carries (–).
    pub axis_B: Vec3<T>,
    /// Inertia of the motor's rotor, seen from the joint through its gear (kg·m² or kg). It turns fast
    /// and along the joint alone: it adds to the diagonal of the mass matrix, and carries no momentum.
    pub rotor_inertia: T,
}

impl<T: Real> Joint<T> {
    /// A joint on `parent`, with `X_PB` at zero travel and its axis in B axes (made a unit vector).
    pub fn new(parent: BodyId, kind: JointKind, X_PB_zero: Pose<T>, axis_B: Vec3<T>) -> Self {
        let axis_B = axis_B * (T::one() / axis_B.norm());
        Self { parent, kind, X_PB_zero, axis_B, rotor_inertia: T::zero() }
    }
    /// The same with a rotor of this inertia, seen from the joint through its gear (kg·m² or kg).
    #[must_use]
    pub fn with_rotor(self, rotor_inertia: T) -> Self {
        Self { rotor_inertia, ..self }
    }
    /// `X_PB` at travel `q` (rad or m).
    #[inline(always)]
    pub fn X_PB(&self, q: T) -> Pose<T> {
        match self.kind {
            JointKind::Revolute => {
                // Rodrigues: R(q) = a aᵀ + sin q [a]× + cos q (1 - a aᵀ).
                let ((sin, cos), a) = (q.sin_cos(), self.axis_B);
                let along = a.outer(a);
                let across = Mat3::identity() - along;
                let turn = along + a.skew().scaled(sin) + across.scaled(cos);
                Pose::new(self.X_PB_zero.rotation * turn, self.X_PB_zero.translation)
            }
            JointKind::Prismatic => {
                Pose::new(self.X_PB_zero.rotation, self.X_PB_zero.point(self.axis_B * q))
            }
        }
    }
    /// `S_B q̇`: velocity of B relative to its parent, at Bo, in B axes, for the joint rate `qdot`.
    #[inline(always)]
    pub fn velocity(&self, qdot: T) -> SpatialVelocity<T> {
        match self.kind {
            JointKind::Revolute => SpatialVelocity::new(self.axis_B * qdot, Vec3::zero()),
            JointKind::Prismatic => SpatialVelocity::new(Vec3::zero(), self.axis_B * qdot),
        }
    }
    /// `S_Bᵀ F_B_B`: the part of a force that the joint's motor feels (N·m or N).
    #[inline(always)]
    pub fn project(&self, F_B_B: &SpatialForce<T>) -> T {
        match self.kind {
            JointKind::Revolute => self.axis_B.dot(F_B_B.torque),
            JointKind::Prismatic => self.axis_B.dot(F_B_B.force),
        }
    }
}

/// What a body is made of.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MassProperties<T> {
    /// Inertia about the frame it is attached to, in that frame's axes.
    pub M_F_F: SpatialInertia<T>,
    /// Sum of the inertias of its rigid parts, each about its own centre of mass, in the same axes
    /// (kg·m²). Only equation (4) of the paper, as printed, asks for it.
    pub I_parts_F: Sym3<T>,
}

impl<T: Real> MassProperties<T> {
    /// One rigid part: mass (kg), centre of mass `p_FFcm_F` (m), central inertia (kg·m²).
    pub fn from_central(mass: T, p_FFcm_F: Vec3<T>, I_FFcm_F: Sym3<T>) -> Self {
        Self { M_F_F: SpatialInertia::from_central(mass, p_FFcm_F, I_FFcm_F), I_parts_F: I_FFcm_F }
    }
    /// The same matter, seen from a frame P in which this one's pose is `X_PF`.
    #[must_use]
    pub fn seen_from(&self, X_PF: &Pose<T>) -> Self {
        Self {
            M_F_F: X_PF.inertia_to_parent(&self.M_F_F),
            I_parts_F: X_PF.rotation.congruence(self.I_parts_F),
        }
    }
    /// Both together, about the same frame.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self { M_F_F: self.M_F_F + other.M_F_F, I_parts_F: self.I_parts_F + other.I_parts_F }
    }
}

/// The number of a joint, with a bound that the compiler sees: no robot has another, and code without
/// a panic is what flies.
#[inline(always)]
pub(crate) fn within<const J: usize>(j: usize) -> usize {
    j.min(J.saturating_sub(1))
}

impl BodyId {
    /// What is this body's, of the base's and the links'.
    ///
    /// Large things are kept so while they are worked on: in a [`PerBody`] they would be moved once.
    #[inline(always)]
    pub(crate) fn of<'a, E, const J: usize>(self, base: &'a E, links: &'a [E; J]) -> &'a E {
        match self {
            Self::Base => base,
            Self::Link(j) => &links[within::<J>(j)],
        }
    }
    /// The same, to be changed.
    #[inline(always)]
    pub(crate) fn of_mut<'a, E, const J: usize>(
        self,
        base: &'a mut E,
        links: &'a mut [E; J],
    ) -> &'a mut E {
        match self {
            Self::Base => base,
            Self::Link(j) => &mut links[within::<J>(j)],
        }
    }
}

/// Something for each body: one for the base, one for each link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerBody<E, const J: usize> {
    /// The base's.
    pub base: E,
    /// The links', by joint number; those from the number of joints on are not used.
    pub links: [E; J],
}

impl<E: Copy, const J: usize> PerBody<E, J> {
    /// The same for every body.
    #[inline(always)]
    pub fn filled(e: E) -> Self {
        Self { base: e, links: [e; J] }
    }
}
impl<E, const J: usize> Index<BodyId> for PerBody<E, J> {
    type Output = E;
    #[inline(always)]
    fn index(&self, body: BodyId) -> &E {
        body.of(&self.base, &self.links)
    }
}
impl<E, const J: usize> IndexMut<BodyId> for PerBody<E, J> {
    #[inline(always)]
    fn index_mut(&mut self, body: BodyId) -> &mut E {
        body.of_mut(&mut self.base, &mut self.links)
    }
}

/// A tree of bodies on a free-flying base: at most `J` joints, parents before children.
///
/// The algorithms work on its links in rows, four at a time where `J` is a multiple of four.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot<T, const J: usize> {
    pub(crate) count: usize,
    pub(crate) joints: [Joint<T>; J],
    pub(crate) bodies: PerBody<MassProperties<T>, J>,
    pub(crate) links: LinkRows<T, J>,
}

/// Why a robot cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum RobotError {
    /// More joints than the capacity.
    TooManyJoints {
        /// Joints given.
        found: usize,
        /// Joints that fit.
        capacity: usize,
    },
    /// A joint is mounted on a body that comes after it, or that does not exist.
    ParentAfterChild {
        /// The joint's number.
        joint: usize,
    },
}

impl fmt::Display for RobotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooManyJoints { found, capacity } => {
                write!(f, "{found} moving joints, at most {capacity} fit")
            }
            Self::ParentAfterChild { joint } => {
                write!(f, "joint {joint} is mounted on a body that does not come before it")
            }
        }
    }
}
impl core::error::Error for RobotError {}

impl<T: Scalar, const J: usize> Robot<T, J> {
    /// From its base, and each joint with the body it carries (about the body's origin).
    ///
    /// Masses and inertias are taken as they are: whether they are physical is asked where they are
    /// read.
    ///
    /// # Errors
    /// If there are more than `J` joints, or a parent does not come before its child.
    pub fn new(
        base: MassProperties<T>,
        links: &[(Joint<T>, MassProperties<T>)],
    ) -> Result<Self, RobotError> {
        if links.len() > J {
            return Err(RobotError::TooManyJoints { found: links.len(), capacity: J });
        }
        let z = Vec3::from_array([T::zero(), T::zero(), T::one()]);
        let idle = Joint::new(BodyId::Base, JointKind::Revolute, Pose::identity(), z);
        let mut robot = Self {
            count: links.len(),
            joints: [idle; J],
            bodies: PerBody::filled(MassProperties::default()),
            links: LinkRows::empty(),
        };
        robot.bodies.base = base;
        for (j, (joint, body)) in links.iter().enumerate() {
            if matches!(joint.parent, BodyId::Link(p) if p >= j) {
                return Err(RobotError::ParentAfterChild { joint: j });
            }
            robot.joints[j] = *joint;
            robot.bodies.links[j] = *body;
            let next = links.iter().find(|(next, _)| next.parent == BodyId::Link(j));
            let next_B = next.map(|(next, _)| next.X_PB_zero.rotation * next.axis_B);
            robot.links.place(j, joint, next_B);
        }
        robot.links.number(&robot.joints, robot.count);
        robot.weigh();
        Ok(robot)
    }
}

impl<T: Real, const J: usize> Robot<T, J> {
    /// Number of moving joints, n.
    #[inline(always)]
    pub fn joint_count(&self) -> usize {
        self.count
    }
    /// Numbers of the moving joints, base to tips.
    #[inline(always)]
    pub fn joints(&self) -> Range<usize> {
        0..self.count.min(J)
    }
    /// A joint.
    #[inline(always)]
    pub fn joint(&self, j: usize) -> &Joint<T> {
        &self.joints[within::<J>(j)]
    }
    /// `M_B_B` of a body about its origin.
    #[inline(always)]
    pub fn inertia(&self, body: BodyId) -> &SpatialInertia<T> {
        &self.bodies[body].M_F_F
    }
    /// Whether any joint slides.
    #[inline(always)]
    pub(crate) fn any_slides(&self) -> bool {
        self.links.slide
    }
    /// Sum of the central inertias of the parts that are fixed together in this body (kg·m²).
    #[inline(always)]
    pub fn inertia_of_parts(&self, body: BodyId) -> &Sym3<T> {
        &self.bodies[body].I_parts_F
    }
    /// Total mass (kg).
    #[inline(always)]
    pub fn mass(&self) -> T {
        self.links.total_mass
    }
    /// The same robot holding a payload: its mass properties merge with the body of the frame.
    #[must_use]
    pub fn with_payload(&self, frame: &Frame<T>, payload: &MassProperties<T>) -> Self {
        let mut robot = *self;
        let body = &mut robot.bodies[frame.body];
        *body = body.and(&payload.seen_from(&frame.X_BF));
        robot.weigh();
        robot
    }
    /// Take the mass properties of the bodies into the rows of links.
    pub(crate) fn weigh(&mut self) {
        self.links.weigh(&self.joints, &self.bodies, self.count);
    }
    /// All bodies, base first.
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> + use<T, J> {
        core::iter::once(BodyId::Base).chain(self.joints().map(BodyId::Link))
    }
    /// The joints between the base and a body, tip first.
    pub fn path_to_base(&self, body: BodyId) -> impl Iterator<Item = usize> + '_ {
        let mut at = body;
        core::iter::from_fn(move || match at {
            BodyId::Base => None,
            BodyId::Link(j) => {
                let j = within::<J>(j);
                at = self.joints[j].parent;
                Some(j)
            }
        })
    }
    /// The joint by which the chain that carries a body leaves the base.
    pub fn chain_root(&self, body: BodyId) -> Option<usize> {
        self.path_to_base(body).last()
    }
}

impl<const J: usize> Robot<f64, J> {
    /// The same robot over another scalar.
    pub fn cast<T: Real>(&self) -> Robot<T, J> {
        let properties = |p: &MassProperties<f64>| MassProperties {
            M_F_F: SpatialInertia::from_f64(&p.M_F_F),
            I_parts_F: Sym3::from_f64(p.I_parts_F),
        };
        Robot {
            count: self.count,
            joints: self.joints.map(|j| Joint {
                parent: j.parent,
                kind: j.kind,
                X_PB_zero: Pose::from_f64(&j.X_PB_zero),
                axis_B: Vec3::from_f64(j.axis_B),
                rotor_inertia: T::from_f64(j.rotor_inertia),
            }),
            bodies: PerBody {
                base: properties(&self.bodies.base),
                links: core::array::from_fn(|j| properties(&self.bodies.links[j])),
            },
            links: self.links.cast(),
        }
    }
}

/// Where the robot is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T, const J: usize> {
    /// Pose of the base, `X_NB`.
    pub X_NB: Pose<T>,
    /// Twist of the base, `V_NB_B` (rad/s, m/s).
    pub V_NB_B: SpatialVelocity<T>,
    /// Joint positions (rad or m).
    pub q: [T; J],
    /// Joint rates (rad/s or m/s).
    pub v: [T; J],
}

impl<T: Real, const J: usize> Default for State<T, J> {
    fn default() -> Self {
        Self {
            X_NB: Pose::identity(),
            V_NB_B: SpatialVelocity::zero(),
            q: [T::zero(); J],
            v: [T::zero(); J],
        }
    }
}

impl<T: Real, const J: usize> State<T, J> {
    /// Generalized velocity.
    #[inline(always)]
    pub fn velocity(&self) -> GeneralizedVelocity<T, J> {
        Generalized { base: self.V_NB_B, joints: self.v }
    }
}

/// A vector over the degrees of freedom: six of the base, one for each joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generalized<B, T, const J: usize> {
    /// The base's six.
    pub base: B,
    /// The joints'.
    pub joints: [T; J],
}
/// `[w_NB_B; v_NB_B; q̇]` or its time derivative.
pub type GeneralizedVelocity<T, const J: usize> = Generalized<SpatialVelocity<T>, T, J>;
/// `[torque about Bo; force; τ]`, base axes.
pub type GeneralizedForce<T, const J: usize> = Generalized<SpatialForce<T>, T, J>;

impl<B: Default, T: Real, const J: usize> Default for Generalized<B, T, J> {
    fn default() -> Self {
        Self { base: B::default(), joints: [T::zero(); J] }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::{string::ToString, vec, vec::Vec};
    use wrasse_spatial::vec3;

    fn on(parent: BodyId) -> (Joint<f64>, MassProperties<f64>) {
        let joint = Joint::new(parent, JointKind::Revolute, Pose::identity(), vec3(0.0, 0.0, 2.0));
        (joint, MassProperties::from_central(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0)))
    }

    #[test]
    fn a_parent_must_come_before_its_child() {
        for (links, joint) in [
            (vec![on(BodyId::Link(0))], 0),
            (vec![on(BodyId::Base), on(BodyId::Link(2)), on(BodyId::Base)], 1),
        ] {
            let found = Robot::<f64, 4>::new(MassProperties::default(), &links);
            assert_eq!(found.unwrap_err(), RobotError::ParentAfterChild { joint });
        }
    }

    #[test]
    fn more_joints_than_there_is_room_for_are_refused() {
        let error =
            Robot::<f64, 2>::new(MassProperties::default(), &[on(BodyId::Base); 3]).unwrap_err();
        assert_eq!(error, RobotError::TooManyJoints { found: 3, capacity: 2 });
        assert_eq!(error.to_string(), "3 moving joints, at most 2 fit");
    }

    #[test]
    fn a_path_leads_from_the_tip_to_the_joint_on_the_base() {
        let links =
            [BodyId::Base, BodyId::Base, BodyId::Link(0), BodyId::Link(2), BodyId::Link(1)].map(on);
        let robot = Robot::<f64, 5>::new(MassProperties::default(), &links).unwrap();
        assert_eq!(robot.path_to_base(BodyId::Link(3)).collect::<Vec<_>>(), [3, 2, 0]);
        let roots = robot.bodies().map(|body| robot.chain_root(body)).collect::<Vec<_>>();
        assert_eq!(roots, [None, Some(0), Some(1), Some(0), Some(0), Some(1)]);
    }

    #[test]
    fn an_axis_is_made_a_unit_vector() {
        assert_eq!(on(BodyId::Base).0.axis_B, vec3(0.0, 0.0, 1.0));
    }

    /// `[0 0 1]` turned by a quarter about x points along -y. Measured 6e-17.
    #[test]
    fn a_joint_turns_by_the_right_hand() {
        let x =
            Joint::new(BodyId::Base, JointKind::Revolute, Pose::identity(), vec3(1.0, 0.0, 0.0));
        let turned = x.X_PB(core::f64::consts::FRAC_PI_2).rotation * vec3(0.0, 0.0, 1.0);
        assert!((turned - vec3(0.0, -1.0, 0.0)).norm() < 1e-16, "{turned:?}");
    }
}

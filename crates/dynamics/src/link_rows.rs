//! The links of a robot in rows: what the algorithms read, one row for each number.

use crate::joint_axes::JointAxes;
use crate::robot::within;
use crate::{BodyId, Joint, JointKind, MassProperties, PerBody};
use core::array;
use wrasse_spatial::{
    At, Group, Layout, Mat3, Pose, Real, Rows, Scalar, SpatialInertia, SpatialVelocity, Sym3, Vec3,
};

/// Joints from the first to the one before the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) first: usize,
    pub(crate) end: usize,
}

/// Links in the axes that make their joints simple (see [`JointAxes`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LinkRows<T, const J: usize> {
    /// θ at zero travel (rad).
    pub(crate) theta_zero: [T; J],
    /// 1 where the joint turns (–).
    pub(crate) turns: [T; J],
    /// 1 where it slides (–).
    pub(crate) slides: [T; J],
    /// Inertia of the rotor seen from the joint (kg·m² or kg).
    pub(crate) rotor: [T; J],
    /// `p_PL` at zero travel, in the axes that θ turns (m).
    pub(crate) origin: Vec3<[T; J]>,
    /// Inertia of each link about its origin, in its axes.
    pub(crate) M_L: SpatialInertia<[T; J]>,
    /// Mass of each link with all that it carries (kg).
    pub(crate) composite_mass: [T; J],
    /// Mass of the whole (kg).
    pub(crate) total_mass: T,
    pub(crate) axes: [JointAxes<T>; J],
    pub(crate) parent: [BodyId; J],
    /// Whether the parent is the link with the number before.
    pub(crate) follows: [bool; J],
    /// Whether any joint slides.
    pub(crate) slide: bool,
    /// Joints that belong together: an arm, or arms whose joints are numbered in turn.
    pub(crate) arm: [Span; J],
    /// Whether a joint of the arm does not follow the one before.
    pub(crate) forked: [bool; J],
}

impl<T: Scalar, const J: usize> LinkRows<T, J> {
    /// Without links.
    pub(crate) fn empty() -> Self {
        let z = Vec3::from_array([T::zero(), T::zero(), T::one()]);
        let idle = Joint::new(BodyId::Base, JointKind::Revolute, Pose::identity(), z);
        let (axes, _) = JointAxes::new(&idle, &Mat3::identity(), None);
        let none = [T::zero(); J];
        Self {
            theta_zero: none,
            turns: none,
            slides: none,
            rotor: none,
            origin: Rows::zero_rows(),
            M_L: Rows::zero_rows(),
            composite_mass: none,
            total_mass: T::zero(),
            axes: [axes; J],
            parent: [BodyId::Base; J],
            follows: [false; J],
            slide: false,
            arm: [Span { first: 0, end: 0 }; J],
            forked: [false; J],
        }
    }
    /// Put the link of joint `j` in its place; it first carries a joint along `next_B`.
    pub(crate) fn place(&mut self, j: usize, joint: &Joint<T>, next_B: Option<Vec3<T>>) {
        let R_PBp = match joint.parent {
            BodyId::Base => Mat3::identity(),
            BodyId::Link(p) => self.axes[within::<J>(p)].R_LB,
        };
        let (axes, theta_zero) = JointAxes::new(joint, &R_PBp, next_B);
        let turns = joint.kind == JointKind::Revolute;
        let j = within::<J>(j);
        self.axes[j] = axes;
        self.parent[j] = joint.parent;
        self.theta_zero[j] = theta_zero;
        self.turns[j] = if turns { T::one() } else { T::zero() };
        self.slides[j] = if turns { T::zero() } else { T::one() };
        self.slide |= !turns;
        self.rotor[j] = joint.rotor_inertia;
        self.origin.put(j, axes.before_theta(R_PBp * joint.X_PB_zero.translation));
        self.follows[j] = j > 0 && joint.parent == BodyId::Link(j - 1);
    }
    /// Say which joints belong together.
    pub(crate) fn number(&mut self, joints: &[Joint<T>; J], count: usize) {
        let mut root: [usize; J] = array::from_fn(|j| j);
        let count = count.min(J);
        for j in 0..count {
            if let BodyId::Link(p) = joints[j].parent {
                root[j] = root[within::<J>(p)];
            }
        }
        let mut first = 0;
        for end in 1..=count {
            // An arm ends where all that comes leaves the base behind it.
            if (end..count).all(|k| root[within::<J>(k)] >= end) {
                let forked = (first + 1..end).any(|k| !self.follows[within::<J>(k)]);
                for j in first..end.min(J) {
                    (self.arm[j], self.forked[j]) = (Span { first, end }, forked);
                }
                first = end;
            }
        }
    }
}

impl<T: Real, const J: usize> LinkRows<T, J> {
    /// Take the mass properties of the bodies, which are in the bodies' axes.
    pub(crate) fn weigh(
        &mut self,
        joints: &[Joint<T>; J],
        bodies: &PerBody<MassProperties<T>, J>,
        count: usize,
    ) {
        self.total_mass = bodies.base.M_F_F.mass;
        self.composite_mass = [T::zero(); J];
        for j in 0..count.min(J) {
            self.M_L.put(j, bodies.links[j].M_F_F.in_axes(&self.axes[j].R_LB));
        }
        for j in (0..count.min(J)).rev() {
            self.composite_mass[j] += self.M_L.mass[j];
            let mass = self.composite_mass[j];
            match joints[j].parent {
                BodyId::Base => self.total_mass += mass,
                BodyId::Link(p) => self.composite_mass[within::<J>(p)] += mass,
            }
        }
    }
    /// The motion subspaces `S` of joints with these axes, about their own origins (–).
    #[inline(always)]
    pub(crate) fn subspace<L: Layout<One = T>>(
        &self,
        i: Group<L>,
        axis: Vec3<L::Some>,
    ) -> SpatialVelocity<L::Some> {
        if self.slide {
            SpatialVelocity::new(axis * self.turns.at(i), axis * self.slides.at(i))
        } else {
            SpatialVelocity::new(axis, Vec3::zero())
        }
    }
}

impl<const J: usize> LinkRows<f64, J> {
    /// The same over another number.
    pub(crate) fn cast<T: Real>(&self) -> LinkRows<T, J> {
        let row = |row: &[f64; J]| row.map(T::from_f64);
        let rows = |v: &Vec3<[f64; J]>| Vec3 { x: row(&v.x), y: row(&v.y), z: row(&v.z) };
        let I = &self.M_L.rotational;
        LinkRows {
            theta_zero: row(&self.theta_zero),
            turns: row(&self.turns),
            slides: row(&self.slides),
            rotor: row(&self.rotor),
            origin: rows(&self.origin),
            M_L: SpatialInertia {
                mass: row(&self.M_L.mass),
                first_moment: rows(&self.M_L.first_moment),
                rotational: Sym3 {
                    xx: row(&I.xx),
                    xy: row(&I.xy),
                    xz: row(&I.xz),
                    yy: row(&I.yy),
                    yz: row(&I.yz),
                    zz: row(&I.zz),
                },
            },
            composite_mass: row(&self.composite_mass),
            total_mass: T::from_f64(self.total_mass),
            axes: self.axes.map(|axes| axes.cast()),
            parent: self.parent,
            follows: self.follows,
            slide: self.slide,
            arm: self.arm,
            forked: self.forked,
        }
    }
}

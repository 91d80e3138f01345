//! Composite rigid bodies: what each joint carries, joints behind it locked; and the base's rows of the
//! mass matrix, which follow.

use crate::{Posture, Robot};
use wrasse_spatial::{
    At, Group, Layout, Real, Rows, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3,
    groups, kernel,
};

/// The base's rows of `M(q)`: momentum of the whole system about Bo, in base axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseRows<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Base block: inertia of the whole system, joints locked, about Bo in base axes.
    pub M_bb: SpatialInertia<T>,
    /// Columns of the coupling block: momentum about Bo, in base axes, per unit joint rate.
    pub M_bj: SpatialForce<[T; J]>,
    /// Motion subspaces: twist of each link about Bo, in base axes, per unit rate of its joint.
    pub S: SpatialVelocity<[T; J]>,
}

/// Inertias of the links in base axes, each about the link's own origin: alone, and with all that the
/// link carries.
///
/// About their own origins, for about the base's the inertia of a small tool at the end of a long arm
/// would be lost in `m p²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompositeInertia<T, const J: usize> {
    /// First moment (kg·m) and rotational inertia (kg·m²) of each link alone.
    pub(crate) h: Vec3<[T; J]>,
    pub(crate) I: Sym3<[T; J]>,
    /// The same with all that it carries.
    pub(crate) h_c: Vec3<[T; J]>,
    pub(crate) I_c: Sym3<[T; J]>,
}

kernel! {
    /// Composite inertias and the base's rows of the mass matrix in a posture.
    ///
    /// # Source
    /// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 6, table 6.2; ch. 9.4
    /// for the floating base.
    pub fn compose<L, T, J>(
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        composite: &mut CompositeInertia<T, J>,
        base: &mut BaseRows<T, J>,
    ) {
        compose_links::<L, J>(robot, posture, composite, base);
    }
}

/// The same, with links in a layout.
#[inline(always)]
pub(crate) fn compose_links<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    posture: &Posture<L::One, J>,
    composite: &mut CompositeInertia<L::One, J>,
    base: &mut BaseRows<L::One, J>,
) {
    let (links, n) = (&robot.links, robot.joint_count());
    let CompositeInertia { h, I, h_c, I_c } = composite;
    for i in groups::<L, J>(n) {
        let M = link_inertia(robot, posture, i);
        h.put(i, M.first_moment);
        I.put(i, M.rotational);
        h_c.put(i, M.first_moment);
        I_c.put(i, M.rotational);
    }
    let own = &robot.bodies.base.M_F_F;
    // What is behind a joint moves its first moment along by the way from the parent …
    let first_moment = robot.tips_to_base(own.first_moment, h_c, |j, h_c| {
        h_c + posture.p_PL_B.at(j) * links.composite_mass.at(j)
    });
    // … and its inertia by what that way adds.
    let mut shift: Sym3<[L::One; J]> = Rows::zero_rows();
    for i in groups::<L, J>(n) {
        let m = links.composite_mass.at(i);
        shift.put(i, Sym3::of_shift(posture.p_PL_B.at(i), h_c.at(i), m));
    }
    let rotational = robot.tips_to_base(own.rotational, I_c, |j, I_c| I_c + shift.at(j));
    base.count = n;
    base.M_bb = SpatialInertia { mass: links.total_mass, first_moment, rotational };
    for i in groups::<L, J>(n) {
        // Momentum of what moves with unit rate, taken from the link's origin to the base's.
        let (p, m, h) = (posture.p_BL_B.at(i), links.composite_mass.at(i), h_c.at(i));
        let S = links.subspace(i, posture.axis(i));
        let mut F = SpatialForce::new(I_c.at(i) * S.angular, S.angular.cross(h));
        let mut push = p.cross(S.angular);
        if links.slide {
            F += SpatialForce::new(h.cross(S.linear), S.linear * m);
            push += S.linear;
        }
        base.S.put(i, SpatialVelocity::new(S.angular, push));
        base.M_bj.put(i, F.about(-p));
    }
}

/// Where the inertias of links about their own origins, in base axes, are taken from.
pub(crate) trait LinkInertias<L: Layout, const J: usize> {
    /// Those of a group.
    fn inertia(&self, robot: &Robot<L::One, J>, i: Group<L>) -> SpatialInertia<L::Some>;
}

/// Turned as they are asked for.
impl<L: Layout, const J: usize> LinkInertias<L, J> for Posture<L::One, J> {
    #[inline(always)]
    fn inertia(&self, robot: &Robot<L::One, J>, i: Group<L>) -> SpatialInertia<L::Some> {
        link_inertia(robot, self, i)
    }
}

/// Already turned.
impl<L: Layout, const J: usize> LinkInertias<L, J> for CompositeInertia<L::One, J> {
    #[inline(always)]
    fn inertia(&self, robot: &Robot<L::One, J>, i: Group<L>) -> SpatialInertia<L::Some> {
        let (mass, first_moment) = (robot.links.M_L.mass.at(i), self.h.at(i));
        SpatialInertia { mass, first_moment, rotational: self.I.at(i) }
    }
}

/// Inertias of links about their own origins, in base axes.
#[inline(always)]
pub(crate) fn link_inertia<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    posture: &Posture<L::One, J>,
    i: Group<L>,
) -> SpatialInertia<L::Some> {
    robot.links.M_L.at(i).in_axes(&posture.R_BL.at(i))
}

impl<T: Real, const J: usize> BaseRows<T, J> {
    /// Room for them.
    #[inline(always)]
    pub fn new() -> Self {
        let (M_bj, S) = (Rows::zero_rows(), Rows::zero_rows());
        Self { count: 0, M_bb: SpatialInertia::zero(), M_bj, S }
    }
    /// `M_bj q̇`: momentum about Bo, in base axes, of the joint rates alone (N·m·s, N·s).
    #[inline(always)]
    pub fn momentum_of_rates(&self, qdot: &[T; J]) -> SpatialForce<T> {
        let mut h = SpatialForce::zero();
        for j in 0..self.count.min(J) {
            h += self.M_bj.at(j) * qdot.at(j);
        }
        h
    }
}

impl<T: Real, const J: usize> CompositeInertia<T, J> {
    /// Room for them.
    #[inline(always)]
    pub fn new() -> Self {
        let (h, I) = (Vec3::zero_rows(), Sym3::zero_rows());
        Self { h, I, h_c: h, I_c: I }
    }
    /// Inertia of what a joint carries, joints behind it locked, about the link's origin in base axes.
    #[inline(always)]
    pub fn carried(&self, robot: &Robot<T, J>, j: usize) -> SpatialInertia<T> {
        let mass = robot.links.composite_mass.at(j);
        SpatialInertia { mass, first_moment: self.h_c.at(j), rotational: self.I_c.at(j) }
    }
}

impl<T: Real, const J: usize> Default for BaseRows<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const J: usize> Default for CompositeInertia<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

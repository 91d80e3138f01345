//! The mass matrix, in the blocks that the theory names.

use crate::robot::within;
use crate::{BodyId, Kinematics, PerBody};
use core::ops::Deref;
use wrasse_spatial::{Mat3, Real, SpatialForce, SpatialInertia, Vec3};

/// The base's rows of `M(q)`: momentum of the whole system about Bo, in base axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseRows<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Base block: inertia of the whole system, joints locked, about Bo in base axes.
    pub M_bb: SpatialInertia<T>,
    /// Columns of the coupling block: momentum about Bo, in base axes, per unit joint rate.
    pub M_bj: [SpatialForce<T>; J],
}

/// `M(q)` in blocks; rows and columns ordered `[w_NB_B; v_NB_B; q̇]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassMatrix<T, const J: usize> {
    /// The rows of the base.
    pub base: BaseRows<T, J>,
    /// Joint block; rows and columns from the number of joints on are zero.
    pub M_jj: [[T; J]; J],
}

impl<T, const J: usize> Deref for MassMatrix<T, J> {
    type Target = BaseRows<T, J>;
    #[inline(always)]
    fn deref(&self) -> &BaseRows<T, J> {
        &self.base
    }
}

/// What a joint carries, joints behind it locked, in base axes about the link's own origin.
#[derive(Clone, Copy)]
struct Composite<T> {
    R_BL: Mat3<T>,
    /// From Bo, and from the parent's origin, to the link's (m).
    p_BL_B: Vec3<T>,
    p_PL_B: Vec3<T>,
    /// The joint's axis (–).
    axis_B: Vec3<T>,
    M_B: SpatialInertia<T>,
}

/// Mass matrix by composite rigid bodies.
///
/// `M` is symmetric positive definite and `½ νᵀ M ν` is the kinetic energy (J). All is in base axes,
/// so that nothing is turned on the way down the tree, and about each link's own origin, so that
/// nothing is lost by long levers.
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 6, table 6.2; ch. 9.4 for
/// the floating base.
#[doc(alias = "crba")]
#[inline(always)]
pub fn mass_matrix<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> MassMatrix<T, J> {
    let mut carried = PerBody::filled(Composite::nothing());
    composites(k, &mut carried);
    let mut M = MassMatrix { base: rows_of(k, &carried), M_jj: [[T::zero(); J]; J] };
    for j in k.robot.joints() {
        let link = &carried.links[j];
        let mut F = k.robot.joint(j).momentum_along(link.axis_B, &link.M_B);
        M.M_jj[j][j] = k.robot.joint(j).project_on(link.axis_B, &F);
        let (mut p_PL_B, mut parent) = (link.p_PL_B, k.robot.joint(j).parent);
        // The same momentum, about the origin of each link on the way to the base.
        while let BodyId::Link(p) = parent {
            let p = within::<J>(p);
            let below = &carried.links[p];
            F = F.about(-p_PL_B);
            let coupling = k.robot.joint(p).project_on(below.axis_B, &F);
            M.M_jj[j][p] = coupling;
            M.M_jj[p][j] = coupling;
            (p_PL_B, parent) = (below.p_PL_B, k.robot.joint(p).parent);
        }
    }
    M
}

/// The base's rows alone: all that momentum needs.
#[inline(always)]
pub fn base_rows<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> BaseRows<T, J> {
    let mut carried = PerBody::filled(Composite::nothing());
    composites(k, &mut carried);
    rows_of(k, &carried)
}

#[inline(always)]
fn rows_of<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    carried: &PerBody<Composite<T>, J>,
) -> BaseRows<T, J> {
    let mut M_bj = [SpatialForce::zero(); J];
    for j in k.robot.joints() {
        let link = &carried.links[j];
        let F = k.robot.joint(j).momentum_along(link.axis_B, &link.M_B);
        M_bj[j] = F.about(-link.p_BL_B);
    }
    BaseRows { count: k.robot.joint_count(), M_bb: carried.base.M_B, M_bj }
}

/// What each joint carries; the base's is the whole system.
#[inline(always)]
fn composites<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    carried: &mut PerBody<Composite<T>, J>,
) {
    carried.base.R_BL = Mat3::identity();
    carried.base.M_B = *k.robot.inertia(BodyId::Base);
    for j in k.robot.joints() {
        let (joint, X_PL) = (k.robot.joint(j), &k.links[j].X_PB);
        let parent = &carried[joint.parent];
        let R_BL = parent.R_BL * X_PL.rotation;
        let p_PL_B = parent.R_BL * X_PL.translation;
        let p_BL_B = parent.p_BL_B + p_PL_B;
        let M_B = k.robot.inertia(BodyId::Link(j)).in_axes(&R_BL);
        let link = &mut carried.links[j];
        (link.p_BL_B, link.p_PL_B) = (p_BL_B, p_PL_B);
        (link.R_BL, link.axis_B, link.M_B) = (R_BL, R_BL * joint.axis_B, M_B);
    }
    for j in k.robot.joints().rev() {
        let link = &carried.links[j];
        let M_B = link.M_B.about(-link.p_PL_B);
        carried[k.robot.joint(j).parent].M_B += M_B;
    }
}

impl<T: Real> Composite<T> {
    #[inline(always)]
    fn nothing() -> Self {
        let (o, M_B) = (Vec3::zero(), SpatialInertia::zero());
        Self { R_BL: Mat3::zero(), p_BL_B: o, p_PL_B: o, axis_B: o, M_B }
    }
}

impl<T: Real, const J: usize> BaseRows<T, J> {
    /// `M_bj q̇`: momentum about Bo, in base axes, of the joint rates alone (N·m·s, N·s).
    #[inline(always)]
    pub fn momentum_of_rates(&self, qdot: &[T; J]) -> SpatialForce<T> {
        let mut h = SpatialForce::zero();
        for j in 0..self.count.min(J) {
            h += self.M_bj[j] * qdot[j];
        }
        h
    }
}

impl<T: Real, const J: usize> MassMatrix<T, J> {
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.M_bb.to_matrix()[row][column],
            (None, Some(j)) => self.M_bj[j].to_array()[row],
            (Some(j), None) => self.M_bj[j].to_array()[column],
            (Some(i), Some(j)) => self.M_jj[i][j],
        }
    }
}

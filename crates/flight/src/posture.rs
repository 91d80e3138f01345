//! Where the links are relative to the base, how they move and what they weigh: all about the base's
//! origin Bo, in base axes, so that what several bodies do is a plain sum.

use wrasse_dynamics::{BodyId, Frame, JointKind, Robot};
use wrasse_spatial::{Pose, Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3};

/// Poses of the links in the base, and the twist of each for unit rate of its joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Posture<T, const J: usize> {
    /// `X_BL` of each link.
    X_BL: [Pose<T>; J],
    /// Twist about Bo for unit joint rate.
    pub(crate) S: [SpatialVelocity<T>; J],
}

/// Inertias about Bo, base axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Matter<T, const J: usize> {
    /// Of each link.
    pub(crate) links: [SpatialInertia<T>; J],
    /// Of all bodies, joints locked.
    pub(crate) whole: SpatialInertia<T>,
}

impl<T: Real, const J: usize> Posture<T, J> {
    /// At joint positions `q` (rad or m).
    #[inline(always)]
    pub(crate) fn new(robot: &Robot<T, J>, q: &[T; J]) -> Self {
        let mut posture = Self { X_BL: [Pose::identity(); J], S: [SpatialVelocity::zero(); J] };
        for j in robot.joints() {
            let link = robot.link(j);
            let X_BP = of_body(link.parent, &Pose::identity(), &posture.X_BL);
            let X_BL = link.at(q[j]).pose(&X_BP);
            let axis = X_BL.rotation.column(2);
            posture.S[j] = match link.kind {
                JointKind::Revolute => SpatialVelocity::new(axis, X_BL.translation.cross(axis)),
                JointKind::Prismatic => SpatialVelocity::new(Vec3::zero(), axis),
            };
            posture.X_BL[j] = X_BL;
        }
        posture
    }
    /// Pose `X_BF` of a frame in the base.
    #[inline(always)]
    pub(crate) fn pose(&self, robot: &Robot<T, J>, frame: &Frame<T>) -> Pose<T> {
        let BodyId::Link(j) = frame.body else { return frame.X_BF };
        let X_LF = Pose::new(robot.link(j).R_LB, Vec3::zero()) * frame.X_BF;
        of_body(frame.body, &Pose::identity(), &self.X_BL) * X_LF
    }
    /// Mass (kg) and first moment (kg·m) of a link.
    #[inline(always)]
    pub(crate) fn first_moment(&self, robot: &Robot<T, J>, j: usize) -> (T, Vec3<T>) {
        let (X, M) = (&self.X_BL[j], &robot.link(j).M_L);
        (M.mass, X.rotation * M.first_moment + X.translation * M.mass)
    }
    /// Inertia of a link about Bo, base axes.
    #[inline(always)]
    pub(crate) fn inertia(&self, robot: &Robot<T, J>, j: usize) -> SpatialInertia<T> {
        seen_from_base(&self.X_BL[j], &robot.link(j).M_L)
    }
    /// What the bodies weigh.
    #[inline(always)]
    pub(crate) fn matter(&self, robot: &Robot<T, J>) -> Matter<T, J> {
        let whole = *robot.inertia(BodyId::Base);
        let mut matter = Matter { links: [SpatialInertia::zero(); J], whole };
        for j in robot.joints() {
            matter.links[j] = self.inertia(robot, j);
            matter.whole += matter.links[j];
        }
        matter
    }
    /// Twists of the links about Bo (rad/s, m/s), the base moving with `V_B`.
    #[inline(always)]
    pub(crate) fn twists(
        &self,
        robot: &Robot<T, J>,
        V_B: &SpatialVelocity<T>,
        qdot: &[T; J],
    ) -> [SpatialVelocity<T>; J] {
        let mut V = [SpatialVelocity::zero(); J];
        for j in robot.joints() {
            V[j] = of_body(robot.joint(j).parent, V_B, &V) + self.S[j] * qdot[j];
        }
        V
    }
    /// Forces on the links about Bo (N·m, N) that the motion of the joints takes, the base moving
    /// on with the steady twist `V_B`.
    ///
    /// # Source
    /// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 5, in base axes.
    #[inline(always)]
    pub(crate) fn forces(
        &self,
        robot: &Robot<T, J>,
        matter: &Matter<T, J>,
        V_B: &SpatialVelocity<T>,
        qdot: &[T; J],
        qddot: &[T; J],
    ) -> [SpatialForce<T>; J] {
        let mut F = [SpatialForce::zero(); J];
        let mut A = [SpatialVelocity::zero(); J];
        let mut V = [SpatialVelocity::zero(); J];
        for j in robot.joints() {
            let parent = robot.joint(j).parent;
            let VJ = self.S[j] * qdot[j];
            V[j] = of_body(parent, V_B, &V) + VJ;
            A[j] = of_body(parent, &SpatialVelocity::zero(), &A)
                + self.S[j] * qddot[j]
                + V[j].cross(&VJ);
            F[j] = force_of(&matter.links[j], &V[j], &A[j]);
        }
        F
    }
}

/// Force on a body (N·m, N) that moves with a twist and a spatial acceleration.
#[inline(always)]
fn force_of<T: Real>(
    M: &SpatialInertia<T>,
    V: &SpatialVelocity<T>,
    A: &SpatialVelocity<T>,
) -> SpatialForce<T> {
    *M * *A + V.cross_force(&(*M * *V))
}

/// What belongs to a body: the base's, or that of the link.
#[inline(always)]
pub(crate) fn of_body<E: Copy>(body: BodyId, base: &E, links: &[E]) -> E {
    match body {
        BodyId::Base => *base,
        BodyId::Link(j) => *links.get(j).unwrap_or(base),
    }
}

/// Inertia about Bo in base axes, of a body at `X_BL`.
///
/// With `u = 2 h + m p` the shift of the rotational part is `(u·p) 1 - (u pᵀ + p uᵀ)/2`.
#[inline(always)]
fn seen_from_base<T: Real>(X_BL: &Pose<T>, M: &SpatialInertia<T>) -> SpatialInertia<T> {
    let (R, p) = (X_BL.rotation, X_BL.translation);
    let turned = R * M.first_moment;
    let first_moment = turned + p * M.mass;
    let u = turned + first_moment;
    let d = p * T::from_f64(0.5);
    let (xx, yy, zz) = (u.x * p.x, u.y * p.y, u.z * p.z);
    let shift = Sym3 {
        xx: yy + zz,
        yy: xx + zz,
        zz: xx + yy,
        xy: -(u.x * d.y + u.y * d.x),
        xz: -(u.x * d.z + u.z * d.x),
        yz: -(u.y * d.z + u.z * d.y),
    };
    SpatialInertia { mass: M.mass, first_moment, rotational: R.congruence(M.rotational) + shift }
}

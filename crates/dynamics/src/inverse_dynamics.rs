//! Inverse dynamics: the forces that a motion takes.

use crate::{
    BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, JointKind, Kinematics, Outside,
    PerBody, Robot,
};
use wrasse_spatial::{Mat3, Real, SpatialForce, SpatialInertia, Vec3, Work, vec3};

/// Forces of a motion: what drives it, and what each joint carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseDynamics<T, const J: usize> {
    /// Wrench on the base at Bo (base axes) and joint forces, `[torque; force; τ]`.
    pub force: GeneralizedForce<T, J>,
    /// What the parent exerts on each link through its joint, in the link's axes.
    F_L: [SpatialForce<T>; J],
}

impl<T: Real, const J: usize> InverseDynamics<T, J> {
    /// All six components that the parent exerts on a body through its joint, about the body's
    /// origin, in its axes (N·m, N). The base's is the wrench on the base.
    #[inline(always)]
    pub fn F_B_B(&self, robot: &Robot<T, J>, body: BodyId) -> SpatialForce<T> {
        let BodyId::Link(j) = body else { return self.force.base };
        let (F_L, R_LB) = (&self.F_L[j], &robot.link(j).R_LB);
        SpatialForce::new(R_LB.transpose_mul(F_L.torque), R_LB.transpose_mul(F_L.force))
    }
}

/// How a body moves, in its axes; accelerations are what an observer in N measures.
#[derive(Clone, Copy)]
struct Motion<T> {
    /// Turning rate (rad/s) and acceleration (rad/s²).
    w: Vec3<T>,
    alpha: Vec3<T>,
    /// Acceleration of the origin (m/s²).
    a: Vec3<T>,
    /// How the acceleration changes from point to point of the body: `[α]× + [w]×[w]×` (1/s²).
    gradient: Mat3<T>,
}

/// Wrench on the base and joint forces that give the accelerations `ν̇`:
/// `M ν̇ + c = force + Σ Jᵀ F_ext` (recursive Newton–Euler).
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `nudot` | `[ẇ_NB_B; v̇_NB_B; q̈]`, time derivatives of the components | rad/s², m/s² |
/// | `outside` | wrench on each body at its origin, in its axes | N·m, N |
///
/// # Source
/// [`LuhWalkerPaul1980`](wrasse_spatial::references::LuhWalkerPaul1980), over a tree on a free base.
#[doc(alias = "rnea")]
pub fn inverse_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> InverseDynamics<T, J> {
    T::apart(Taken { k, nudot, outside: outside.into() })
}

/// The forces that a motion takes, as a piece of work.
struct Taken<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
    nudot: &'a GeneralizedVelocity<T, J>,
    outside: Outside<'a, T, J>,
}

impl<T: Real, const J: usize> Work for Taken<'_, T, J> {
    type Out = InverseDynamics<T, J>;
    #[inline(always)]
    fn run(self) -> Self::Out {
        let Self { k, nudot, outside } = self;
        let (mut base, mut F_L) = own_forces(k, nudot);
        base = base - outside.base;
        let mut joints = [T::zero(); J];
        for j in k.robot.joints().rev() {
            // Tip to base: the motor feels the part along its joint, the parent all of it.
            let link = k.robot.link(j);
            if let Some(F) = outside.on_link(k.robot, j) {
                F_L[j] = F_L[j] - F;
            }
            joints[j] = link.project(&F_L[j]);
            let onto_parent = k.seat(j).force_to_parent(&F_L[j]);
            match link.parent {
                BodyId::Base => base += onto_parent,
                BodyId::Link(p) => F_L[p.min(j)] += onto_parent,
            }
        }
        InverseDynamics { force: Generalized { base, joints }, F_L }
    }
}

/// `c(q, ν)`: the forces that a motion without generalized acceleration takes.
pub fn bias_force<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> GeneralizedForce<T, J> {
    inverse_dynamics(k, &Generalized::default(), Outside::nothing()).force
}

/// What each body alone needs for its motion: the rate of its momentum.
#[inline(always)]
fn own_forces<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
) -> (SpatialForce<T>, [SpatialForce<T>; J]) {
    let (V, Vdot) = (&k.state.V_NB_B, &nudot.base);
    // From the derivative of a twist's components to what an observer measures: v̇ + w × v.
    let a = Vdot.linear + V.angular.cross(V.linear);
    let mut motions: PerBody<_, J> = PerBody::filled(Motion::new(V.angular, Vdot.angular, a));
    let mut F_L = [SpatialForce::zero(); J];
    for j in k.robot.joints() {
        let parent = &motions[k.robot.link(j).parent];
        motions.links[j] = motion_of_link(k, j, parent, nudot.joints[j]);
        F_L[j] = motions.links[j].force(&k.robot.link(j).M_L);
    }
    (motions.base.force(k.robot.inertia(BodyId::Base)), F_L)
}

/// Motion of a link from that of its parent.
#[inline(always)]
fn motion_of_link<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    j: usize,
    parent: &Motion<T>,
    qddot: T,
) -> Motion<T> {
    let (seat, qdot) = (k.seat(j), k.state.v[j]);
    let mut w = seat.to_link(&parent.w);
    let mut alpha = seat.to_link(&parent.alpha);
    let mut a = seat.to_link(&(parent.a + parent.gradient * seat.p_PL_P));
    // w × z q̇: what the turning parent does to the joint's motion.
    let across = vec3(w.y * qdot, -(w.x * qdot), T::zero());
    match k.robot.link(j).kind {
        JointKind::Revolute => {
            w.z += qdot;
            alpha = vec3(alpha.x + across.x, alpha.y + across.y, alpha.z + qddot);
        }
        JointKind::Prismatic => {
            let two = T::from_f64(2.0);
            a = vec3(a.x + across.x * two, a.y + across.y * two, a.z + qddot);
        }
    }
    Motion::new(w, alpha, a)
}

impl<T: Real> Motion<T> {
    #[inline(always)]
    fn new(w: Vec3<T>, alpha: Vec3<T>, a: Vec3<T>) -> Self {
        let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
        let (xy, xz, yz) = (w.x * w.y, w.x * w.z, w.y * w.z);
        let gradient = Mat3::from_rows(
            vec3(-(yy + zz), xy - alpha.z, xz + alpha.y),
            vec3(xy + alpha.z, -(xx + zz), yz - alpha.x),
            vec3(xz - alpha.y, yz + alpha.x, -(xx + yy)),
        );
        Self { w, alpha, a, gradient }
    }
    /// Newton and Euler about the origin.
    #[inline(always)]
    fn force(&self, M: &SpatialInertia<T>) -> SpatialForce<T> {
        let (h, I) = (M.first_moment, M.rotational);
        let torque = I * self.alpha + self.w.cross(I * self.w) + h.cross(self.a);
        SpatialForce::new(torque, self.a * M.mass + self.gradient * h)
    }
}

//! Inverse dynamics: the forces that a motion takes.

use crate::{BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, Kinematics, PerBody};
use wrasse_spatial::{Real, SpatialAcceleration, SpatialForce, SpatialInertia, Vec3};

/// Forces of a motion: what drives it, and what each joint carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseDynamics<T, const J: usize> {
    /// Wrench on the base at Bo (base axes) and joint forces, `[torque; force; τ]`.
    pub force: GeneralizedForce<T, J>,
    /// All six components that the parent exerts on each body through its joint, about the body's
    /// origin, in its axes (N·m, N). The base's is the wrench on the base.
    pub F_B_B: PerBody<SpatialForce<T>, J>,
}

/// Wrench on the base and joint forces that give the accelerations `ν̇`:
/// `M ν̇ + c = force + Σ Jᵀ F_ext` (recursive Newton–Euler).
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `nudot` | `[ẇ_NB_B; v̇_NB_B; q̈]`, time derivatives of the components | rad/s², m/s² |
/// | `external` | wrench on each body at its origin, in its axes | N·m, N |
///
/// # Source
/// [`LuhWalkerPaul1980`](wrasse_spatial::references::LuhWalkerPaul1980), over a tree on a free base.
#[doc(alias = "rnea")]
#[inline(always)]
pub fn inverse_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> InverseDynamics<T, J> {
    let mut F_B_B = own_forces(k, nudot);
    F_B_B.base = F_B_B.base - external.base;
    for j in k.robot.joints() {
        F_B_B.links[j] = F_B_B.links[j] - external.links[j];
    }
    let mut joints = [T::zero(); J];
    for j in k.robot.joints().rev() {
        // Tip to base: the motor feels the part along its joint, the parent all of it.
        let joint = k.robot.joint(j);
        joints[j] = joint.project(&F_B_B.links[j]);
        let onto_parent = k.links[j].X_PB.force_to_parent(&F_B_B.links[j]);
        F_B_B[joint.parent] += onto_parent;
    }
    InverseDynamics { force: Generalized { base: F_B_B.base, joints }, F_B_B }
}

/// `c(q, ν)`: the forces that a motion without generalized acceleration takes.
#[inline(always)]
pub fn bias_force<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> GeneralizedForce<T, J> {
    inverse_dynamics(k, &Generalized::default(), &PerBody::filled(SpatialForce::zero())).force
}

/// What each body alone needs for its motion: the rate of its momentum.
#[inline(always)]
fn own_forces<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
) -> PerBody<SpatialForce<T>, J> {
    let V_NB_B = &k.state.V_NB_B;
    let base = classical(&nudot.base, V_NB_B.angular.cross(V_NB_B.linear));
    let mut A = PerBody { base, links: [SpatialAcceleration::zero(); J] };
    let mut F_B_B = PerBody::filled(SpatialForce::zero());
    F_B_B.base = own_force(k.robot.inertia(BodyId::Base), &V_NB_B.angular, &base);
    for j in k.robot.joints() {
        let (joint, link) = (k.robot.joint(j), &k.links[j]);
        let (A_P, w_NP_P) = (&A[joint.parent], k.w_NB_B(joint.parent));
        let (R, p) = (&link.X_PB.rotation, link.X_PB.translation);
        let at_Bo = A_P.linear + A_P.angular.cross(p) + w_NP_P.cross(w_NP_P.cross(p));
        let carried =
            SpatialAcceleration::new(R.transpose_mul(A_P.angular), R.transpose_mul(at_Bo));
        let A_B = carried + joint.acceleration(link.w_NB_B, k.state.v[j], nudot.joints[j]);
        A.links[j] = A_B;
        F_B_B.links[j] = own_force(k.robot.inertia(BodyId::Link(j)), &link.w_NB_B, &A_B);
    }
    F_B_B
}

/// From the derivative of a twist's components to what an observer in N measures: `v̇ + w × v`.
#[inline(always)]
fn classical<T: Real>(Vdot: &SpatialAcceleration<T>, w_cross_v: Vec3<T>) -> SpatialAcceleration<T> {
    SpatialAcceleration::new(Vdot.angular, Vdot.linear + w_cross_v)
}

/// Newton and Euler about Bo, from the classical acceleration of Bo.
#[inline(always)]
fn own_force<T: Real>(
    M_B: &SpatialInertia<T>,
    w: &Vec3<T>,
    A: &SpatialAcceleration<T>,
) -> SpatialForce<T> {
    let (h, I) = (M_B.first_moment, M_B.rotational);
    let force = A.linear * M_B.mass + A.angular.cross(h) + w.cross(w.cross(h));
    let torque = I * A.angular + w.cross(I * *w) + h.cross(A.linear);
    SpatialForce::new(torque, force)
}

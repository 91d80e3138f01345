//! Inverse dynamics: the forces that a motion takes.

use crate::jacobian::spatial_accelerations;
use crate::{BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, Kinematics, PerBody};
use wrasse_spatial::{Real, SpatialForce};

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
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 5, table 5.1.
#[doc(alias = "rnea")]
pub fn inverse_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> InverseDynamics<T, J> {
    let A_NB_B = spatial_accelerations(k, nudot);
    // Each body alone: the rate of its momentum, less what pushes it from outside.
    let alone = |body: BodyId| {
        let (M, V) = (*k.robot.inertia(body), k.V_NB_B(body));
        M * A_NB_B[body] + V.cross_force(&(M * V)) - external[body]
    };
    let mut F_B_B: PerBody<_, J> = PerBody::filled(SpatialForce::zero());
    F_B_B.base = alone(BodyId::Base);
    for j in k.robot.joints() {
        F_B_B.links[j] = alone(BodyId::Link(j));
    }
    let mut force = Generalized::default();
    for j in k.robot.joints().rev() {
        // Tip to base: the motor feels the part along its joint, the parent all of it.
        let joint = k.robot.joint(j);
        force.joints[j] = joint.project(&F_B_B.links[j]);
        let onto_parent = k.X_PB[j].force_to_parent(&F_B_B.links[j]);
        F_B_B[joint.parent] += onto_parent;
    }
    force.base = F_B_B.base;
    InverseDynamics { force, F_B_B }
}

/// `c(q, ν)`: the forces that a motion without generalized acceleration takes.
pub fn bias_force<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> GeneralizedForce<T, J> {
    inverse_dynamics(k, &Generalized::default(), &PerBody::filled(SpatialForce::zero())).force
}

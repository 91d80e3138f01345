//! Forward dynamics, with joints driven by force or made to follow, and the base free or held.

use crate::{
    BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, Joint, Kinematics, PerBody,
};
use wrasse_spatial::{
    ArticulatedInertia, Real, SpatialAcceleration, SpatialForce, SpatialVelocity, Vec3,
};

/// What is given of a joint; the other is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointDrive<T> {
    /// Torque (N·m) or force (N) of its motor.
    Effort(T),
    /// Its acceleration (rad/s² or m/s²), whatever it takes.
    Acceleration(T),
}

/// What holds the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BaseMode {
    /// Nothing.
    Free,
    /// A torque that keeps its angular acceleration zero; it translates freely.
    AttitudeHeld,
}

/// Accelerations and forces, all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dynamics<T, const J: usize> {
    /// `ν̇ = [ẇ_NB_B; v̇_NB_B; q̈]`.
    pub nudot: GeneralizedVelocity<T, J>,
    /// Joint forces; the base's entry is what holds it (zero where it is free).
    pub force: GeneralizedForce<T, J>,
}

/// What a body keeps between the two passes.
#[derive(Clone, Copy)]
struct Articulated<T> {
    M: ArticulatedInertia<T>,
    /// Bias force.
    p: SpatialForce<T>,
    /// `V × S q̇`.
    A_bias: SpatialAcceleration<T>,
    /// `M S`, `1/(Sᵀ M S)` and `τ - Sᵀ p` of a joint driven by force.
    U: SpatialForce<T>,
    D_inverse: T,
    u: T,
}

/// Accelerations from forces, or forces from accelerations, joint by joint (articulated bodies).
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `drives` | what is given of each joint | N·m, N or rad/s², m/s² |
/// | `base` | what holds the base | – |
/// | `external` | wrench on each body at its origin, in its axes; the base's included | N·m, N |
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 7, table 7.1; ch. 9.2 for
/// joints that follow, ch. 9.4 for the floating base. The held attitude is the same elimination
/// with the base's angular acceleration given.
#[doc(alias = "aba")]
pub fn driven_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    drives: &[JointDrive<T>; J],
    base: BaseMode,
    external: &PerBody<SpatialForce<T>, J>,
) -> Dynamics<T, J> {
    let mut bodies = alone(k, external);
    for j in k.robot.joints().rev() {
        // Tip to base: what the parent feels of the tree behind the joint.
        let joint = k.robot.joint(j);
        let (M, p) = bodies.links[j].felt_through(joint, drives[j]);
        let (M_P, p_P) = (k.X_PB[j].articulated_to_parent(&M), k.X_PB[j].force_to_parent(&p));
        let parent = &mut bodies[joint.parent];
        parent.M += M_P;
        parent.p += p_P;
    }
    let mut found = Dynamics { nudot: Generalized::default(), force: Generalized::default() };
    (found.nudot.base, found.force.base) = solve_base(&bodies.base, base);
    let mut A_NB_B: PerBody<_, J> = PerBody::filled(found.nudot.base);
    for j in k.robot.joints() {
        // Base to tip: the acceleration that is left for the joint.
        let (joint, body) = (k.robot.joint(j), &bodies.links[j]);
        let A = k.X_PB[j].velocity_to_child(&A_NB_B[joint.parent]) + body.A_bias;
        let (qddot, tau) = match drives[j] {
            JointDrive::Effort(tau) => (body.D_inverse * (body.u - A.power(&body.U)), tau),
            JointDrive::Acceleration(qddot) => {
                let F = body.M * (A + joint.velocity(qddot)) + body.p;
                (qddot, joint.project(&F))
            }
        };
        (found.nudot.joints[j], found.force.joints[j]) = (qddot, tau);
        A_NB_B.links[j] = A + joint.velocity(qddot);
    }
    found
}

/// Accelerations that the given forces cause: `M⁻¹ (force - c + Σ Jᵀ F_ext)`.
pub fn forward_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> GeneralizedVelocity<T, J> {
    let mut with_base = *external;
    with_base.base += force.base;
    driven_dynamics(k, &force.joints.map(JointDrive::Effort), BaseMode::Free, &with_base).nudot
}

/// Each body by itself, before it feels what it carries.
#[inline(always)]
fn alone<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> PerBody<Articulated<T>, J> {
    let rigid = |body: BodyId, VJ_B: SpatialVelocity<T>| {
        let (M, V) = (*k.robot.inertia(body), k.V_NB_B(body));
        Articulated {
            M: ArticulatedInertia::from_rigid(&M),
            p: V.cross_force(&(M * V)) - external[body],
            A_bias: V.cross(&VJ_B),
            U: SpatialForce::zero(),
            D_inverse: T::zero(),
            u: T::zero(),
        }
    };
    let mut bodies: PerBody<_, J> = PerBody::filled(rigid(BodyId::Base, SpatialVelocity::zero()));
    for j in k.robot.joints() {
        bodies.links[j] = rigid(BodyId::Link(j), k.robot.joint(j).velocity(k.state.v[j]));
    }
    bodies
}

impl<T: Real> Articulated<T> {
    /// Inertia and bias force that the parent feels through the joint, still at this body's origin.
    #[inline(always)]
    fn felt_through(
        &mut self,
        joint: &Joint<T>,
        drive: JointDrive<T>,
    ) -> (ArticulatedInertia<T>, SpatialForce<T>) {
        match drive {
            JointDrive::Effort(tau) => {
                self.U = self.M * joint.velocity(T::one());
                self.D_inverse = T::one() / joint.project(&self.U);
                self.u = tau - joint.project(&self.p);
                let M = self.M.without(&self.U, self.D_inverse);
                (M, self.p + M * self.A_bias + self.U * (self.u * self.D_inverse))
            }
            JointDrive::Acceleration(qddot) => {
                (self.M, self.p + self.M * (self.A_bias + joint.velocity(qddot)))
            }
        }
    }
}

/// The base's acceleration, and the wrench that holds it.
#[inline(always)]
fn solve_base<T: Real>(
    base: &Articulated<T>,
    mode: BaseMode,
) -> (SpatialAcceleration<T>, SpatialForce<T>) {
    match mode {
        BaseMode::Free => (base.M.solve(&-base.p), SpatialForce::zero()),
        BaseMode::AttitudeHeld => {
            let a = base.M.linear.solve(-base.p.force);
            let torque = base.p.torque + base.M.coupling * a;
            (SpatialAcceleration::new(Vec3::zero(), a), SpatialForce::new(torque, Vec3::zero()))
        }
    }
}

//! Forward dynamics, with joints driven by force or made to follow, and the base free or held.

use crate::{
    BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, Joint, Kinematics, PerBody,
};
use wrasse_spatial::{
    ArticulatedInertia, Mat3, Real, SpatialAcceleration, SpatialForce, SpatialInertia, Vec3,
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

/// What a body keeps between the two passes: in base axes, about its own origin. Accelerations are
/// classical: what an observer in N measures of the body's origin.
#[derive(Clone, Copy)]
struct Articulated<T> {
    R_BL: Mat3<T>,
    /// From the parent's origin (m), and the joint's axis (–).
    p_PL_B: Vec3<T>,
    axis_B: Vec3<T>,
    /// Turning rate (rad/s).
    w_NL_B: Vec3<T>,
    M: ArticulatedInertia<T>,
    /// Bias force.
    p: SpatialForce<T>,
    /// What the motion adds to the parent's acceleration.
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
#[inline(always)]
pub fn driven_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    drives: &[JointDrive<T>; J],
    base: BaseMode,
    external: &PerBody<SpatialForce<T>, J>,
) -> Dynamics<T, J> {
    let nothing = rigid(&SpatialInertia::zero(), Vec3::zero(), &SpatialForce::zero());
    let mut bodies = PerBody::filled(nothing);
    alone(k, external, &mut bodies);
    for j in k.robot.joints().rev() {
        // Tip to base: what the parent feels of the tree behind the joint.
        let (joint, link) = (k.robot.joint(j), &mut bodies.links[j]);
        let (M, p) = link.felt_through(joint, &drives[j]);
        let p_LP_B = -link.p_PL_B;
        let parent = &mut bodies[joint.parent];
        parent.M += M.about(p_LP_B);
        parent.p += p.about(p_LP_B);
    }
    let (A_base, holding) = solve_base(&bodies.base, base);
    let mut found = Dynamics { nudot: Generalized::default(), force: Generalized::default() };
    let V_NB_B = &k.state.V_NB_B;
    let turned = V_NB_B.angular.cross(V_NB_B.linear);
    found.nudot.base = SpatialAcceleration::new(A_base.angular, A_base.linear - turned);
    found.force.base = holding;
    let mut A_NB_B = PerBody { base: A_base, links: [SpatialAcceleration::zero(); J] };
    for j in k.robot.joints() {
        // Base to tip: the acceleration that is left for the joint.
        let (joint, body) = (k.robot.joint(j), &bodies.links[j]);
        let A = A_NB_B[joint.parent].shifted_by(body.p_PL_B) + body.A_bias;
        let (qddot, tau) = match drives[j] {
            JointDrive::Effort(tau) => (body.D_inverse * (body.u - A.power(&body.U)), tau),
            JointDrive::Acceleration(qddot) => {
                let F = body.M * (A + joint.motion_along(body.axis_B, qddot)) + body.p;
                (qddot, joint.project_on(body.axis_B, &F))
            }
        };
        (found.nudot.joints[j], found.force.joints[j]) = (qddot, tau);
        A_NB_B.links[j] = A + joint.motion_along(body.axis_B, qddot);
    }
    found
}

/// Accelerations that the given forces cause: `M⁻¹ (force - c + Σ Jᵀ F_ext)`.
#[inline(always)]
pub fn forward_dynamics<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> GeneralizedVelocity<T, J> {
    let mut with_base = *external;
    with_base.base += force.base;
    let mut drives = [JointDrive::Effort(T::zero()); J];
    for j in k.robot.joints() {
        drives[j] = JointDrive::Effort(force.joints[j]);
    }
    driven_dynamics(k, &drives, BaseMode::Free, &with_base).nudot
}

/// Each body by itself, before it feels what it carries.
#[inline(always)]
fn alone<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    external: &PerBody<SpatialForce<T>, J>,
    bodies: &mut PerBody<Articulated<T>, J>,
) {
    let o = Vec3::zero();
    let w_NB_B = k.state.V_NB_B.angular;
    bodies.base = rigid(k.robot.inertia(BodyId::Base), w_NB_B, &external.base);
    bodies.base.R_BL = Mat3::identity();
    for j in k.robot.joints() {
        let (joint, X_PL) = (k.robot.joint(j), &k.links[j].X_PB);
        let parent = &bodies[joint.parent];
        let (R_BP, w_P) = (&parent.R_BL, parent.w_NL_B);
        let (R_BL, p_PL_B) = (*R_BP * X_PL.rotation, *R_BP * X_PL.translation);
        let axis_B = R_BL * joint.axis_B;
        let w_NL_B = w_P + joint.motion_along(axis_B, k.state.v[j]).angular;
        let F_L = &external.links[j];
        let F_B = SpatialForce::new(R_BL * F_L.torque, R_BL * F_L.force);
        let M_B = k.robot.inertia(BodyId::Link(j)).in_axes(&R_BL);
        let mut A_bias = joint.acceleration_along(axis_B, w_NL_B, k.state.v[j], T::zero());
        A_bias += SpatialAcceleration::new(o, w_P.cross(w_P.cross(p_PL_B)));
        bodies.links[j] = Articulated { R_BL, p_PL_B, axis_B, A_bias, ..rigid(&M_B, w_NL_B, &F_B) };
    }
}

/// A body that turns with `w_NL_B` and carries nothing; all in base axes.
#[inline(always)]
fn rigid<T: Real>(
    M_B: &SpatialInertia<T>,
    w_NL_B: Vec3<T>,
    external: &SpatialForce<T>,
) -> Articulated<T> {
    let torque = w_NL_B.cross(M_B.rotational * w_NL_B);
    let force = w_NL_B.cross(w_NL_B.cross(M_B.first_moment));
    Articulated {
        R_BL: Mat3::zero(),
        p_PL_B: Vec3::zero(),
        axis_B: Vec3::zero(),
        w_NL_B,
        M: ArticulatedInertia::from_rigid(M_B),
        p: SpatialForce::new(torque, force) - *external,
        A_bias: SpatialAcceleration::zero(),
        U: SpatialForce::zero(),
        D_inverse: T::zero(),
        u: T::zero(),
    }
}

impl<T: Real> Articulated<T> {
    /// Inertia and bias force that the parent feels through the joint, still at this body's origin.
    #[inline(always)]
    fn felt_through(
        &mut self,
        joint: &Joint<T>,
        drive: &JointDrive<T>,
    ) -> (ArticulatedInertia<T>, SpatialForce<T>) {
        match *drive {
            JointDrive::Effort(tau) => {
                self.U = joint.force_along(self.axis_B, &self.M);
                self.D_inverse = T::one() / joint.project_on(self.axis_B, &self.U);
                self.u = tau - joint.project_on(self.axis_B, &self.p);
                let M = self.M.without(&self.U, self.D_inverse);
                (M, self.p + M * self.A_bias + self.U * (self.u * self.D_inverse))
            }
            JointDrive::Acceleration(qddot) => {
                let A = self.A_bias + joint.motion_along(self.axis_B, qddot);
                (self.M, self.p + self.M * A)
            }
        }
    }
}

/// The base's classical acceleration, and the wrench that holds it.
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

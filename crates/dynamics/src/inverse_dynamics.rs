//! Inverse dynamics: the forces that a motion takes.

use crate::composite_inertia::LinkInertias;
use crate::{
    BodyId, Configuration, Generalized, GeneralizedForce, GeneralizedVelocity, Kinematics, Outside,
    Posture, Robot,
};
use wrasse_spatial::{
    At, ClassicalAcceleration, Layout, Real, Rows, SpatialForce, SpatialInertia, SpatialVelocity,
    Vec3, groups, kernel,
};

/// Forces of a motion: what drives it, and what each joint carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseDynamics<T, const J: usize> {
    /// Wrench on the base at Bo (base axes) and joint forces, `[torque; force; τ]`.
    pub force: GeneralizedForce<T, J>,
    /// What the parent exerts on each link through its joint, about the link's origin in base axes (N·m, N).
    pub(crate) F: SpatialForce<[T; J]>,
    /// Turning rate of each link (rad/s), base axes.
    pub(crate) w: Vec3<[T; J]>,
    /// Classical acceleration of each link at its origin, base axes (rad/s², m/s²).
    pub(crate) A: ClassicalAcceleration<[T; J]>,
}

/// What a base does: its turning rate, and the classical acceleration of Bo, base axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseMotion<T> {
    pub(crate) w: Vec3<T>,
    pub(crate) A: ClassicalAcceleration<T>,
}

impl<T: Real> BaseMotion<T> {
    /// From the twist and the time derivatives of its components.
    #[inline(always)]
    pub(crate) fn new(V_NB_B: &SpatialVelocity<T>, Vdot: &SpatialVelocity<T>) -> Self {
        Self { w: V_NB_B.angular, A: ClassicalAcceleration::of_twist(V_NB_B, Vdot) }
    }
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
/// [`LuhWalkerPaul1980`](wrasse_spatial::references::LuhWalkerPaul1980), over a tree on a free base,
/// all of it in base axes.
#[doc(alias = "rnea")]
#[inline]
pub fn inverse_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> InverseDynamics<T, J> {
    let mut out = InverseDynamics::new();
    drive(k.robot, &k.posture, &k.state.velocity(), nudot, outside.into(), &mut out);
    out
}

/// `c(q, ν)`: the forces that a motion without generalized acceleration takes.
pub fn bias_force<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> GeneralizedForce<T, J> {
    inverse_dynamics(k, &Generalized::default(), Outside::nothing()).force
}

kernel! {
    /// The forces of a motion in a posture: [`inverse_dynamics`] into a place.
    pub fn drive<L, T, J>(
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        nu: &GeneralizedVelocity<T, J>,
        nudot: &GeneralizedVelocity<T, J>,
        outside: Outside<'_, T, J>,
        out: &mut InverseDynamics<T, J>,
    ) {
        let base = BaseMotion::new(&nu.base, &nudot.base);
        let joints = (&nu.joints, &nudot.joints);
        newton_euler::<L, J>(robot, posture, &base, joints, posture, &outside, out);
    }
}

kernel! {
    /// The same in a configuration: inertias in base axes are at hand.
    pub fn drive_configuration<L, T, J>(
        robot: &Robot<T, J>,
        configuration: &Configuration<T, J>,
        nu: &GeneralizedVelocity<T, J>,
        nudot: &GeneralizedVelocity<T, J>,
        outside: Outside<'_, T, J>,
        out: &mut InverseDynamics<T, J>,
    ) {
        let Configuration { posture, composite, .. } = configuration;
        let base = BaseMotion::new(&nu.base, &nudot.base);
        let joints = (&nu.joints, &nudot.joints);
        newton_euler::<L, J>(robot, posture, &base, joints, composite, &outside, out);
    }
}

/// Newton's and Euler's laws for all links: how they move, base to tips; what that takes; what the
/// joints carry of it, tips to base.
#[inline(always)]
pub(crate) fn newton_euler<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    posture: &Posture<L::One, J>,
    base: &BaseMotion<L::One>,
    joints: (&[L::One; J], &[L::One; J]),
    inertias: &impl LinkInertias<L, J>,
    outside: &Outside<'_, L::One, J>,
    out: &mut InverseDynamics<L::One, J>,
) {
    accelerate::<L, J>(robot, posture, base, joints, out);
    let InverseDynamics { force, F, w, A } = out;
    for i in groups::<L, J>(robot.joint_count()) {
        F.put(i, own_wrench(&inertias.inertia(robot, i), w.at(i), &A.at(i)));
    }
    let mut on_base = own_wrench(&robot.bodies.base.M_F_F, base.w, &base.A) - outside.base;
    outside.take_off(robot, posture, F);
    on_base = robot.tips_to_base(on_base, F, |j, F| F.about(-posture.p_PL_B.at(j)));
    force.base = on_base;
    for i in groups::<L, J>(robot.joint_count()) {
        let (axis, F) = (posture.axis(i), F.at(i));
        let mut tau = axis.dot(F.torque);
        if robot.links.slide {
            tau = tau * robot.links.turns.at(i) + axis.dot(F.force) * robot.links.slides.at(i);
        }
        force.joints.put(i, tau + robot.links.rotor.at(i) * joints.1.at(i));
    }
}

/// Turning rates and accelerations of all links.
#[inline(always)]
pub(crate) fn accelerate<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    posture: &Posture<L::One, J>,
    base: &BaseMotion<L::One>,
    (qdot, qddot): (&[L::One; J], &[L::One; J]),
    out: &mut InverseDynamics<L::One, J>,
) {
    let (links, A) = (&robot.links, &mut out.A);
    // w = w_P + s q̇,  α = α_P + s q̈ + w_P × s q̇
    let start = (base.w, base.A.angular);
    robot.base_to_tips(start, &mut (&mut out.w, &mut A.angular), |j, (w_P, alpha_P)| {
        let axis = posture.axis_of(j);
        let (mut rate, mut gain) = (qdot.at(j), qddot.at(j));
        if links.slide {
            (rate, gain) = (rate * links.turns.at(j), gain * links.turns.at(j));
        }
        let turn = axis * rate;
        (w_P + turn, alpha_P + (axis * gain + w_P.cross(turn)))
    });
    // a = a_P + α_P × p + w_P × (w_P × p), and where the joint slides + 2 w_P × s q̇ + s q̈
    for i in groups::<L, J>(robot.joint_count()) {
        let (axis, p) = (posture.axis(i), posture.p_PL_B.at(i));
        let (mut rate, mut gain) = (qdot.at(i), qddot.at(i));
        if links.slide {
            (rate, gain) = (rate * links.turns.at(i), gain * links.turns.at(i));
        }
        let turn = axis * rate;
        let w_P = out.w.at(i) - turn;
        let alpha_P = A.angular.at(i) - (axis * gain + w_P.cross(turn));
        let mut more = w_P.cross(p);
        let mut a = alpha_P.cross(p);
        if links.slide {
            let slide = axis * (qdot.at(i) * links.slides.at(i));
            more += slide + slide;
            a += axis * (qddot.at(i) * links.slides.at(i));
        }
        A.linear.put(i, a + w_P.cross(more));
    }
    robot.sum_to_tips(base.A.linear, &mut A.linear);
}

/// What bodies alone need for their motion, about their origins: Newton and Euler.
#[inline(always)]
fn own_wrench<T: Real>(
    M: &SpatialInertia<T>,
    w: Vec3<T>,
    A: &ClassicalAcceleration<T>,
) -> SpatialForce<T> {
    let (m, h, I) = (M.mass, M.first_moment, M.rotational);
    SpatialForce::new(
        I * A.angular + w.cross(I * w) + h.cross(A.linear),
        A.linear * m + A.angular.cross(h) + w.cross(w.cross(h)),
    )
}

impl<T: Real, const J: usize> InverseDynamics<T, J> {
    /// Room for them.
    #[inline(always)]
    pub fn new() -> Self {
        let force = Generalized { base: SpatialForce::zero(), joints: [T::zero(); J] };
        Self { force, F: Rows::zero_rows(), w: Rows::zero_rows(), A: Rows::zero_rows() }
    }
    /// All six components that the parent exerts on a body through its joint, about the body's
    /// origin, in its axes (N·m, N). The base's is the wrench on the base.
    #[inline(always)]
    pub fn F_B_B(&self, k: &Kinematics<'_, T, J>, body: BodyId) -> SpatialForce<T> {
        let BodyId::Link(j) = body else { return self.force.base };
        let (F, R) = (self.F.at(j), k.posture.pose_of(k.robot, body).rotation);
        SpatialForce::new(R.transpose_mul(F.torque), R.transpose_mul(F.force))
    }
}

impl<T: Real, const J: usize> Default for InverseDynamics<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

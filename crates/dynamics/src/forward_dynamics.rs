//! Forward dynamics, with joints driven by force or made to follow, and the base free or held.

use crate::{
    BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, JointKind, Kinematics, Outside,
    PerBody,
};
use wrasse_spatial::{
    ArticulatedInertia, Mat3, Real, SpatialAcceleration, SpatialForce, SpatialInertia, Vec3, Work,
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
    /// From the parent's origin (m).
    p_PL_B: Vec3<T>,
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

/// A joint's axis (–) and how it moves.
#[derive(Clone, Copy)]
struct Axis<T> {
    along_B: Vec3<T>,
    kind: JointKind,
}

impl<T: Real> Axis<T> {
    /// `S q̈`.
    #[inline(always)]
    fn motion(&self, rate: T) -> SpatialAcceleration<T> {
        match self.kind {
            JointKind::Revolute => SpatialAcceleration::new(self.along_B * rate, Vec3::zero()),
            JointKind::Prismatic => SpatialAcceleration::new(Vec3::zero(), self.along_B * rate),
        }
    }
    /// `M S`.
    #[inline(always)]
    fn force(&self, M: &ArticulatedInertia<T>) -> SpatialForce<T> {
        let s = self.along_B;
        match self.kind {
            JointKind::Revolute => SpatialForce::new(M.angular * s, M.coupling.transpose_mul(s)),
            JointKind::Prismatic => SpatialForce::new(M.coupling * s, M.linear * s),
        }
    }
    /// `Sᵀ F`.
    #[inline(always)]
    fn project(&self, F: &SpatialForce<T>) -> T {
        match self.kind {
            JointKind::Revolute => self.along_B.dot(F.torque),
            JointKind::Prismatic => self.along_B.dot(F.force),
        }
    }
    /// What the joint rate adds to the classical acceleration, when its body turns with `w`.
    #[inline(always)]
    fn bias(&self, w: Vec3<T>, qdot: T) -> SpatialAcceleration<T> {
        let across = w.cross(self.along_B * qdot);
        match self.kind {
            JointKind::Revolute => SpatialAcceleration::new(across, Vec3::zero()),
            JointKind::Prismatic => SpatialAcceleration::new(Vec3::zero(), across + across),
        }
    }
}

/// Accelerations from forces, or forces from accelerations, joint by joint (articulated bodies).
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `drives` | what is given of each joint | N·m, N or rad/s², m/s² |
/// | `base` | what holds the base | – |
/// | `outside` | wrench on each body at its origin, in its axes; the base's included | N·m, N |
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 7, table 7.1; ch. 9.2 for
/// joints that follow, ch. 9.4 for the floating base. The held attitude is the same elimination
/// with the base's angular acceleration given.
#[doc(alias = "aba")]
pub fn driven_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    drives: &[JointDrive<T>; J],
    base: BaseMode,
    outside: impl Into<Outside<'a, T, J>>,
) -> Dynamics<T, J> {
    T::apart(Driven { k, drives, base, outside: outside.into() })
}

/// Accelerations and forces of what is driven, as a piece of work.
struct Driven<'a, T, const J: usize> {
    k: &'a Kinematics<'a, T, J>,
    drives: &'a [JointDrive<T>; J],
    base: BaseMode,
    outside: Outside<'a, T, J>,
}

impl<T: Real, const J: usize> Work for Driven<'_, T, J> {
    type Out = Dynamics<T, J>;
    #[inline(always)]
    fn run(self) -> Self::Out {
        let k = self.k;
        let mut base = Articulated::nothing();
        let mut links = [Articulated::nothing(); J];
        base.R_BL = Mat3::identity();
        base.w_NL_B = k.state.V_NB_B.angular;
        base.load(k.robot.inertia(BodyId::Base), Some(self.outside.base));
        for j in k.robot.joints() {
            // Base to tip: each body by itself, before it feels what it carries.
            place(k, j, &base, &mut links);
            self.load(j, &mut links[j]);
        }
        for j in k.robot.joints().rev() {
            // Tip to base: what the parent feels of the tree behind the joint.
            let (link, body) = (k.robot.link(j), &mut links[j]);
            let (M, p) = body.felt_through(link.kind, &self.drives[j]);
            let p_LP_B = -body.p_PL_B;
            let parent = link.parent.of_mut(&mut base, &mut links);
            parent.M += M.about(p_LP_B);
            parent.p += p.about(p_LP_B);
        }
        self.accelerate(&base, &links)
    }
}

impl<T: Real, const J: usize> Driven<'_, T, J> {
    /// The matter of a link that is placed, and what pushes it.
    #[inline(always)]
    fn load(&self, j: usize, body: &mut Articulated<T>) {
        let Self { k, outside, .. } = self;
        let (R_BL, M_L) = (body.R_BL, &k.robot.link(j).M_L);
        let outside_B =
            outside.on_link(k.robot, j).map(|F| SpatialForce::new(R_BL * F.torque, R_BL * F.force));
        body.load(&M_L.in_axes(&R_BL), outside_B);
    }
    /// Base to tip: the acceleration that is left for each joint.
    #[inline(always)]
    fn accelerate(&self, base: &Articulated<T>, links: &[Articulated<T>; J]) -> Dynamics<T, J> {
        let k = self.k;
        let (A_base, holding) = solve_base(base, self.base);
        let mut found = Dynamics { nudot: Generalized::default(), force: Generalized::default() };
        let V_NB_B = &k.state.V_NB_B;
        let turned = V_NB_B.angular.cross(V_NB_B.linear);
        found.nudot.base = SpatialAcceleration::new(A_base.angular, A_base.linear - turned);
        found.force.base = holding;
        let mut A_NB_B = PerBody { base: A_base, links: [SpatialAcceleration::zero(); J] };
        for j in k.robot.joints() {
            let (link, body) = (k.robot.link(j), &links[j]);
            let axis = body.axis(link.kind);
            let A = A_NB_B[link.parent].shifted_by(body.p_PL_B) + body.A_bias;
            let (qddot, tau) = match self.drives[j] {
                JointDrive::Effort(tau) => (body.D_inverse * (body.u - A.power(&body.U)), tau),
                JointDrive::Acceleration(qddot) => {
                    let F = body.M * (A + axis.motion(qddot)) + body.p;
                    (qddot, axis.project(&F))
                }
            };
            (found.nudot.joints[j], found.force.joints[j]) = (qddot, tau);
            A_NB_B.links[j] = A + axis.motion(qddot);
        }
        found
    }
}

/// Accelerations that the given forces cause: `M⁻¹ (force - c + Σ Jᵀ F_ext)`.
pub fn forward_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> GeneralizedVelocity<T, J> {
    let mut with_base = outside.into();
    with_base.base += force.base;
    let mut drives = [JointDrive::Effort(T::zero()); J];
    for j in k.robot.joints() {
        drives[j] = JointDrive::Effort(force.joints[j]);
    }
    driven_dynamics(k, &drives, BaseMode::Free, with_base).nudot
}

/// Where a link is, how it turns, and what that adds to its acceleration.
#[inline(always)]
fn place<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    j: usize,
    base: &Articulated<T>,
    links: &mut [Articulated<T>; J],
) {
    let (link, seat, qdot) = (k.robot.link(j), k.seat(j), k.state.v[j]);
    let parent = link.parent.of(base, links);
    let (R_BL, p_PL_B) = (seat.carried_by(&parent.R_BL), parent.R_BL * seat.p_PL_P);
    let axis = Axis { along_B: R_BL.column(2), kind: link.kind };
    let w_P = parent.w_NL_B;
    let w_NL_B = w_P + axis.motion(qdot).angular;
    let body = &mut links[j];
    (body.R_BL, body.p_PL_B, body.w_NL_B) = (R_BL, p_PL_B, w_NL_B);
    body.A_bias = axis.bias(w_NL_B, qdot);
    body.A_bias.linear += w_P.cross(w_P.cross(p_PL_B));
}

impl<T: Real> Articulated<T> {
    #[inline(always)]
    fn nothing() -> Self {
        let (none, o) = (SpatialForce::zero(), Vec3::zero());
        Self {
            R_BL: Mat3::zero(),
            p_PL_B: o,
            w_NL_B: o,
            M: ArticulatedInertia::default(),
            p: none,
            A_bias: SpatialAcceleration::zero(),
            U: none,
            D_inverse: T::zero(),
            u: T::zero(),
        }
    }
    /// The joint's axis.
    #[inline(always)]
    fn axis(&self, kind: JointKind) -> Axis<T> {
        Axis { along_B: self.R_BL.column(2), kind }
    }
    /// Put matter into the body, in base axes, and what pushes it.
    #[inline(always)]
    fn load(&mut self, M_B: &SpatialInertia<T>, outside_B: Option<SpatialForce<T>>) {
        let w = self.w_NL_B;
        let torque = w.cross(M_B.rotational * w);
        let force = w.cross(w.cross(M_B.first_moment));
        self.p = SpatialForce::new(torque, force);
        if let Some(F) = outside_B {
            self.p = self.p - F;
        }
        self.M = ArticulatedInertia::from_rigid(M_B);
    }
    /// Inertia and bias force that the parent feels through the joint, still at this body's origin.
    #[inline(always)]
    fn felt_through(
        &mut self,
        kind: JointKind,
        drive: &JointDrive<T>,
    ) -> (ArticulatedInertia<T>, SpatialForce<T>) {
        let axis = self.axis(kind);
        match *drive {
            JointDrive::Effort(tau) => {
                self.U = axis.force(&self.M);
                self.D_inverse = T::one() / axis.project(&self.U);
                self.u = tau - axis.project(&self.p);
                let M = self.M.without(&self.U, self.D_inverse);
                (M, self.p + M * self.A_bias + self.U * (self.u * self.D_inverse))
            }
            JointDrive::Acceleration(qddot) => {
                (self.M, self.p + self.M * (self.A_bias + axis.motion(qddot)))
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

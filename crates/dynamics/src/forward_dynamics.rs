//! Forward dynamics, with joints driven by force or made to follow, and the base free or held.

use crate::inverse_dynamics::{BaseMotion, newton_euler};
use crate::{
    Configuration, Factorization, Generalized, GeneralizedForce, GeneralizedVelocity,
    InverseDynamics, Kinematics, Outside, Robot,
};
use wrasse_spatial::{At, Real, SpatialForce, SpatialVelocity, groups, kernel};

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
    /// A wrench that keeps it from accelerating at all: it is bolted down.
    Fixed,
}

/// Accelerations and forces, all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dynamics<T, const J: usize> {
    /// `ν̇ = [ẇ_NB_B; v̇_NB_B; q̈]`.
    pub nudot: GeneralizedVelocity<T, J>,
    /// Joint forces; the base's entry is what holds it (zero where it is free).
    pub force: GeneralizedForce<T, J>,
}

/// Forward dynamics with all that it works out on the way; made once and filled for each state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForwardDynamics<T, const J: usize> {
    /// The bias force: what the motion takes without the accelerations that are found.
    bias: InverseDynamics<T, J>,
    /// The mass matrix, factorized.
    pub factors: Factorization<T, J>,
    /// What comes of it.
    pub found: Dynamics<T, J>,
}

/// Accelerations from forces, or forces from accelerations, joint by joint.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `drives` | what is given of each joint | N·m, N or rad/s², m/s² |
/// | `base` | what holds the base | – |
/// | `outside` | wrench on each body at its origin, in its axes; the base's included | N·m, N |
///
/// # Source
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 6, the method of the
/// inertia matrix; ch. 9.2 for joints that follow, ch. 9.4 for the floating base.
pub fn driven_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    drives: &[JointDrive<T>; J],
    base: BaseMode,
    outside: impl Into<Outside<'a, T, J>>,
) -> Dynamics<T, J> {
    let (configuration, mut forward) = (k.configuration(), ForwardDynamics::new());
    let nu = k.state.velocity();
    accelerate(k.robot, &configuration, &nu, drives, base, outside.into(), &mut forward);
    forward.found
}

/// Accelerations that the given forces cause: `M⁻¹ (force - c + Σ Jᵀ F_ext)`.
pub fn forward_dynamics<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> GeneralizedVelocity<T, J> {
    let mut with_base = outside.into();
    with_base.base += force.base;
    let drives = force.joints.map(JointDrive::Effort);
    driven_dynamics(k, &drives, BaseMode::Free, with_base).nudot
}

kernel! {
    /// Forward dynamics in a configuration: the mass matrix is factorized, and the accelerations are
    /// found.
    pub fn accelerate<L, T, J>(
        robot: &Robot<T, J>,
        configuration: &Configuration<T, J>,
        nu: &GeneralizedVelocity<T, J>,
        drives: &[JointDrive<T>; J],
        mode: BaseMode,
        outside: Outside<'_, T, J>,
        forward: &mut ForwardDynamics<T, J>,
    ) {
        let Configuration { posture, composite, base: M } = configuration;
        let ForwardDynamics { bias, factors, found } = forward;
        let given = Given::of(robot, drives);
        // 1. What the motion takes without the accelerations that are to be found.
        let still = BaseMotion::new(&nu.base, &SpatialVelocity::zero());
        let joints = (&nu.joints, &given.acceleration);
        newton_euler::<L, J>(robot, posture, &still, joints, composite, &outside, bias);
        // 2. What is left of the forces accelerates.
        let mut left = Generalized { base: -bias.force.base, joints: given.effort };
        for i in groups::<L, J>(robot.joint_count()) {
            left.joints.put(i, given.effort.at(i) - bias.force.joints.at(i));
        }
        factors.eliminate::<L>(robot, M, &given.free, &left);
        let (A, holding) = factors.accelerations(robot, mode, &mut found.nudot.joints);
        (found.nudot.base, found.force.base) = (A, holding);
        found.force.joints = given.effort;
        if given.any_follows {
            // 3. What the joints that follow take of it.
            for j in robot.joints() {
                found.nudot.joints[j] += given.acceleration[j];
            }
            let moving = BaseMotion::new(&nu.base, &A);
            let joints = (&nu.joints, &found.nudot.joints);
            newton_euler::<L, J>(robot, posture, &moving, joints, composite, &outside, bias);
            for j in robot.joints() {
                let follows = T::one() - given.free[j];
                found.force.joints[j] += bias.force.joints[j] * follows;
            }
        }
    }
}

/// What is given of the joints, in rows; zero where it is not given.
struct Given<T, const J: usize> {
    effort: [T; J],
    acceleration: [T; J],
    /// 1 for the joints whose effort is given.
    free: [T; J],
    any_follows: bool,
}

impl<T: Real, const J: usize> Given<T, J> {
    #[inline(always)]
    fn of(robot: &Robot<T, J>, drives: &[JointDrive<T>; J]) -> Self {
        let none = [T::zero(); J];
        let mut given = Self { effort: none, acceleration: none, free: none, any_follows: false };
        for j in robot.joints() {
            match drives[j] {
                JointDrive::Effort(tau) => (given.effort[j], given.free[j]) = (tau, T::one()),
                JointDrive::Acceleration(qddot) => {
                    given.acceleration[j] = qddot;
                    given.any_follows = true;
                }
            }
        }
        given
    }
}

impl<T: Real, const J: usize> ForwardDynamics<T, J> {
    /// Room for it.
    #[inline(always)]
    pub fn new() -> Self {
        let base = SpatialForce::zero();
        let nudot = Generalized { base: SpatialVelocity::zero(), joints: [T::zero(); J] };
        let force = Generalized { base, joints: [T::zero(); J] };
        Self {
            bias: InverseDynamics::new(),
            factors: Factorization::new(),
            found: Dynamics { nudot, force },
        }
    }
}

impl<T: Real, const J: usize> Default for ForwardDynamics<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

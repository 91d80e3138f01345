//! Exact derivatives of forward dynamics: how the accelerations change with state and forces.

use crate::factorization::Columns;
use crate::inverse_dynamics_derivatives::Bodies;
use crate::{
    BaseColumns, BaseMode, Factorization, Generalized, GeneralizedForce, GeneralizedVelocity,
    InverseDynamicsDerivatives, InverseMassMatrix, JointColumns, Kinematics, Outside, Robot,
};
use core::array;
use wrasse_spatial::{OneByOne, Real, SpatialForce, SpatialVelocity, Vec3};

/// Accelerations that forces cause, and their derivatives.
///
/// The derivative with respect to the base's pose is zero: nothing depends on where in free space
/// the robot is, as long as the wrenches from outside are carried along with their bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForwardDynamicsDerivatives<T, const J: usize> {
    /// `ν̇ = [ẇ_NB_B; v̇_NB_B; q̈]`.
    pub nudot: GeneralizedVelocity<T, J>,
    /// By joint positions.
    pub by_position: JointColumns<SpatialVelocity<T>, T, J>,
    /// By joint rates.
    pub by_rate: JointColumns<SpatialVelocity<T>, T, J>,
    /// By the base's twist `V_NB_B`.
    pub by_base_velocity: BaseColumns<SpatialVelocity<T>, T, J>,
    /// By the generalized force: `M⁻¹`.
    pub by_force: InverseMassMatrix<T, J>,
}

/// Accelerations that the given forces cause, and their derivatives by positions, velocities and
/// forces.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `force` | wrench on the base at Bo (base axes) and joint forces | N·m, N |
/// | `outside` | wrench on each body at its origin, in its axes | N·m, N |
///
/// # Source
/// [`CarpentierMansard2018`](wrasse_spatial::references::CarpentierMansard2018).
#[doc(alias = "aba derivatives")]
#[inline]
pub fn forward_dynamics_derivatives<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> ForwardDynamicsDerivatives<T, J> {
    let mut found = ForwardDynamicsDerivatives::nothing();
    found.fill(k, force, &outside.into());
    found
}

impl<T: Real, const J: usize> ForwardDynamicsDerivatives<T, J> {
    /// All zero.
    #[inline(always)]
    fn nothing() -> Self {
        let still = SpatialVelocity::zero();
        Self {
            nudot: Generalized::default(),
            by_position: JointColumns::filled(still),
            by_rate: JointColumns::filled(still),
            by_base_velocity: BaseColumns { base: [still; 6], joints: [[T::zero(); 6]; J] },
            by_force: InverseMassMatrix::nothing(),
        }
    }
    /// All of it, into a place that is zero.
    fn fill(
        &mut self,
        k: &Kinematics<'_, T, J>,
        force: &GeneralizedForce<T, J>,
        outside: &Outside<'_, T, J>,
    ) {
        // 1. The motion that the forces cause.
        let (robot, mut taken) = (k.robot, InverseDynamicsDerivatives::nothing());
        let (mut bodies, mut M) = (Bodies::nothing(), Factorization::new());
        bodies.observe(k);
        bodies.mass_matrix_into(k, &mut taken.by_acceleration);
        let mut forces = bodies.forces(k, &Generalized::default(), outside);
        let left = difference(force, &bodies.project(k, &forces));
        M.eliminate::<OneByOne<T>>(robot, &taken.by_acceleration.base, &[T::one(); J], &left);
        (self.nudot.base, _) = M.accelerations(robot, BaseMode::Free, &mut self.nudot.joints);
        self.by_force = InverseMassMatrix::of(robot, &M);
        // 2. What more force a motion close to it would take.
        bodies.accelerate(k, &self.nudot, &mut forces);
        taken.differentiate(k, &bodies, &forces);
        // 3. That force is not there: the accelerations give way.
        give_way(robot, &M, &taken.by_position, &mut self.by_position);
        give_way(robot, &M, &taken.by_rate, &mut self.by_rate);
        let w_NB_B = k.state.V_NB_B.angular;
        give_way_of_base(robot, &M, &taken.by_base_velocity, w_NB_B, &mut self.by_base_velocity);
    }
}

#[inline(always)]
fn difference<T: Real, const J: usize>(
    a: &GeneralizedForce<T, J>,
    b: &GeneralizedForce<T, J>,
) -> GeneralizedForce<T, J> {
    Generalized { base: a.base - b.base, joints: array::from_fn(|j| a.joints[j] - b.joints[j]) }
}

/// Columns that are solved for at a time: enough to fill the processor's lanes.
const SOME: usize = 4;

/// `-M⁻¹ F` of the columns of the joints.
#[inline(always)]
fn give_way<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &Factorization<T, J>,
    F: &JointColumns<SpatialForce<T>, T, J>,
    found: &mut JointColumns<SpatialVelocity<T>, T, J>,
) {
    let (n, mut some, mut answer) = (robot.joint_count(), Columns::zero(), Columns::zero());
    for first in (0..n).step_by(SOME) {
        // The last one fills up.
        let columns: [usize; SOME] = array::from_fn(|c| (first + c).min(n - 1));
        some.set_base(columns.map(|j| -F.base[j]));
        for i in robot.joints() {
            some.joints[i] = columns.map(|j| -F.joints[i][j]);
        }
        M.solve(robot, &some, &mut answer);
        for (c, &j) in columns.iter().enumerate() {
            found.base[j] = answer.base_column(c);
            for i in robot.joints() {
                found.joints[i][j] = answer.joints[i][c];
            }
        }
    }
}

/// `-M⁻¹ F` of the columns of the base's twist.
#[inline(always)]
fn give_way_of_base<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &Factorization<T, J>,
    F: &BaseColumns<SpatialForce<T>, T, J>,
    w_NB_B: Vec3<T>,
    found: &mut BaseColumns<SpatialVelocity<T>, T, J>,
) {
    // Three columns are asked for; the fourth fills up.
    let columns: [usize; SOME] = [0, 1, 2, 2];
    let (mut some, mut answer) = (Columns::zero(), Columns::zero());
    some.set_base(columns.map(|c| -F.base[c]));
    for i in robot.joints() {
        some.joints[i] = columns.map(|c| -F.joints[i][c]);
    }
    M.solve(robot, &some, &mut answer);
    // A uniform velocity changes no acceleration in inertial axes, so in the base's it turns with
    // them: v̇ = -w × v.
    let turns = w_NB_B.skew();
    for c in 0..3 {
        found.base[c] = answer.base_column(c);
        found.base[c + 3] = SpatialVelocity::new(Vec3::zero(), -turns.column(c));
    }
    for i in robot.joints() {
        found.joints[i][..3].copy_from_slice(&answer.joints[i][..3]);
    }
}

//! Exact derivatives of forward dynamics: how the accelerations change with state and forces.

use crate::inverse_dynamics_derivatives::Bodies;
use crate::inverse_mass_matrix::{Elimination, Rows};
use crate::{
    BaseColumns, Generalized, GeneralizedForce, GeneralizedVelocity, InverseDynamicsDerivatives,
    InverseMassMatrix, JointColumns, Kinematics, Outside,
};
use core::array;
use wrasse_spatial::{Real, SpatialForce, SpatialVelocity, Vec3};

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
        let mut taken = InverseDynamicsDerivatives::nothing(k.robot.joint_count());
        let mut bodies = Bodies::nothing();
        bodies.observe(k);
        bodies.mass_matrix_into(k, &mut taken.by_acceleration);
        let M = Elimination::new(k.robot, &taken.by_acceleration);
        M.inverse_into(&mut self.by_force);
        let mut forces = bodies.forces(k, &Generalized::default(), outside);
        self.nudot = self.by_force.times(&difference(force, &bodies.project(k, &forces)));
        // 2. What more force a motion close to it would take.
        bodies.accelerate(k, &self.nudot, &mut forces);
        taken.differentiate(k, &bodies, &forces);
        // 3. That force is not there: the accelerations give way.
        give_way(&M, &taken.by_position, &mut self.by_position);
        give_way(&M, &taken.by_rate, &mut self.by_rate);
        let w_NB_B = k.state.V_NB_B.angular;
        give_way_of_base(&M, &taken.by_base_velocity, w_NB_B, &mut self.by_base_velocity);
    }
}

#[inline(always)]
fn difference<T: Real, const J: usize>(
    a: &GeneralizedForce<T, J>,
    b: &GeneralizedForce<T, J>,
) -> GeneralizedForce<T, J> {
    Generalized { base: a.base - b.base, joints: array::from_fn(|j| a.joints[j] - b.joints[j]) }
}

/// `-M⁻¹ F` of the columns of the joints, some at a time: enough to fill the processor's lanes.
#[inline(always)]
fn give_way<T: Real, const J: usize>(
    M: &Elimination<T, J>,
    F: &JointColumns<SpatialForce<T>, T, J>,
    found: &mut JointColumns<SpatialVelocity<T>, T, J>,
) {
    let (mut first, mut four, mut two) =
        (0, Columns::<T, J, 4>::nothing(), Columns::<T, J, 2>::nothing());
    while first < M.joints().len() {
        let left = M.arm(first).end - first;
        if left > 2 {
            four.give_way(M, F, first, found);
        } else {
            two.give_way(M, F, first, found);
        }
        first += left.min(4);
    }
}

/// Some columns, and what becomes of them: a place that is used again and again.
struct Columns<T, const J: usize, const W: usize> {
    F: Rows<T, J, W>,
    answer: Rows<T, J, W>,
}

impl<T: Real, const J: usize, const W: usize> Columns<T, J, W> {
    #[inline(always)]
    fn nothing() -> Self {
        Self { F: Rows::zero(), answer: Rows::zero() }
    }
    /// The columns of the joint in a place and of those behind it in its arm.
    #[inline(always)]
    fn give_way(
        &mut self,
        M: &Elimination<T, J>,
        F: &JointColumns<SpatialForce<T>, T, J>,
        first: usize,
        found: &mut JointColumns<SpatialVelocity<T>, T, J>,
    ) {
        // A joint changes the forces of its own arm and of the base only. The last one fills up.
        let (joints, arm) = (M.joints(), M.arm(first));
        let columns: [usize; W] = array::from_fn(|c| joints[(first + c).min(arm.end - 1)]);
        self.F.set_base(columns.map(|j| F.base[j].to_array()));
        for a in arm {
            self.F.joints[a] = columns.map(|j| F.joints[joints[a]][j]);
        }
        M.give_way(&self.F, Some(first), &mut self.answer);
        for (c, &j) in columns.iter().enumerate() {
            found.base[j] = self.answer.base_column(c);
        }
        for (row, &i) in self.answer.joints.iter().zip(joints) {
            for (x, &j) in row.iter().zip(&columns) {
                found.joints[i][j] = *x;
            }
        }
    }
}

/// `-M⁻¹ F` of the columns of the base's twist.
#[inline(always)]
fn give_way_of_base<T: Real, const J: usize>(
    M: &Elimination<T, J>,
    F: &BaseColumns<SpatialForce<T>, T, J>,
    w_NB_B: Vec3<T>,
    found: &mut BaseColumns<SpatialVelocity<T>, T, J>,
) {
    // Three columns are asked for; the fourth fills up.
    let columns = [0, 1, 2, 2];
    let Columns { F: mut rows, mut answer } = Columns::nothing();
    rows.set_base(columns.map(|c| F.base[c].to_array()));
    for (row, &i) in rows.joints.iter_mut().zip(M.joints()) {
        *row = columns.map(|c| F.joints[i][c]);
    }
    M.give_way(&rows, None, &mut answer);
    // A uniform velocity changes no acceleration in inertial axes, so in the base's it turns with
    // them: v̇ = -w × v.
    let turns = w_NB_B.skew();
    for c in 0..3 {
        found.base[c] = answer.base_column(c);
        found.base[c + 3] = SpatialVelocity::new(Vec3::zero(), -turns.column(c));
    }
    for (row, &i) in answer.joints.iter().zip(M.joints()) {
        found.joints[i][..3].copy_from_slice(&row[..3]);
    }
}

//! Exact derivatives of forward dynamics: how the accelerations change with state and forces.

use crate::inverse_dynamics_derivatives::Bodies;
use crate::{
    BaseColumns, BodyId, Generalized, GeneralizedForce, GeneralizedVelocity,
    InverseDynamicsDerivatives, InverseMassMatrix, JointColumns, Kinematics, PerBody,
    inverse_mass_matrix,
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
/// | `external` | wrench on each body at its origin, in its axes | N·m, N |
///
/// # Source
/// J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.
#[doc(alias = "aba derivatives")]
#[inline(always)]
pub fn forward_dynamics_derivatives<T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    force: &GeneralizedForce<T, J>,
    external: &PerBody<SpatialForce<T>, J>,
) -> ForwardDynamicsDerivatives<T, J> {
    // 1. The motion that the forces cause.
    let mut taken = InverseDynamicsDerivatives::nothing(k.robot.joint_count());
    let bodies = Bodies::new(k);
    bodies.mass_matrix_into(k, &mut taken.by_acceleration);
    let by_force = inverse_mass_matrix(&taken.by_acceleration);
    let bias = bodies.project(k, &bodies.forces(k, &Generalized::default(), external));
    let mut found = ForwardDynamicsDerivatives {
        nudot: by_force.times(&difference(force, &bias)),
        by_position: JointColumns::filled(SpatialVelocity::zero()),
        by_rate: JointColumns::filled(SpatialVelocity::zero()),
        by_base_velocity: BaseColumns {
            base: [SpatialVelocity::zero(); 6],
            joints: [[T::zero(); 6]; J],
        },
        by_force,
    };
    // 2. What more force a motion close to it would take.
    let forces = bodies.forces(k, &found.nudot, external);
    taken.differentiate(k, &bodies, &forces);
    // 3. That force is not there: the accelerations give way.
    found.by_force.give_way(&taken.by_position, &mut found.by_position);
    found.by_force.give_way(&taken.by_rate, &mut found.by_rate);
    let w_NB_B = k.V_NB_B(BodyId::Base).angular;
    found.by_force.give_way_of_base(&taken.by_base_velocity, w_NB_B, &mut found.by_base_velocity);
    found
}

#[inline(always)]
fn difference<T: Real, const J: usize>(
    a: &GeneralizedForce<T, J>,
    b: &GeneralizedForce<T, J>,
) -> GeneralizedForce<T, J> {
    Generalized { base: a.base - b.base, joints: array::from_fn(|j| a.joints[j] - b.joints[j]) }
}

/// Columns that are worked on at a time: enough to fill the processor's lanes.
const WIDTH: usize = 4;

/// Rows of [`WIDTH`] columns, side by side.
struct Rows<T, const J: usize> {
    base: [[T; WIDTH]; 6],
    joints: [[T; WIDTH]; J],
}

impl<T: Real, const J: usize> InverseMassMatrix<T, J> {
    /// `-M⁻¹ F` of all columns.
    #[inline(always)]
    fn give_way(
        &self,
        F: &JointColumns<SpatialForce<T>, T, J>,
        found: &mut JointColumns<SpatialVelocity<T>, T, J>,
    ) {
        let n = self.count.min(J);
        let mut rows = Rows::zero();
        for first in (0..n).step_by(WIDTH) {
            let width = WIDTH.min(n - first);
            for c in 0..width {
                rows.set(c, &F.base[first + c].to_array());
            }
            for i in 0..n {
                rows.joints[i][..width].copy_from_slice(&F.joints[i][first..first + width]);
            }
            let answer = self.times_minus(&rows);
            for c in 0..width {
                found.base[first + c] = answer.base_column(c);
            }
            for i in 0..n {
                let place = &mut found.joints[i][first..first + width];
                place.copy_from_slice(&answer.joints[i][..width]);
            }
        }
    }
    /// `-M⁻¹ F` of the columns of the base's twist.
    #[inline(always)]
    fn give_way_of_base(
        &self,
        F: &BaseColumns<SpatialForce<T>, T, J>,
        w_NB_B: Vec3<T>,
        found: &mut BaseColumns<SpatialVelocity<T>, T, J>,
    ) {
        let n = self.count.min(J);
        let mut rows = Rows::zero();
        for c in 0..3 {
            rows.set(c, &F.base[c].to_array());
        }
        for i in 0..n {
            rows.joints[i][..3].copy_from_slice(&F.joints[i][..3]);
        }
        let answer = self.times_minus(&rows);
        // A uniform velocity changes no acceleration in inertial axes, so in the base's it turns
        // with them: v̇ = -w × v.
        let turns = w_NB_B.skew();
        for c in 0..3 {
            found.base[c] = answer.base_column(c);
            found.base[c + 3] = SpatialVelocity::new(Vec3::zero(), -turns.column(c));
        }
        for i in 0..n {
            found.joints[i][..3].copy_from_slice(&answer.joints[i][..3]);
        }
    }
    /// `-M⁻¹ F` of some columns.
    #[inline(always)]
    fn times_minus(&self, F: &Rows<T, J>) -> Rows<T, J> {
        let n = self.count.min(J);
        let mut found = Rows::zero();
        for c in 0..6 {
            let column = self.A_bb[c].to_array();
            for r in 0..6 {
                take(&mut found.base[r], column[r], &F.base[c]);
            }
        }
        for i in 0..n {
            let column = self.A_bj[i].to_array();
            let mut row = [T::zero(); WIDTH];
            for r in 0..6 {
                take(&mut found.base[r], column[r], &F.joints[i]);
                take(&mut row, column[r], &F.base[r]);
            }
            for j in 0..n {
                take(&mut row, self.A_jj[i][j], &F.joints[j]);
            }
            found.joints[i] = row;
        }
        found
    }
}

impl<T: Real, const J: usize> Rows<T, J> {
    #[inline(always)]
    fn zero() -> Self {
        Self { base: [[T::zero(); WIDTH]; 6], joints: [[T::zero(); WIDTH]; J] }
    }
    /// The base's six of one column.
    #[inline(always)]
    fn set(&mut self, column: usize, six: &[T; 6]) {
        for r in 0..6 {
            self.base[r][column] = six[r];
        }
    }
    #[inline(always)]
    fn base_column(&self, column: usize) -> SpatialVelocity<T> {
        SpatialVelocity::from_array(self.base.map(|row| row[column]))
    }
}

/// `row -= s x`.
#[inline(always)]
fn take<T: Real>(row: &mut [T; WIDTH], s: T, x: &[T; WIDTH]) {
    for c in 0..WIDTH {
        row[c] -= s * x[c];
    }
}

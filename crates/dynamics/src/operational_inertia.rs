//! Operational inertia: how a vehicle resists a push at a frame, its joints and its base giving way.

use crate::factorization::Columns;
use crate::{Cholesky, Configuration, Factorization, Generalized, Jacobian, Robot};
use core::array;
use wrasse_spatial::{At, Real, SpatialForce, kernel};

kernel! {
    /// Factorize the mass matrix of a configuration. Joints that are not `free` (0, not 1) are held.
    pub fn factorize<L, T, J>(
        robot: &Robot<T, J>,
        configuration: &Configuration<T, J>,
        free: &[T; J],
        factors: &mut Factorization<T, J>,
    ) {
        let nothing = Generalized { base: SpatialForce::zero(), joints: [T::zero(); J] };
        factors.eliminate::<L>(robot, &configuration.base, free, &nothing);
    }
}

/// `Λ⁻¹ = J_A M⁻¹ J_Bᵀ`: how frame A accelerates for a unit wrench on frame B.
///
/// Rows are `[angular; linear]` of A's twist at its origin (rad/s², m/s²), columns `[torque; force]` on B
/// at its origin (N·m, N), both in inertial axes. With A and B the same frame it is symmetric and positive
/// definite, for nothing holds the base; between two frames it is what a contact or a closed loop couples.
///
/// # Source
/// [`Khatib1987`](wrasse_spatial::references::Khatib1987);
/// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 11.4 for its use at contacts.
pub fn inverse_operational_inertia<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &Factorization<T, J>,
    J_A: &Jacobian<T, J>,
    J_B: &Jacobian<T, J>,
) -> [[T; 6]; 6] {
    let (mut pushes, mut answers) = (Columns::zero(), Columns::zero());
    let units: [_; 6] = array::from_fn(unit_wrench::<T>);
    pushes.set_base(units.map(|F| J_B.on_base(&F)));
    for j in robot.joints() {
        pushes.joints[j] = units.map(|F| J_B.joints.at(j).power(&F));
    }
    M.solve(robot, &pushes, &mut answers);
    let columns: [_; 6] = array::from_fn(|c| {
        let mut A = J_A.of_base(&answers.base_column(c));
        for j in robot.joints() {
            A += J_A.joints.at(j) * answers.joints[j][c];
        }
        A.to_array()
    });
    array::from_fn(|r| array::from_fn(|c| columns[c][r]))
}

/// `Λ = (J M⁻¹ Jᵀ)⁻¹`: the wrench that accelerates a frame, `[torque; force]` per `[angular; linear]`, at
/// its origin in inertial axes (kg·m², kg·m, kg).
///
/// The same frames and sources as [`inverse_operational_inertia`].
pub fn operational_inertia<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &Factorization<T, J>,
    J_frame: &Jacobian<T, J>,
) -> [[T; 6]; 6] {
    let factor = Cholesky::new(&inverse_operational_inertia(robot, M, J_frame, J_frame), 6);
    array::from_fn(|c| factor.solve(&unit_wrench::<T>(c).to_array()))
}

fn unit_wrench<T: Real>(c: usize) -> SpatialForce<T> {
    let mut six = [T::zero(); 6];
    six[c] = T::one();
    SpatialForce::from_array(six)
}

impl<T: Real, const J: usize> Jacobian<T, J> {
    /// `J_bᵀ F`: what a wrench on the frame at its origin, inertial axes, does to the base, `[torque;
    /// force]` at Bo in base axes (N·m, N).
    #[inline(always)]
    pub fn on_base(&self, F_N: &SpatialForce<T>) -> SpatialForce<T> {
        let F = F_N.about(-self.p_BE_N);
        let (torque, force) = (F.torque, F.force);
        SpatialForce::new(self.R_NB.transpose_mul(torque), self.R_NB.transpose_mul(force))
    }
}

//! The mass matrix against inverse dynamics, energy and a dense factorization.

use crate::measure::{dense, dense_joints, dense_vector, for_every_robot};
use nalgebra::{DVector, SymmetricEigen};
use wrasse_dynamics::{
    Cholesky, Generalized, PerBody, bias_force, inverse_dynamics, kinematics, kinetic_energy,
    mass_matrix,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity};
use wrasse_testing::gap;
use wrasse_testing::random_robot::JOINTS;

/// Measured 1e-15.
#[test]
fn each_column_of_the_mass_matrix_is_the_force_of_a_unit_acceleration() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let M = dense(&mass_matrix(&k));
        let c = dense_vector(&s.robot, &bias_force(&k));
        let mut by_columns = M.clone();
        for i in 0..M.ncols() {
            let mut nudot = Generalized { base: SpatialVelocity::zero(), joints: [0.0; JOINTS] };
            match i.checked_sub(6) {
                Some(j) => nudot.joints[j] = 1.0,
                None => {
                    nudot.base =
                        SpatialVelocity::from_array(std::array::from_fn(|r| f64::from(r == i)));
                }
            }
            let force = inverse_dynamics(&k, &nudot, &PerBody::filled(SpatialForce::zero())).force;
            by_columns.set_column(i, &(dense_vector(&s.robot, &force) - &c));
        }
        gap(&M, &by_columns)
    });
}

/// Measured 1e-15.
#[test]
fn the_kinetic_energy_of_the_bodies_is_that_of_the_mass_matrix() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let nu = dense_vector(&s.robot, &s.state.velocity());
        let by_matrix = 0.5 * nu.dot(&(dense(&mass_matrix(&k)) * &nu));
        gap(&kinetic_energy(&k), &by_matrix)
    });
}

/// Symmetric to the last bit, by construction. The error here is the condition: kilograms of the
/// base against the lightest link's kg·m². Measured 4e4, far from round-off.
#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    for_every_robot(1e8, |s| {
        let M = dense(&mass_matrix(&kinematics(&s.robot, &s.state)));
        let values = SymmetricEigen::new(M.clone()).eigenvalues;
        let lawful = M == M.transpose() && values.min() > 0.0;
        if lawful { values.max() / values.min() } else { f64::INFINITY }
    });
}

/// Condition of the joint block up to 3e4, times round-off. Measured 1e-14.
#[test]
fn the_small_factorization_solves_like_a_dense_one() {
    for_every_robot(1e-12, |s| {
        let n = s.robot.joint_count();
        let H = mass_matrix(&kinematics(&s.robot, &s.state)).M_jj;
        let factor = Cholesky::new(&H, n);
        assert!(factor.smallest_pivot() > 0.0);
        let b = DVector::from_column_slice(&s.xi[..n]);
        let dense = dense_joints(&H, n).cholesky().unwrap().solve(&b);
        let ours = factor.solve(&s.xi);
        gap(&ours[..n].to_vec(), &dense.as_slice().to_vec())
    });
}

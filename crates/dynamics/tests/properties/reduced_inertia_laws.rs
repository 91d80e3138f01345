//! The joint dynamics with the base eliminated.

use crate::measure::{dense, dense_joints, for_every_robot};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use wrasse_dynamics::{
    BaseMode, Generalized, JointDrive, PerBody, ReducedDynamics, State, attitude_held_dynamics,
    base_twist, bias_force, driven_dynamics, forward_dynamics, free_floating_dynamics, kinematics,
    kinetic_energy, mass_matrix,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, larger, size};

type Reduced = ReducedDynamics<f64, JOINTS>;

/// Free-floating, attitude-held, and base-fixed inertia, and both reduced dynamics.
fn inertias(s: &Scene) -> ([DMatrix<f64>; 3], Reduced, Reduced) {
    let k = kinematics(&s.robot, &s.state);
    let (M, c, n) = (mass_matrix(&k), bias_force(&k), s.robot.joint_count());
    let free = free_floating_dynamics(&s.robot, &M, &c);
    let held = attitude_held_dynamics(&s.robot, &M, &c);
    let all = [&free.H, &held.H, &M.M_jj].map(|H| dense_joints(H, n));
    (all, free, held)
}

/// H* loses up to three digits against H_m where the base recoils freely. Measured 2e-14.
#[test]
fn the_free_floating_inertia_is_the_inverse_of_the_joint_block_of_the_inverse() {
    for_every_robot(1e-12, |s| {
        let n = s.robot.joint_count();
        let M = dense(&mass_matrix(&kinematics(&s.robot, &s.state)));
        let inverse = M.cholesky().unwrap().inverse();
        let block = inverse.view((6, 6), (n, n)).into_owned();
        let ([free, ..], ..) = inertias(s);
        gap(&free, &block.cholesky().unwrap().inverse())
    });
}

/// A base that yields makes every joint motion lighter: no eigenvalue of a difference is negative
/// by more than round-off. Measured 1e-16.
#[test]
fn free_floating_is_lighter_than_attitude_held_is_lighter_than_fixed() {
    for_every_robot(1e-14, |s| {
        let ([free, held, fixed], ..) = inertias(s);
        let lowest = |D: DMatrix<f64>| SymmetricEigen::new(D).eigenvalues.min();
        let least = lowest(&held - &free).min(lowest(&fixed - &held));
        larger(-least / size(&fixed), 0.0)
    });
}

/// And really lighter, so that the law above is not empty.
#[test]
fn the_three_inertias_differ() {
    for_every_robot(0.0, |s| {
        let ([free, held, fixed], ..) = inertias(s);
        let both = gap(&free, &held) > 1e-9 && gap(&held, &fixed) > 1e-9;
        f64::from(!both)
    });
}

/// Measured 1e-15.
#[test]
fn at_zero_momentum_the_energy_is_half_the_rates_times_the_free_floating_inertia() {
    for_every_robot(1e-13, |s| {
        let ([free, ..], ..) = inertias(s);
        let M = mass_matrix(&kinematics(&s.robot, &s.state));
        let V_NB_B = base_twist(&M, &SpatialForce::zero(), &s.state.v);
        let state = State { V_NB_B, ..s.state };
        let qdot = DVector::from_column_slice(&s.state.v[..s.robot.joint_count()]);
        gap(&kinetic_energy(&kinematics(&s.robot, &state)), &(0.5 * qdot.dot(&(free * &qdot))))
    });
}

/// Computed torque, free-floating: the joints do as they are told, the base turning or not.
/// Measured 8e-14.
#[test]
fn free_floating_effort_gives_the_joint_accelerations_asked_for() {
    for_every_robot(1e-12, |s| {
        let (_, free, _) = inertias(s);
        let k = kinematics(&s.robot, &s.state);
        let joints = free.effort(&s.robot, &s.xi);
        let force = Generalized { base: SpatialForce::zero(), joints };
        let found = forward_dynamics(&k, &force, &PerBody::filled(SpatialForce::zero()));
        gap(&found.joints, &s.xi)
    });
}

/// Computed torque, attitude held. Measured 4e-14.
#[test]
fn attitude_held_effort_gives_the_joint_accelerations_asked_for() {
    for_every_robot(1e-12, |s| {
        let (_, _, held) = inertias(s);
        let k = kinematics(&s.robot, &s.state);
        let drives = held.effort(&s.robot, &s.xi).map(JointDrive::Effort);
        let none = PerBody::filled(SpatialForce::zero());
        let found = driven_dynamics(&k, &drives, BaseMode::AttitudeHeld, &none);
        gap(&found.nudot.joints, &s.xi)
    });
}

/// A terrestrial torque `H_m q̈` gives a free-flyer `H*⁻¹ H_m q̈`, and `q̈ᵀ H_m H*⁻¹ H_m q̈` is
/// never less than `q̈ᵀ H_m q̈`: it moves too far. Measured 5e-14.
#[test]
fn terrestrial_torque_moves_a_free_flyer_too_far() {
    for_every_robot(1e-12, |s| {
        let state = State { v: [0.0; JOINTS], V_NB_B: SpatialVelocity::zero(), ..s.state };
        let still = Scene { state, ..*s };
        let ([free, _, fixed], ..) = inertias(&still);
        let n = s.robot.joint_count();
        let wanted = DVector::from_column_slice(&s.xi[..n]);
        let torque = &fixed * &wanted;
        let mut joints = [0.0; JOINTS];
        joints[..n].copy_from_slice(torque.as_slice());
        let k = kinematics(&still.robot, &still.state);
        let force = Generalized { base: SpatialForce::zero(), joints };
        let found = forward_dynamics(&k, &force, &PerBody::filled(SpatialForce::zero()));
        let found = DVector::from_column_slice(&found.joints[..n]);
        let predicted = free.cholesky().unwrap().solve(&torque);
        let (done, asked) = (found.dot(&torque), wanted.dot(&torque));
        larger(gap(&found, &predicted), gap_at(&0.0, &larger(asked - done, 0.0), asked))
    });
}

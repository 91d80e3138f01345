//! Momentum and energy: what an isolated system keeps.

use crate::in_time::{Rate, in_time};
use crate::measure::for_every_robot;
use wrasse_dynamics::{
    Generalized, GeneralizedVelocity, Momentum, PerBody, base_twist, forward_dynamics, kinematics,
    kinetic_energy, mass_matrix, momentum, momentum_matrix,
};
use wrasse_spatial::{Dual, SpatialForce, SpatialMomentum, Vec3};
use wrasse_testing::random_robot::Scene;
use wrasse_testing::{gap, gap_at, larger, largest, size};

/// Largest momentum of one body, about the system's centre of mass: what the sum is made of.
fn largest_share(scene: &Scene) -> f64 {
    let k = kinematics(&scene.robot, &scene.state);
    let p_NScm = k.centre_of_mass().1;
    largest(scene.robot.bodies().map(|body| {
        let h_B = *scene.robot.inertia(body) * k.V_NB_B(body);
        size(&k.X_NB(body).force_to_parent(&h_B).about(p_NScm))
    }))
}

/// The system's momentum as it moves on with these accelerations.
fn momentum_in_time(scene: &Scene, nudot: &GeneralizedVelocity<f64, 12>) -> Momentum<Dual<f64>> {
    let robot = scene.robot.cast::<Dual<f64>>();
    let moving = in_time(&scene.state, nudot);
    momentum(&kinematics(&robot, &moving))
}

/// Measured 4e-15.
#[test]
fn the_momentum_matrix_times_the_rates_is_the_momentum_of_the_bodies() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let A = momentum_matrix(&mass_matrix(&k), &s.state.X_NB.rotation);
        let (base, joints) = (A.base, A.joints.columns());
        let rates = s.state.V_NB_B.to_array();
        let mut h = SpatialMomentum::zero();
        base.iter().zip(rates).for_each(|(column, rate)| h += *column * rate);
        joints.iter().zip(s.state.v).for_each(|(column, rate)| h += *column * rate);
        let summed = momentum(&k);
        gap_at(&h, &SpatialMomentum::new(summed.angular, summed.linear), largest_share(s))
    });
}

/// Condition of the locked inertia, about 1e2. Measured 5e-15.
#[test]
fn the_base_twist_is_found_again_from_momentum_and_joint_rates() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let h = momentum(&k);
        let R = s.state.X_NB.rotation;
        let h_B = SpatialMomentum::new(R.transpose_mul(h.angular), R.transpose_mul(h.linear));
        gap(&base_twist(&mass_matrix(&k), &h_B, &s.state.v), &s.state.V_NB_B)
    });
}

/// Motors only move momentum about: exact rates, relative to the largest rate of one body.
/// Measured 4e-15.
#[test]
fn the_momentum_of_a_system_that_nothing_pushes_is_constant() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let none = PerBody::filled(SpatialForce::zero());
        let motors = Generalized { base: SpatialForce::zero(), joints: s.xi };
        let h = momentum_in_time(s, &forward_dynamics(&k, &motors, &none));
        let scale = larger(largest_share(s), size(&s.xi));
        larger(
            gap_at(&h.linear.rate(), &Vec3::zero(), scale),
            gap_at(&h.angular.rate(), &Vec3::zero(), scale),
        )
    });
}

/// Measured 7e-15.
#[test]
fn momentum_changes_by_the_external_wrench_about_the_centre_of_mass() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let motors = Generalized { base: SpatialForce::zero(), joints: s.xi };
        let h = momentum_in_time(s, &forward_dynamics(&k, &motors, &s.external));
        let p_NScm = k.centre_of_mass().1;
        let wrench = s.robot.bodies().fold(SpatialForce::zero(), |sum, body| {
            sum + k.X_NB(body).force_to_parent(&s.external[body]).about(p_NScm)
        });
        let scale = larger(largest_share(s), size(&wrench));
        larger(
            gap_at(&h.linear.rate(), &wrench.force, scale),
            gap_at(&h.angular.rate(), &wrench.torque, scale),
        )
    });
}

/// Measured 2e-15.
#[test]
fn the_centre_of_mass_moves_with_the_linear_momentum() {
    for_every_robot(1e-13, |s| {
        let h = momentum_in_time(s, &s.nudot);
        let now = momentum(&kinematics(&s.robot, &s.state));
        larger(gap(&(h.p_NScm_N.rate() * now.mass), &now.linear), gap(&now.mass, &s.robot.mass()))
    });
}

/// Measured 7e-16.
#[test]
fn the_energy_of_a_system_without_forces_is_constant() {
    for_every_robot(1e-14, |s| {
        let none = PerBody::filled(SpatialForce::zero());
        let k = kinematics(&s.robot, &s.state);
        let nudot = forward_dynamics(&k, &Generalized::default(), &none);
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &nudot);
        let rate = kinetic_energy(&kinematics(&robot, &moving)).rate();
        rate.abs() / kinetic_energy(&k)
    });
}

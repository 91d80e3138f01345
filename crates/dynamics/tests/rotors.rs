//! Rotors behind gears: they add to the diagonal of the mass matrix, and every algorithm knows it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_dynamics::{
    BaseMode, BodyId, Generalized, GeneralizedVelocity, Joint, JointDrive, MassProperties, Outside,
    Robot, State, bias_force, driven_dynamics, forward_dynamics, forward_dynamics_derivatives,
    inverse_dynamics, inverse_dynamics_derivatives, inverse_mass_matrix, kinematics,
    kinetic_energy, mass_matrix, momentum,
};
use wrasse_testing::largest;
use wrasse_testing::random_robot::{JOINTS, Recipe, Scene};

/// Inertias from far below to far above those of the links.
fn rotor(j: usize) -> f64 {
    [0.02, 3.0, 0.4, 90.0][j % 4]
}

/// The same robot with these rotors on its joints.
fn carrying(robot: &Robot<f64, JOINTS>, rotor: impl Fn(usize) -> f64) -> Robot<f64, JOINTS> {
    let matter = |body| MassProperties {
        M_F_F: *robot.inertia(body),
        I_parts_F: *robot.inertia_of_parts(body),
    };
    let link = |j: usize| (robot.joint(j).with_rotor(rotor(j)), matter(BodyId::Link(j)));
    let links: Vec<(Joint<f64>, MassProperties<f64>)> = robot.joints().map(link).collect();
    Robot::new(matter(BodyId::Base), &links).expect("the same tree")
}

fn scenes() -> impl Iterator<Item = Scene> {
    (0..40).zip((1..=JOINTS).cycle()).map(|(seed, joints)| {
        let recipe = Recipe { seed, joints, arms: 1 + joints / 5, sliding: 0.3, branching: 0.3 };
        let mut scene = Scene::new(&recipe);
        scene.robot = carrying(&scene.robot, rotor);
        scene
    })
}

/// `½ νᵀ M ν` as a part of a scale.
fn energy_by_matrix(robot: &Robot<f64, JOINTS>, state: &State<f64, JOINTS>) -> f64 {
    let k = kinematics(robot, state);
    let M = mass_matrix(&k);
    let nu: Vec<f64> =
        state.V_NB_B.to_array().into_iter().chain(state.v).take(6 + robot.joint_count()).collect();
    let product = |i: usize| (0..nu.len()).map(|k| M.element(i, k) * nu[k]).sum::<f64>();
    0.5 * (0..nu.len()).map(|i| nu[i] * product(i)).sum::<f64>()
}

#[test]
fn a_rotor_is_on_the_diagonal_of_the_mass_matrix_and_in_no_momentum() {
    for scene in scenes() {
        let state = scene.state;
        let k = kinematics(&scene.robot, &state);
        let M = mass_matrix(&k);
        let without = carrying(&scene.robot, |_| 0.0);
        let k_without = kinematics(&without, &state);
        let M_without = mass_matrix(&k_without);
        let n = scene.robot.joint_count() + 6;
        for i in 0..n {
            for j in 0..n {
                let more = M.element(i, j) - M_without.element(i, j);
                let expected = if i == j && i >= 6 { rotor(i - 6) } else { 0.0 };
                assert!((more - expected).abs() < 1e-12 * M.element(i, i).abs().max(1.0));
            }
        }
        let (h, h_without) = (momentum(&k), momentum(&k_without));
        assert_eq!((h.linear, h.angular), (h_without.linear, h_without.angular));
    }
}

#[test]
fn energy_is_that_of_the_mass_matrix() {
    for scene in scenes() {
        let energy = kinetic_energy(&kinematics(&scene.robot, &scene.state));
        let off = (energy - energy_by_matrix(&scene.robot, &scene.state)).abs() / energy;
        assert!(off < 1e-13, "{off:e}");
    }
}

#[test]
fn inverse_and_forward_dynamics_undo_each_other_and_agree_with_the_matrix() {
    for scene in scenes() {
        let k = kinematics(&scene.robot, &scene.state);
        let none = Outside::nothing();
        let tau = inverse_dynamics(&k, &scene.nudot, none).force;
        let found = forward_dynamics(&k, &tau, none);
        let nudot = |x: &GeneralizedVelocity<f64, JOINTS>| -> Vec<f64> {
            x.base.to_array().into_iter().chain(x.joints).collect()
        };
        let off = largest(nudot(&found).into_iter().zip(nudot(&scene.nudot)).map(|(a, b)| a - b));
        assert!(off < 1e-10, "of 2 rad/s²: {off:e}");
        // τ - c = M ν̇, row by row.
        let (M, c) = (mass_matrix(&k), bias_force(&k));
        let n = scene.robot.joint_count() + 6;
        let x = nudot(&scene.nudot);
        let force: Vec<f64> = tau.base.to_array().into_iter().chain(tau.joints).collect();
        let bias: Vec<f64> = c.base.to_array().into_iter().chain(c.joints).collect();
        for i in 0..n {
            let sum: f64 = (0..n).map(|j| M.element(i, j) * x[j]).sum();
            let scale = (0..n).map(|j| (M.element(i, j) * x[j]).abs()).sum::<f64>() + bias[i].abs();
            assert!((force[i] - bias[i] - sum).abs() < 1e-12 * scale, "row {i}");
        }
        let inverse = inverse_mass_matrix(&scene.robot, &M);
        for i in 0..n {
            let sum: f64 = (0..n).map(|j| M.element(i, j) * inverse.element(j, i)).sum();
            assert!((sum - 1.0).abs() < 1e-10, "row {i}: {sum}");
        }
    }
}

/// A joint whose acceleration is given takes what its rotor takes of it.
#[test]
fn a_joint_that_follows_bears_its_rotor() {
    for scene in scenes() {
        let k = kinematics(&scene.robot, &scene.state);
        let none = Outside::nothing();
        let drives = core::array::from_fn(|j| JointDrive::Acceleration(scene.nudot.joints[j]));
        let found = driven_dynamics(&k, &drives, BaseMode::Free, none);
        let nudot = Generalized { base: found.nudot.base, joints: scene.nudot.joints };
        let expected = inverse_dynamics(&k, &nudot, none).force;
        let scale = largest(expected.joints).max(1.0);
        let off = largest((0..JOINTS).map(|j| found.force.joints[j] - expected.joints[j]));
        assert!(off < 1e-12 * scale, "{off:e}");
    }
}

/// Derivatives against small differences.
#[test]
fn derivatives_know_of_rotors() {
    for scene in scenes().take(12) {
        let k = kinematics(&scene.robot, &scene.state);
        let none = Outside::nothing();
        let taken = inverse_dynamics_derivatives(&k, &scene.nudot, none);
        let tau = inverse_dynamics(&k, &scene.nudot, none).force;
        let off = largest((0..JOINTS).map(|j| taken.force.joints[j] - tau.joints[j]));
        assert!(off < 1e-11 * largest(tau.joints).max(1.0), "{off:e}");
        let n = scene.robot.joint_count();
        let M = mass_matrix(&k);
        for j in 0..n {
            let diagonal = taken.by_acceleration.element(6 + j, 6 + j);
            assert!((diagonal - M.element(6 + j, 6 + j)).abs() < 1e-12 * diagonal);
        }
        let derivatives = forward_dynamics_derivatives(&k, &tau, none);
        let step = 1e-6;
        for j in 0..n {
            let at = |side: f64| {
                let mut state = scene.state;
                state.q[j] += side * step;
                forward_dynamics(&kinematics(&scene.robot, &state), &tau, none).joints
            };
            let (after, before) = (at(1.0), at(-1.0));
            for i in 0..n {
                let slope = (after[i] - before[i]) / (2.0 * step);
                let found = derivatives.by_position.joints[i][j];
                let scale = largest((0..n).map(|i| derivatives.by_position.joints[i][j])).max(1.0);
                assert!((slope - found).abs() < 1e-6 * scale, "{slope} and {found}");
            }
        }
    }
}

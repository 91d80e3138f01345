//! The reaction null space: joint motion that leaves the base's attitude alone.

use crate::measure::{any_robot, dense_columns, for_every, for_every_robot};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::Strategy;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::array;
use wrasse_dynamics::{
    BodyId, Joint, JointKind, MassMatrix, MassProperties, Robot, State, angular_momentum_per_rate,
    attitude_held_jacobian, base_twist, generalized_jacobian, jacobian, kinematics, mass_matrix,
    reaction_null_space,
};
use wrasse_spatial::{Pose, Quat, Real, SpatialForce, Sym3, Vec3, vec3};
use wrasse_testing::random_robot::{JOINTS, Random, Recipe, Scene};
use wrasse_testing::{gap, gap_at, larger, size};

/// `1 - H⁺ H` by singular values, as an oracle.
fn projector(M: &MassMatrix<f64, JOINTS>, tiny: f64) -> DMatrix<f64> {
    let H_w = angular_momentum_per_rate(M);
    let H = DMatrix::from_fn(3, M.count, |i, j| H_w[j].to_array()[i]);
    let largest = size(&H);
    let inverse = H.clone().pseudo_inverse(tiny * largest).unwrap();
    DMatrix::identity(M.count, M.count) - inverse * H
}

fn scene_matrix(s: &Scene) -> MassMatrix<f64, JOINTS> {
    mass_matrix(&kinematics(&s.robot, &s.state))
}

/// H_w of random arms has a condition up to 1e3. Measured 2e-15.
#[test]
fn null_space_rates_do_not_turn_a_free_base() {
    for_every_robot(1e-13, |s| {
        let M = scene_matrix(s);
        let rates = reaction_null_space(&s.robot, &M, &s.xi);
        let turned = base_twist(&M, &SpatialForce::zero(), &rates).angular;
        let without = base_twist(&M, &SpatialForce::zero(), &s.xi).angular;
        gap_at(&turned, &Vec3::zero(), size(&without))
    });
}

/// Measured 1e-13.
#[test]
fn null_space_rates_are_those_of_the_pseudo_inverse() {
    for_every_robot(1e-11, |s| {
        let M = scene_matrix(s);
        let n = M.count;
        let oracle = projector(&M, 1e-9) * DVector::from_column_slice(&s.xi[..n]);
        let rates = reaction_null_space(&s.robot, &M, &s.xi);
        gap_at(&rates[..n].to_vec(), &oracle.as_slice().to_vec(), size(&s.xi))
    });
}

/// Trace of the projector: it counts the free directions.
fn dimension(robot: &Robot<f64, JOINTS>, M: &MassMatrix<f64, JOINTS>) -> f64 {
    robot.joints().fold(0.0, |sum, j| {
        let unit = array::from_fn(|i| f64::from(i == j));
        sum + reaction_null_space(robot, M, &unit)[j]
    })
}

/// Three equations: n - 3 directions are left, none for three joints or fewer.
/// Measured 2e-15.
#[test]
fn the_null_space_has_three_dimensions_less_than_there_are_joints() {
    for_every_robot(1e-13, |s| {
        let left = s.robot.joint_count().saturating_sub(3) as f64;
        (dimension(&s.robot, &scene_matrix(s)) - left).abs()
    });
}

/// Measured 7e-16.
#[test]
fn null_space_rates_stay_as_they_are() {
    for_every_robot(1e-14, |s| {
        let M = scene_matrix(s);
        let once = reaction_null_space(&s.robot, &M, &s.xi);
        gap_at(&reaction_null_space(&s.robot, &M, &once), &once, size(&s.xi))
    });
}

/// In the null space both Jacobians give the tip the same twist: the base does not turn.
/// Measured 2e-15.
#[test]
fn both_jacobians_agree_in_the_null_space() {
    let seven = any_robot().prop_map(|recipe| Recipe { joints: 7, ..recipe });
    for_every(seven, 1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let (M, J_frame) = (mass_matrix(&k), jacobian(&k, &s.frame));
        let n = M.count;
        let rates = reaction_null_space(&s.robot, &M, &s.xi);
        let rates = DVector::from_column_slice(&rates[..n]);
        let free = dense_columns(&generalized_jacobian(&J_frame, &M).columns()[..n]) * &rates;
        let held = attitude_held_jacobian(&J_frame, &M, &s.state.X_NB.rotation);
        gap(&free, &(dense_columns(&held.columns()[..n]) * &rates))
    });
}

/// A planar arm of four joints on a base whose own axes are turned against the plane.
fn planar_robot(seed: u64, tilt: Quat<f64>) -> (Robot<f64, JOINTS>, State<f64, JOINTS>) {
    let mut r = Random(seed);
    let mut flat = |size: f64| {
        let m = r.between(1.0, 20.0);
        let I = vec3(r.between(0.1, 1.0), r.between(0.1, 1.0), r.between(0.1, 1.0)) * m;
        let p = vec3(r.within(size), r.within(size), 0.0);
        (MassProperties::from_central(m, p, Sym3::diagonal(I.x, I.y, I.z)), p)
    };
    // P: axes of the plane; the base's own are B, turned against them.
    let X_BP = Pose::from_quat(tilt, Vec3::zero());
    let base = flat(0.5).0.seen_from(&X_BP);
    let mut links = vec![];
    for j in 0..4_usize {
        let (matter, p) = flat(0.5);
        let at = Pose { translation: p, ..Pose::identity() };
        let (parent, X_PB) = match j.checked_sub(1) {
            None => (BodyId::Base, X_BP * at),
            Some(before) => (BodyId::Link(before), at),
        };
        links.push((Joint::new(parent, JointKind::Revolute, X_PB, vec3(0.0, 0.0, 1.0)), matter));
    }
    let q = array::from_fn(|j| if j < 4 { r.within(2.5) } else { 0.0 });
    (Robot::new(base, &links).unwrap(), State { q, ..State::default() })
}

/// The plane's normal becomes (0.6 ε, -0.6, 0.8) in base axes: one row of H_w is small, and mostly
/// round-off, but not zero.
fn nearly_across_x(small: f64) -> Quat<f64> {
    let across = 0.6_f64.asin();
    Quat::exp(vec3(0.0, 0.0, small)) * Quat::exp(vec3(across, 0.0, 0.0))
}

/// A planar arm can turn the base about one axis only: three of four directions are left, however
/// the base's axes lie against the plane. Measured 9e-16.
#[test]
fn a_planar_arm_keeps_all_but_one_direction() {
    let tilts = [0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 0.3, 1.0];
    let mut worst = 0.0_f64;
    for seed in 0..50 {
        for size in tilts {
            let tilt = nearly_across_x(size);
            let (robot, state) = planar_robot(seed, tilt);
            let M = mass_matrix(&kinematics(&robot, &state));
            let found = dimension(&robot, &M);
            worst = larger(worst, (found - 3.0).abs());
            assert!((found - 3.0).abs() < 1e-12, "seed {seed}, tilt {size:e}: {found}");
        }
    }
    println!("planar dimension: worst {worst:.1e}");
}

/// The same with the flight computer's scalar. Measured 2e-7.
#[test]
fn a_planar_arm_keeps_all_but_one_direction_in_single_precision() {
    let mut worst = 0.0;
    for seed in 0..50 {
        for size in [0.0, 1e-6, 1e-4, 1e-3, 0.3, 1.0] {
            let tilt = nearly_across_x(size);
            let (robot, state) = planar_robot(seed, tilt);
            let robot = robot.cast::<f32>();
            let state = State { q: state.q.map(f32::from_f64), ..State::<f32, JOINTS>::default() };
            let M = mass_matrix(&kinematics(&robot, &state));
            let found = f64::from((0..4).fold(0.0, |sum, j| {
                let unit = array::from_fn(|i| f32::from(u8::from(i == j)));
                sum + reaction_null_space(&robot, &M, &unit)[j]
            }));
            worst = larger(worst, (found - 3.0).abs());
            assert!((found - 3.0).abs() < 1e-4, "seed {seed}, tilt {size:e}: {found}");
        }
    }
    println!("planar dimension, single precision: worst {worst:.1e}");
}

/// An arm that cannot turn the base at all leaves every rate as it is: one sliding joint through
/// the common centre of mass. Measured 0.
#[test]
fn an_arm_that_cannot_turn_the_base_is_free_in_every_rate() {
    let ball = MassProperties::from_central(10.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let axis = vec3(0.0, 0.0, 1.0);
    let joint = Joint::new(BodyId::Base, JointKind::Prismatic, Pose::identity(), axis);
    let robot = Robot::<f64, JOINTS>::new(ball, &[(joint, ball)]).unwrap();
    let state = State { q: array::from_fn(|_| 0.3), ..State::default() };
    let M = mass_matrix(&kinematics(&robot, &state));
    let xi = array::from_fn(|j| if j == 0 { 0.7 } else { 0.0 });
    assert_eq!(reaction_null_space(&robot, &M, &xi), xi);
}

/// Strategies must not be empty by accident.
#[test]
fn the_generator_makes_every_kind_of_tree() {
    let mut runner = TestRunner::deterministic();
    let mut seen = [false; 4];
    for _ in 0..200 {
        let recipe = any_robot().new_tree(&mut runner).unwrap().current();
        let robot = Scene::new(&recipe).robot;
        let parents = || robot.joints().map(|j| robot.joint(j).parent);
        let on_base = parents().filter(|p| *p == BodyId::Base).count();
        seen[0] |= on_base == 3;
        seen[1] |= robot.joint_count() == JOINTS;
        seen[2] |= robot.joints().any(|j| robot.joint(j).kind == JointKind::Prismatic);
        seen[3] |= robot.joints().any(|j| parents().filter(|p| *p == BodyId::Link(j)).count() > 1);
    }
    assert_eq!(seen, [true; 4], "three arms, twelve joints, sliding joints, branches");
}

//! Arms of 15 m with light tips: what is small at the end of something long must not be lost.
#![allow(clippy::unwrap_used, reason = "a test that unwraps nothing fails")]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod reference;

use wrasse_dynamics::{
    BodyId, Generalized, Joint, JointKind, MassProperties, Outside, Robot, State, forward_dynamics,
    inverse_dynamics, kinematics,
};
use wrasse_spatial::{Pose, SpatialForce, Sym3, Vec3, vec3};
use wrasse_testing::largest;
use wrasse_testing::random_robot::{JOINTS, Random, Recipe, Scene};

const J: usize = 32;

/// An arm of 15 m on a base whose origin is 2 m off its centre of mass; links taper to a tip of 0.1 kg.
fn long_arm(links: u32, random: &mut Random) -> Robot<f64, J> {
    let length = 15.0 / f64::from(links);
    let base = MassProperties::from_central(
        2000.0,
        vec3(2.0, -1.0, 0.5),
        Sym3::diagonal(900.0, 1100.0, 800.0),
    );
    let link = |i: u32| {
        let parent = i.checked_sub(1).map_or(BodyId::Base, |p| BodyId::Link(p as usize));
        let X = Pose::new(random.pose(0.0).rotation, vec3(length, 0.05, -0.02));
        let slides = i % 5 == 3;
        let kind = if slides { JointKind::Prismatic } else { JointKind::Revolute };
        let mass = if i + 1 == links { 0.1 } else { 60.0 / f64::from(i + 1) };
        let I = Sym3::diagonal(0.01, 0.3 * length * length, 0.3 * length * length).scaled(mass);
        let body = MassProperties::from_central(mass, vec3(0.5 * length, 0.01, 0.0), I);
        (Joint::new(parent, kind, X, random.vector(1.0)), body)
    };
    Robot::new(base, &(0..links).map(link).collect::<Vec<_>>()).expect("the joints fit")
}

/// Each motor torque by itself, against the largest in the chain, in 200 states. Rounding of up to 30
/// links on the way: measured 2.9e-15 with 7 links, 1.1e-14 with 30.
#[test]
fn each_motor_of_a_long_arm_is_told_its_torque() {
    for links in [7, 30] {
        let mut random = Random(15);
        let robot = long_arm(links, &mut random);
        for _ in 0..200 {
            let mut joints = |size: f64| std::array::from_fn(|_| random.within(size));
            let (q, v, qddot) = (joints(2.0), joints(0.3), joints(0.5));
            let state = State { X_NB: random.pose(3.0), V_NB_B: random.twist(0.1), q, v };
            let nudot = Generalized { base: random.twist(0.1), joints: qddot };
            let k = kinematics(&robot, &state);
            let found = inverse_dynamics(&k, &nudot, Outside::nothing()).force.joints;
            let expected = reference::inverse_dynamics(&robot, &state, &nudot);
            let scale = largest(expected.iter().map(|tau| tau.abs()));
            for j in robot.joints() {
                let off = (found[j] - expected[j]).abs() / scale;
                assert!(off < 1e-12, "{links} links, joint {j}: {off:e}");
            }
        }
    }
}

/// What forces do to a long arm, undone: forces of the accelerations that they cause. The mass matrix of
/// a long arm is badly conditioned, but the forces that come back are not: measured 6e-15 and 7e-13 of
/// the largest.
#[test]
fn forces_of_the_accelerations_that_forces_cause_are_those_forces() {
    for (links, bound) in [(7, 1e-13), (30, 1e-11)] {
        let mut random = Random(7);
        let robot = long_arm(links, &mut random);
        for _ in 0..50 {
            let mut joints = |size: f64| std::array::from_fn(|_| random.within(size));
            let (q, v, tau) = (joints(2.0), joints(0.1), joints(20.0));
            let state = State { q, v, ..State::default() };
            let k = kinematics(&robot, &state);
            let base = SpatialForce::new(Vec3::zero(), vec3(1.0, 2.0, 3.0));
            let force = Generalized { base, joints: tau };
            let nudot = forward_dynamics(&k, &force, Outside::nothing());
            let back = inverse_dynamics(&k, &nudot, Outside::nothing()).force.joints;
            for j in robot.joints() {
                let off = (back[j] - tau[j]).abs() / 20.0;
                assert!(off < bound, "{links} links, joint {j}: {off:e}");
            }
        }
    }
}

/// The textbook's recursion on random trees, forks and sliding joints among them. Measured 2e-14.
#[test]
fn rows_and_the_textbook_agree_on_random_trees() {
    for seed in 0..200 {
        let joints = 1 + usize::try_from(seed).unwrap() % JOINTS;
        let recipe = Recipe { seed, joints, arms: 1 + joints / 5, sliding: 0.3, branching: 0.3 };
        let s = Scene::new(&recipe);
        let found = inverse_dynamics(&kinematics(&s.robot, &s.state), &s.nudot, Outside::nothing());
        let expected = reference::inverse_dynamics(&s.robot, &s.state, &s.nudot);
        let scale = largest(expected.iter().map(|tau| tau.abs()));
        for j in s.robot.joints() {
            let off = (found.force.joints[j] - expected[j]).abs() / scale;
            assert!(off < 1e-12, "seed {seed}, joint {j}: {off:e}");
        }
    }
}

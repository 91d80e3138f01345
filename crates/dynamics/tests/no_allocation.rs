//! The real-time claim: no kernel touches the heap.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use std::hint::black_box;
use wrasse_dynamics::{
    BaseMode, BodyId, Cholesky, Generalized, Joint, JointDrive, JointKind, PerBody, Robot, State,
    angular_momentum_per_rate, attitude_held_dynamics, attitude_held_jacobian, attitude_torque,
    barycentric_vectors, base_twist, bias_acceleration, bias_force, driven_dynamics,
    forward_dynamics, free_floating_dynamics, generalized_jacobian, inverse_dynamics, jacobian,
    kinematics, kinetic_energy, mass_matrix, momentum, momentum_matrix, mount_reaction,
    printed_reaction, reaction_null_space, velocity_from_momentum, virtual_manipulator,
};
use wrasse_spatial::SpatialForce;
use wrasse_testing::random_robot::{JOINTS, Random, Recipe, Scene};
use wrasse_testing::{Counting, allocations};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn scene() -> Scene {
    Scene::new(&Recipe { seed: 7, joints: 9, arms: 2, sliding: 0.25, branching: 0.3 })
}

#[test]
fn the_counter_sees_an_allocation() {
    assert_eq!(allocations(|| drop(black_box(Box::new(1)))), 2, "one box made, one dropped");
}

#[test]
fn building_and_loading_a_robot_allocates_nothing() {
    let s = scene();
    let mut random = Random(3);
    let joint = Joint::new(BodyId::Base, JointKind::Revolute, random.pose(1.0), random.vector(1.0));
    let links = [(joint, random.matter(5.0, 0.5))];
    let calls = allocations(|| {
        let robot = Robot::<f64, JOINTS>::new(s.load, &links).unwrap();
        black_box(robot.with_payload(&s.frame, &s.load).cast::<f32>().mass());
        black_box(s.robot.bodies().filter_map(|body| s.robot.chain_root(body)).sum::<usize>());
        black_box(State::<f64, JOINTS>::default().velocity());
    });
    assert_eq!(calls, 0);
}

#[test]
fn motion_allocates_nothing() {
    let s = scene();
    let calls = allocations(|| {
        let k = kinematics(&s.robot, &s.state);
        black_box(s.X_elsewhere * k.pose(&s.frame));
        black_box((k.velocity(&s.frame), k.centre_of_mass(), k.joint_origin(2)));
        let (J_frame, M) = (jacobian(&k, &s.frame), mass_matrix(&k));
        black_box((J_frame.times(&s.nudot), bias_acceleration(&k, &s.frame)));
        let R_NB = &s.state.X_NB.rotation;
        black_box(generalized_jacobian(&J_frame, &M));
        black_box(velocity_from_momentum(&J_frame, &M, &s.external.base));
        black_box(attitude_held_jacobian(&J_frame, &M, R_NB));
        black_box((momentum(&k), kinetic_energy(&k), momentum_matrix(&M, R_NB)));
        black_box(base_twist(&M, &s.external.base, &s.xi));
        black_box((M.momentum_of_rates(&s.xi), M.element(3, 7)));
        black_box((angular_momentum_per_rate(&M), reaction_null_space(&s.robot, &M, &s.xi)));
        let lambda = barycentric_vectors(&k, &s.frame);
        black_box(virtual_manipulator(&k, &lambda, k.centre_of_mass().1));
    });
    assert_eq!(calls, 0);
}

#[test]
fn forces_allocate_nothing() {
    let s = scene();
    let calls = allocations(|| {
        let k = kinematics(&s.robot, &s.state);
        let dynamics = inverse_dynamics(&k, &s.nudot, &s.external);
        black_box((attitude_torque(&k, &dynamics), mount_reaction(&k, &dynamics, 0)));
        black_box(printed_reaction(&k, &s.nudot, 0));
        let (M, c) = (mass_matrix(&k), bias_force(&k));
        let free = free_floating_dynamics(&s.robot, &M, &c);
        black_box(free.effort(&s.robot, &s.xi));
        black_box(attitude_held_dynamics(&s.robot, &M, &c));
        let factor = Cholesky::new(&free.H, s.robot.joint_count());
        black_box((factor.solve(&s.xi), factor.smallest_pivot()));
        let force = Generalized { base: SpatialForce::zero(), joints: s.xi };
        black_box(forward_dynamics(&k, &force, &PerBody::filled(SpatialForce::zero())));
        let drives = std::array::from_fn(|j| {
            if s.follows[j] {
                JointDrive::Acceleration(s.xi[j])
            } else {
                JointDrive::Effort(s.xi[j])
            }
        });
        for mode in [BaseMode::Free, BaseMode::AttitudeHeld] {
            black_box(driven_dynamics(&k, &drives, mode, &s.external));
        }
    });
    assert_eq!(calls, 0);
}

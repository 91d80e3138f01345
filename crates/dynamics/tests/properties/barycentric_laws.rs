//! Barycentric vectors and the virtual manipulator: eqs (6) and (7), and their tree form.

use crate::in_time::{Rate, in_time};
use crate::measure::{any_robot, for_every, for_every_robot};
use proptest::prelude::Strategy;
use wrasse_dynamics::{
    BodyId, Frame, JointKind, Kinematics, attitude_held_jacobian, barycentric_vectors, jacobian,
    kinematics, mass_matrix, virtual_manipulator,
};
use wrasse_spatial::{At, Dual, Pose, Vec3};
use wrasse_testing::random_robot::{JOINTS, Recipe};
use wrasse_testing::{gap_at, largest, size};

/// Trees whose joints only turn.
fn turning() -> impl Strategy<Value = Recipe> {
    any_robot().prop_map(|recipe| Recipe { sliding: 0.0, ..recipe })
}

/// One arm without branches, whose joints only turn: the paper's case.
fn serial() -> impl Strategy<Value = Recipe> {
    turning().prop_map(|recipe| Recipe { arms: 1, branching: 0.0, ..recipe })
}

/// Eq. (6), tree form, whatever the base does. Measured 3e-15.
#[test]
fn the_virtual_manipulator_reaches_from_the_centre_of_mass_to_the_frame() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let lambda = barycentric_vectors(&k, &s.frame);
        let reached = virtual_manipulator(&k, &lambda, k.centre_of_mass().1);
        gap_at(&reached, &k.pose(&s.frame).translation, 1.0)
    });
}

/// Eqs (6) and (7) as the paper writes them, `R0` put before `s0`, the payload a body of its own.
/// Measured 2e-15.
#[test]
fn a_serial_arm_with_payload_obeys_equations_6_and_7() {
    for_every(serial(), 1e-13, |s| {
        let n = s.robot.joint_count();
        let loaded = s.robot.with_payload(&s.frame, &s.load);
        let k = kinematics(&loaded, &s.state);
        let per_mass = 1.0 / loaded.mass();
        let base = s.robot.inertia(BodyId::Base);
        let s_0 = s.robot.joint(0).X_PB_zero.translation - base.centre_of_mass();
        let mut p = k.centre_of_mass().1 + s.state.X_NB.rotation * s_0 * (base.mass * per_mass);
        let mut carried = base.mass;
        for i in 0..n {
            let M = s.robot.inertia(BodyId::Link(i));
            carried += M.mass;
            let last = i + 1 == n;
            let l_i = if last { s.frame.X_BF } else { s.robot.joint(i + 1).X_PB_zero }.translation;
            let lambda = (l_i * carried - M.centre_of_mass() * M.mass) * per_mass;
            p += k.X_NB(BodyId::Link(i)).rotation * lambda;
        }
        let R_NPayload = k.pose(&s.frame).rotation;
        p += -(R_NPayload * s.load.M_F_F.first_moment * per_mass);
        gap_at(&p, &k.pose(&s.frame).translation, 1.0)
    });
}

/// The payload's term of eq. (6) is part of the last link's vector once they are one body.
/// Measured 1e-16.
#[test]
fn merging_the_payload_adds_its_term_to_the_last_vector() {
    for_every(serial(), 1e-14, |s| {
        let n = s.robot.joint_count();
        let loaded = s.robot.with_payload(&s.frame, &s.load);
        let k = kinematics(&loaded, &s.state);
        let last = barycentric_vectors(&k, &s.frame).links[n - 1];
        let per_mass = 1.0 / loaded.mass();
        let M = s.robot.inertia(BodyId::Link(n - 1));
        let l_n = s.frame.X_BF.translation;
        let before = s.robot.mass();
        let paper = (l_n * before - M.first_moment) * per_mass;
        let term = s.frame.X_BF.rotation * s.load.M_F_F.first_moment * -per_mass;
        gap_at(&last, &(paper + term), 1.0)
    });
}

/// λ of a tree whose joints turn are constants of the robot: their exact rates are zero.
/// Measured 0.
#[test]
fn the_vectors_do_not_change_while_joints_turn() {
    for_every(turning(), 0.0, |s| {
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let frame = Frame { body: s.frame.body, X_BF: Pose::from_f64(&s.frame.X_BF) };
        let lambda = barycentric_vectors(&kinematics(&robot, &moving), &frame);
        largest(s.robot.bodies().map(|body| size(&lambda[body].rate())))
    });
}

/// A sliding joint's travel belongs to its parent's vector, weighed by what it carries, and by
/// whether the frame is behind it. Measured 2e-16.
#[test]
fn travel_of_a_sliding_joint_changes_its_parents_vector_only() {
    for_every_robot(1e-14, |s| {
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let frame = Frame { body: s.frame.body, X_BF: Pose::from_f64(&s.frame.X_BF) };
        let lambda = barycentric_vectors(&kinematics(&robot, &moving), &frame);
        let behind = |b: BodyId, j: usize| s.robot.path_to_base(b).any(|at| at == j);
        largest(s.robot.bodies().map(|body| {
            let mut expected = Vec3::zero();
            for j in s.robot.joints() {
                let joint = s.robot.joint(j);
                if joint.parent != body || joint.kind != JointKind::Prismatic {
                    continue;
                }
                let carried = s.robot.bodies().filter(|b| behind(*b, j));
                let mass = carried.fold(0.0, |m, b| m + s.robot.inertia(b).mass);
                let way = if behind(s.frame.body, j) { 1.0 } else { 0.0 };
                let along = joint.X_PB_zero.rotation * joint.axis_B * s.state.v[j];
                expected += along * (way - mass / s.robot.mass());
            }
            gap_at(&lambda[body].rate(), &expected, 1.0)
        }))
    });
}

/// `J̄_v` column k is `z_k × Σ R_i λ_i` over the bodies behind joint k, on the way or off it.
/// Measured 1e-15.
#[test]
fn the_attitude_held_jacobian_turns_the_vectors_behind_each_joint() {
    for_every(turning(), 1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let lambda = barycentric_vectors(&k, &s.frame);
        let held = attitude_held_jacobian(
            &jacobian(&k, &s.frame),
            &mass_matrix(&k),
            &s.state.X_NB.rotation,
        );
        largest(s.robot.joints().map(|j| {
            let z = k.X_NB(BodyId::Link(j)).rotation * s.robot.joint(j).axis_B;
            let behind = s.robot.bodies().filter(|b| s.robot.path_to_base(*b).any(|at| at == j));
            let arm = behind.fold(Vec3::zero(), |sum, b| sum + k.X_NB(b).rotation * lambda[b]);
            gap_at(&held.linear.at(j), &z.cross(arm), 1.0)
        }))
    });
}

/// The path of the base is not in eq. (6): with the attitude held, the tip depends on the joints
/// alone. Measured 3e-15.
#[test]
fn moving_the_base_without_turning_it_moves_frame_and_centre_of_mass_alike() {
    for_every_robot(1e-13, |s| {
        let mut pushed = s.state;
        pushed.X_NB.translation = s.X_elsewhere.translation;
        let (here, there) = (kinematics(&s.robot, &s.state), kinematics(&s.robot, &pushed));
        let lambda = barycentric_vectors(&here, &s.frame);
        assert_eq!(lambda, barycentric_vectors(&there, &s.frame));
        let from_cm =
            |k: &Kinematics<f64, JOINTS>| k.pose(&s.frame).translation - k.centre_of_mass().1;
        gap_at(&from_cm(&here), &from_cm(&there), 1.0)
    });
}

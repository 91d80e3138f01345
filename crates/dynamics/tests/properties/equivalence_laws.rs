//! The same robot told differently: with a load, with an empty link, in single precision, again.

use crate::measure::{any_robot, dense, dense_vector, for_every, for_every_robot};
use proptest::prelude::Strategy;
use std::array;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, Joint, JointKind, MassProperties, PerBody, Robot, State,
    attitude_held_jacobian, barycentric_vectors, bias_acceleration, bias_force, forward_dynamics,
    free_floating_dynamics, generalized_jacobian, inverse_dynamics, jacobian, kinematics,
    kinetic_energy, mass_matrix, momentum, printed_reaction,
};
use wrasse_spatial::{Pose, Scalar, SpatialForce, SpatialVelocity, Vec3};
use wrasse_testing::random_robot::{JOINTS, Recipe, Scene};
use wrasse_testing::{Numbers, gap, gap_at, larger, largest, size};

fn nothing() -> PerBody<SpatialForce<f64>, JOINTS> {
    PerBody::filled(SpatialForce::zero())
}

/// The load as a rigid body of its own, riding with the frame: its momentum, energy, and the force
/// that its motion takes add to those of the robot. Measured 2e-15.
#[test]
fn a_load_adds_what_a_rigid_body_of_its_own_would() {
    for_every_robot(1e-13, |s| {
        let loaded = s.robot.with_payload(&s.frame, &s.load);
        let (k, k_loaded) = (kinematics(&s.robot, &s.state), kinematics(&loaded, &s.state));
        // Alone: a robot that is nothing but the load, moving as the frame does.
        let alone = Robot::<f64, JOINTS>::new(s.load, &[]).unwrap();
        let X_NF = k.pose(&s.frame);
        let (V, A) = (k.velocity(&s.frame), frame_acceleration(s));
        let to_F = |x: Vec3<f64>| X_NF.rotation.transpose_mul(x);
        let V_NF_F = SpatialVelocity::new(to_F(V.angular), to_F(V.linear));
        let state = State { X_NB: X_NF, V_NB_B: V_NF_F, ..State::default() };
        let k_alone = kinematics(&alone, &state);

        let energy = kinetic_energy(&k) + kinetic_energy(&k_alone);
        let (h, h_alone, h_loaded) = (momentum(&k), momentum(&k_alone), momentum(&k_loaded));
        let nudot = Generalized { base: A, joints: [0.0; JOINTS] };
        let F_F = inverse_dynamics(&k_alone, &nudot, &nothing()).force.base;
        let mut carried = nothing();
        carried[s.frame.body] = -s.frame.X_BF.force_to_parent(&F_F);
        let sum = inverse_dynamics(&k, &s.nudot, &carried).force;
        let whole = inverse_dynamics(&k_loaded, &s.nudot, &nothing()).force;
        largest([
            gap(&kinetic_energy(&k_loaded), &energy),
            gap(&h_loaded.linear, &(h.linear + h_alone.linear)),
            gap(&whole, &sum),
            gap(&loaded.mass(), &(s.robot.mass() + s.load.M_F_F.mass)),
        ])
    });
}

/// Spatial acceleration of the scene's frame in its own axes: the rate of its components.
fn frame_acceleration(s: &Scene) -> SpatialVelocity<f64> {
    let k = kinematics(&s.robot, &s.state);
    let V = k.velocity(&s.frame);
    let classical = jacobian(&k, &s.frame).times(&s.nudot) + bias_acceleration(&k, &s.frame);
    // From the classical acceleration to Featherstone's: less w × v, then to the frame's axes.
    let R_NF = k.pose(&s.frame).rotation;
    SpatialVelocity::new(
        R_NF.transpose_mul(classical.angular),
        R_NF.transpose_mul(classical.linear - V.angular.cross(V.linear)),
    )
}

/// Two loads one after the other are their sum; taking one off again restores the robot.
/// Measured 2e-16.
#[test]
fn putting_a_load_down_restores_the_robot() {
    for_every_robot(1e-14, |s| {
        let mut less = s.load;
        less.M_F_F.mass = -less.M_F_F.mass;
        less.M_F_F.first_moment = -less.M_F_F.first_moment;
        less.M_F_F.rotational = less.M_F_F.rotational.scaled(-1.0);
        less.I_parts_F = less.I_parts_F.scaled(-1.0);
        let back = s.robot.with_payload(&s.frame, &s.load).with_payload(&s.frame, &less);
        let mass = |robot| dense(&mass_matrix(&kinematics(robot, &s.state)));
        let loaded = s.robot.with_payload(&s.frame, &s.load);
        gap_at(&mass(&back), &mass(&s.robot), size(&mass(&loaded)))
    });
}

/// The robot with one joint more at the last tip, whose link has no mass.
fn with_empty_link(s: &Scene) -> Robot<f64, JOINTS> {
    let matter = |body| {
        let M = s.robot.inertia(body);
        MassProperties::from_central(M.mass, M.centre_of_mass(), M.central())
    };
    let mut links: Vec<_> =
        s.robot.joints().map(|j| (*s.robot.joint(j), matter(BodyId::Link(j)))).collect();
    let axis = s.X_elsewhere.translation;
    let joint = Joint::new(s.frame.body, JointKind::Revolute, s.frame.X_BF, axis);
    links.push((joint, MassProperties::default()));
    Robot::new(matter(BodyId::Base), &links).unwrap()
}

/// A link without mass takes no force and changes nothing for the others, whatever it does.
/// Measured 4e-16.
#[test]
fn a_link_without_mass_changes_nothing() {
    let room = any_robot().prop_map(|r| Recipe { joints: r.joints.min(JOINTS - 1), ..r });
    for_every(room, 1e-14, |s| {
        let n = s.robot.joint_count();
        let empty = with_empty_link(s);
        let (mut state, mut nudot) = (s.state, s.nudot);
        (state.q[n], state.v[n], nudot.joints[n]) = (0.7, -0.4, 1.3);
        let (k, k_empty) = (kinematics(&s.robot, &s.state), kinematics(&empty, &state));
        let mut external = s.external;
        external.links[n] = SpatialForce::zero();
        let force = inverse_dynamics(&k, &s.nudot, &s.external).force;
        let with = inverse_dynamics(&k_empty, &nudot, &external).force;
        assert_eq!(with.joints[n], 0.0, "nothing to move");
        let M = dense(&mass_matrix(&k));
        let M_with = dense(&mass_matrix(&k_empty)).view((0, 0), M.shape()).into_owned();
        largest([
            gap(&with.base, &force.base),
            gap_at(&with.joints, &force.joints, size(&force)),
            gap(&M_with, &M),
            gap_at(&k_empty.centre_of_mass().1, &k.centre_of_mass().1, 1.0),
        ])
    });
}

/// Everything that the kernels find for one scene, as plain numbers; the forward dynamics last.
fn everything<T: Scalar>(s: &Scene) -> Vec<Vec<f64>> {
    let cast = T::from_f64;
    let robot = s.robot.cast::<T>();
    let twist = |V: SpatialVelocity<f64>| SpatialVelocity::from_array(V.to_array().map(cast));
    let state: State<T, JOINTS> = State {
        X_NB: Pose::from_f64(&s.state.X_NB),
        V_NB_B: twist(s.state.V_NB_B),
        q: s.state.q.map(cast),
        v: s.state.v.map(cast),
    };
    let frame = Frame { body: s.frame.body, X_BF: Pose::from_f64(&s.frame.X_BF) };
    let nudot = Generalized { base: twist(s.nudot.base), joints: s.nudot.joints.map(cast) };
    let none = PerBody::filled(SpatialForce::zero());
    let (k, n) = (kinematics(&robot, &state), robot.joint_count());
    let (M, J_frame, c) = (mass_matrix(&k), jacobian(&k, &frame), bias_force(&k));
    let plain = |x: &[T]| x.iter().map(|x| x.to_f64()).collect::<Vec<_>>();
    let columns = |J: [SpatialVelocity<T>; JOINTS]| {
        J[..n].iter().flat_map(|c| plain(&c.to_array())).collect::<Vec<_>>()
    };
    let force = inverse_dynamics(&k, &nudot, &none).force;
    let forward = forward_dynamics(&k, &force, &none);
    let printed = printed_reaction(&k, &nudot, s.robot.chain_root(frame.body).unwrap());
    let (h, size) = (momentum(&k), 6 + n);
    let elements = (0..size * size).map(|e| M.element(e / size, e % size).to_f64());
    let reduced = free_floating_dynamics(&robot, &M, &c);
    vec![
        elements.collect(),
        [plain(&c.base.to_array()), plain(&c.joints)].concat(),
        [plain(&force.base.to_array()), plain(&force.joints)].concat(),
        plain(&h.angular.to_array()),
        plain(&h.linear.to_array()),
        vec![kinetic_energy(&k).to_f64()],
        columns(generalized_jacobian(&J_frame, &M).columns()),
        columns(attitude_held_jacobian(&J_frame, &M, &state.X_NB.rotation).columns()),
        plain(&barycentric_vectors(&k, &frame).links.map(Vec3::to_array)[n - 1]),
        plain(&printed.N_r_arm_cm.to_array()),
        reduced.H.iter().flat_map(|row| plain(row)).collect(),
        [plain(&forward.base.to_array()), plain(&forward.joints)].concat(),
    ]
}

/// Single precision has a round-off of 1.2e-7; sums over 12 bodies and one inverse of the locked
/// inertia cost up to two digits of it. Measured 2e-5.
#[test]
fn single_precision_agrees_to_single_precision() {
    for_every_robot(1e-4, |s| {
        let (double, single) = (everything::<f64>(s), everything::<f32>(s));
        assert!(double.iter().zip(&single).any(|(a, b)| a != b), "it is another scalar");
        let sums = double.len() - 1;
        largest(double[..sums].iter().zip(&single).map(|(a, b)| gap(a, b)))
    });
}

/// The forward dynamics lose digits by the condition of M, up to 4e4. Measured 1e-4.
#[test]
fn single_precision_moves_as_double_does_within_the_condition_of_the_mass_matrix() {
    for_every_robot(1e-3, |s| {
        let (double, single) = (everything::<f64>(s), everything::<f32>(s));
        gap(&double[double.len() - 1], &single[single.len() - 1])
    });
}

/// Measured 0: no state is kept between calls.
#[test]
fn the_second_call_equals_the_first_bit_for_bit() {
    for_every_robot(0.0, |s| {
        let bits =
            |all: Vec<Vec<f64>>| all.concat().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        f64::from(bits(everything::<f64>(s)) != bits(everything::<f64>(s)))
    });
}

/// A robot without joints is a rigid body: Euler's equations in base axes. Measured 5e-16.
#[test]
fn a_robot_without_joints_obeys_eulers_equations() {
    for_every_robot(1e-14, |s| {
        let robot = Robot::<f64, JOINTS>::new(s.load, &[]).unwrap();
        let k = kinematics(&robot, &s.state);
        let M = s.load.M_F_F;
        let (w, v) = (s.state.V_NB_B.angular, s.state.V_NB_B.linear);
        let (wdot, vdot) = (s.nudot.base.angular, s.nudot.base.linear);
        let (p, I) = (M.centre_of_mass(), M.central());
        // Classical acceleration of the centre of mass, in base axes.
        let a = vdot + w.cross(v) + wdot.cross(p) + w.cross(w.cross(p));
        let force = a * M.mass;
        let torque = I * wdot + w.cross(I * w) + p.cross(force);
        let found = inverse_dynamics(&k, &s.nudot, &nothing()).force;
        let numbers = dense_vector(&robot, &found).numbers();
        larger(
            gap(&numbers, &SpatialForce::new(torque, force).numbers()),
            f64::from(found.joints != array::from_fn(|_| 0.0)),
        )
    });
}

//! Operational inertia against forward dynamics of a push, by a route that forms no factors' columns.

use crate::measure::for_every_robot;
use std::array;
use wrasse_dynamics::{
    BaseMode, BodyId, Configuration, Factorization, Frame, JointDrive, PerBody, State,
    driven_dynamics, factorize, inverse_operational_inertia, jacobian, kinematics,
    operational_inertia,
};
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, larger};

type Matrix = [[f64; 6]; 6];

/// The scene at rest: what happens is the push alone.
fn at_rest(s: &Scene) -> State<f64, JOINTS> {
    State { V_NB_B: SpatialVelocity::zero(), v: [0.0; JOINTS], ..s.state }
}

/// Another frame, on the base.
fn mount(s: &Scene) -> Frame<f64> {
    Frame { body: BodyId::Base, X_BF: s.X_elsewhere }
}

fn origin(body: BodyId) -> Frame<f64> {
    Frame { body, X_BF: Pose::identity() }
}

fn free(s: &Scene) -> [f64; JOINTS] {
    array::from_fn(|j| if s.follows[j] { 0.0 } else { 1.0 })
}

fn factors(s: &Scene) -> Factorization<f64, JOINTS> {
    let mut M = Factorization::new();
    factorize(&s.robot, &Configuration::at(&s.robot, &s.state.q), &free(s), &mut M);
    M
}

fn times(M: &Matrix, x: &[f64; 6]) -> [f64; 6] {
    M.map(|row| (0..6).map(|c| row[c] * x[c]).sum())
}

/// How frame A accelerates when frame B is pushed by `F_N`, by forward dynamics; some joints held.
fn pushed(s: &Scene, A: &Frame<f64>, B: &Frame<f64>, F_N: &SpatialForce<f64>) -> [f64; 6] {
    let state = at_rest(s);
    let k = kinematics(&s.robot, &state);
    // The wrench at the body's origin, in the body's axes.
    let (X_NB, X_NE) = (k.pose(&origin(B.body)), k.pose(B));
    let F = F_N.about(X_NB.translation - X_NE.translation);
    let mut outside = PerBody::filled(SpatialForce::zero());
    let R = X_NB.rotation;
    outside[B.body] = SpatialForce::new(R.transpose_mul(F.torque), R.transpose_mul(F.force));
    let drives = array::from_fn(|j| {
        if s.follows[j] { JointDrive::Acceleration(0.0) } else { JointDrive::Effort(0.0) }
    });
    let nudot = driven_dynamics(&k, &drives, BaseMode::Free, &outside).nudot;
    jacobian(&k, A).times(&nudot).to_array()
}

fn push(s: &Scene) -> SpatialForce<f64> {
    let V = s.nudot.base;
    SpatialForce::new(V.angular * 3.0, V.linear * 5.0)
}

/// Frames on different bodies, some joints held. Round-off times the condition of M. Measured 7.4e-15.
#[test]
fn a_push_on_one_frame_accelerates_another_as_forward_dynamics_says() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let [A, B] = [s.frame, mount(s)].map(|frame| (frame, jacobian(&k, &frame)));
        let M = factors(s);
        let mut worst = 0.0_f64;
        for (to, at) in [(A, A), (A, B), (B, A), (B, B)] {
            let per_push = inverse_operational_inertia(&s.robot, &M, &to.1, &at.1);
            let found = times(&per_push, &push(s).to_array());
            worst = larger(worst, gap(&found, &pushed(s, &to.0, &at.0, &push(s))));
        }
        worst
    });
}

/// Reciprocity: what a push on B does at A, a push on A does at B. Measured 1.9e-15.
#[test]
fn frames_answer_each_other_alike() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let (A, B) = (jacobian(&k, &s.frame), jacobian(&k, &mount(s)));
        let M = factors(s);
        let there = inverse_operational_inertia(&s.robot, &M, &A, &B);
        let back = inverse_operational_inertia(&s.robot, &M, &B, &A);
        let back: Matrix = array::from_fn(|r| array::from_fn(|c| back[c][r]));
        gap(&there, &back)
    });
}

/// The wrench that the operational inertia says accelerates the frame as it was to. Measured 6.1e-12: the
/// conditions of M and of `J M⁻¹ Jᵀ`.
#[test]
fn the_wrench_of_an_acceleration_gives_it() {
    for_every_robot(1e-10, |s| {
        let k = kinematics(&s.robot, &s.state);
        let J_frame = jacobian(&k, &s.frame);
        let wanted = s.nudot.base.to_array();
        let F = times(&operational_inertia(&s.robot, &factors(s), &J_frame), &wanted);
        gap(&pushed(s, &s.frame, &s.frame, &SpatialForce::from_array(F)), &wanted)
    });
}

/// With all joints held the vehicle is one body, and the inertia at a frame on its base is that body's.
/// Measured 2.6e-15.
#[test]
fn a_vehicle_whose_joints_are_held_resists_as_one_body() {
    for_every_robot(1e-13, |s| {
        let configuration = Configuration::at(&s.robot, &s.state.q);
        let mut M = Factorization::new();
        factorize(&s.robot, &configuration, &[0.0; JOINTS], &mut M);
        let k = kinematics(&s.robot, &s.state);
        let J_frame = jacobian(&k, &origin(BodyId::Base));
        let found = operational_inertia(&s.robot, &M, &J_frame);
        let body = configuration.base.M_bb;
        let columns: Matrix = array::from_fn(|c| {
            // Twist per axis of N, momentum of the body, back to axes of N.
            let mut unit = [0.0; 6];
            unit[c] = 1.0;
            let (V, R) = (SpatialVelocity::from_array(unit), s.state.X_NB.rotation);
            let V = SpatialVelocity::new(R.transpose_mul(V.angular), R.transpose_mul(V.linear));
            let h = body * V;
            SpatialForce::new(R * h.torque, R * h.force).to_array()
        });
        gap(&found, &array::from_fn::<_, 6, _>(|r| array::from_fn::<_, 6, _>(|c| columns[c][r])))
    });
}

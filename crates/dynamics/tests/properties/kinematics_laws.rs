//! Poses, twists and Jacobians against exact derivatives.

use crate::in_time::{Rate, in_time};
use crate::measure::for_every_robot;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, GeneralizedVelocity, JointKind, State, bias_acceleration,
    bias_force, jacobian, kinematics, mass_matrix,
};
use wrasse_spatial::{Dual, Pose, Quat, SpatialVelocity, vec3};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, larger, largest, size};

/// Twist of the scene's tool from the derivative of its pose, `Ṙ Rᵀ = [w]×`.
fn twist_by_derivative(scene: &Scene, state: &State<f64, JOINTS>) -> SpatialVelocity<f64> {
    let robot = scene.robot.cast::<Dual<f64>>();
    let frame = Frame { body: scene.frame.body, X_BF: Pose::from_f64(&scene.frame.X_BF) };
    let moving = in_time(state, &Generalized::default());
    let X_NF = kinematics(&robot, &moving).pose(&frame);
    let now = kinematics(&scene.robot, state).pose(&scene.frame);
    let [a, b, c] = (X_NF.rotation.rate() * now.rotation.transpose()).rows;
    let w = vec3(c.y - b.z, a.z - c.x, b.x - a.y) * 0.5;
    SpatialVelocity::new(w, X_NF.translation.rate())
}

fn unit(c: usize) -> GeneralizedVelocity<f64, JOINTS> {
    let mut nu = GeneralizedVelocity::default();
    match c.checked_sub(6) {
        Some(j) => nu.joints[j] = 1.0,
        None => {
            nu.base = SpatialVelocity::from_array(std::array::from_fn(|i| f64::from(i == c)));
        }
    }
    nu
}

/// Round-off of products of up to 12 rotations. Measured 2e-15.
#[test]
fn the_twist_of_a_frame_is_the_rate_of_its_pose() {
    for_every_robot(1e-13, |s| {
        let V_NF_N = kinematics(&s.robot, &s.state).velocity(&s.frame);
        gap(&V_NF_N, &twist_by_derivative(s, &s.state))
    });
}

/// Round-off of products of up to 12 rotations. Measured 4e-15.
#[test]
fn each_column_of_the_jacobian_is_the_derivative_of_the_pose() {
    for_every_robot(1e-13, |s| {
        let J_frame = jacobian(&kinematics(&s.robot, &s.state), &s.frame);
        largest((0..6 + s.robot.joint_count()).map(|c| {
            let nu = unit(c);
            let state = State { V_NB_B: nu.base, v: nu.joints, ..s.state };
            gap_at(&J_frame.times(&nu), &twist_by_derivative(s, &state), 1.0)
        }))
    });
}

/// The same sums in another order. Measured 2e-15.
#[test]
fn the_jacobian_times_the_rates_is_the_twist() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        gap(&jacobian(&k, &s.frame).times(&s.state.velocity()), &k.velocity(&s.frame))
    });
}

/// Measured 4e-15.
#[test]
fn the_bias_acceleration_is_the_rate_of_the_jacobian_times_the_rates() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &Generalized::default());
        let frame = Frame { body: s.frame.body, X_BF: Pose::from_f64(&s.frame.X_BF) };
        let J_frame = jacobian(&kinematics(&robot, &moving), &frame);
        let held = Generalized { base: moving.V_NB_B, joints: moving.v };
        gap(&bias_acceleration(&k, &s.frame), &J_frame.times(&held).rate())
    });
}

/// The acceleration of a frame is `J ν̇` and the bias: against the derivative of its twist.
/// Measured 2e-15.
#[test]
fn the_rate_of_a_twist_is_the_jacobian_times_the_accelerations_plus_the_bias() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let frame = Frame { body: s.frame.body, X_BF: Pose::from_f64(&s.frame.X_BF) };
        let by_derivative = kinematics(&robot, &moving).velocity(&frame).rate();
        let sum = jacobian(&k, &s.frame).times(&s.nudot) + bias_acceleration(&k, &s.frame);
        gap(&sum, &by_derivative)
    });
}

/// The base's pose enters nothing that is expressed in base axes; the tool's pose and twist move
/// along with it. Measured 1e-15.
#[test]
fn nothing_changes_for_the_robot_when_every_pose_is_moved() {
    for_every_robot(1e-13, |s| {
        let moved = State { X_NB: s.X_elsewhere * s.state.X_NB, ..s.state };
        let (here, there) = (kinematics(&s.robot, &s.state), kinematics(&s.robot, &moved));
        assert_eq!(mass_matrix(&here), mass_matrix(&there), "bit for bit");
        assert_eq!(bias_force(&here), bias_force(&there), "bit for bit");
        let (V, R) = (here.velocity(&s.frame), s.X_elsewhere.rotation);
        let V_turned = SpatialVelocity::new(R * V.angular, R * V.linear);
        larger(
            gap(&(s.X_elsewhere * here.pose(&s.frame)), &there.pose(&s.frame)),
            gap(&V_turned, &there.velocity(&s.frame)),
        )
    });
}

/// Three folded matrices against a quaternion. Measured 9e-16.
#[test]
fn a_revolute_joint_turns_about_its_axis_and_a_prismatic_one_slides_along_it() {
    for_every_robot(1e-14, |s| {
        largest(s.robot.joints().map(|j| {
            let (joint, q) = (s.robot.joint(j), s.state.q[j]);
            let along = joint.axis_B * q;
            let X_moved = match joint.kind {
                JointKind::Revolute => Pose::new(Quat::exp(along).to_matrix(), vec3(0.0, 0.0, 0.0)),
                JointKind::Prismatic => Pose { translation: along, ..Pose::identity() },
            };
            gap(&joint.X_PB(q), &(joint.X_PB_zero * X_moved))
        }))
    });
}

/// The origin that a joint has at zero travel does not follow its travel. Measured 0.
#[test]
fn the_origin_of_a_joint_stays_on_its_parent() {
    for_every_robot(1e-14, |s| {
        let k = kinematics(&s.robot, &s.state);
        largest(s.robot.joints().map(|j| {
            let mut state = s.state;
            state.q[j] = 0.0;
            let at_zero = kinematics(&s.robot, &state).X_NB(BodyId::Link(j)).translation;
            let off = k.joint_origin(j) - at_zero;
            off.norm() / larger(size(&at_zero), 1.0)
        }))
    });
}

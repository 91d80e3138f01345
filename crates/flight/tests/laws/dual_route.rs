//! The second route to the accelerations of resolved motion: the law run once more over dual numbers,
//! on a vehicle that moves as the law believes it to.

use super::postures::{Case, J, free_use};
use std::array;
use wrasse_dynamics::Frame;
use wrasse_flight::{
    Assignment, Belief, JointUse, Resolved, ResolvedMotion, Task, WantedMotion, joint_rates,
    resolved_motion,
};
use wrasse_spatial::{Dual, Mat3, Pose, Real, SpatialMomentum, SpatialVelocity, Vec3, vec3};
use wrasse_testing::random_robot::Random;
use wrasse_testing::{Worst, larger, largest};

type D = Dual<f64>;

fn constant(x: f64) -> D {
    D::from_f64(x)
}

fn vector(v: Vec3<f64>, rate: Vec3<f64>) -> Vec3<D> {
    vec3(D::new(v.x, rate.x), D::new(v.y, rate.y), D::new(v.z, rate.z))
}

fn twist(V: &SpatialVelocity<f64>, rate: &SpatialVelocity<f64>) -> SpatialVelocity<D> {
    SpatialVelocity::new(vector(V.angular, rate.angular), vector(V.linear, rate.linear))
}

/// A belief that moves at the given rates, with constant momentum.
fn in_motion(belief: &Belief<f64, J>, rate: &Resolved<f64, J>) -> Belief<D, J> {
    let (R, p) = (belief.X_NB.rotation, belief.X_NB.translation);
    let (Rdot, pdot) = (R * rate.V_NB_B.angular.skew(), R * rate.V_NB_B.linear);
    let rotation = Mat3 { rows: array::from_fn(|i| vector(R.rows[i], Rdot.rows[i])) };
    let h = &belief.h_Scm_N;
    let still = |v| vector(v, Vec3::zero());
    Belief {
        X_NB: Pose::new(rotation, vector(p, pdot)),
        q: array::from_fn(|j| D::new(belief.q[j], rate.qdot[j])),
        h_Scm_N: SpatialMomentum::new(still(h.torque), still(h.force)),
    }
}

/// Accelerations of joints and base by duals.
fn by_duals(
    case: &Case,
    motion: &ResolvedMotion<f64, J>,
    wanted: &WantedMotion<f64>,
    joints: &JointUse<f64, J>,
) -> ([f64; J], [f64; 6]) {
    let Assignment { tool, axes, task, law, damped_below } = case.to;
    let tool = Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) };
    let to = Assignment { tool, axes, task, law, damped_below: constant(damped_below) };
    let joints = JointUse {
        gain: D::new(joints.gain, joints.gain_rate),
        gain_rate: constant(joints.gain_rate),
        posture: joints.posture.map(constant),
        rate_limit: joints.rate_limit.map(constant),
    };
    let found = joint_rates(
        &case.arm.robot.cast(),
        &to,
        &in_motion(&case.belief, &motion.rate),
        &twist(&wanted.V_NE, &wanted.Vdot_NE),
        &joints,
    );
    let rate = |x: D| x.derivative;
    (found.qdot.map(rate), found.V_NB_B.to_array().map(rate))
}

/// Largest difference between the two routes, relative to the largest acceleration above 1.
fn off(case: &Case, joints: &JointUse<f64, J>, random: &mut Random) -> f64 {
    let wanted = WantedMotion { V_NE: case.V_NE, Vdot_NE: random.twist(0.1) };
    let motion = resolved_motion(&case.arm.robot, &case.to, &case.belief, &wanted, joints);
    let (qddot, A_NB_B) = by_duals(case, &motion, &wanted, joints);
    let mut worst = Worst::none();
    worst.see_all(qddot, motion.qddot);
    worst.see_all(A_NB_B, motion.A_NB_B.to_array());
    worst.largest() / larger(1.0, largest(motion.qddot.iter().map(|a| a.abs())))
}

/// Free, drifting to a posture, slowed down at the rate limits, and damped everywhere: each changes
/// the derivative in its own way. Round-off, larger by the condition of the Jacobian.
/// Measured 1.6e-14.
#[test]
fn accelerations_are_those_of_the_law_over_dual_numbers() {
    let (mut worst, mut random) = (Worst::none(), Random(11));
    let drifting = JointUse { gain: 0.3, gain_rate: -0.2, posture: [0.2; J], ..free_use() };
    let slow = JointUse { rate_limit: [0.01; J], ..drifting };
    for whole in Case::all() {
        for task in [Task::Pose, Task::Position] {
            for damped_below in [1e-4, 0.3] {
                let mut case = whole;
                (case.to.task, case.to.damped_below) = (task, damped_below);
                for joints in [free_use(), drifting, slow] {
                    worst.see(off(&case, &joints, &mut random));
                }
            }
        }
    }
    worst.is_below(1e-12);
}

//! Near singular postures the inverse is damped: rates and accelerations stay bounded.

use super::postures::{Arm, Case, J, LAWS, free_use};
use std::f64::consts::PI;
use wrasse_flight::{Assignment, Axes, Belief, Task, WantedMotion, joint_rates, resolved_motion};
use wrasse_spatial::{SpatialMomentum, SpatialVelocity};
use wrasse_testing::Worst;
use wrasse_testing::random_robot::Random;

/// Positions of the joints that carry the tool, each at or near one of the angles that line axes up:
/// stretched, folded, wrist or shoulder aligned, and all of them together.
fn lined_up(random: &mut Random) -> [f64; 7] {
    let mut q = [0.0; 7];
    for angle in &mut q {
        *angle = match random.below(4) {
            0 => 0.0,
            1 => [PI, 0.5 * PI, -0.5 * PI][random.below(3)],
            2 => 10_f64.powf(random.between(-12.0, -1.0)),
            _ => random.within(3.0),
        };
    }
    q
}

/// Each arm by each law in 400 postures that are singular, or next to it.
fn cases() -> Vec<Case> {
    let mut random = Random(3);
    let mut cases = Vec::new();
    for arm in Arm::three() {
        for k in 0..400 {
            let mut belief: Belief<f64, J> = arm.belief(&mut random);
            let q = if k == 0 { [0.0; 7] } else { lined_up(&mut random) };
            (0..7).for_each(|i| belief.q[arm.own(i)] = q[i]);
            let V_NE = random.twist(0.1);
            let wanted = |law| {
                let to = Assignment { damped_below: 0.02, ..arm.assignment(law, Axes::Inertial) };
                Case { arm, to, belief, V_NE }
            };
            cases.extend(LAWS.map(wanted));
        }
    }
    cases
}

/// An inverse that is damped below the singular value 0.02 m passes on at most 1/0.02 of a twist,
/// were the smallest pivot that singular value squared. It is larger: the gain is 6.0 of them at
/// worst, measured.
#[test]
fn rates_stay_bounded_however_singular_the_posture() {
    let mut gain = Worst::none();
    for mut case in cases() {
        case.belief.h_Scm_N = SpatialMomentum::zero();
        for task in [Task::Pose, Task::Position] {
            case.to.task = task;
            let found =
                joint_rates(&case.arm.robot, &case.to, &case.belief, &case.V_NE, &free_use());
            let asked: f64 = case.V_NE.to_array().iter().map(|x| x * x).sum();
            let got: f64 = found.qdot.iter().map(|x| x * x).sum();
            gain.see(case.to.damped_below * (got / asked).sqrt());
            found.V_NB_B.to_array().iter().for_each(|x| gain.see(x * 0.0));
        }
    }
    gain.is_below(10.0);
}

/// The damping sets in within a short way, so that they are large. Measured 6.7e4 rad/s².
#[test]
fn accelerations_stay_finite_however_singular_the_posture() {
    let (mut worst, mut random) = (Worst::none(), Random(4));
    for case in cases() {
        let robot = &case.arm.robot;
        let wanted = WantedMotion { V_NE: case.V_NE, Vdot_NE: random.twist(0.1) };
        let (to, belief) = (&case.to, &case.belief);
        let found = resolved_motion(robot, to, belief, &wanted, &free_use());
        found.qddot.iter().chain(&found.A_NB_B.to_array()).for_each(|a| worst.see(a.abs()));
    }
    worst.is_below(5e5);
}

/// Stretched out, the arm cannot move its tool outwards: it does not try. Measured 1.3e-14 rad/s.
#[test]
fn a_stretched_arm_does_not_try_to_reach_further() {
    let arm = Arm::laden(200.0);
    let mut random = Random(1);
    let belief =
        Belief { q: [0.0; J], h_Scm_N: SpatialMomentum::zero(), ..arm.belief(&mut random) };
    let mut worst = Worst::none();
    for law in LAWS {
        let to = Assignment { damped_below: 0.02, ..arm.assignment(law, Axes::Base) };
        let V_NE = SpatialVelocity::from_array([0.0, 0.0, 0.0, 0.1, 0.0, 0.0]);
        let found = joint_rates(&arm.robot, &to, &belief, &V_NE, &free_use());
        worst.see_all(found.qdot, [0.0; J]);
    }
    worst.is_below(1e-13);
}

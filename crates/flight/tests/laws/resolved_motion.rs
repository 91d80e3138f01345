//! Resolved motion: the tool moves as wanted once the base answers by momentum alone.

use super::postures::{Arm, Case, J, LAWS, free_use};
use std::array;
use wrasse_dynamics::{BodyId, Cholesky, Frame, State, kinematics, momentum};
use wrasse_flight::{
    ArmLaw, Axes, Belief, JointUse, Resolved, ResolvedMotion, Task, WantedMotion,
    believed_base_response, joint_rates, resolved_motion, task_jacobian,
};
use wrasse_spatial::{Pose, Quat, SpatialMomentum, SpatialVelocity, Vec3};
use wrasse_testing::random_robot::Random;
use wrasse_testing::{Worst, larger, largest};

impl Case {
    fn rates(&self, joints: &JointUse<f64, J>) -> Resolved<f64, J> {
        joint_rates(&self.arm.robot, &self.to, &self.belief, &self.V_NE, joints)
    }
    /// The vehicle as the law believes it to move.
    fn state(&self, found: &Resolved<f64, J>) -> State<f64, J> {
        let belief = &self.belief;
        State { X_NB: belief.X_NB, V_NB_B: found.V_NB_B, q: belief.q, v: found.qdot }
    }
    /// Twist of the tool, by kinematics alone; in base axes as seen from the base.
    fn tool_twist(&self, found: &Resolved<f64, J>) -> [f64; 6] {
        let state = match self.to.axes {
            Axes::Inertial => self.state(found),
            Axes::Base => State { q: self.belief.q, v: found.qdot, ..State::default() },
        };
        kinematics(&self.arm.robot, &state).velocity(&self.arm.tool).to_array()
    }
    /// By how much the base's answer breaks what the law takes for granted (rad/s, m/s): nothing
    /// moves; or no turn and the linear momentum; or all the momentum. Summed body by body.
    fn broken_promise(&self, found: &Resolved<f64, J>) -> f64 {
        let h = momentum(&kinematics(&self.arm.robot, &self.state(found)));
        let (V, believed) = (found.V_NB_B, self.belief.h_Scm_N);
        let pushed = (h.linear - believed.force).norm() / h.mass;
        match self.to.law {
            ArmLaw::Terrestrial => V.angular.norm() + V.linear.norm(),
            ArmLaw::AttitudeHeld => V.angular.norm() + pushed,
            ArmLaw::FreeFloating => pushed + (h.angular - believed.torque).norm() / h.mass,
        }
    }
    /// `J q̇` by the law's own Jacobian.
    fn task_twist(&self, qdot: &[f64; J]) -> [f64; 6] {
        let columns = task_jacobian(&self.arm.robot, &self.to, &self.belief);
        (0..J).fold(SpatialVelocity::zero(), |V, j| V + columns[j] * qdot[j]).to_array()
    }
    /// Joint rates that the law's Jacobian does not see: what is left of `xi` without `J⁺ J xi`.
    fn null_motion(&self, xi: &[f64; J]) -> [f64; J] {
        let rows =
            task_jacobian(&self.arm.robot, &self.to, &self.belief).map(SpatialVelocity::to_array);
        let JJt = array::from_fn(|r| {
            array::from_fn(|c| (0..J).map(|j| rows[j][r] * rows[j][c]).sum::<f64>())
        });
        let y = Cholesky::<f64, 6>::new(&JJt, 6).solve(&self.task_twist(xi));
        array::from_fn(|j| {
            let seen: f64 = (0..6).map(|r| rows[j][r] * y[r]).sum();
            if j < self.arm.robot.joint_count() { xi[j] - seen } else { 0.0 }
        })
    }
    /// The same a little later, on the way that `motion` describes.
    fn later(&self, h: f64, motion: &ResolvedMotion<f64, J>, wanted: &WantedMotion<f64>) -> Self {
        let (X, V) = (self.belief.X_NB, motion.rate.V_NB_B);
        let X_NB = Pose::new(
            X.rotation * Quat::exp(V.angular * h).to_matrix(),
            X.translation + X.rotation * V.linear * h,
        );
        let q = array::from_fn(|j| self.belief.q[j] + motion.rate.qdot[j] * h);
        let belief = Belief { X_NB, q, ..self.belief };
        Self { belief, V_NE: wanted.V_NE + wanted.Vdot_NE * h, ..*self }
    }
    /// Largest difference between accelerations and the central difference of the rates.
    fn derivative_error(&self, joints: &JointUse<f64, J>, Vdot_NE: SpatialVelocity<f64>) -> f64 {
        let wanted = WantedMotion { V_NE: self.V_NE, Vdot_NE };
        let robot = &self.arm.robot;
        let motion = resolved_motion(robot, &self.to, &self.belief, &wanted, joints);
        let h = 1e-6;
        let [before, after] = [-h, h].map(|h| self.later(h, &motion, &wanted).rates(joints));
        difference_error(&motion, &before, &after, h)
    }
}

/// Largest difference between accelerations and a central difference of rates, relative to the
/// largest joint acceleration above 1 rad/s².
fn difference_error(
    motion: &ResolvedMotion<f64, J>,
    before: &Resolved<f64, J>,
    after: &Resolved<f64, J>,
    h: f64,
) -> f64 {
    let mut worst = Worst::none();
    let qddot = array::from_fn(|j| (after.qdot[j] - before.qdot[j]) / (2.0 * h));
    worst.see_all(qddot, motion.qddot);
    let A_NB_B = (after.V_NB_B - before.V_NB_B) * (0.5 / h);
    worst.see_all(A_NB_B.to_array(), motion.A_NB_B.to_array());
    worst.largest() / larger(1.0, largest(motion.qddot.iter().map(|a| a.abs())))
}

fn dot(a: &[f64; J], b: &[f64; J]) -> f64 {
    (0..J).map(|j| a[j] * b[j]).sum()
}

/// Round-off, larger by the condition of the Jacobian. Measured 1.2e-13 of the twist, 1.2e-16 of the
/// promise.
#[test]
fn the_tool_gets_the_wanted_twist_and_the_base_answers_by_momentum() {
    let (mut twist, mut promise) = (Worst::none(), Worst::none());
    for case in Case::all() {
        let found = case.rates(&free_use());
        twist.see_all(case.tool_twist(&found), case.V_NE.to_array());
        promise.see(case.broken_promise(&found));
    }
    twist.is_below(1e-12);
    promise.is_below(1e-15);
}

/// Central differences over 2e-6 s: ε of the rates over that, and h² of their third derivative.
/// Measured 3.5e-8.
#[test]
fn accelerations_are_the_derivatives_of_the_rates() {
    let (mut worst, mut random) = (Worst::none(), Random(5));
    for case in Case::all() {
        for task in [Task::Pose, Task::Position] {
            let mut case = case;
            case.to.task = task;
            let joints = JointUse { gain: 0.3, posture: [0.2; J], ..free_use() };
            worst.see(case.derivative_error(&joints, random.twist(0.1)));
        }
    }
    worst.is_below(3e-7);
}

/// The drift to the posture comes with a gain that grows: its part of the acceleration is a difference
/// of rates. Round-off, larger by the condition of the Jacobian squared. Measured 8.2e-12.
#[test]
fn accelerations_know_of_a_gain_that_changes() {
    let mut worst = Worst::none();
    for case in Case::all() {
        let robot = &case.arm.robot;
        let with_gain =
            |gain, gain_rate| JointUse { gain, gain_rate, posture: [0.4; J], ..free_use() };
        let wanted = WantedMotion { V_NE: case.V_NE, Vdot_NE: SpatialVelocity::zero() };
        let motion = |joints: &JointUse<f64, J>| {
            resolved_motion(robot, &case.to, &case.belief, &wanted, joints)
        };
        // The rates are linear in the gain, so that its part of the acceleration is a difference.
        let (without, with) = (motion(&with_gain(0.3, 0.0)), motion(&with_gain(0.3, 0.7)));
        let (none, one) = (case.rates(&with_gain(0.0, 0.0)), case.rates(&with_gain(1.0, 0.0)));
        for j in 0..robot.joint_count() {
            let grown = 0.7 * (one.qdot[j] - none.qdot[j]);
            worst.see(with.qddot[j] - without.qddot[j] - grown);
        }
    }
    worst.is_below(1e-10);
}

/// All joints are slowed down, so that the share changes as the fastest does. Measured 2.6e-9.
#[test]
fn accelerations_are_the_derivatives_of_rates_at_their_limit() {
    let (mut worst, mut random) = (Worst::none(), Random(6));
    for case in Case::all() {
        let free = case.rates(&free_use()).qdot;
        let fastest = largest(free.iter().map(|rate| rate.abs()));
        let joints = JointUse { rate_limit: [0.5 * fastest; J], ..free_use() };
        worst.see(case.derivative_error(&joints, random.twist(0.1)));
    }
    worst.is_below(3e-8);
}

/// Measured 1.2e-16 of the promise, 8.8e-11 of the derivative.
#[test]
fn the_believed_answer_to_given_joint_motion_keeps_the_promise_and_is_differentiated() {
    let (mut promise, mut derivative, mut random) = (Worst::none(), Worst::none(), Random(7));
    for case in Case::all() {
        let n = case.arm.robot.joint_count();
        let mut some = || array::from_fn(|j| if j < n { random.within(0.3) } else { 0.0 });
        let (qdot, qddot): ([f64; J], [f64; J]) = (some(), some());
        let robot = &case.arm.robot;
        let answer = |belief: &Belief<f64, J>, qdot: &[f64; J]| {
            believed_base_response(robot, case.to.law, belief, qdot, &qddot)
        };
        let motion = answer(&case.belief, &qdot);
        assert_eq!((motion.rate.qdot, motion.qddot), (qdot, qddot));
        promise.see(case.broken_promise(&motion.rate));
        let h = 1e-6;
        let wanted = WantedMotion { V_NE: case.V_NE, Vdot_NE: case.V_NE };
        let [before, after] = [-h, h].map(|h| {
            let rates = array::from_fn(|j| qdot[j] + qddot[j] * h);
            answer(&case.later(h, &motion, &wanted).belief, &rates).rate
        });
        derivative.see(difference_error(&motion, &before, &after, h));
    }
    promise.is_below(1e-15);
    derivative.is_below(1e-9);
}

/// Locked joints would leave a rigid body that drifts: `v = p/m + w × d`, `w = I⁻¹ L`. The arm has
/// to move against it for as long as the tool stands still. Measured 5.0e-14.
#[test]
fn holding_the_tool_still_takes_joint_rates_against_the_drift() {
    let mut worst = Worst::none();
    for mut case in Case::all() {
        (case.to.axes, case.V_NE) = (Axes::Inertial, SpatialVelocity::zero());
        let qdot = case.rates(&free_use()).qdot;
        let state = State { X_NB: case.belief.X_NB, q: case.belief.q, ..State::default() };
        let k = kinematics(&case.arm.robot, &state);
        let (mass, p_NScm) = k.centre_of_mass();
        let d = k.pose(&case.arm.tool).translation - p_NScm;
        let h = case.belief.h_Scm_N;
        let drift = match case.to.law {
            ArmLaw::Terrestrial => SpatialVelocity::zero(),
            ArmLaw::AttitudeHeld => SpatialVelocity::new(Vec3::zero(), h.force * (1.0 / mass)),
            ArmLaw::FreeFloating => {
                let (R, M) = (state.X_NB.rotation, wrasse_dynamics::mass_matrix(&k).M_bb);
                let w = R * M.central().solve(R.transpose_mul(h.torque));
                SpatialVelocity::new(w, h.force * (1.0 / mass) + w.cross(d))
            }
        };
        worst.see_all(case.task_twist(&qdot), (-drift).to_array());
    }
    worst.is_below(1e-12);
}

/// Measured 2.6e-12 for the cosine between the rates and what could be added to them.
#[test]
fn any_other_joint_rates_for_the_same_twist_are_longer() {
    let (mut across, mut random) = (Worst::none(), Random(8));
    for case in Case::all() {
        let qdot = case.rates(&free_use()).qdot;
        let n = case.null_motion(&array::from_fn(|_| random.within(1.0)));
        let longer: [f64; J] = array::from_fn(|j| qdot[j] + n[j]);
        assert!(dot(&longer, &longer) > dot(&qdot, &qdot));
        across.see(dot(&qdot, &n).abs() / (dot(&qdot, &qdot) * dot(&n, &n)).sqrt());
    }
    across.is_below(3e-11);
}

/// Measured 2.0e-13 (m/s, rad/s).
#[test]
fn the_drift_to_a_posture_moves_the_joints_there_and_the_tool_not_at_all() {
    let (mut moved, mut random) = (Worst::none(), Random(9));
    for case in Case::all() {
        let posture = array::from_fn(|_| random.within(2.0));
        let plain = case.rates(&free_use()).qdot;
        let found = case.rates(&JointUse { gain: 0.5, posture, ..free_use() });
        moved.see_all(case.tool_twist(&found), case.V_NE.to_array());
        let towards = array::from_fn(|j| posture[j] - case.belief.q[j]);
        let added: [f64; J] = array::from_fn(|j| found.qdot[j] - plain[j]);
        let expected = case.null_motion(&towards).map(|rate| 0.5 * rate);
        moved.see_all(added, expected);
        assert!(dot(&towards, &added) > 0.0, "it goes away from the posture");
    }
    moved.is_below(2e-12);
}

/// One share for all joints; the fastest, for its limit, is at it. Measured 9.6e-17.
#[test]
fn rate_limits_slow_all_joints_down_together() {
    let mut off = Worst::none();
    for case in Case::all() {
        let free = case.rates(&free_use()).qdot;
        let rate_limit = array::from_fn(|j| if j % 2 == 0 { 0.02 } else { 0.05 });
        let limited = case.rates(&JointUse { rate_limit, ..free_use() });
        let over = |qdot: &[f64; J]| largest((0..J).map(|j| qdot[j].abs() / rate_limit[j]));
        let share = (1.0 / over(&free)).min(1.0);
        off.see_all(limited.qdot, free.map(|rate| rate * share));
        assert!(over(&limited.qdot) <= 1.0 + 1e-15, "{}", over(&limited.qdot));
        // The base answers what the joints do, not what was wanted of them.
        off.see(case.broken_promise(&limited));
    }
    off.is_below(1e-15);
}

/// Measured 1.0e-15 m/s.
#[test]
fn a_position_task_gives_the_velocity_and_ignores_the_rotation() {
    let mut worst = Worst::none();
    for whole in Case::all() {
        let mut case = whole;
        case.to.task = Task::Position;
        let found = case.rates(&free_use());
        let V = case.tool_twist(&found);
        worst.see_all([V[3], V[4], V[5]], case.V_NE.linear.to_array());
        worst.see(case.broken_promise(&found));
        case.V_NE.angular = Vec3 { x: 7.0, y: -3.0, z: 9.0 };
        assert_eq!(case.rates(&free_use()), found);
        // Less is asked, so it takes less.
        let all = whole.rates(&free_use()).qdot;
        assert!(dot(&found.qdot, &found.qdot) < dot(&all, &all));
    }
    worst.is_below(1e-14);
}

/// What a base of 1e9 times the mass still gives way is what is left. Measured 7.0e-9.
#[test]
fn on_a_heavy_base_all_laws_are_the_terrestrial_one() {
    let (mut worst, mut random) = (Worst::none(), Random(10));
    for mut arm in Arm::three() {
        let on_base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let ballast = random.matter(1e9 * arm.robot.mass(), 2.0);
        arm.robot = arm.robot.with_payload(&on_base, &ballast);
        for _ in 0..40 {
            let belief = Belief { h_Scm_N: SpatialMomentum::zero(), ..arm.belief(&mut random) };
            let V_NE = random.twist(0.1);
            let rates = LAWS.map(|law| {
                let to = arm.assignment(law, Axes::Inertial);
                Case { arm, to, belief, V_NE }.rates(&free_use())
            });
            worst.see_all(rates[0].qdot, rates[1].qdot);
            worst.see_all(rates[0].qdot, rates[2].qdot);
            worst.see_all(rates[0].V_NB_B.to_array(), rates[1].V_NB_B.to_array());
            worst.see_all(rates[0].V_NB_B.to_array(), rates[2].V_NB_B.to_array());
        }
    }
    worst.is_below(1e-7);
}

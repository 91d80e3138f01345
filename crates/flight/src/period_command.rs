//! What the actuators are told between two sets of set-points.

use crate::attitude_control::attitude_torque;
use crate::computed_torque::computed_torque;
use crate::computer::Setup;
use crate::feedforward::feedforward_torque;
use crate::law::{ArmLaw, Feedforward};
use crate::tool_wrench::against_tool_wrench;
use wrasse_dynamics::{Robot, State};
use wrasse_hardware::{SetPoint, SetPointMotion};
use wrasse_spatial::{Quat, Real, SpatialForce, SpatialInertia, Vec3};

/// What a control period tells the actuators of the arm, and what it asks of those of the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told<T, const J: usize> {
    /// Where each joint should be at the end of the period.
    pub set_points: [SetPoint<T>; J],
    /// Torque (N·m) or force (N) of each joint over the period.
    pub effort: [T; J],
    /// Torque that the base should feel over the period, base axes (N·m).
    pub attitude_torque_B: Vec3<T>,
    /// Force that keeps the base from giving way to a push at the tool, base axes (N).
    pub ahead_force_B: Vec3<T>,
    /// Inertia of the whole system with joints locked, about the base's origin in base axes.
    pub M_B: SpatialInertia<T>,
}

impl<T: Real, const J: usize> Told<T, J> {
    /// No torque and no force.
    #[inline(always)]
    pub(crate) fn nothing(set_points: [SetPoint<T>; J], M_B: SpatialInertia<T>) -> Self {
        let none = Vec3::zero();
        let effort = [T::zero(); J];
        Self { set_points, effort, attitude_torque_B: none, ahead_force_B: none, M_B }
    }
}

/// Torques that carry joints and base from the set-points now to the next ones. They are constant over
/// the period: those of its middle are right on average, and for the base so is `reaction_B`, what the
/// joints' angular momentum gains over the period per time (N·m), whose impulse is exact.
#[inline(always)]
pub(crate) fn told<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    sensed: &State<T, J>,
    (now, next): (&[SetPoint<T>; J], &[SetPoint<T>; J]),
    (M_B, reaction_B): (SpatialInertia<T>, Vec3<T>),
    tool_wrench_E: Option<&SpatialForce<T>>,
) -> Told<T, J> {
    let (tuning, law) = (&setup.tuning, setup.assignment.law);
    let (period, half) = (tuning.period, T::from_f64(0.5));
    let (mut middle, mut ahead) = (*now, *sensed);
    let mut acceleration = [T::zero(); J];
    for j in robot.joints() {
        middle[j] = SetPointMotion::between(now[j], next[j], period).at(period * half);
        acceleration[j] = (next[j].rate - now[j].rate) / period;
        let gain = acceleration[j] * period * half;
        ahead.q[j] += (sensed.v[j] + gain * half) * period * half;
        ahead.v[j] += gain;
    }
    let mut effort = computed_torque(robot, law, tuning, &ahead, &middle, &acceleration);
    let reaction_B = match setup.base.feedforward {
        Feedforward::Exact => reaction_B,
        as_printed => feedforward_torque(robot, as_printed, &middle),
    };
    let mut ahead_B = SpatialForce::new(reaction_B, Vec3::zero());
    if let Some(F_E) = tool_wrench_E {
        // A base that is held in its place stands as if it were bolted down.
        let held = setup.base.position_hold.is_some();
        let law = if held { ArmLaw::Terrestrial } else { law };
        let tool = &setup.assignment.tool;
        let (against, on_base_B) = against_tool_wrench(robot, law, tool, sensed, F_E);
        for j in robot.joints() {
            effort[j] += against[j];
        }
        ahead_B += on_base_B;
    }
    let quat_NB = Quat::from_matrix(&sensed.X_NB.rotation);
    let (I, w_NB_B) = (M_B.central(), sensed.V_NB_B.angular);
    let back_B = attitude_torque(tuning, &I, &quat_NB, w_NB_B, &setup.base.quat_ND);
    Told {
        set_points: *next,
        effort: within_limits(robot, setup, effort),
        attitude_torque_B: ahead_B.torque + back_B,
        ahead_force_B: ahead_B.force,
        M_B,
    }
}

/// All torques scaled so that none passes its limit: a drive that saturated alone would let the
/// others throw the arm off its way.
#[inline(always)]
fn within_limits<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    effort: [T; J],
) -> [T; J] {
    let mut share = T::one();
    for j in robot.joints() {
        if let Some(limit) = setup.limits[j].effort {
            share = share.min(limit / limit.max(effort[j].abs()));
        }
    }
    effort.map(|tau| tau * share)
}

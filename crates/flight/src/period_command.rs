//! The control law: commands of the actuators between two sets of set-points.

use crate::attitude_control::attitude_acceleration;
use crate::computed_torque::{joint_feedback, law_effort};
use crate::coupling_inertia::CouplingInertia;
use crate::feedforward::feedforward_torque;
use crate::law::{ArmLaw, Feedforward};
use crate::setup::Actuation;
use crate::setup::Setup;
use crate::tool_wrench::against_tool_wrench;
use wrasse_dynamics::{Configuration, InverseDynamics, Robot, State};
use wrasse_hardware::{SetPoint, SetPointMotion, through_gears};
use wrasse_spatial::{Quat, Real, SpatialForce, SpatialInertia, Vec3};

/// Output of the control law: commands of the arm's drives, and the torque that the base needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControlOutput<T, const J: usize> {
    /// Where each joint should be at the end of the period.
    pub set_points: [SetPoint<T>; J],
    /// Torque (N·m) or force (N) of each joint that the law asks for, before limits.
    pub effort_commanded: [T; J],
    /// The same within the limits: the command of the drives over the period.
    pub effort: [T; J],
    /// Torque that the base should feel over the period, base axes (N·m).
    pub attitude_torque_B: Vec3<T>,
    /// Force that keeps the base from giving way to a push at the tool, base axes (N).
    pub ahead_force_B: Vec3<T>,
    /// Share of the rates that the tool's way asks of the joints which their rate limits leave (–).
    pub rate_share: T,
    /// Inertia of the whole system with joints locked, about the base's origin in base axes.
    pub M_B: SpatialInertia<T>,
    /// How joints and base push each other.
    pub coupling: CouplingInertia<T, J>,
}

impl<T: Real, const J: usize> ControlOutput<T, J> {
    /// No torque and no force.
    #[inline(always)]
    pub(crate) fn nothing(set_points: [SetPoint<T>; J], M_B: SpatialInertia<T>) -> Self {
        let (none, effort) = (Vec3::zero(), [T::zero(); J]);
        Self {
            set_points,
            effort_commanded: effort,
            effort,
            attitude_torque_B: none,
            ahead_force_B: none,
            rate_share: T::one(),
            M_B,
            coupling: CouplingInertia::zero(),
        }
    }

    /// The same for a base that feels another torque than it should: the joints keep the accelerations
    /// that are asked of them, whatever the base does. `lack_B` is what it should feel less what it will
    /// (N·m, base axes).
    ///
    /// With `[I N; Nᵀ H̄] [ẇ; q̈] = [T; τ]` a torque on the base that is short by `ΔT` turns it by
    /// `-I⁻¹ ΔT`, and the joints stay on their way if their torques change by `-Nᵀ I⁻¹ ΔT`.
    ///
    /// The drives give as much of that change as the arm's own motion leaves them: a pulse of strong
    /// thrusters that all torques were scaled down for would throw the arm off its way.
    #[inline(always)]
    #[must_use]
    pub(crate) fn without_base_torque(
        mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        lack_B: Vec3<T>,
    ) -> Self {
        let mut change = self.coupling.effort(self.M_B.central().solve(lack_B));
        through_gears(&setup.followers, &mut change);
        let mut share = T::one();
        for j in robot.joints() {
            self.effort_commanded[j] -= change[j];
            if let Some(limit) = effort_limit(setup, j) {
                let (falls, reference) = (T::zero().lt(change[j]), change[j].abs());
                let left = T::select(falls, limit + self.effort[j], limit - self.effort[j]);
                let part = T::select(left.lt(reference), left.max(T::zero()) / reference, T::one());
                share = share.min(part);
            }
        }
        for j in robot.joints() {
            self.effort[j] -= change[j] * share;
            if let Some(limit) = effort_limit(setup, j) {
                self.effort[j] = self.effort[j].clamp_to(limit);
            }
        }
        self
    }

    /// All torques scaled so that no drive passes its limit, those on the base with them: a drive that
    /// saturated alone would let the others throw the arm off its way, and a base that is held against
    /// motion that no drive can give is turned.
    #[inline(always)]
    fn within_limits(mut self, robot: &Robot<T, J>, setup: &Setup<T, J>) -> Self {
        let share = share_within_limits(robot, setup, &self.effort_commanded);
        self.effort = self.effort_commanded.map(|tau| tau * share);
        self.attitude_torque_B = self.attitude_torque_B * share;
        self
    }
}

/// Torques that carry joints and base from the set-points now to the next ones. They are constant over
/// the period: those of its middle are right on average, and for the base so is `reaction_B`, what the
/// joints' angular momentum gains over the period per time (N·m), whose impulse is exact.
///
/// The joints' feedback is fed forward to the base too: an arm law that counts on a base whose attitude is
/// held gets its accelerations only if the base is held against all of them.
#[inline(always)]
pub(crate) fn control_law<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    (sensed, at, forces): (&State<T, J>, &Configuration<T, J>, &mut InverseDynamics<T, J>),
    (now, next): (&[SetPoint<T>; J], &[SetPoint<T>; J]),
    (M_B, reaction_B): (SpatialInertia<T>, Vec3<T>),
    tool_wrench_E: Option<&SpatialForce<T>>,
) -> ControlOutput<T, J> {
    let (tuning, law) = (&setup.tuning, setup.assignment.law);
    let Middle { state: ahead, set_points: middle, acceleration } =
        Middle::new(robot, tuning.period, sensed, now, next);
    let back = joint_feedback(robot, tuning, &ahead, &middle);
    let qddot = core::array::from_fn(|j| acceleration[j] + back[j]);
    let mut effort = law_effort(robot, law, (at, forces), (&ahead.V_NB_B, &ahead.v), &qddot);
    let coupling = CouplingInertia::of(&at.base);
    let feedback_B = coupling.reaction(&driven_feedback(robot, setup, back));
    // What holds the base against the commanded motion of the joints.
    let mut holding_B = reaction_B + feedback_B;
    let fed_forward_B = match setup.base.feedforward {
        // Pulses that come late for the joints' feedback would feed it. The joints do without.
        Feedforward::Exact if !setup.base.actuation.answers_at_once() => reaction_B,
        Feedforward::Exact => holding_B,
        as_printed => feedforward_torque(robot, as_printed, &middle),
    };
    let mut ahead_B = SpatialForce::new(fed_forward_B, Vec3::zero());
    if let Some(F_E) = tool_wrench_E {
        let (against, on_base_B) = against_push(robot, setup, sensed, F_E);
        for j in robot.joints() {
            effort[j] += against[j];
        }
        ahead_B += on_base_B;
        holding_B += on_base_B.torque;
    }
    let quat_NB = Quat::from_matrix(&sensed.X_NB.rotation);
    let (I, w_NB_B) = (M_B.central(), sensed.V_NB_B.angular);
    let back_B = I * attitude_acceleration(tuning, &quat_NB, w_NB_B, &setup.base.quat_ND);
    let attitude_torque_B = ahead_B.torque + back_B;
    // What the torques of the arm law count on, and where the base turns otherwise, how it does.
    let counted_on_B = match (setup.base.actuation, law) {
        (Actuation::None, _) | (_, ArmLaw::Terrestrial) => attitude_torque_B,
        (_, ArmLaw::AttitudeHeld) => holding_B,
        (_, ArmLaw::FreeFloating) => Vec3::zero(),
    };
    let with_base = coupling.effort(I.solve(attitude_torque_B - counted_on_B));
    for j in robot.joints() {
        effort[j] += with_base[j];
    }
    through_gears(&setup.followers, &mut effort);
    let (set_points, ahead_force_B) = (*next, ahead_B.force);
    let effort_commanded = effort;
    let rate_share = T::one();
    ControlOutput {
        set_points,
        effort_commanded,
        effort,
        attitude_torque_B,
        ahead_force_B,
        rate_share,
        M_B,
        coupling,
    }
    .within_limits(robot, setup)
}

/// Acceleration that the loops of the joints ask for, where torques drive them (rad/s², m/s²).
#[inline(always)]
fn driven_feedback<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    mut back: [T; J],
) -> [T; J] {
    for j in robot.joints() {
        if setup.position_driven[j] {
            back[j] = T::zero();
        }
    }
    back
}

/// Torques of the joints and wrench on the base that stand against a push at the tool.
#[inline(always)]
fn against_push<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    sensed: &State<T, J>,
    F_E: &SpatialForce<T>,
) -> ([T; J], SpatialForce<T>) {
    // A base that is held in its place stands as if it were bolted down.
    let held = setup.base.position_hold.is_some();
    let law = if held { ArmLaw::Terrestrial } else { setup.assignment.law };
    against_tool_wrench(robot, law, &setup.assignment.tool, sensed, F_E)
}

/// The middle of a period.
struct Middle<T, const J: usize> {
    /// The vehicle as it was sensed, moved on by the acceleration that is fed forward.
    state: State<T, J>,
    /// Where the joints should be.
    set_points: [SetPoint<T>; J],
    /// Mean acceleration between the set-points (rad/s², m/s²).
    acceleration: [T; J],
}

impl<T: Real, const J: usize> Middle<T, J> {
    #[inline(always)]
    fn new(
        robot: &Robot<T, J>,
        period: T,
        sensed: &State<T, J>,
        now: &[SetPoint<T>; J],
        next: &[SetPoint<T>; J],
    ) -> Self {
        let half = T::from_f64(0.5);
        let mut middle = Self { state: *sensed, set_points: *now, acceleration: [T::zero(); J] };
        for j in robot.joints() {
            let way = SetPointMotion::between(now[j], next[j], period);
            middle.set_points[j] = way.at(period * half);
            middle.acceleration[j] = (next[j].rate - now[j].rate) / period;
            let gain = middle.acceleration[j] * period * half;
            middle.state.q[j] += (sensed.v[j] + gain * half) * period * half;
            middle.state.v[j] += gain;
        }
        middle
    }
}

/// Share of all torques at which none passes its limit (–): a drive that saturated alone would let the
/// others throw the arm off its way.
#[inline(always)]
fn share_within_limits<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    effort: &[T; J],
) -> T {
    let mut share = T::one();
    for j in robot.joints() {
        if let Some(limit) = effort_limit(setup, j) {
            share = share.min(limit / limit.max(effort[j].abs()));
        }
    }
    share
}

/// Largest torque or force of a drive that is commanded one (N·m, N); those that follow their
/// set-points are not.
#[inline(always)]
fn effort_limit<T: Real, const J: usize>(setup: &Setup<T, J>, j: usize) -> Option<T> {
    setup.limits[j].effort.filter(|_| !setup.position_driven[j])
}

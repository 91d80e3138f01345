//! Resolved motion: joint rates and accelerations that give the tool a wanted motion, as a law
//! believes the base to answer.

use crate::Axes;
use crate::damped_inverse::DampedInverse;
use crate::law::{ArmLaw, Task};
use core::array;
use wrasse_dynamics::{
    BaseResponse, BodyId, Configuration, Frame, Robot, base_response, base_response_rate,
};
use wrasse_spatial::{
    At, Mat3, Pose, Real, SpatialAcceleration, SpatialMomentum, SpatialVelocity, Vec3,
};

/// The arm's assignment: which point, in which axes, how much of its motion, by which law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Assignment<T> {
    /// The tool.
    pub tool: Frame<T>,
    /// Axes of its wanted motion.
    pub axes: Axes,
    /// Which part of its motion counts.
    pub task: Task,
    /// What the base is taken for.
    pub law: ArmLaw,
    /// Singular value below which the inverse is damped.
    pub damped_below: T,
}

/// How the joints may be used: how fast, and what they do with the freedom that the task leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointUse<T, const J: usize> {
    /// Drift towards the posture (1/s); zero for joint rates of least norm.
    pub gain: T,
    /// How fast the gain changes (1/s²).
    pub gain_rate: T,
    /// The posture (rad or m).
    pub posture: [T; J],
    /// Largest rate of each joint (rad/s or m/s): where one would pass it, all are slowed down
    /// together, so that the tool keeps its direction and falls behind.
    pub rate_limit: [T; J],
}

/// Rates and accelerations of joints and base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResolvedMotion<T, const J: usize> {
    /// Rates.
    pub rate: Resolved<T, J>,
    /// Joint accelerations (rad/s² or m/s²).
    pub qddot: [T; J],
    /// Time derivative of the base's believed twist (rad/s², m/s²).
    pub A_NB_B: SpatialAcceleration<T>,
}

/// A twist of the tool and its time derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WantedMotion<T> {
    /// Twist (rad/s, m/s).
    pub V_NE: SpatialVelocity<T>,
    /// Its derivative (rad/s², m/s²).
    pub Vdot_NE: SpatialVelocity<T>,
}

/// Where the vehicle is believed to be, and the momentum it is believed to have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belief<T, const J: usize> {
    /// Pose of the base, `X_NB`.
    pub X_NB: Pose<T>,
    /// Joint positions (rad or m).
    pub q: [T; J],
    /// Total momentum about the system's centre of mass, inertial axes (N·m·s, N·s); only its linear part
    /// counts where the attitude is held, and nothing where the base is bolted down.
    pub h_Scm_N: SpatialMomentum<T>,
}

/// Rates, and how the base is believed to answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved<T, const J: usize> {
    /// Joint rates (rad/s or m/s).
    pub qdot: [T; J],
    /// Base twist `V_NB_B` (rad/s, m/s).
    pub V_NB_B: SpatialVelocity<T>,
}

impl<T: Real, const J: usize> Belief<T, J> {
    /// The momentum in base axes.
    #[inline(always)]
    pub(crate) fn h_Scm_B(&self) -> SpatialMomentum<T> {
        let (R_NB, h) = (&self.X_NB.rotation, &self.h_Scm_N);
        SpatialMomentum::new(R_NB.transpose_mul(h.torque), R_NB.transpose_mul(h.force))
    }
}

/// The tool, and the law's Jacobian in one posture; about the base's origin, in base axes, where the
/// attitude of the base changes nothing.
pub(crate) struct LawJacobian<'a, T, const J: usize> {
    p_BE: Vec3<T>,
    /// Whether a joint carries the tool.
    carries: [bool; J],
    /// Twist of the tool's body for unit rate of each joint.
    pub(crate) columns: [SpatialVelocity<T>; J],
    /// Twist that no joint causes.
    pub(crate) drift: SpatialVelocity<T>,
    response: &'a BaseResponse<T, J>,
}

impl<'a, T: Real, const J: usize> LawJacobian<'a, T, J> {
    #[inline(always)]
    pub(crate) fn new(
        robot: &Robot<T, J>,
        to: &Assignment<T>,
        configuration: &Configuration<T, J>,
        response: &'a BaseResponse<T, J>,
    ) -> Self {
        let p_BE = configuration.posture.pose(robot, &to.tool).translation;
        let (columns, drift) = ([SpatialVelocity::zero(); J], SpatialVelocity::zero());
        let carries = carrying(robot, to.tool.body);
        let mut law = Self { p_BE, carries, columns, drift, response };
        let S = &configuration.base.S;
        for j in robot.joints() {
            law.columns[j] = law.total(to, j, &S.at(j), &response.per_rate.at(j));
        }
        if to.axes == Axes::Inertial {
            law.drift = law.response.drift;
        }
        law
    }

    /// What a joint itself does to the tool, and what the base does about it. What happens relative to
    /// the base does not depend on how the base moves.
    #[inline(always)]
    fn total(
        &self,
        to: &Assignment<T>,
        j: usize,
        own: &SpatialVelocity<T>,
        answer: &SpatialVelocity<T>,
    ) -> SpatialVelocity<T> {
        let own = if self.carries[j] { *own } else { SpatialVelocity::zero() };
        if to.axes == Axes::Inertial { own + *answer } else { own }
    }

    /// The six rows of the task at the tool.
    #[inline(always)]
    pub(crate) fn rows(&self, task: Task, V: &SpatialVelocity<T>) -> [T; 6] {
        masked(&V.shifted_by(self.p_BE), task).to_array()
    }
}

/// Joints between the base and a body.
#[inline(always)]
pub(crate) fn carrying<T: Real, const J: usize>(robot: &Robot<T, J>, body: BodyId) -> [bool; J] {
    let (mut carries, mut at) = ([false; J], body);
    for j in robot.joints().rev() {
        if at == BodyId::Link(j) {
            carries[j] = true;
            at = robot.joint(j).parent;
        }
    }
    carries
}

pub(crate) fn masked<T: Real>(V: &SpatialVelocity<T>, task: Task) -> SpatialVelocity<T> {
    match task {
        Task::Pose => *V,
        Task::Position => SpatialVelocity::new(Vec3::zero(), V.linear),
    }
}

/// The law's Jacobian at a belief: columns are the tool's twist per joint rate, in the axes of the
/// assignment.
pub fn task_jacobian<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
) -> [SpatialVelocity<T>; J] {
    task_jacobian_in(robot, to, &Configuration::at(robot, &belief.q), belief)
}

/// The same in the belief's configuration, which is at hand.
pub(crate) fn task_jacobian_in<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    configuration: &Configuration<T, J>,
    belief: &Belief<T, J>,
) -> [SpatialVelocity<T>; J] {
    let response = base_response(to.law.base(), &configuration.base, &belief.h_Scm_B());
    let law = LawJacobian::new(robot, to, configuration, &response);
    let R = match to.axes {
        Axes::Inertial => belief.X_NB.rotation,
        Axes::Base => Mat3::identity(),
    };
    law.columns.map(|c| {
        let V = masked(&c.shifted_by(law.p_BE), to.task);
        SpatialVelocity::new(R * V.angular, R * V.linear)
    })
}

/// Joint rates of least norm that give the tool the twist `V_NE`, plus the part of the drift towards
/// the preferred posture that does not move it.
///
/// Where the Jacobian comes close to singular its inverse is damped: the rates stay bounded and the
/// tool falls behind, which the planning reports. No iteration depends on the data, and the damping
/// does not depend on how the base is turned.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989); damping after
/// [`NakamuraHanafusa1986`](wrasse_spatial::references::NakamuraHanafusa1986), with the smallest
/// pivot in place of the manipulability.
pub fn joint_rates<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
    V_NE: &SpatialVelocity<T>,
    joints: &JointUse<T, J>,
) -> Resolved<T, J> {
    let configuration = Configuration::at(robot, &belief.q);
    let response = base_response(to.law.base(), &configuration.base, &belief.h_Scm_B());
    let law = LawJacobian::new(robot, to, &configuration, &response);
    Solved::new(robot, to, belief, &law, V_NE, joints).rate
}

/// Joint rates, and what their derivatives need of the way they were found.
struct Solved<T, const J: usize> {
    rate: Resolved<T, J>,
    /// Wanted twist of the tool, base axes.
    V_NE_B: SpatialVelocity<T>,
    /// Columns at the tool, six rows of the task.
    rows: [[T; 6]; J],
    inverse: DampedInverse<T, 6>,
    y: [T; 6],
    /// Rates before all were slowed down, and the share of them that is left.
    free: [T; J],
    share: T,
}

impl<T: Real, const J: usize> Solved<T, J> {
    #[inline(always)]
    fn new(
        robot: &Robot<T, J>,
        to: &Assignment<T>,
        belief: &Belief<T, J>,
        law: &LawJacobian<'_, T, J>,
        V_NE: &SpatialVelocity<T>,
        joints: &JointUse<T, J>,
    ) -> Self {
        let V_NE_B = in_base_axes(to, belief, V_NE);
        let mut wanted =
            subtract(&masked(&V_NE_B, to.task).to_array(), &law.rows(to.task, &law.drift));
        let (mut rows, mut free) = ([[T::zero(); 6]; J], [T::zero(); J]);
        for j in robot.joints() {
            let row = law.rows(to.task, &law.columns[j]);
            free[j] = (joints.posture[j] - belief.q[j]) * joints.gain;
            for r in 0..6 {
                wanted[r] -= row[r] * free[j];
            }
            rows[j] = row;
        }
        let first = if to.task == Task::Position { 3 } else { 0 };
        let mut orthogonal = rows;
        let columns = orthogonal.get_mut(robot.joints()).unwrap_or_default();
        let inverse = DampedInverse::new(columns, first, to.damped_below);
        let y = inverse.solve(&wanted);
        let mut share = T::one();
        for j in robot.joints() {
            free[j] += dot(&rows[j], &y);
            share = share.min(joints.rate_limit[j] / joints.rate_limit[j].max(free[j].abs()));
        }
        let qdot = free.map(|rate| rate * share);
        let V_NB_B = law.response.to_rates(robot, &qdot) + law.response.drift;
        Self { rate: Resolved { qdot, V_NB_B }, V_NE_B, rows, inverse, y, free, share }
    }
}

/// A twist that is given in the axes of the assignment.
#[inline(always)]
pub(crate) fn in_base_axes<T: Real, const J: usize>(
    to: &Assignment<T>,
    belief: &Belief<T, J>,
    V: &SpatialVelocity<T>,
) -> SpatialVelocity<T> {
    let R_NB = &belief.X_NB.rotation;
    match to.axes {
        Axes::Inertial => {
            SpatialVelocity::new(R_NB.transpose_mul(V.angular), R_NB.transpose_mul(V.linear))
        }
        Axes::Base => *V,
    }
}

#[inline(always)]
fn subtract<T: Real>(a: &[T; 6], b: &[T; 6]) -> [T; 6] {
    array::from_fn(|r| a[r] - b[r])
}

#[inline(always)]
fn dot<T: Real>(a: &[T; 6], b: &[T; 6]) -> T {
    (1..6).fold(a[0] * b[0], |sum, r| sum + a[r] * b[r])
}

/// Joint motion that gives the tool a wanted motion. Accelerations are the exact derivatives of the
/// rates.
pub fn resolved_motion<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
    wanted: &WantedMotion<T>,
    joints: &JointUse<T, J>,
) -> ResolvedMotion<T, J> {
    resolved_motion_in(robot, to, &Configuration::at(robot, &belief.q), belief, wanted, joints).0
}

/// The same in a configuration that is at hand, and the share of the rates that the rate limits leave (–).
///
/// With `q̇ = q̇₀ + Jᵀ y`, `(J Jᵀ + λ²) y = w - J q̇₀` the derivatives are
/// `q̈ = e + Jᵀ ẏ`, `(J Jᵀ + λ²) ẏ = ẇ - J̇ q̇ - J e - λ̇² y`, `e = q̈₀ + J̇ᵀ y`.
#[inline(always)]
pub(crate) fn resolved_motion_in<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    configuration: &Configuration<T, J>,
    belief: &Belief<T, J>,
    wanted: &WantedMotion<T>,
    joints: &JointUse<T, J>,
) -> (ResolvedMotion<T, J>, T) {
    let (mode, h_Scm_B) = (to.law.base(), belief.h_Scm_B());
    let response = base_response(mode, &configuration.base, &h_Scm_B);
    let law = LawJacobian::new(robot, to, configuration, &response);
    let solved = Solved::new(robot, to, belief, &law, &wanted.V_NE, joints);
    let rate = solved.rate;
    let w_NB_B = rate.V_NB_B.angular;
    let V = configuration.twists(robot, &rate.qdot);
    let moving = (&V, &rate.qdot);
    let changing =
        base_response_rate(mode, robot, configuration, &response, moving, &h_Scm_B, w_NB_B);
    let rows = row_rates(robot, to, configuration, &law, &changing, &V);
    let mut Vdot = in_base_axes(to, belief, &wanted.Vdot_NE);
    if to.axes == Axes::Inertial {
        // Seen from a base that turns.
        let V_NE = &solved.V_NE_B;
        Vdot += SpatialVelocity::new(V_NE.angular.cross(w_NB_B), V_NE.linear.cross(w_NB_B));
    }
    let wanted = subtract(&masked(&Vdot, to.task).to_array(), &rows.drift);
    let free = free_accelerations(robot, belief, &solved, &rows.columns, wanted, joints);
    let share_rate = share_rate(robot, &solved, &free, joints);
    let mut qddot = [T::zero(); J];
    for j in robot.joints() {
        qddot[j] = free[j] * solved.share + solved.free[j] * share_rate;
    }
    let A_NB_B = law.response.to_rates(robot, &qddot)
        + changing.to_rates(robot, &rate.qdot)
        + changing.drift;
    (ResolvedMotion { rate, qddot, A_NB_B }, solved.share)
}

/// Time derivatives of the rows of the Jacobian at the tool, in base axes.
pub(crate) struct RowRates<T, const J: usize> {
    pub(crate) columns: [[T; 6]; J],
    pub(crate) drift: [T; 6],
}

#[inline(always)]
pub(crate) fn row_rates<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    configuration: &Configuration<T, J>,
    law: &LawJacobian<'_, T, J>,
    changing: &BaseResponse<T, J>,
    V: &SpatialVelocity<[T; J]>,
) -> RowRates<T, J> {
    let v_BE = match to.tool.body {
        BodyId::Base => Vec3::zero(),
        BodyId::Link(j) => V.at(j).shifted_by(law.p_BE).linear,
    };
    let S = &configuration.base.S;
    // The tool moves on while the twist is carried to it.
    let row_rate = |V: &SpatialVelocity<T>, Vdot: &SpatialVelocity<T>| {
        let moved = SpatialVelocity::new(Vec3::zero(), V.angular.cross(v_BE));
        masked(&(Vdot.shifted_by(law.p_BE) + moved), to.task).to_array()
    };
    let mut columns = [[T::zero(); 6]; J];
    for j in robot.joints() {
        let own = V.at(j).cross(&S.at(j));
        let rate = law.total(to, j, &own, &changing.per_rate.at(j));
        columns[j] = row_rate(&law.columns[j], &rate);
    }
    let drift = match to.axes {
        Axes::Inertial => row_rate(&law.drift, &changing.drift),
        Axes::Base => [T::zero(); 6],
    };
    RowRates { columns, drift }
}

/// Derivatives of the rates before all are slowed down.
#[inline(always)]
fn free_accelerations<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    belief: &Belief<T, J>,
    solved: &Solved<T, J>,
    row_rates: &[[T; 6]; J],
    wanted: [T; 6],
    joints: &JointUse<T, J>,
) -> [T; J] {
    let mut rest = wanted;
    let damping_rate =
        solved.inverse.damping_rate(robot.joints().map(|j| (&solved.rows[j], &row_rates[j])));
    for r in 0..6 {
        rest[r] -= damping_rate * solved.y[r];
    }
    let mut qddot = [T::zero(); J];
    for j in robot.joints() {
        qddot[j] = (joints.posture[j] - belief.q[j]) * joints.gain_rate
            - solved.rate.qdot[j] * joints.gain
            + dot(&row_rates[j], &solved.y);
        for r in 0..6 {
            rest[r] -= row_rates[j][r] * solved.free[j] + solved.rows[j][r] * qddot[j];
        }
    }
    let ydot = solved.inverse.solve(&rest);
    for j in robot.joints() {
        qddot[j] += dot(&solved.rows[j], &ydot);
    }
    qddot
}

/// Derivative of the share of their rates that the joints are slowed down to.
#[inline(always)]
fn share_rate<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    solved: &Solved<T, J>,
    free_accelerations: &[T; J],
    joints: &JointUse<T, J>,
) -> T {
    let (mut share, mut rate) = (T::one(), T::zero());
    for j in robot.joints() {
        let (limit, speed) = (joints.rate_limit[j], solved.free[j].abs());
        let backwards = solved.free[j].lt(T::zero());
        let gain = T::select(backwards, -free_accelerations[j], free_accelerations[j]);
        let largest = limit.max(speed);
        let own = limit / largest;
        let own_rate = T::select(limit.lt(speed), -own * gain / largest, T::zero());
        rate = T::select(own.lt(share), own_rate, rate);
        share = share.min(own);
    }
    rate
}

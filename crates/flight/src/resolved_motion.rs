//! Resolved motion: joint rates and accelerations that give the tool a wanted motion, as a law
//! believes the base to answer.

use crate::Axes;
use crate::law::{ArmLaw, Task};
use wrasse_dynamics::{
    Cholesky, Frame, MassMatrix, Robot, State, attitude_held_jacobian, base_twist,
    generalized_jacobian, jacobian, kinematics, mass_matrix, velocity_from_momentum,
};
use wrasse_spatial::{
    Dual, Mat3, Pose, Quat, Real, Scalar, SpatialAcceleration, SpatialMomentum, SpatialVelocity,
    Vec3, turned_by,
};

/// What is asked of the arm: which point, in which axes, how much of its motion, by which law.
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

/// Where the vehicle is believed to be, and the momentum it is believed to have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belief<T, const J: usize> {
    /// Pose of the base, `X_NB`.
    pub X_NB: Pose<T>,
    /// Joint positions (rad or m).
    pub q: [T; J],
    /// Total momentum about the system's centre of mass, inertial axes (N·m·s, N·s).
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

/// The law's Jacobian and the twist of the tool that no joint causes.
fn law_jacobian<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
) -> ([SpatialVelocity<T>; J], SpatialVelocity<T>, MassMatrix<T, J>) {
    let still = State { X_NB: belief.X_NB, q: belief.q, ..State::default() };
    let k = kinematics(robot, &still);
    let (J_frame, M) = (jacobian(&k, &to.tool), mass_matrix(&k));
    let R_NB = belief.X_NB.rotation;
    let (columns, drift) = match (to.axes, to.law) {
        // What happens relative to the base does not depend on how the base moves.
        (Axes::Base, _) => (
            J_frame.joints.map(|c| {
                SpatialVelocity::new(R_NB.transpose_mul(c.angular), R_NB.transpose_mul(c.linear))
            }),
            SpatialVelocity::zero(),
        ),
        (Axes::Inertial, ArmLaw::Terrestrial) => (J_frame.joints, SpatialVelocity::zero()),
        (Axes::Inertial, ArmLaw::AttitudeHeld) => (
            attitude_held_jacobian(&J_frame, &M, &R_NB),
            SpatialVelocity::new(Vec3::zero(), belief.h_Scm_N.force * (T::one() / M.M_bb.mass)),
        ),
        (Axes::Inertial, ArmLaw::FreeFloating) => (
            generalized_jacobian(&J_frame, &M),
            velocity_from_momentum(&J_frame, &M, &in_base_axes(&belief.h_Scm_N, &R_NB)),
        ),
    };
    (columns, drift, M)
}

fn in_base_axes<T: Real>(h_N: &SpatialMomentum<T>, R_NB: &Mat3<T>) -> SpatialMomentum<T> {
    SpatialMomentum::new(R_NB.transpose_mul(h_N.torque), R_NB.transpose_mul(h_N.force))
}

/// The law's Jacobian at a belief: columns are the tool's twist per joint rate.
pub fn task_jacobian<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
) -> [SpatialVelocity<T>; J] {
    let (columns, _, _) = law_jacobian(robot, to, belief);
    columns.map(|c| masked(&c, to.task))
}

fn masked<T: Real>(V: &SpatialVelocity<T>, task: Task) -> SpatialVelocity<T> {
    match task {
        Task::Pose => *V,
        Task::Position => SpatialVelocity::new(Vec3::zero(), V.linear),
    }
}

/// Joint rates of least norm that give the tool the twist `V_NE`, plus the part of the drift towards
/// the preferred posture that does not move it.
///
/// Where the Jacobian comes close to singular its inverse is damped: the rates stay bounded and the
/// tool falls behind, which the planning reports. No iteration depends on the data.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989); damping after
/// [`NakamuraHanafusa1986`](wrasse_spatial::references::NakamuraHanafusa1986), with the smallest
/// Cholesky pivot in place of the manipulability.
pub fn joint_rates<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
    V_NE: &SpatialVelocity<T>,
    joints: &JointUse<T, J>,
) -> Resolved<T, J> {
    let (columns, drift, M) = law_jacobian(robot, to, belief);
    let rows = columns.map(|c| masked(&c, to.task).to_array());
    let mut wanted = masked(&(*V_NE - drift), to.task).to_array();
    let mut qdot = [T::zero(); J];
    for j in robot.joints() {
        qdot[j] = (joints.posture[j] - belief.q[j]) * joints.gain;
    }
    for j in robot.joints() {
        for r in 0..6 {
            wanted[r] -= rows[j][r] * qdot[j];
        }
    }
    let y = damped_inverse(robot, &rows, to).solve(&wanted);
    for j in robot.joints() {
        for r in 0..6 {
            qdot[j] += rows[j][r] * y[r];
        }
    }
    let mut share = T::one();
    for j in robot.joints() {
        share = share.min(joints.rate_limit[j] / joints.rate_limit[j].max(qdot[j].abs()));
    }
    let qdot = qdot.map(|rate| rate * share);
    Resolved { qdot, V_NB_B: believed_base_twist(to.law, belief, &M, &qdot) }
}

/// `(J Jᵀ + λ² 1)⁻¹`, with λ zero while the smallest pivot stays above the floor.
fn damped_inverse<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    rows: &[[T; 6]; J],
    to: &Assignment<T>,
) -> Cholesky<T, 6> {
    let mut JJt = [[T::zero(); 6]; 6];
    for j in robot.joints() {
        for r in 0..6 {
            for c in 0..=r {
                JJt[r][c] += rows[j][r] * rows[j][c];
            }
        }
    }
    if to.task == Task::Position {
        // Rows that are not asked for: any pivot will do.
        (0..3).for_each(|r| JJt[r][r] = T::one());
    }
    let floor = to.damped_below * to.damped_below;
    let lack = (T::one() - Cholesky::new(&JJt, 6).smallest_pivot() / floor).max(T::zero());
    let damping = floor * lack.min(T::one()) * lack.min(T::one());
    (0..6).for_each(|r| JJt[r][r] += damping);
    Cholesky::new(&JJt, 6)
}

/// How a law believes the base to answer joint rates.
fn believed_base_twist<T: Real, const J: usize>(
    law: ArmLaw,
    belief: &Belief<T, J>,
    M: &MassMatrix<T, J>,
    qdot: &[T; J],
) -> SpatialVelocity<T> {
    let h_Scm_B = in_base_axes(&belief.h_Scm_N, &belief.X_NB.rotation);
    match law {
        ArmLaw::Terrestrial => SpatialVelocity::zero(),
        ArmLaw::AttitudeHeld => {
            let push = h_Scm_B.force - M.momentum_of_rates(qdot).force;
            SpatialVelocity::new(Vec3::zero(), push * (T::one() / M.M_bb.mass))
        }
        ArmLaw::FreeFloating => base_twist(M, &h_Scm_B, qdot),
    }
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

/// Joint motion that gives the tool a wanted motion. Accelerations are the exact derivatives of the
/// rates: the law is run once more over dual numbers.
pub fn resolved_motion<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    dual_robot: &Robot<Dual<T>, J>,
    to: &Assignment<T>,
    belief: &Belief<T, J>,
    wanted: &WantedMotion<T>,
    joints: &JointUse<T, J>,
) -> ResolvedMotion<T, J> {
    let rate = joint_rates(robot, to, belief, &wanted.V_NE, joints);
    let moving = in_motion(belief, &rate);
    let V = dual_velocity(&wanted.V_NE, &wanted.Vdot_NE);
    let constant = |x: T| Dual::new(x, T::zero());
    let joints = JointUse {
        gain: Dual::new(joints.gain, joints.gain_rate),
        gain_rate: constant(joints.gain_rate),
        posture: joints.posture.map(constant),
        rate_limit: joints.rate_limit.map(constant),
    };
    let found = joint_rates(dual_robot, &over_duals(to), &moving, &V, &joints);
    ResolvedMotion {
        rate,
        qddot: found.qdot.map(|x| x.derivative),
        A_NB_B: derivative(&found.V_NB_B),
    }
}

/// The same for joint motion that is given: how the base is believed to answer it.
pub fn answered_motion<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    dual_robot: &Robot<Dual<T>, J>,
    law: ArmLaw,
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let rate = Resolved { qdot: *qdot, V_NB_B: answered_twist(robot, law, belief, qdot) };
    let dual_rates = core::array::from_fn(|j| Dual::new(qdot[j], qddot[j]));
    let V_NB_B = answered_twist(dual_robot, law, &in_motion(belief, &rate), &dual_rates);
    ResolvedMotion { rate, qddot: *qddot, A_NB_B: derivative(&V_NB_B) }
}

/// Base twist `V_NB_B` with which the base is believed to answer joint rates.
pub(crate) fn answered_twist<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    belief: &Belief<T, J>,
    qdot: &[T; J],
) -> SpatialVelocity<T> {
    let still = State { X_NB: belief.X_NB, q: belief.q, ..State::default() };
    believed_base_twist(law, belief, &mass_matrix(&kinematics(robot, &still)), qdot)
}

/// A belief that moves at the given rates.
fn in_motion<T: Real, const J: usize>(
    belief: &Belief<T, J>,
    rate: &Resolved<T, J>,
) -> Belief<Dual<T>, J> {
    let (R, p) = (belief.X_NB.rotation, belief.X_NB.translation);
    let (Rdot, pdot) = (R * rate.V_NB_B.angular.skew(), R * rate.V_NB_B.linear);
    let rotation = Mat3 { rows: core::array::from_fn(|i| dual_vector(R.rows[i], Rdot.rows[i])) };
    let h = &belief.h_Scm_N;
    let constant = |v: Vec3<T>| dual_vector(v, Vec3::zero());
    Belief {
        X_NB: Pose::new(rotation, dual_vector(p, pdot)),
        q: core::array::from_fn(|j| Dual::new(belief.q[j], rate.qdot[j])),
        h_Scm_N: SpatialMomentum::new(constant(h.torque), constant(h.force)),
    }
}

fn dual_vector<T: Real>(v: Vec3<T>, vdot: Vec3<T>) -> Vec3<Dual<T>> {
    Vec3 { x: Dual::new(v.x, vdot.x), y: Dual::new(v.y, vdot.y), z: Dual::new(v.z, vdot.z) }
}

fn dual_velocity<T: Real>(
    V: &SpatialVelocity<T>,
    Vdot: &SpatialVelocity<T>,
) -> SpatialVelocity<Dual<T>> {
    SpatialVelocity::new(dual_vector(V.angular, Vdot.angular), dual_vector(V.linear, Vdot.linear))
}

fn derivative<T: Real>(V: &SpatialVelocity<Dual<T>>) -> SpatialAcceleration<T> {
    SpatialAcceleration::new(V.angular.map(|x| x.derivative), V.linear.map(|x| x.derivative))
}

fn over_duals<T: Real>(to: &Assignment<T>) -> Assignment<Dual<T>> {
    let constant = |v: Vec3<T>| dual_vector(v, Vec3::zero());
    let X = &to.tool.X_BF;
    let rotation = Mat3 { rows: X.rotation.rows.map(constant) };
    Assignment {
        tool: Frame { body: to.tool.body, X_BF: Pose::new(rotation, constant(X.translation)) },
        axes: to.axes,
        task: to.task,
        law: to.law,
        damped_below: Dual::new(to.damped_below, T::zero()),
    }
}

/// A pose after a period of motion with a mean twist.
pub(crate) fn moved_on<T: Scalar>(X_NB: &Pose<T>, mean: &SpatialVelocity<T>, period: T) -> Pose<T> {
    let quat = turned_by(Quat::from_matrix(&X_NB.rotation), mean.angular * period);
    // The translation is in axes that turn: half the turn is felt on average.
    let half = Quat::exp(mean.angular * (period * T::from_f64(0.5))).to_matrix();
    let way = X_NB.rotation * (half * mean.linear) * period;
    Pose::from_quat(quat, X_NB.translation + way)
}

//! Momentum management by posture: the arm moves so that a lasting force on the tool asks less of
//! the base.

use super::rate_conditions::RateConditions;
use core::fmt;
use wrasse_dynamics::{
    Frame, Kinematics, angular_momentum_per_rate, attitude_held_jacobian, base_rows, jacobian,
};
use wrasse_spatial::{Scalar, SpatialForce, SpatialVelocity, Vec3};

/// What of the tool must stay as it is, in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToolTask {
    /// Nothing: the tool takes the force wherever it is.
    Free,
    /// How it is turned.
    Orientation,
    /// Where it is.
    Position,
    /// Both.
    Pose,
}

/// How the joints may be used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostureUnloadingUse<T, const J: usize> {
    /// What of the tool must stay.
    pub task: ToolTask,
    /// Rate at which what can be lowered should fade (1/s).
    pub gain: T,
    /// Largest rate of each joint (rad/s or m/s): where one would pass it, all are slowed down.
    pub rate_limit: [T; J],
}

/// A motion that lowers what the base must store.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostureUnloading<T, const J: usize> {
    /// Joint rates (rad/s or m/s); they do not turn the base.
    pub qdot: [T; J],
    /// What the base must store per second now, inertial axes (N·m).
    pub demand_N: Vec3<T>,
    /// How that changes with the motion, inertial axes (N·m/s).
    pub demand_rate_N: Vec3<T>,
    /// What is left of it in the best posture that could be (N·m).
    pub least: T,
}

/// Why no motion of the joints lowers what the base must store.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum NoPostureUnloading<T> {
    /// The tool feels no force; a torque asks the same of the base in any posture.
    NoForce {
        /// What the base must store per second (N·m).
        demand: T,
    },
    /// The line of the force passes through the centre of mass already.
    AlreadyLeast {
        /// What the base must store per second (N·m).
        demand: T,
    },
    /// The conditions use up all the joints.
    NoFreedom {
        /// Joints of the vehicle.
        joints: usize,
        /// Independent conditions: base not turned, tool held.
        conditions: usize,
        /// What the base must store per second (N·m).
        demand: T,
    },
    /// The tool's place is held, and only an outside force moves the centre of mass: the lever
    /// between them is the same in every posture.
    LeverHeld {
        /// Joint motions that are free, and of no use.
        freedom: usize,
        /// Distance of the centre of mass from the line of the force that the wrench amounts to (m).
        lever: T,
        /// What the base must store per second (N·m).
        demand: T,
    },
    /// From this posture no allowed motion changes the lever.
    NotFromHere {
        /// Joint motions that are free.
        freedom: usize,
        /// What the base must store per second (N·m).
        demand: T,
    },
}

impl<T: Scalar> fmt::Display for NoPostureUnloading<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let demand = match *self {
            Self::NoForce { demand } => {
                write!(f, "the tool feels no force, and a torque weighs the same in any posture")?;
                demand
            }
            Self::AlreadyLeast { demand } => {
                write!(f, "the force already passes through the centre of mass")?;
                demand
            }
            Self::NoFreedom { joints, conditions, demand } => {
                write!(f, "{conditions} conditions leave {joints} joints no motion")?;
                demand
            }
            Self::LeverHeld { freedom, lever, demand } => {
                let lever = lever.to_f64();
                write!(
                    f,
                    "the tool stays where it is and no joint moves the centre of mass: the "
                )?;
                write!(f, "lever stays {lever:.3} m, whatever the {freedom} free motions do")?;
                demand
            }
            Self::NotFromHere { freedom, demand } => {
                write!(f, "none of the {freedom} free motions changes the lever in this posture")?;
                demand
            }
        };
        let demand = demand.to_f64();
        write!(
            f,
            "; the base must store {demand:.3} N·m·s every second, or the load path must be "
        )?;
        write!(f, "closed: a second arm or a grapple takes the reaction")
    }
}
impl<T: Scalar> core::error::Error for NoPostureUnloading<T> {}

/// Momentum that the base must store per second while a wrench acts on the tool, arm and attitude
/// held (N·m, inertial axes): `(p_E - p_cm) × f + τ`, with the wrench at the tool's origin.
///
/// The force also pushes the centre of mass, along itself: from rest that does not change the lever.
pub fn momentum_rate<T: Scalar, const J: usize>(
    k: &Kinematics<'_, T, J>,
    tool: &Frame<T>,
    F_E_N: &SpatialForce<T>,
) -> Vec3<T> {
    let (_, p_NScm_N) = k.centre_of_mass();
    F_E_N.about(p_NScm_N - k.pose(tool).translation).torque
}

/// Rates below this share of the wanted ones are not worth the motion.
const WORTH: f64 = 1e-3;

/// Joint rates that bring the line of a lasting force on the tool closer to the centre of mass and do
/// not turn the base: the steepest way down among those.
///
/// They lower what must be stored from now on; what is stored stays stored. Travel of the joints and
/// obstacles are the caller's.
///
/// # Errors
/// [`NoPostureUnloading`]: why there is no such motion.
///
/// # Source
/// The reaction null space of [`Nenchev1992`](wrasse_spatial::references::Nenchev1992), with the
/// tool's conditions added.
pub fn unload_by_posture<T: Scalar, const J: usize>(
    k: &Kinematics<'_, T, J>,
    tool: &Frame<T>,
    F_E_N: &SpatialForce<T>,
    joints: &PostureUnloadingUse<T, J>,
) -> Result<PostureUnloading<T, J>, NoPostureUnloading<T>> {
    let M = base_rows(k);
    let J_held = attitude_held_jacobian(&jacobian(k, tool), &M, &k.state.X_NB.rotation).columns();
    let conditions = held(&angular_momentum_per_rate(&M), &J_held, joints.task);
    let demand_N = momentum_rate(k, tool, F_E_N);
    // Only what stands across the force can change: (v × f) does.
    let (force, demand) = (F_E_N.force, demand_N.norm());
    let square = force.dot(force);
    if square <= T::zero() {
        return Err(NoPostureUnloading::NoForce { demand });
    }
    let along_N = force * (demand_N.dot(force) / square);
    let across_N = demand_N - along_N;
    let lever = across_N.norm() / square.sqrt();
    let distance = (k.pose(tool).translation - k.centre_of_mass().1).norm();
    if lever <= (distance + demand / square.sqrt()) * T::epsilon() * T::from_f64(1e3) {
        return Err(NoPostureUnloading::AlreadyLeast { demand });
    }
    let (count, held) = (k.robot.joint_count(), conditions.count());
    let freedom = count.saturating_sub(held);
    match joints.task {
        _ if freedom == 0 => {
            return Err(NoPostureUnloading::NoFreedom { joints: count, conditions: held, demand });
        }
        ToolTask::Position | ToolTask::Pose => {
            return Err(NoPostureUnloading::LeverHeld { freedom, lever, demand });
        }
        ToolTask::Free | ToolTask::Orientation => {}
    }
    // D · (v × f) = v · (f × D): how each joint raises half the square of the demand.
    let uphill = J_held.map(|V| V.linear.dot(force.cross(across_N)));
    let qdot = downhill(&conditions.across(&uphill), &uphill, across_N.dot(across_N), joints)
        .ok_or(NoPostureUnloading::NotFromHere { freedom, demand })?;
    let moved = J_held.iter().zip(&qdot);
    let V_N = moved.fold(SpatialVelocity::zero(), |sum, (V, &rate)| sum + *V * rate);
    Ok(PostureUnloading {
        qdot,
        demand_N,
        demand_rate_N: V_N.linear.cross(force),
        least: along_N.norm(),
    })
}

/// Base not turned, and what of the tool must stay.
fn held<T: Scalar, const J: usize>(
    H_w: &[Vec3<T>; J],
    J_held: &[SpatialVelocity<T>; J],
    task: ToolTask,
) -> RateConditions<T, J> {
    let rows = |of: &dyn Fn(usize) -> Vec3<T>| {
        let columns: [_; J] = core::array::from_fn(|j| of(j).to_array());
        [0, 1, 2].map(|r| columns.map(|column| column[r]))
    };
    let base = RateConditions::none().and(rows(&|j| H_w[j]));
    let turned = |c: RateConditions<T, J>| c.and(rows(&|j| J_held[j].angular));
    let moved = |c: RateConditions<T, J>| c.and(rows(&|j| J_held[j].linear));
    match task {
        ToolTask::Free => base,
        ToolTask::Orientation => turned(base),
        ToolTask::Position => moved(base),
        ToolTask::Pose => moved(turned(base)),
    }
}

/// Rates against the slope with which `square` fades at the wanted gain, slowed down to the limits;
/// nothing if there is no slope, or the limits let it fade too slowly.
fn downhill<T: Scalar, const J: usize>(
    allowed: &[T; J],
    uphill: &[T; J],
    square: T,
    joints: &PostureUnloadingUse<T, J>,
) -> Option<[T; J]> {
    let sum = |of: &[T; J]| of.iter().fold(T::zero(), |sum, &x| sum + x * x);
    let (slope, whole) = (sum(allowed), sum(uphill));
    let floor = T::epsilon() * T::from_f64(1e3);
    if slope <= whole * floor * floor || slope <= T::zero() {
        return None;
    }
    let qdot = allowed.map(|g| -(g * (joints.gain * square / slope)));
    let shares = qdot.iter().zip(&joints.rate_limit);
    let share = shares.fold(T::one(), |share, (rate, &limit)| {
        if rate.abs() > limit { share.min(limit / rate.abs()) } else { share }
    });
    let possible = qdot.iter().all(|rate| rate.is_finite()) && share > T::from_f64(WORTH);
    possible.then(|| qdot.map(|rate| rate * share))
}

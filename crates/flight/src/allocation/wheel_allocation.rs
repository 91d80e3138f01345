//! Wheel allocation: which motor turns which wheel how hard.

use super::GroupAllocation;
use super::least_peak::least_peak;
use super::span::{all_finite, least_norm, share_that_fits, sum};
use wrasse_hardware::{ReactionWheel, WHEELS};
use wrasse_spatial::{Scalar, Vec3};

/// What is least when wheels share a torque, each measured against its own limit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum WheelSharing {
    /// The sum of squares.
    #[default]
    PseudoInverse,
    /// The largest.
    MinimumPeak,
}

/// How wheels share a torque, and how they are brought back to even speeds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WheelLaw<T> {
    /// What is least.
    pub sharing: WheelSharing,
    /// Rate at which the speeds are evened out without torque on the base (1/s); zero: not at all.
    pub null_gain: T,
}

/// Motor torques (N·m) whose sum on the wheels is what is wanted; the base feels the opposite.
///
/// The sum keeps its direction when limits cut it. No wheel is driven beyond its speed limit within the
/// period: the others take over. What is then left of the limits evens out the speeds, with no torque in sum.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `usable` | whether each wheel is to be used | – |
/// | `wanted_B` | change of the wheels' momentum, base axes | N·m |
/// | `speeds` | speed of each wheel against the base | rad/s |
/// | `period` | control period over which the torques act | s |
///
/// # Source
/// [`Wie2008`](wrasse_spatial::references::Wie2008) ch. 7 for the pseudo-inverse;
/// [`Markley2010`](wrasse_spatial::references::Markley2010) for the least peak.
pub fn wheel_torques<T: Scalar>(
    wheels: &[ReactionWheel<T>],
    usable: &[bool; WHEELS],
    law: &WheelLaw<T>,
    wanted_B: Vec3<T>,
    speeds: &[T; WHEELS],
    period: T,
) -> GroupAllocation<T, WHEELS> {
    let wheel = |k: usize| wheels.get(k).copied().unwrap_or_default();
    let finite = all_finite(&wanted_B.to_array());
    let used =
        core::array::from_fn(|k| usable[k] && finite && speeds[k].is_finite() && able(&wheel(k)));
    // All is counted in shares of each wheel's torque limit.
    let axes = core::array::from_fn(|k| wheel(k).axis_B * wheel(k).torque_limit);
    let bounds = share_bounds(wheels, speeds, period);
    let shares = shares_within_speed(&axes, used, law.sharing, wanted_B, &bounds);

    let evening = evening_shares(wheels, used, law, speeds);
    let [lower, upper] = bounds;
    let part = share_that_fits(&shares, &evening, &lower, &upper);
    let values = core::array::from_fn(|k| {
        // Round-off must not push a bound.
        let share = (shares[k] + evening[k] * part).min(upper[k]).max(lower[k]);
        share * wheel(k).torque_limit
    });
    let given = core::array::from_fn(|k| wheel(k).axis_B * values[k]);
    GroupAllocation { values, missing_B: wanted_B - sum(&given, &[T::one(); WHEELS]) }
}

/// Whether a wheel has what it takes to give torque.
fn able<T: Scalar>(wheel: &ReactionWheel<T>) -> bool {
    let limits = [wheel.torque_limit, wheel.momentum_limit()];
    all_finite(&limits) && limits.iter().all(|limit| *limit > T::zero())
}

impl WheelSharing {
    fn solve<T: Scalar>(
        self,
        axes: &[Vec3<T>; WHEELS],
        used: [bool; WHEELS],
        wanted: Vec3<T>,
    ) -> [T; WHEELS] {
        match self {
            Self::PseudoInverse => least_norm(axes, &used, wanted),
            Self::MinimumPeak => least_peak(axes, &used, wanted),
        }
    }
}

/// Shares within bounds that give what is wanted, or the part of it that the torque limits let through.
/// Of the wheels that would pass their speed limits, the one that would pass it by most is held to what
/// it may give, and the others share what is left.
fn shares_within_speed<T: Scalar>(
    axes: &[Vec3<T>; WHEELS],
    used: [bool; WHEELS],
    sharing: WheelSharing,
    wanted: Vec3<T>,
    [lower, upper]: &[[T; WHEELS]; 2],
) -> [T; WHEELS] {
    let (mut free, mut held) = (used, [T::zero(); WHEELS]);
    // The torque limits first: beyond them any wheel would pass its speed limit, too.
    let mut shares = sharing.solve(axes, used, wanted);
    let wanted = wanted * (T::one() / peak(&shares));
    shares = cut(shares);
    loop {
        let (mut most, mut passing) = (T::zero(), None);
        for k in (0..WHEELS).filter(|&k| free[k]) {
            let within = shares[k].min(upper[k]).max(lower[k]);
            let bound = if shares[k] > T::zero() { upper[k] } else { lower[k] };
            let beyond = (shares[k] - within).abs();
            // What is beyond the torque limit is cut for all alike.
            if bound.abs() < T::one() && beyond > most {
                (most, passing) = (beyond, Some((k, within)));
            }
        }
        let Some((k, within)) = passing else { return cut(shares) };
        (free[k], held[k]) = (false, within);
        shares = sharing.solve(axes, free, wanted - sum(axes, &held));
        for k in 0..WHEELS {
            shares[k] += held[k];
        }
    }
}

/// The largest share, at least one.
fn peak<T: Scalar>(shares: &[T; WHEELS]) -> T {
    shares.iter().fold(T::one(), |peak, x| peak.max(x.abs()))
}

/// All divided by the largest, if that is above one.
fn cut<T: Scalar>(shares: [T; WHEELS]) -> [T; WHEELS] {
    let peak = peak(&shares);
    shares.map(|x| x / peak)
}

/// Bounds of each wheel's share: the torque limit, and what brings it to its speed limit over a
/// period (s); none towards a speed beyond.
fn share_bounds<T: Scalar>(
    wheels: &[ReactionWheel<T>],
    speeds: &[T; WHEELS],
    period: T,
) -> [[T; WHEELS]; 2] {
    let mut bounds = [[-T::one(); WHEELS], [T::one(); WHEELS]];
    for (k, wheel) in wheels.iter().enumerate().take(WHEELS) {
        let share = |room: T| {
            if room <= T::zero() {
                return T::zero();
            }
            let share = room * wheel.inertia / (wheel.torque_limit * period);
            // Written so that NaN bounds nothing.
            if share < T::one() { share.max(T::zero()) } else { T::one() }
        };
        bounds[0][k] = -share(wheel.speed_limit + speeds[k]);
        bounds[1][k] = share(wheel.speed_limit - speeds[k]);
    }
    bounds
}

/// Shares that even out the speeds: towards the same momentum in sum, shared as the law shares. The
/// difference has no sum, so the base does not feel it.
fn evening_shares<T: Scalar>(
    wheels: &[ReactionWheel<T>],
    used: [bool; WHEELS],
    law: &WheelLaw<T>,
    speeds: &[T; WHEELS],
) -> [T; WHEELS] {
    let mut full = [T::zero(); WHEELS];
    let (mut axes, mut filled) = ([Vec3::zero(); WHEELS], full);
    for (k, wheel) in wheels.iter().enumerate().take(WHEELS).filter(|(k, _)| used[*k]) {
        full[k] = wheel.momentum_limit();
        axes[k] = wheel.axis_B * full[k];
        filled[k] = speeds[k] / wheel.speed_limit;
    }
    let even = law.sharing.solve(&axes, used, sum(&axes, &filled));
    let mut shares = [T::zero(); WHEELS];
    for (k, wheel) in wheels.iter().enumerate().take(WHEELS).filter(|(k, _)| used[*k]) {
        shares[k] = law.null_gain * (even[k] - filled[k]) * full[k] / wheel.torque_limit;
    }
    shares
}

//! Wheel allocation: which motor turns which wheel how hard.

use super::Allocation;
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
/// The sum keeps its direction when limits cut it. A wheel at its speed limit is not driven on: the
/// others take over. What is then left of the limits evens out the speeds, with no torque in sum.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `usable` | whether each wheel is to be used | – |
/// | `wanted_B` | change of the wheels' momentum, base axes | N·m |
/// | `speeds` | speed of each wheel against the base | rad/s |
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
) -> Allocation<T, WHEELS> {
    let wheel = |k: usize| wheels.get(k).copied().unwrap_or_default();
    let finite = all_finite(&wanted_B.to_array());
    let used =
        core::array::from_fn(|k| usable[k] && finite && speeds[k].is_finite() && able(&wheel(k)));
    // All is counted in shares of each wheel's torque limit.
    let axes = core::array::from_fn(|k| wheel(k).axis_B * wheel(k).torque_limit);
    let shares = shares_within_speed(wheels, &axes, used, law.sharing, wanted_B, speeds);
    let peak = shares.iter().fold(T::one(), |peak, x| peak.max(x.abs()));
    let shares = shares.map(|x| x / peak);

    let evening = evening_shares(wheels, used, law, speeds);
    let [lower, upper] = share_bounds(wheels, speeds);
    let part = share_that_fits(&shares, &evening, &lower, &upper);
    let values = core::array::from_fn(|k| {
        // Round-off must not push a bound.
        let share = (shares[k] + evening[k] * part).min(upper[k]).max(lower[k]);
        share * wheel(k).torque_limit
    });
    let given = core::array::from_fn(|k| wheel(k).axis_B * values[k]);
    Allocation { values, missing_B: wanted_B - sum(&given, &[T::one(); WHEELS]) }
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

/// Shares that give what is wanted without driving on a wheel at its speed limit: the one that would
/// be driven hardest is left out, and the others share again.
fn shares_within_speed<T: Scalar>(
    wheels: &[ReactionWheel<T>],
    axes: &[Vec3<T>; WHEELS],
    used: [bool; WHEELS],
    sharing: WheelSharing,
    wanted: Vec3<T>,
    speeds: &[T; WHEELS],
) -> [T; WHEELS] {
    let (mut used, [lower, upper]) = (used, share_bounds(wheels, speeds));
    loop {
        let shares = sharing.solve(axes, used, wanted);
        let (mut worst, mut driven_on) = (T::zero(), None);
        for k in (0..WHEELS).filter(|&k| used[k]) {
            // At its limit a wheel has a bound of zero on one side.
            let bound = if shares[k] > T::zero() { upper[k] } else { lower[k] };
            if bound == T::zero() && shares[k].abs() > worst {
                (worst, driven_on) = (shares[k].abs(), Some(k));
            }
        }
        match driven_on {
            Some(k) => used[k] = false,
            None => return shares,
        }
    }
}

/// Bounds of each wheel's share: the torque limit, but none towards a speed beyond the limit.
fn share_bounds<T: Scalar>(wheels: &[ReactionWheel<T>], speeds: &[T; WHEELS]) -> [[T; WHEELS]; 2] {
    let mut bounds = [[-T::one(); WHEELS], [T::one(); WHEELS]];
    for (k, wheel) in wheels.iter().enumerate().take(WHEELS) {
        if speeds[k] <= -wheel.speed_limit {
            bounds[0][k] = T::zero();
        }
        if speeds[k] >= wheel.speed_limit {
            bounds[1][k] = T::zero();
        }
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

//! CMG steering: which gimbal turns how fast.

use super::GroupAllocation;
use super::cmg_null_motion::null_motion;
use super::span::{all_finite, gram, least_norm, share_that_fits, sum};
use wrasse_hardware::{CMGS, ControlMomentGyro};
use wrasse_spatial::{Scalar, Sym3, Vec3};

/// How the gimbal rates follow from the wanted change of momentum. A is the change of momentum by the
/// angles over the mean momentum of a rotor (–).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum CmgSharing<T> {
    /// `Aᵀ (A Aᵀ)⁻¹`: exact, and helpless at a singularity.
    #[default]
    PseudoInverse,
    /// `Aᵀ (A Aᵀ + k 1)⁻¹`: bounded, and may stay at a singularity for ever.
    SingularityRobust(Damping<T>),
    /// `Aᵀ (A Aᵀ + k E)⁻¹`: E has ones and small waves beside them, which shake it off singularities.
    GeneralizedSingularityRobust(Damping<T>, Waves<T>),
}

/// What is added at a singularity: `k = k0 exp(-μ det A Aᵀ)`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Damping<T> {
    /// k at a singularity (–).
    pub k0: T,
    /// How soon it fades with the distance from the singularity, μ (–).
    pub fading: T,
}

/// Elements beside the diagonal of E: `ε_i = e0 sin(ωt + φ_i)`, at yz, zx, xy.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Waves<T> {
    /// Height e0, well below one (–).
    pub height: T,
    /// Frequency ω (rad/s).
    pub frequency: T,
    /// Phases φ at yz, zx, xy (rad); all different, so that no direction is left out.
    pub phases: [T; 3],
}

/// How CMGs are steered.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CmgLaw<T> {
    /// How the rates follow from the wanted change of momentum.
    pub sharing: CmgSharing<T>,
    /// Gain of the null motion up the gradient of the singularity measure (rad/s); zero: none.
    pub null_gain: T,
}

impl<T: Scalar> CmgLaw<T> {
    /// A time (s) at which the waves stand as they do at `time` (s), at most half a wave from zero; zero
    /// without waves. A clock that is kept so goes on for ever, however few digits it has.
    pub fn within_a_wave(&self, time: T) -> T {
        let CmgSharing::GeneralizedSingularityRobust(_, waves) = self.sharing else {
            return T::zero();
        };
        let (sin, cos) = (waves.frequency * time).sin_cos();
        let within = sin.atan2(cos) / waves.frequency;
        // Waves that stand still need no clock; one that is NaN is set again.
        if within.is_finite() { within } else { T::zero() }
    }
}

/// Gimbal rates (rad/s) that change the CMGs' momentum as wanted; the base feels the opposite.
///
/// At the rate limits all are slowed together, so the direction stays. What is then left of the limits
/// goes to the null motion.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `usable` | whether each gimbal is to be turned | – |
/// | `wanted_B` | change of the CMGs' momentum against the base, base axes | N·m |
/// | `angles` | gimbal angles | rad |
/// | `time` | where the waves stand, on a clock that jumps by whole waves at most | s |
///
/// # Source
/// [`Bedrossian1990`](wrasse_spatial::references::Bedrossian1990) for the robust inverse,
/// [`OhVadali1991`](wrasse_spatial::references::OhVadali1991) for its fading,
/// [`WieBaileyHeiberg2001`](wrasse_spatial::references::WieBaileyHeiberg2001) for the waves.
pub fn cmg_rates<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    usable: &[bool; CMGS],
    law: &CmgLaw<T>,
    wanted_B: Vec3<T>,
    angles: &[T; CMGS],
    time: T,
) -> GroupAllocation<T, CMGS> {
    let finite = all_finite(&wanted_B.to_array());
    let used = used_cmgs(cmgs, usable.map(|usable| usable && finite), angles);
    let mean = mean_momentum(cmgs, used);
    let axes = torque_axes(cmgs, used, mean, angles);
    let rates = law.sharing.rates(&axes, used, wanted_B * (T::one() / mean), time);
    let upper = rate_limits(cmgs, used);
    let excess = |most: T, k: usize| most.max(rates[k].abs() / upper[k]);
    let excess = (0..CMGS).filter(|&k| used[k]).fold(T::one(), excess);
    let rates = rates.map(|rate| rate / excess);

    let null = null_motion(cmgs, &axes, used, mean, angles).map(|rate| rate * law.null_gain);
    let part = share_that_fits(&rates, &null, &upper.map(|rate| -rate), &upper);
    // Round-off must not push a limit.
    let values = core::array::from_fn(|k| (rates[k] + null[k] * part).clamp_to(upper[k]));
    GroupAllocation { values, missing_B: wanted_B - sum(&axes, &values) * mean }
}

/// How far the CMGs are from a singularity: `det A Aᵀ` for rotors of mean momentum one (–). Zero: in
/// some direction no usable gimbal can give torque.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `usable` | whether each gimbal is to be turned | – |
/// | `angles` | gimbal angles | rad |
pub fn cmg_singularity<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    usable: &[bool; CMGS],
    angles: &[T; CMGS],
) -> T {
    let used = used_cmgs(cmgs, *usable, angles);
    let axes = torque_axes(cmgs, used, mean_momentum(cmgs, used), angles);
    determinant(&gram(&axes, &used))
}

/// Determinant of `A Aᵀ`: never below zero but by round-off.
fn determinant<T: Scalar>(G: &Sym3<T>) -> T {
    let [x, y, z] = G.to_mat3().rows;
    x.cross(y).dot(z).max(T::zero())
}

/// Which CMGs can be steered: there, usable, with momentum and a rate.
pub(super) fn used_cmgs<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    usable: [bool; CMGS],
    angles: &[T; CMGS],
) -> [bool; CMGS] {
    let able = |cmg: &ControlMomentGyro<T>| {
        let momentum = cmg.momentum.abs();
        momentum.is_finite() && momentum > T::zero() && cmg.rate_limit > T::zero()
    };
    core::array::from_fn(|k| usable[k] && angles[k].is_finite() && cmgs.get(k).is_some_and(able))
}

/// Largest rate of each gimbal in use (rad/s).
fn rate_limits<T: Scalar>(cmgs: &[ControlMomentGyro<T>], used: [bool; CMGS]) -> [T; CMGS] {
    let limit = |k: usize| cmgs.get(k).filter(|_| used[k]).map(|cmg| cmg.rate_limit);
    core::array::from_fn(|k| limit(k).unwrap_or_default())
}

/// Mean momentum of the rotors in use (N·m·s); one if there is none.
pub(super) fn mean_momentum<T: Scalar>(cmgs: &[ControlMomentGyro<T>], used: [bool; CMGS]) -> T {
    let (mut sum, mut count) = (T::zero(), T::zero());
    for (cmg, _) in cmgs.iter().zip(used).filter(|(_, used)| *used) {
        sum += cmg.momentum.abs();
        count += T::one();
    }
    if count > T::zero() { sum / count } else { T::one() }
}

/// Columns of A: torque axes, base axes, each times its rotor's momentum over the mean (–).
pub(super) fn torque_axes<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    used: [bool; CMGS],
    mean: T,
    angles: &[T; CMGS],
) -> [Vec3<T>; CMGS] {
    let mut axes = [Vec3::zero(); CMGS];
    for (k, cmg) in cmgs.iter().enumerate().take(CMGS).filter(|(k, _)| used[*k]) {
        axes[k] = cmg.torque_axis(angles[k]) * (cmg.momentum / mean);
    }
    axes
}

impl<T: Scalar> CmgSharing<T> {
    /// Rates for a wanted change of momentum over the mean momentum of a rotor (1/s).
    fn rates(
        &self,
        axes: &[Vec3<T>; CMGS],
        used: [bool; CMGS],
        wanted: Vec3<T>,
        time: T,
    ) -> [T; CMGS] {
        let G = gram(axes, &used);
        let (damping, waves) = match self {
            Self::PseudoInverse => return least_norm(axes, &used, wanted),
            Self::SingularityRobust(damping) => (damping, &Waves::default()),
            Self::GeneralizedSingularityRobust(damping, waves) => (damping, waves),
        };
        let k = damping.k0 * T::exp(-damping.fading * determinant(&G));
        let y = (G + waves.at(time).scaled(k)).solve(wanted);
        let rates = axes.map(|axis| axis.dot(y));
        // Without damping a singularity has no inverse.
        if all_finite(&rates) { rates } else { least_norm(axes, &used, wanted) }
    }
}

impl<T: Scalar> Waves<T> {
    /// E at a time (s).
    fn at(&self, time: T) -> Sym3<T> {
        let wave = |phase: T| (self.frequency * time + phase).sin_cos().0 * self.height;
        let [yz, xz, xy] = self.phases.map(wave);
        Sym3 { xy, xz, yz, ..Sym3::diagonal(T::one(), T::one(), T::one()) }
    }
}

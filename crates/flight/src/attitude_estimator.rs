//! Attitude and gyro bias from a rate gyro and a star tracker: the multiplicative extended Kalman
//! filter.

use crate::error_covariance::{ErrorCovariance, ErrorMap, isotropic, mean_of_turn};
use wrasse_hardware::{RateGyro, StarTracker, TrackerReading};
use wrasse_spatial::{Mat3, Quat, Scalar, Sym3, Vec3, turned_by};

#[cfg(doc)]
use wrasse_spatial::references::MarkleyCrassidis2014;

/// Control periods that a star tracker's reading may be old.
pub const TRACKER_MEMORY: usize = 128;
/// Innovations beyond this many standard deviations are refused (–).
const GATE: f64 = 5.0;
/// After this many refusals in a row the filter starts again from the next reading.
const PATIENCE: u32 = 10;
/// How much less is believed of the bias at each restart (–), and down to where (rad/s): 0.57 deg/s, more
/// than any gyro that a star tracker is flown with.
const WIDENING: f64 = 10.0;
const WIDEST_BIAS: f64 = 1e-2;
/// What the arithmetic rounds about each axis, in a period and in a reading (units of ε, rad).
const ROUND_OFF: (f64, f64) = (2.0, 8.0);
/// Least noise of a reading about each axis (rad): a perfect one meets an imperfect model.
const LEAST_NOISE: f64 = 1e-9;

/// What the estimator knows of its sensors and of its own start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimatorSetup<T> {
    /// The gyro. Its bias at the start is what the filter has to find: it does not read it.
    pub gyro: RateGyro<T>,
    /// The star tracker.
    pub tracker: StarTracker<T>,
    /// Standard deviation of the attitude at the start, about each axis (rad).
    pub start_attitude_sigma: T,
    /// Standard deviation of the gyro's bias at the start, about each axis (rad/s).
    pub start_bias_sigma: T,
}

/// What is believed of the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttitudeEstimate<T> {
    /// Attitude, `quat_NB`.
    pub quat_NB: Quat<T>,
    /// Rate by the gyro without its bias, base axes (rad/s).
    pub w_NB_B: Vec3<T>,
    /// Bias of the gyro, base axes (rad/s).
    pub bias_B: Vec3<T>,
    /// Standard deviation of the attitude about the base axis that is known worst (rad).
    pub sigma: T,
    /// Readings of the star tracker that were refused since the start.
    pub refused: u32,
    /// How often the filter started again because it refused one reading after the other.
    pub restarts: u32,
}

/// The filter. The true attitude is `quat_NB exp(a)`, the true bias `bias_B + b`, with small errors
/// a and b in base axes.
#[derive(Debug, Clone)]
pub struct AttitudeEstimator<T> {
    setup: EstimatorSetup<T>,
    quat_NB: Quat<T>,
    bias_B: Vec3<T>,
    covariance: ErrorCovariance<T>,
    past: PastRates<T>,
    /// Standard deviation of the bias at the last start, about each axis (rad/s).
    bias_sigma: T,
    refused: u32,
    refused_in_a_row: u32,
    restarts: u32,
}

/// The measured rates of the last control periods, in a ring.
#[derive(Debug, Clone)]
struct PastRates<T> {
    /// Rate (rad/s, base axes) and period (s).
    ring: [(Vec3<T>, T); TRACKER_MEMORY],
    newest: usize,
}

/// A star tracker's reading, carried to the present.
struct Carried<T> {
    quat_NB: Quat<T>,
    /// How a bias error enters: the innovation is `a + G b` (s).
    G: Mat3<T>,
    /// Noise, base axes as they are now (rad²).
    noise: Sym3<T>,
}

impl<T: Scalar> AttitudeEstimator<T> {
    /// Starts at an attitude, with no bias.
    pub fn new(setup: &EstimatorSetup<T>, quat_NB: Quat<T>) -> Self {
        let (attitude, bias) = (setup.start_attitude_sigma, setup.start_bias_sigma);
        Self {
            setup: *setup,
            quat_NB,
            bias_B: Vec3::zero(),
            covariance: ErrorCovariance::of_sigmas(attitude, bias),
            past: PastRates { ring: [(Vec3::zero(), T::zero()); TRACKER_MEMORY], newest: 0 },
            bias_sigma: bias,
            refused: 0,
            refused_in_a_row: 0,
            restarts: 0,
        }
    }
    /// The estimate after a control period (s), from the mean rate of that period by the gyro
    /// (rad/s, base axes) and the reading of the star tracker that came at its end, if one did. A
    /// period of zero, at the start, only takes the reading.
    ///
    /// # Assumptions
    /// The rate is even within a period and, where the bias enters a late reading, over its
    /// latency. The bias does not walk during a latency.
    ///
    /// # Source
    /// [`MarkleyCrassidis2014`] ch. 6; here the error is in base axes on the right of the
    /// attitude, and the reading is late.
    pub fn step(
        &mut self,
        rate_B: Vec3<T>,
        reading: Option<TrackerReading<T>>,
        period: T,
    ) -> AttitudeEstimate<T> {
        self.propagate(rate_B, period);
        if let Some(reading) = reading {
            self.take(&reading, period);
        }
        AttitudeEstimate {
            quat_NB: self.quat_NB,
            w_NB_B: rate_B - self.bias_B,
            bias_B: self.bias_B,
            sigma: self.sigma(),
            refused: self.refused,
            restarts: self.restarts,
        }
    }
    /// Covariance of the attitude's error, base axes (rad²).
    pub fn attitude_covariance(&self) -> Sym3<T> {
        self.covariance.aa
    }
    /// Covariance of the bias's error, base axes (rad²/s²).
    pub fn bias_covariance(&self) -> Sym3<T> {
        self.covariance.bb
    }
    /// Standard deviation of the attitude about the base axis that is known worst (rad).
    fn sigma(&self) -> T {
        let Sym3 { xx, yy, zz, .. } = self.covariance.aa;
        xx.max(yy).max(zz).sqrt()
    }
    /// Carry attitude and covariance over a period.
    fn propagate(&mut self, rate_B: Vec3<T>, period: T) {
        self.past.push(rate_B, period);
        let u = (rate_B - self.bias_B) * period;
        self.quat_NB = turned_by(self.quat_NB, u);
        // The old error seen from the new axes, and what the bias error turns meanwhile.
        let map = ErrorMap {
            aa: Quat::exp(u).to_matrix().transpose(),
            ab: mean_of_turn(u).scaled(-period),
            ba: Mat3::zero(),
            bb: Mat3::identity(),
        };
        self.covariance = self.covariance.mapped(&map).with(&self.process_noise(period));
    }
    /// What the gyro's noise and its rounding, read once per period, add to the variance of the
    /// angle (rad²/s).
    fn angle_noise(&self, period: T) -> T {
        let RateGyro { angle_random_walk, rate_step, .. } = self.setup.gyro;
        // Rounding errors are even between half a step down and up.
        angle_random_walk * angle_random_walk
            + rate_step * rate_step * period * T::from_f64(1.0 / 12.0)
    }
    /// What the gyro adds over a period.
    fn process_noise(&self, period: T) -> ErrorCovariance<T> {
        let (c, gyro) = (T::from_f64, &self.setup.gyro);
        let walk = gyro.bias_random_walk * gyro.bias_random_walk * period;
        let round_off = T::epsilon() * c(ROUND_OFF.0);
        let angle = self.angle_noise(period) * period + round_off * round_off;
        ErrorCovariance {
            aa: isotropic(angle + walk * period * period * c(1.0 / 3.0)),
            ab: Mat3::identity().scaled(walk * period * c(-0.5)),
            bb: isotropic(walk),
        }
    }
    /// Correct by a reading, or refuse it.
    fn take(&mut self, reading: &TrackerReading<T>, period: T) {
        let Some(carried) = self.carried(reading) else {
            self.refused = self.refused.saturating_add(1);
            return;
        };
        // A late reading knows nothing of the gyro's noise since: set that aside.
        let since = self.angle_noise(period) * reading.age;
        let before = self.covariance.aa - isotropic(since);
        let since = if is_positive(&before) { since } else { T::zero() };
        let then = ErrorCovariance { aa: self.covariance.aa - isotropic(since), ..self.covariance };
        let z = (self.quat_NB.conjugate() * carried.quat_NB).log();
        // Covariance of each error with the innovation, and of the innovation itself.
        let with_a = then.aa.to_mat3() + then.ab * carried.G.transpose();
        let with_b = then.ab.transpose() + then.bb.to_mat3() * carried.G.transpose();
        let S = Sym3::symmetric_part(&(with_a + carried.G * with_b)) + carried.noise;
        // Written so that a NaN innovation is refused as well.
        let fits = z.dot(S.solve(z)) <= T::from_f64(GATE * GATE);
        if !fits {
            self.refuse(&carried);
            return;
        }
        self.refused_in_a_row = 0;
        let gain = |C: Mat3<T>| Mat3 { rows: C.rows.map(|row| S.solve(row)) };
        let (K_a, K_b) = (gain(with_a), gain(with_b));
        self.quat_NB = turned_by(self.quat_NB, K_a * z);
        self.bias_B += K_b * z;
        self.covariance = corrected(&then, &carried, K_a, K_b);
        self.covariance.aa += isotropic(since);
    }
    /// Count a reading that does not fit. After many in a row the filter is wrong, not they: start
    /// again from this one. What is known of the bias is kept, but believed less each time: a bias that
    /// is larger than the filter was told to expect would make it fail for ever.
    fn refuse(&mut self, carried: &Carried<T>) {
        self.refused = self.refused.saturating_add(1);
        self.refused_in_a_row += 1;
        if self.refused_in_a_row < PATIENCE {
            return;
        }
        let c = T::from_f64;
        let widest = self.setup.start_bias_sigma.max(c(WIDEST_BIAS));
        self.bias_sigma = (self.bias_sigma * c(WIDENING)).min(widest);
        self.quat_NB = carried.quat_NB;
        self.covariance =
            ErrorCovariance::of_sigmas(self.setup.start_attitude_sigma, self.bias_sigma);
        self.refused_in_a_row = 0;
        self.restarts = self.restarts.saturating_add(1);
    }
    /// A reading carried from when it was taken to now, by the gyro without its bias. None if it is
    /// NaN, or older than the memory reaches.
    fn carried(&self, reading: &TrackerReading<T>) -> Option<Carried<T>> {
        let turn = self.past.turn_since(reading.age, self.bias_B)?;
        let quat_NB = (reading.quat_NB * turn).normalized();
        let finite = quat_NB.w.is_finite() && quat_NB.vector().dot(quat_NB.vector()).is_finite();
        let StarTracker { boresight_B, noise_across, noise_about, .. } = self.setup.tracker;
        let least = (T::epsilon() * T::from_f64(ROUND_OFF.1)).max(T::from_f64(LEAST_NOISE));
        let across = noise_across * noise_across + least * least;
        let more = (noise_about * noise_about - across).max(T::zero());
        let boresight = turn.to_matrix().transpose() * boresight_B;
        let along = Sym3::symmetric_part(&boresight.outer(boresight)).scaled(more);
        finite.then(|| Carried {
            quat_NB,
            G: mean_of_turn(turn.log()).scaled(reading.age),
            noise: isotropic(across) + along,
        })
    }
}

/// Covariance after a correction by gains, after Joseph: it stays positive in single precision.
fn corrected<T: Scalar>(
    P: &ErrorCovariance<T>,
    carried: &Carried<T>,
    K_a: Mat3<T>,
    K_b: Mat3<T>,
) -> ErrorCovariance<T> {
    let map = ErrorMap {
        aa: Mat3::identity() - K_a,
        ab: Mat3::zero() - K_a * carried.G,
        ba: Mat3::zero() - K_b,
        bb: Mat3::identity() - K_b * carried.G,
    };
    let noise = ErrorCovariance {
        aa: K_a.congruence(carried.noise),
        ab: K_a * carried.noise.to_mat3() * K_b.transpose(),
        bb: K_b.congruence(carried.noise),
    };
    P.mapped(&map).with(&noise)
}

/// Whether a symmetric matrix is positive definite, by its leading minors.
fn is_positive<T: Scalar>(S: &Sym3<T>) -> bool {
    let minor = S.xx * S.yy - S.xy * S.xy;
    let [x, y, z] = S.to_mat3().rows;
    S.xx > T::zero() && minor > T::zero() && x.dot(y.cross(z)) > T::zero()
}

impl<T: Scalar> PastRates<T> {
    /// Remember the rate (rad/s) of the period (s) that ended now.
    fn push(&mut self, rate_B: Vec3<T>, period: T) {
        self.newest = (self.newest + 1) % TRACKER_MEMORY;
        self.ring[self.newest] = (rate_B, period);
    }
    /// Turn of the base in the last `age` (s) by the rates without the bias (rad/s): `quat_BB` from
    /// now to then. None if that is longer than the memory.
    fn turn_since(&self, age: T, bias_B: Vec3<T>) -> Option<Quat<T>> {
        let (mut turn, mut left) = (Quat::identity(), age);
        for back in 0..TRACKER_MEMORY {
            if left <= T::zero() {
                return Some(turn);
            }
            let (rate_B, period) =
                self.ring[(self.newest + TRACKER_MEMORY - back) % TRACKER_MEMORY];
            turn = Quat::exp((rate_B - bias_B) * period.min(left)) * turn;
            left -= period;
        }
        // What is missing is round-off of the sum, or beyond the memory.
        (left <= age * T::epsilon() * T::from_f64(TRACKER_MEMORY as f64)).then_some(turn)
    }
}

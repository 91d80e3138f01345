//! A base that turns, and sensors that err as their numbers say.

use nalgebra::Matrix3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use wrasse_flight::{AttitudeEstimate, AttitudeEstimator, EstimatorSetup};
use wrasse_hardware::{RateGyro, StarTracker, TrackerReading};
use wrasse_spatial::{Mat3, Quat, Real, Vec3, vec3};

pub(super) const PERIOD: f64 = 0.1;

pub(super) fn setup() -> EstimatorSetup<f64> {
    EstimatorSetup {
        gyro: RateGyro {
            bias_B: vec3(3e-5, -2e-5, 1e-5),
            angle_random_walk: 1e-5,
            bias_random_walk: 3e-7,
            rate_step: 0.0,
        },
        tracker: StarTracker {
            boresight_B: vec3(0.48, 0.6, -0.64),
            noise_across: 2e-5,
            noise_about: 1.5e-4,
            interval: 0.5,
            latency: 0.2,
            rate_limit: 0.1,
        },
        start_attitude_sigma: 1e-3,
        start_bias_sigma: 3e-5,
    }
}

/// Without noise, walks and steps; the filter still believes in a little of it.
pub(super) fn silent() -> RateGyro<f64> {
    RateGyro { angle_random_walk: 0.0, bias_random_walk: 0.0, ..setup().gyro }
}

/// Normal numbers from a seed, by Box and Muller.
pub(super) struct Normal(pub(super) ChaCha8Rng);

impl Normal {
    pub(super) fn number(&mut self) -> f64 {
        let mut uniform = || ((self.0.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
        let (radius, angle) = (uniform(), uniform());
        (-2.0 * radius.ln()).sqrt() * (core::f64::consts::TAU * angle).cos()
    }
    pub(super) fn vector(&mut self) -> Vec3<f64> {
        vec3(self.number(), self.number(), self.number())
    }
}

/// The truth: a base that turns, and sensors that err as their numbers say.
pub(super) struct Truth {
    pub(super) normal: Normal,
    /// Attitudes at the control instants, oldest first.
    pub(super) quats: Vec<Quat<f64>>,
    pub(super) bias_B: Vec3<f64>,
    pub(super) gyro: RateGyro<f64>,
    pub(super) tracker: StarTracker<f64>,
    /// Rate of the base at a time.
    pub(super) rate: fn(f64) -> Vec3<f64>,
}

impl Truth {
    pub(super) fn new(setup: &EstimatorSetup<f64>, seed: u64) -> Self {
        Self {
            normal: Normal(ChaCha8Rng::seed_from_u64(seed)),
            quats: vec![Quat::exp(vec3(0.4, -1.1, 0.7))],
            bias_B: setup.gyro.bias_B,
            gyro: setup.gyro,
            tracker: setup.tracker,
            rate: swinging,
        }
    }
    pub(super) fn quat_NB(&self) -> Quat<f64> {
        self.quats[self.quats.len() - 1]
    }
    /// One period on; what the gyro says of it.
    pub(super) fn turn(&mut self) -> Vec3<f64> {
        let w = (self.rate)(self.quats.len() as f64 * PERIOD);
        self.quats.push((self.quat_NB() * Quat::exp(w * PERIOD)).normalized());
        let RateGyro { angle_random_walk: N, bias_random_walk: K, rate_step, .. } = self.gyro;
        let before = self.bias_B;
        self.bias_B += self.normal.vector() * (K * PERIOD.sqrt());
        let spread = (N * N / PERIOD + K * K * PERIOD / 12.0).sqrt();
        let said = w + (before + self.bias_B) * 0.5 + self.normal.vector() * spread;
        said.map(|x| if rate_step > 0.0 { (x / rate_step).round() * rate_step } else { x })
    }
    /// What the star tracker says, if a reading is due.
    pub(super) fn reading(&mut self) -> Option<TrackerReading<f64>> {
        let StarTracker { boresight_B: b, noise_across, noise_about, interval, latency, .. } =
            self.tracker;
        let in_periods = |time: f64| (time / PERIOD).round() as usize;
        let (now, late) = (self.quats.len() - 1, in_periods(latency));
        if now % in_periods(interval) != 0 || now < late {
            return None;
        }
        let n = self.normal.vector();
        let error = n * noise_across + b * ((noise_about - noise_across) * n.dot(b));
        Some(TrackerReading { quat_NB: self.quats[now - late] * Quat::exp(error), age: latency })
    }
    /// A filter that starts as wrong as it is told to expect.
    pub(super) fn filter(&mut self, setup: &EstimatorSetup<f64>) -> AttitudeEstimator<f64> {
        let error = self.normal.vector() * setup.start_attitude_sigma;
        self.bias_B = self.normal.vector() * setup.start_bias_sigma;
        AttitudeEstimator::new(setup, self.quat_NB() * Quat::exp(error))
    }
    /// So many periods of a filter.
    pub(super) fn run(
        &mut self,
        filter: &mut AttitudeEstimator<f64>,
        periods: u32,
    ) -> AttitudeEstimate<f64> {
        let mut last = None;
        for _ in 0..periods {
            let said = self.turn();
            last = Some(filter.step(said, self.reading(), PERIOD));
        }
        last.expect("at least one period")
    }
    /// Error of an estimate about the base axes (rad).
    pub(super) fn error(&self, estimate: &AttitudeEstimate<f64>) -> Vec3<f64> {
        (estimate.quat_NB.conjugate() * self.quat_NB()).log()
    }
}

pub(super) fn swinging(time: f64) -> Vec3<f64> {
    let (s, c) = Real::sin_cos(0.3 * time);
    vec3(0.02, -0.03, 0.01) + vec3(s, 0.5 * c, -s) * 0.02
}

pub(super) fn steady(_: f64) -> Vec3<f64> {
    vec3(0.02, -0.03, 0.05)
}

pub(super) fn still(_: f64) -> Vec3<f64> {
    Vec3::zero()
}

/// nalgebra's matrix of a 3×3.
pub(super) fn matrix(m: Mat3<f64>) -> Matrix3<f64> {
    Matrix3::from_row_iterator(m.rows.iter().flat_map(|row| row.to_array()))
}

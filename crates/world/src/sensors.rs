//! Sensors as they behave: rate gyro, star tracker, joint encoders.

use crate::noise::Noise;
use std::collections::VecDeque;
use wrasse_hardware::{RateGyro, Sensors, StarTracker, TrackerReading};
use wrasse_spatial::{Quat, Vec3, turned_by, vec3};

#[cfg(doc)]
use wrasse_spatial::references::MarkleyCrassidis2014;

/// Streams of the seed that the sensors draw from; lower numbers are left to the actuators.
const GYRO_STREAM: u64 = 1 << 32;
const BIAS_STREAM: u64 = GYRO_STREAM + 1;
const TRACKER_STREAM: u64 = GYRO_STREAM + 2;

/// Part of a period by which an instant may fall short of a due time and still meet it: round-off.
const ON_TIME: f64 = 1e-6;

/// What the sensors say at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorReadings<const J: usize> {
    /// Rate of the base by the gyro, mean over the period that ends now, base axes (rad/s).
    pub w_NB_B: Vec3<f64>,
    /// What the star tracker delivers now.
    pub tracker: Option<TrackerReading<f64>>,
    /// Whether a reading of the star tracker is missing because the base turned too fast.
    pub blinded: bool,
    /// Joint positions by the encoders (rad or m).
    pub q: [f64; J],
}

/// The sensors of a vehicle, and what they remember.
#[derive(Debug, Clone)]
pub struct SensorSuite {
    attitude: Option<AttitudeSensors>,
    encoder_step: f64,
}

#[derive(Debug, Clone)]
struct AttitudeSensors {
    gyro: RateGyro<f64>,
    /// Present bias of the gyro, base axes (rad/s).
    bias_B: Vec3<f64>,
    gyro_noise: Noise,
    bias_noise: Noise,
    tracker: StarTracker<f64>,
    tracker_noise: Noise,
    /// Readings of the tracker that have been due.
    readings_due: f64,
    /// What the tracker can still look back to, oldest first.
    past: VecDeque<Moment>,
}

/// How the base was.
#[derive(Debug, Clone, Copy)]
struct Moment {
    /// Time (s).
    time: f64,
    quat_NB: Quat<f64>,
    /// Magnitude of the base's rate (rad/s).
    rate: f64,
}

impl SensorSuite {
    /// Sensors at the start of a run. The same seed gives the same readings.
    pub fn new(sensors: Sensors<f64>, seed: u64) -> Self {
        let attitude = sensors.attitude.map(|(gyro, tracker)| AttitudeSensors {
            gyro,
            bias_B: gyro.bias_B,
            gyro_noise: Noise::new(seed, GYRO_STREAM),
            bias_noise: Noise::new(seed, BIAS_STREAM),
            tracker,
            tracker_noise: Noise::new(seed, TRACKER_STREAM),
            readings_due: 0.0,
            past: VecDeque::new(),
        });
        Self { attitude, encoder_step: sensors.encoder_step }
    }
    /// Readings at a time (s), once per `period` (s), of the true attitude, rate (rad/s, base axes)
    /// and joint positions (rad or m). Without attitude sensors attitude and rate are exact.
    ///
    /// # Source
    /// [`MarkleyCrassidis2014`] p. 147 for the gyro.
    pub fn read<const J: usize>(
        &mut self,
        quat_NB: Quat<f64>,
        w_NB_B: Vec3<f64>,
        q: &[f64; J],
        time: f64,
        period: f64,
    ) -> SensorReadings<J> {
        let q = q.map(|q| rounded(q, self.encoder_step));
        let Some(sensors) = &mut self.attitude else {
            let tracker = Some(TrackerReading { quat_NB, age: 0.0 });
            return SensorReadings { w_NB_B, tracker, blinded: false, q };
        };
        let before = sensors.past.back().copied();
        sensors.past.push_back(Moment { time, quat_NB, rate: w_NB_B.norm() });
        // A gyro adds up the turn. Before the first period has passed there is only the rate.
        let mean_rate_B = before
            .map_or(w_NB_B, |before| (before.quat_NB.conjugate() * quat_NB).log() * (1.0 / period));
        let w_NB_B = sensors.rate_reading(mean_rate_B, period);
        let (tracker, blinded) = match sensors.seen(time, period) {
            Seen::Stars(reading) => (Some(reading), false),
            Seen::Smear => (None, true),
            Seen::NothingYet => (None, false),
        };
        SensorReadings { w_NB_B, tracker, blinded, q }
    }
    /// Present bias of the gyro, base axes (rad/s); zero without one.
    pub fn gyro_bias(&self) -> Vec3<f64> {
        self.attitude.as_ref().map_or(Vec3::zero(), |sensors| sensors.bias_B)
    }
}

/// What the star tracker makes of an instant.
enum Seen {
    Stars(TrackerReading<f64>),
    /// A reading is due, but the base turned too fast.
    Smear,
    NothingYet,
}

impl AttitudeSensors {
    /// Rate by the gyro from the true mean rate over the period: bias, its walk, noise, rounding.
    fn rate_reading(&mut self, mean_rate_B: Vec3<f64>, period: f64) -> Vec3<f64> {
        let RateGyro { angle_random_walk, bias_random_walk, rate_step, .. } = self.gyro;
        let before = self.bias_B;
        self.bias_B += normal_vector(&mut self.bias_noise) * (bias_random_walk * period.sqrt());
        // Between its two ends the walk of the bias strays; the mean of that is the second term.
        let variance = angle_random_walk * angle_random_walk / period
            + bias_random_walk * bias_random_walk * period / 12.0;
        let mean_bias = (before + self.bias_B) * 0.5;
        let noise = normal_vector(&mut self.gyro_noise) * variance.sqrt();
        (mean_rate_B + mean_bias + noise).map(|rate| rounded(rate, rate_step))
    }
    /// The reading of the star tracker that is due now: attitude as it was `latency` ago.
    fn seen(&mut self, time: f64, period: f64) -> Seen {
        let StarTracker { interval, latency, rate_limit, .. } = self.tracker;
        let slack = ON_TIME * period;
        let due = interval <= period || time + slack >= self.readings_due * interval;
        let Some((earlier, later)) = self.moments_around(time - latency, slack) else {
            return Seen::NothingYet;
        };
        if !due {
            return Seen::NothingYet;
        }
        self.readings_due = ((time + slack) / interval).floor() + 1.0;
        if earlier.rate > rate_limit || later.rate > rate_limit {
            return Seen::Smear;
        }
        let turn_B = (earlier.quat_NB.conjugate() * later.quat_NB).log();
        let span = later.time - earlier.time;
        let part = if span > 0.0 { (time - latency - earlier.time) / span } else { 0.0 };
        let then = turned_by(earlier.quat_NB, turn_B * part);
        Seen::Stars(TrackerReading {
            quat_NB: turned_by(then, self.pointing_noise()),
            age: latency,
        })
    }
    /// The two moments around a time (s), which may be one and the same; older ones are forgotten.
    /// None while the memory does not reach back that far.
    fn moments_around(&mut self, time: f64, slack: f64) -> Option<(Moment, Moment)> {
        while self.past.get(1).is_some_and(|next| next.time <= time + slack) {
            self.past.pop_front();
        }
        let earlier = *self.past.front().filter(|first| first.time <= time + slack)?;
        Some((earlier, self.past.get(1).copied().unwrap_or(earlier)))
    }
    /// Error of a reading of the star tracker as a rotation vector, base axes (rad).
    fn pointing_noise(&mut self) -> Vec3<f64> {
        let StarTracker { boresight_B, noise_across, noise_about, .. } = self.tracker;
        let n = normal_vector(&mut self.tracker_noise);
        n * noise_across + boresight_B * ((noise_about - noise_across) * n.dot(boresight_B))
    }
}

/// Three normal numbers of standard deviation 1 (–).
fn normal_vector(noise: &mut Noise) -> Vec3<f64> {
    vec3(noise.normal(), noise.normal(), noise.normal())
}

/// The nearest multiple of a step; a step of zero rounds nothing.
fn rounded(x: f64, step: f64) -> f64 {
    if step > 0.0 { (x / step).round() * step } else { x }
}

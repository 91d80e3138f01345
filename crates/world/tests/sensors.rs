//! Each sensor against its own numbers: what it says, when, and how far off.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use wrasse_hardware::{RateGyro, Sensors, StarTracker};
use wrasse_spatial::{Quat, Vec3, vec3};
use wrasse_testing::larger;
use wrasse_world::{SensorReadings, SensorSuite};

const PERIOD: f64 = 0.1;

fn gyro() -> RateGyro<f64> {
    RateGyro {
        bias_B: vec3(3e-5, -2e-5, 1e-5),
        angle_random_walk: 4e-5,
        bias_random_walk: 2e-6,
        rate_step: 0.0,
    }
}

fn tracker() -> StarTracker<f64> {
    StarTracker {
        boresight_B: vec3(0.48, 0.6, -0.64),
        noise_across: 2e-5,
        noise_about: 1.5e-4,
        interval: 0.5,
        latency: 0.0,
        rate_limit: 0.1,
    }
}

fn noiseless() -> StarTracker<f64> {
    StarTracker { noise_across: 0.0, noise_about: 0.0, ..tracker() }
}

/// Rate of the base (rad/s): below what blinds the tracker.
fn turning() -> Vec3<f64> {
    vec3(0.02, -0.03, 0.05)
}

/// A base that turns steadily from a general attitude.
fn attitude(w_NB_B: Vec3<f64>, time: f64) -> Quat<f64> {
    Quat::exp(vec3(0.4, -1.1, 0.7)) * Quat::exp(w_NB_B * time)
}

fn suite(gyro: RateGyro<f64>, tracker: StarTracker<f64>, seed: u64) -> SensorSuite {
    SensorSuite::new(Sensors { attitude: Some((gyro, tracker)), encoder_step: 0.0 }, seed)
}

/// Readings number 0 to `count` of a steadily turning base.
fn readings(mut suite: SensorSuite, w_NB_B: Vec3<f64>, count: u32) -> Vec<SensorReadings<0>> {
    let at = |k| f64::from(k) * PERIOD;
    let each = 0..=count;
    each.map(|k| suite.read(attitude(w_NB_B, at(k)), w_NB_B, &[], at(k), PERIOD)).collect()
}

/// How many of its standard deviations a mean square of `count` normal numbers is off.
fn off(mean_square: f64, expected: f64, count: usize) -> f64 {
    (mean_square / expected - 1.0) / (2.0 / count as f64).sqrt()
}

/// Components of all the vectors squared, mean.
fn mean_square(of: &[Vec3<f64>]) -> f64 {
    of.iter().map(|v| v.dot(*v)).sum::<f64>() / (3 * of.len()) as f64
}

/// With a bias that stays. Bounds are five standard deviations: one try in two million is beyond. Measured
/// -1.5 at most of the mean, 0.3 of the spread.
#[test]
fn a_gyro_is_off_by_its_bias_and_by_noise_of_its_density() {
    let still_biased = RateGyro { bias_random_walk: 0.0, ..gyro() };
    let said = readings(suite(still_biased, tracker(), 1), turning(), 20_000);
    let errors: Vec<_> = said.iter().map(|s| s.w_NB_B - turning() - still_biased.bias_B).collect();
    let noise = still_biased.angle_random_walk / PERIOD.sqrt();
    let mean = errors.iter().fold(Vec3::zero(), |sum, &e| sum + e) * (1.0 / errors.len() as f64);
    let mean_off = mean * ((errors.len() as f64).sqrt() / noise);
    let spread_off = off(mean_square(&errors), noise * noise, 3 * errors.len());
    assert!(mean_off.to_array().iter().all(|m| m.abs() < 5.0), "{mean_off:?}");
    assert!(spread_off.abs() < 5.0, "{spread_off}");
}

/// Allan variance of white noise: `N²/τ`. Half the mean square of the difference of neighbouring
/// means over τ. Measured 0.3, 1.1 and 1.6 standard deviations.
#[test]
fn means_over_longer_times_calm_down_as_white_noise_does() {
    let still_biased = RateGyro { bias_random_walk: 0.0, ..gyro() };
    let said = readings(suite(still_biased, tracker(), 2), turning(), 40_000);
    for cluster in [1_usize, 10, 100] {
        let means: Vec<Vec3<f64>> = said
            .chunks_exact(cluster)
            .map(|c| c.iter().fold(Vec3::zero(), |s, r| s + r.w_NB_B) * (1.0 / cluster as f64))
            .collect();
        // Pairs apart from each other, so that they are independent.
        let steps: Vec<_> = means.chunks_exact(2).map(|pair| pair[1] - pair[0]).collect();
        let tau = cluster as f64 * PERIOD;
        let expected = still_biased.angle_random_walk * still_biased.angle_random_walk / tau;
        let off = off(0.5 * mean_square(&steps), expected, 3 * steps.len());
        assert!(off.abs() < 5.0, "over {tau} s: {off} standard deviations");
    }
}

/// The angle that a gyro adds up is off by `N²τ + K²τ³/3` (variance), the start's bias known. At
/// 20 s and 100 s first the noise, then the bias decides. Measured -0.7 and 0.1 standard deviations.
#[test]
fn the_angle_of_a_gyro_strays_by_both_of_its_walks() {
    let RateGyro { bias_B, angle_random_walk: N, bias_random_walk: K, .. } = gyro();
    let mut after = [Vec::new(), Vec::new()];
    for seed in 0..200 {
        let said = readings(suite(gyro(), tracker(), seed), turning(), 1000);
        let mut angle = Vec3::zero();
        for (k, reading) in said.iter().enumerate().skip(1) {
            angle += (reading.w_NB_B - turning() - bias_B) * PERIOD;
            match k {
                200 => after[0].push(angle),
                1000 => after[1].push(angle),
                _ => {}
            }
        }
    }
    for (angles, tau) in after.iter().zip([20.0, 100.0]) {
        // The first reading, before the first period, walks the bias by one period more.
        let walk = K * K * tau * tau * (tau / 3.0 + PERIOD);
        let off = off(mean_square(angles), N * N * tau + walk, 3 * angles.len());
        assert!(off.abs() < 5.0, "after {tau} s: {off} standard deviations");
    }
}

#[test]
fn a_gyro_speaks_in_steps() {
    let step = 1e-4;
    let coarse = RateGyro { rate_step: step, angle_random_walk: 0.0, ..gyro() };
    let silent = RateGyro { bias_random_walk: 0.0, ..coarse };
    for reading in readings(suite(silent, tracker(), 3), turning(), 20) {
        let error = reading.w_NB_B - turning() - silent.bias_B;
        for (said, error) in reading.w_NB_B.to_array().into_iter().zip(error.to_array()) {
            // The true rate comes from two attitudes: 1e-16 rad over a period of 0.1 s.
            assert!((said / step - (said / step).round()).abs() < 1e-10);
            assert!(error.abs() <= 0.5 * step + 1e-14, "{error}");
        }
    }
}

/// An oblique boresight. Five standard deviations; about it and across it they differ by 7.5 times.
/// Measured 1.0 and 0.7.
#[test]
fn a_star_tracker_is_sharp_across_its_boresight_and_dull_about_it() {
    let said = readings(suite(gyro(), tracker(), 4), turning(), 20_000);
    let (b, mut about, mut across, mut count) = (tracker().boresight_B, 0.0, 0.0, 0);
    for (k, reading) in said.iter().enumerate() {
        let Some(seen) = reading.tracker else { continue };
        let truth = attitude(turning(), k as f64 * PERIOD);
        let error = (truth.conjugate() * seen.quat_NB).log();
        let along = error.dot(b);
        about += along * along;
        across += error.dot(error) - along * along;
        count += 1;
    }
    let StarTracker { noise_about, noise_across, .. } = tracker();
    let n = f64::from(count);
    let about_off = off(about / n, noise_about * noise_about, 4001);
    let across_off = off(across / (2.0 * n), noise_across * noise_across, 8002);
    assert_eq!(count, 4001);
    assert!(about_off.abs() < 5.0 && across_off.abs() < 5.0, "{about_off} {across_off}");
}

/// Also between two instants. The round-off of the turn between them: measured 5e-16 rad.
#[test]
fn a_reading_shows_the_attitude_as_it_was_a_latency_ago() {
    for latency in [0.0, 0.2, 0.137, 0.04] {
        let late = StarTracker { latency, ..noiseless() };
        let said = readings(suite(gyro(), late, 5), turning(), 50);
        let mut worst = 0.0_f64;
        for (k, reading) in said.iter().enumerate() {
            let Some(seen) = reading.tracker else { continue };
            let then = attitude(turning(), k as f64 * PERIOD - latency);
            worst = larger(worst, (then.conjugate() * seen.quat_NB).log().norm());
            assert_eq!(seen.age, latency);
        }
        assert!(worst < 1e-15, "latency {latency} s: off by {worst:e} rad");
    }
}

/// The first as soon as there is a past to look at.
#[test]
fn readings_come_once_an_interval() {
    let come = |tracker, count| {
        let said = readings(suite(gyro(), tracker, 6), turning(), count);
        let at = said.iter().enumerate().filter(|(_, said)| said.tracker.is_some());
        at.map(|(k, _)| k).collect::<Vec<_>>()
    };
    assert_eq!(come(noiseless(), 20), [0, 5, 10, 15, 20]);
    assert_eq!(come(StarTracker { latency: 0.21, ..noiseless() }, 20), [3, 5, 10, 15, 20]);
    assert_eq!(come(StarTracker { interval: 0.25, ..noiseless() }, 10), [0, 3, 5, 8, 10]);
    assert_eq!(come(StarTracker { interval: 0.05, ..noiseless() }, 5), [0, 1, 2, 3, 4, 5]);
    // Ten thousand intervals later still on time.
    assert_eq!(come(StarTracker { interval: 0.3, ..noiseless() }, 30_000).len(), 10_001);
}

#[test]
fn a_base_that_turns_too_fast_blinds_the_tracker_and_it_says_so() {
    let mut suite = suite(gyro(), StarTracker { latency: 0.1, ..noiseless() }, 7);
    let (fast, slow) = (vec3(0.0, 0.0, 0.11), vec3(0.0, 0.0, 0.09));
    let mut said = Vec::new();
    for k in 0..40 {
        let w = if (11..26).contains(&k) { fast } else { slow };
        let time = f64::from(k) * PERIOD;
        let reading = suite.read(attitude(w, time), w, &[], time, PERIOD);
        assert!(!(reading.blinded && reading.tracker.is_some()));
        if reading.blinded || reading.tracker.is_some() {
            said.push((k, reading.blinded));
        }
    }
    // The moment 0.1 s before is what counts.
    let expected = [
        (1, false),
        (5, false),
        (10, false),
        (15, true),
        (20, true),
        (25, true),
        (30, false),
        (35, false),
    ];
    assert_eq!(said, expected);
}

#[test]
fn the_same_seed_says_the_same_and_each_sensor_has_its_own_numbers() {
    let all = |tracker, seed| readings(suite(gyro(), tracker, seed), turning(), 30);
    assert_eq!(all(tracker(), 8), all(tracker(), 8));
    assert_ne!(all(tracker(), 8), all(tracker(), 9));
    // A tracker that is asked more often does not change what the gyro says.
    let often = StarTracker { interval: 0.1, ..tracker() };
    let rates = |all: Vec<SensorReadings<0>>| all.iter().map(|s| s.w_NB_B).collect::<Vec<_>>();
    assert_eq!(rates(all(tracker(), 8)), rates(all(often, 8)));
}

#[test]
fn the_bias_is_known_to_who_keeps_the_truth() {
    let mut suite = suite(gyro(), tracker(), 10);
    assert_eq!(suite.gyro_bias(), gyro().bias_B);
    suite.read(attitude(turning(), 0.0), turning(), &[], 0.0, PERIOD);
    let step = suite.gyro_bias() - gyro().bias_B;
    assert!(step.norm() > 0.0 && step.norm() < 5.0 * gyro().bias_random_walk);
}

#[test]
fn perfect_sensors_tell_the_truth() {
    let mut suite = SensorSuite::new(Sensors::default(), 0);
    let quat_NB = attitude(turning(), 3.0);
    let said = suite.read(quat_NB, turning(), &[0.123_456_789], 3.0, PERIOD);
    assert_eq!((said.w_NB_B, said.q, said.blinded), (turning(), [0.123_456_789], false));
    let seen = said.tracker.unwrap();
    assert_eq!((seen.quat_NB, seen.age), (quat_NB, 0.0));
}

/// A 16-bit encoder of a full turn.
#[test]
fn encoders_round_to_the_nearest_step() {
    let step = core::f64::consts::TAU / 65_536.0;
    let mut suite = SensorSuite::new(Sensors { attitude: None, encoder_step: step }, 0);
    let q = [0.4 * step, 0.6 * step, -7.4 * step, 1.0];
    let said = suite.read(Quat::identity(), Vec3::zero(), &q, 0.0, PERIOD).q;
    assert_eq!(said[..3], [0.0, step, -7.0 * step]);
    assert!((said[3] - 1.0).abs() <= 0.5 * step && said[3] != 1.0);
}

//! Readings of the star tracker that are late.

use super::truth::*;
use wrasse_flight::AttitudeEstimator;
use wrasse_hardware::{StarTracker, TrackerReading};
use wrasse_spatial::{Mat3, Quat, Vec3, vec3};

/// Sensors without noise on a steadily turning base, latencies shorter and longer than the interval.
/// Measured 3e-14 rad. Taken for new, the same readings are wrong by rate times latency: 0.0123 and
/// 0.0432 rad.
#[test]
fn a_late_reading_of_a_turning_base_leaves_no_error() {
    for latency in [0.2, 0.7] {
        let mut setup = setup();
        setup.tracker.latency = latency;
        let quiet = StarTracker { noise_across: 0.0, noise_about: 0.0, ..setup.tracker };
        let mut truth =
            Truth { rate: steady, gyro: silent(), tracker: quiet, ..Truth::new(&setup, 5) };
        let mut filter = AttitudeEstimator::new(&setup, truth.quat_NB());
        let mut hasty = filter.clone();
        let mut errors = (0.0, 0.0);
        for _ in 0..6000 {
            let (said, reading) = (truth.turn(), truth.reading());
            let good = filter.step(said, reading, PERIOD);
            let new = reading.map(|reading| TrackerReading { age: 0.0, ..reading });
            let bad = hasty.step(said, new, PERIOD);
            errors = (truth.error(&good).norm(), truth.error(&bad).norm());
        }
        let due = steady(0.0).norm() * latency;
        assert!(errors.0 < 1e-12, "{errors:?}");
        assert!((errors.1 / due - 1.0).abs() < 0.01, "{errors:?}, due {due}");
    }
}

/// Between two control instants as well: rates are even within a period. Measured 1.4e-9 rad, what is
/// left of 1e-4 at the start.
#[test]
fn a_latency_need_not_be_a_number_of_periods() {
    let mut setup = setup();
    setup.gyro.bias_B = Vec3::zero();
    let start = Quat::exp(vec3(0.4, -1.1, 0.7));
    let at = |time: f64| start * Quat::exp(steady(0.0) * time);
    let mut filter = AttitudeEstimator::new(&setup, start * Quat::exp(vec3(1e-4, 0.0, 0.0)));
    for k in 1..=600 {
        let time = f64::from(k) * PERIOD;
        let reading = TrackerReading { quat_NB: at(time - 0.137), age: 0.137 };
        let estimate = filter.step(steady(0.0), (k > 1).then_some(reading), PERIOD);
        let error = (estimate.quat_NB.conjugate() * at(time)).log().norm();
        if k == 600 {
            assert!(error < 1e-8, "{error:e} rad");
        }
    }
}

/// Half a second about x, then half a second about z: a turn that cannot be taken in another order.
/// The start is uncertain, so after one reading attitude and covariance are the reading's, in axes
/// that have turned since. What the start still weighs is (1.5e-4/1e-2)², 2e-4. Measured 1.1e-6 rad,
/// and 2.2e-4 of the largest variance.
#[test]
fn a_late_reading_and_its_noise_are_turned_into_the_present_axes() {
    let mut setup = setup();
    (setup.start_attitude_sigma, setup.start_bias_sigma) = (1e-2, 1e-9);
    setup.gyro.angle_random_walk = 1e-8;
    let start = Quat::exp(vec3(0.4, -1.1, 0.7));
    let mut filter = AttitudeEstimator::new(&setup, start * Quat::exp(vec3(4e-3, -6e-3, 5e-3)));
    let (about_x, about_z) = (vec3(0.9, 0.0, 0.0), vec3(0.0, 0.0, 0.8));
    for k in 0..9 {
        filter.step(if k < 5 { about_x } else { about_z }, None, PERIOD);
    }
    let reading = TrackerReading { quat_NB: start, age: 1.0 };
    let estimate = filter.step(about_z, Some(reading), PERIOD);
    let turn = Quat::exp(about_x * 0.5) * Quat::exp(about_z * 0.5);
    let error = (estimate.quat_NB.conjugate() * start * turn).log().norm();
    let StarTracker { boresight_B, noise_across, noise_about, .. } = setup.tracker;
    let (across, about) = (noise_across * noise_across, noise_about * noise_about);
    let b = turn.to_matrix().transpose() * boresight_B;
    let expected = Mat3::identity().scaled(across) + b.outer(b).scaled(about - across);
    let off = matrix(filter.attitude_covariance().to_mat3() - expected).norm() / about;
    assert!(error < 1e-5, "{error:e} rad");
    assert!(off < 1e-3, "{off:e}");
}

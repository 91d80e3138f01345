//! The covariance against theory: Farrenkopf's steady state, another route, an outage.

use super::truth::*;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, SMatrix, Vector3};
use std::path::Path;
use wrasse_flight::AttitudeEstimator;
use wrasse_hardware::{RateGyro, StarTracker};
use wrasse_spatial::Vec3;
use wrasse_testing::{Worst, larger};

/// A still base, a tracker alike about all axes and in time: each axis is Farrenkopf's problem,
/// whose steady state is known in closed form (F. L. Markley, *Analytic steady-state accuracy of a
/// spacecraft attitude estimator*, NASA 2000, NTRS 20000086664, without noise of the gyro's angle).
/// Measured 8e-10 apart: the least noise that the filter gives any tracker, (1e-9/2e-5)².
#[test]
fn the_steady_state_is_farrenkopfs() {
    let mut setup = setup();
    let n = 2e-5;
    let interval = setup.tracker.interval;
    setup.tracker = StarTracker { noise_across: n, noise_about: n, latency: 0.0, ..setup.tracker };
    let mut truth = Truth { rate: still, ..Truth::new(&setup, 2) };
    let mut filter = truth.filter(&setup);
    let after = truth.run(&mut filter, 10_000).sigma;
    truth.run(&mut filter, 4);
    let period_before = {
        let said = truth.turn();
        filter.step(said, None, PERIOD)
    };
    let RateGyro { angle_random_walk: N, bias_random_walk: K, .. } = setup.gyro;
    let s_u = K * interval * interval.sqrt() / n;
    let s_v = N * interval.sqrt() / n;
    let gamma = (1.0 + s_v * s_v / 4.0 + s_u * s_u / 48.0).sqrt();
    let zeta = gamma + s_u / 4.0 + 0.5 * (2.0 * gamma * s_u + s_v * s_v + s_u * s_u / 3.0).sqrt();
    let expected_before = n * (zeta * zeta - 1.0).sqrt();
    let expected_after = n * (1.0 - 1.0 / (zeta * zeta)).sqrt();
    let off = [period_before.sigma / expected_before - 1.0, after / expected_after - 1.0];
    assert!(off.iter().all(|off| off.abs() < 1e-8), "{off:?}");
}

/// The same three times from outside: the textbook's recursion about one axis in 60 digits, the first with
/// the numbers of Crassidis and Junkins, *Optimal Estimation of Dynamic Systems*, 2nd ed., Example 3.3.
/// The filter takes ten periods from reading to reading, or five. Measured 4e-9 of sigma: the least noise that
/// it gives any tracker, (1e-9/1e-5)², is 1e-8 of a variance.
#[test]
fn the_steady_state_is_that_of_the_textbooks_recursion() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/farrenkopf.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let rows = rows.map(|line| line.split(',').map(|x| x.parse::<f64>().unwrap()));
    let mut worst = Worst::none();
    for row in rows.map(Iterator::collect::<Vec<_>>) {
        let [noise, walk, reading, interval, before, after, bias_before, bias_after] = row[..]
        else {
            panic!("eight numbers in {row:?}");
        };
        let mut setup = setup();
        setup.gyro.angle_random_walk = noise;
        setup.gyro.bias_random_walk = walk;
        let tracker = StarTracker { noise_across: reading, noise_about: reading, ..setup.tracker };
        setup.tracker = StarTracker { interval, latency: 0.0, ..tracker };
        let mut truth = Truth { rate: still, ..Truth::new(&setup, 5) };
        let mut filter = truth.filter(&setup);
        // The slowest of the three forgets its start within a thousand seconds, by a factor of e.
        let sigma = |filter: &AttitudeEstimator<f64>| {
            [filter.attitude_covariance(), filter.bias_covariance()].map(|P| P.xx.sqrt())
        };
        truth.run(&mut filter, 200_000);
        let [attitude, bias] = sigma(&filter);
        worst.see_all([attitude / after, bias / bias_after], [1.0; 2]);
        let blind = (interval / PERIOD).round() as u32 - 1;
        truth.run(&mut filter, blind);
        filter.step(truth.turn(), None, PERIOD);
        let [attitude, bias] = sigma(&filter);
        worst.see_all([attitude / before, bias / bias_before], [1.0; 2]);
    }
    worst.is_below(1e-7);
}

fn skew(w: Vec3<f64>) -> Matrix3<f64> {
    Vector3::new(w.x, w.y, w.z).cross_matrix()
}

/// Transition and noise of a period from the differential equation of the errors, by one matrix
/// exponential (Van Loan).
fn period_by_exponential(w: Vec3<f64>, gyro: &RateGyro<f64>) -> (Matrix6<f64>, Matrix6<f64>) {
    let mut A = Matrix6::zeros();
    A.fixed_view_mut::<3, 3>(0, 0).copy_from(&-skew(w));
    A.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Matrix3::identity());
    let (N, K) = (gyro.angle_random_walk, gyro.bias_random_walk);
    let mut Q = Matrix6::zeros();
    Q.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * (N * N)));
    Q.fixed_view_mut::<3, 3>(3, 3).copy_from(&(Matrix3::identity() * (K * K)));
    let mut big = SMatrix::<f64, 12, 12>::zeros();
    big.fixed_view_mut::<6, 6>(0, 0).copy_from(&-A);
    big.fixed_view_mut::<6, 6>(0, 6).copy_from(&Q);
    big.fixed_view_mut::<6, 6>(6, 6).copy_from(&A.transpose());
    let e = (big * PERIOD).exp();
    let transition = e.fixed_view::<6, 6>(6, 6).transpose();
    (transition, transition * e.fixed_view::<6, 6>(0, 6))
}

/// A steadily turning base and a tracker with a boresight, no latency. The other route: transition
/// and noise by a matrix exponential, the update in information form, `(P⁻¹ + Hᵀ R⁻¹ H)⁻¹`. The
/// two share the equation of the errors. What is left is the noise common to attitude and bias,
/// which the filter takes as if the base stood still during a period. Measured 3.6e-7.
#[test]
fn the_covariance_is_that_of_another_route() {
    let mut setup = setup();
    setup.tracker.latency = 0.0;
    setup.gyro.bias_B = Vec3::zero();
    let noiseless = RateGyro { angle_random_walk: 0.0, bias_random_walk: 0.0, ..setup.gyro };
    let mut truth = Truth { rate: steady, gyro: noiseless, ..Truth::new(&setup, 3) };
    truth.tracker = StarTracker { noise_across: 0.0, noise_about: 0.0, ..setup.tracker };
    let mut filter = AttitudeEstimator::new(&setup, truth.quat_NB());
    let (transition, noise) = period_by_exponential(steady(0.0), &setup.gyro);
    let b = setup.tracker.boresight_B;
    let (across, about) = (setup.tracker.noise_across, setup.tracker.noise_about);
    let R = Matrix3::identity() * (across * across)
        + matrix(b.outer(b)) * (about * about - across * across);
    let information = R.try_inverse().expect("noise about every axis");
    let mut H = Matrix3x6::<f64>::zeros();
    H.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
    let start = [setup.start_attitude_sigma; 3].into_iter().chain([setup.start_bias_sigma; 3]);
    let mut P =
        Matrix6::from_diagonal(&nalgebra::Vector6::from_iterator(start.map(|sigma| sigma * sigma)));
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let said = truth.turn();
        let reading = truth.reading();
        filter.step(said, reading, PERIOD);
        P = transition * P * transition.transpose() + noise;
        if reading.is_some() {
            let inverse = P.try_inverse().expect("nothing is known exactly");
            let informed: Matrix6<f64> = inverse + H.transpose() * information * H;
            P = informed.try_inverse().expect("still so");
        }
        let pairs = [(filter.attitude_covariance(), 0), (filter.bias_covariance(), 3)];
        for (ours, at) in pairs {
            let theirs = P.fixed_view::<3, 3>(at, at).into_owned();
            worst = larger(worst, (matrix(ours.to_mat3()) - theirs).norm() / theirs.norm());
        }
    }
    assert!(worst < 1e-5, "relative difference {worst:e}");
}

/// Without readings the variance of the attitude is a cubic in time: gyro noise makes its slope,
/// the variance of the bias its curvature, the walk of the bias its third derivative. The fourth
/// coefficient, from attitude and bias together, is read off after 50 s. The error stays inside.
/// Measured 4.5e-6 off: by the gyro's noise the filter sees the base turn a little. Sigma grows from
/// 2.1e-5 to 6.4e-4 rad.
#[test]
fn an_outage_of_the_tracker_is_as_bad_as_foretold() {
    let (mut truth, RateGyro { angle_random_walk: N, bias_random_walk: K, .. }) =
        (Truth { rate: still, ..Truth::new(&setup(), 4) }, setup().gyro);
    let mut filter = truth.filter(&setup());
    truth.run(&mut filter, 3000);
    let (start, bias) = (filter.attitude_covariance().xx, filter.bias_covariance().xx);
    let known = |t: f64| start + t * (N * N + t * (bias + t * K * K / 3.0));
    let mut blind = |seconds: f64| {
        let mut last = None;
        for _ in 0..(seconds / PERIOD).round() as u32 {
            let said = truth.turn();
            last = Some(filter.step(said, None, PERIOD));
        }
        let estimate = last.expect("at least one period");
        (filter.attitude_covariance(), truth.error(&estimate), estimate.sigma)
    };
    let slope = (blind(50.0).0.xx - known(50.0)) / 50.0;
    let (P, error, sigma) = blind(150.0);
    let off = P.xx / (known(200.0) + slope * 200.0) - 1.0;
    assert!(off.abs() < 1e-4, "{off:e}");
    assert!(sigma > 10.0 * start.sqrt(), "{sigma:e}");
    assert!(error.to_array().iter().all(|e| e.abs() < 3.0 * sigma), "{error:?}");
}

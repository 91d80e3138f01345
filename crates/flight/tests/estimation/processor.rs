//! What a flight processor asks: single precision, no heap, a first period of no length.

use super::truth::*;
use std::hint::black_box;
use wrasse_flight::{AttitudeEstimator, EstimatorSetup, JointEstimator};
use wrasse_hardware::TrackerReading;
use wrasse_spatial::{Quat, Vec3, vec3};
use wrasse_testing::allocations;
use wrasse_testing::larger;

/// The same readings in single and in double precision, ten minutes from a start that is off by
/// 0.1 rad: the covariance falls by seven powers of ten at the first readings. Measured 1.5e-6 rad
/// apart, twelve units in the last place; sigma by 0.1 %.
#[test]
fn single_precision_is_enough() {
    let mut setup = setup();
    setup.start_attitude_sigma = 0.1;
    let single = EstimatorSetup {
        gyro: setup.gyro.cast::<f32>(),
        tracker: setup.tracker.cast(),
        start_attitude_sigma: 0.1,
        start_bias_sigma: 3e-5,
    };
    let to_single = |q: Quat<f64>| Quat::new(q.w as f32, q.x as f32, q.y as f32, q.z as f32);
    let mut truth = Truth::new(&setup, 9);
    let start = truth.quat_NB() * Quat::exp(vec3(0.1, -0.05, 0.08));
    let mut double = AttitudeEstimator::new(&setup, start);
    let mut filter = AttitudeEstimator::new(&single, to_single(start));
    let (mut apart, mut sigmas) = (0.0_f64, (0.0, 0.0));
    for k in 0..6000 {
        let (said, reading) = (truth.turn(), truth.reading());
        let short =
            reading.map(|r| TrackerReading { quat_NB: to_single(r.quat_NB), age: r.age as f32 });
        let a = double.step(said, reading, PERIOD);
        let b = filter.step(Vec3::from_f64(said), short, PERIOD as f32);
        let q = b.quat_NB;
        let q = Quat::new(f64::from(q.w), f64::from(q.x), f64::from(q.y), f64::from(q.z));
        sigmas = (a.sigma, f64::from(b.sigma));
        assert!(b.sigma > 0.0 && b.refused == 0);
        if k > 100 {
            apart = larger(apart, (a.quat_NB.conjugate() * q.normalized()).log().norm());
        }
    }
    assert!(apart < 4e-6, "{apart:e} rad");
    assert!((sigmas.1 / sigmas.0 - 1.0).abs() < 0.01, "{sigmas:?}");
}

#[test]
fn a_period_of_either_estimator_allocates_nothing() {
    let mut truth = Truth::new(&setup(), 10);
    let mut filter = truth.filter(&setup());
    let mut joints = JointEstimator::new([0.1; 7], 20.0);
    let (said, reading) = (truth.turn(), truth.reading());
    let wild = TrackerReading { quat_NB: Quat::exp(vec3(0.0, 2.0, 0.0)), age: 0.05 };
    let calls = allocations(|| {
        black_box(filter.step(said, reading, PERIOD));
        for _ in 0..12 {
            black_box(filter.step(said, Some(wild), PERIOD));
        }
        black_box(joints.step(&[0.11; 7], &[0.0; 7], PERIOD));
    });
    assert_eq!(calls, 0);
}

/// The first control instant comes before the first period.
#[test]
fn a_period_of_zero_only_takes_the_reading() {
    let truth = Truth::new(&setup(), 12);
    let off = truth.quat_NB() * Quat::exp(vec3(1e-3, 0.0, 0.0));
    let mut filter = AttitudeEstimator::new(&setup(), off);
    let reading = TrackerReading { quat_NB: truth.quat_NB(), age: 0.0 };
    let estimate = filter.step(steady(0.0), Some(reading), 0.0);
    // What the start still weighs: (1.5e-4/1e-3)² at most, of 1e-3 rad.
    assert!(truth.error(&estimate).norm() < 3e-5 && estimate.sigma < 1.5e-4);
    assert_eq!((estimate.bias_B, estimate.w_NB_B), (Vec3::zero(), steady(0.0)));
    let mut joints = JointEstimator::new([0.1], 20.0);
    assert_eq!(joints.step(&[0.2], &[0.5], 0.0), ([0.1], [0.0]));
}

//! From readings to the state that the laws work on.

use wrasse_dynamics::State;
use wrasse_flight::{
    AttitudeEstimator, BaseReading, EstimatorSetup, JointReading, Navigation, NavigationSetup,
    Sensed,
};
use wrasse_hardware::{ActuatorReadings, RateGyro, StarTracker, TrackerReading};
use wrasse_spatial::{Pose, Quat, Real, SpatialVelocity, Vec3, vec3};
use wrasse_testing::{larger, largest};

/// Control period (s).
const PERIOD: f64 = 0.05;

fn start() -> Quat<f64> {
    Quat::exp(vec3(0.3, -0.7, 0.5))
}

fn state() -> State<f64, 2> {
    State {
        X_NB: Pose::from_quat(start(), vec3(1.0, -2.0, 3.0)),
        V_NB_B: SpatialVelocity::from_array([0.01, -0.02, 0.03, 0.4, -0.5, 0.6]),
        q: [0.1, -0.2],
        v: [0.3, 0.4],
    }
}

fn estimator() -> EstimatorSetup<f64> {
    EstimatorSetup {
        gyro: RateGyro { angle_random_walk: 1e-5, bias_random_walk: 1e-7, ..RateGyro::default() },
        tracker: StarTracker {
            boresight_B: vec3(-1.0, 0.0, 0.0),
            noise_across: 2e-5,
            noise_about: 1e-4,
            interval: 0.25,
            latency: 0.1,
            rate_limit: 0.1,
        },
        start_attitude_sigma: 1e-3,
        start_bias_sigma: 1e-5,
    }
}

fn with_estimator() -> NavigationSetup<f64> {
    NavigationSetup { attitude: Some(estimator()), joint_bandwidth: 20.0, quat_NB: start() }
}

/// What gyro, star tracker and relative navigation say, and perfect joints.
fn felt(
    rate_B: Vec3<f64>,
    tracker: Option<TrackerReading<f64>>,
    v_NB_N: Vec3<f64>,
) -> Sensed<f64, 2> {
    let base = BaseReading::Felt { rate_B, tracker, p_NB_N: vec3(1.0, -2.0, 3.0), v_NB_N };
    Sensed { base, ..Sensed::perfect(&state(), ActuatorReadings::default()) }
}

/// Largest difference of the elements of two attitudes.
fn apart(X_NB: &Pose<f64>, quat_NB: Quat<f64>) -> f64 {
    let off = X_NB.rotation - quat_NB.to_matrix();
    largest(off.rows.iter().map(|row| row.norm()))
}

#[test]
fn perfect_readings_pass_through_to_the_bit() {
    let mut navigation = Navigation::<f64, 2>::new(&NavigationSetup::perfect());
    for k in 0..3 {
        let mut state = state();
        state.q[1] += f64::from(k);
        state.V_NB_B.linear.z = f64::from(k) / 3.0;
        let sensed = Sensed::perfect(&state, ActuatorReadings::default());
        assert_eq!(navigation.estimate(&sensed, &[9.0, -9.0], PERIOD), state);
        assert!(navigation.attitude_estimate().is_none());
    }
}

/// The base turns evenly at 3 deg/s, with readings of the tracker 0.1 s old now and then; a gyro that
/// is off by its bias. Attitude and rate are those of the estimator run by itself, to the bit; the
/// velocity is turned into base axes by that attitude.
#[test]
fn the_attitude_is_the_estimate_and_velocity_is_in_its_axes() {
    let (w_NB_B, bias_B) = (vec3(0.03, -0.02, 0.04), vec3(2e-6, -1e-6, 3e-6));
    let v_NB_N = vec3(0.4, -0.5, 0.6);
    let mut navigation = Navigation::<f64, 2>::new(&with_estimator());
    let mut alone = AttitudeEstimator::new(&estimator(), start());
    let (mut slip, mut turn) = (0.0_f64, 0.0_f64);
    for k in 0..200 {
        let at = |periods: f64| start() * Quat::exp(w_NB_B * (PERIOD * periods));
        let now = f64::from(k);
        let seen = k >= 2 && k % 5 == 0;
        let tracker = seen.then(|| TrackerReading { quat_NB: at(now - 2.0), age: 2.0 * PERIOD });
        let got = navigation.estimate(&felt(w_NB_B + bias_B, tracker, v_NB_N), &[0.0; 2], PERIOD);
        let passed = if k == 0 { 0.0 } else { PERIOD };
        let wanted = alone.step(w_NB_B + bias_B, tracker, passed);
        assert_eq!(navigation.attitude_estimate(), Some(&wanted));
        assert_eq!(apart(&got.X_NB, wanted.quat_NB), 0.0);
        assert_eq!(got.V_NB_B.angular, wanted.w_NB_B);
        assert_eq!(got.X_NB.translation, vec3(1.0, -2.0, 3.0));
        let back_N = at(now).to_matrix() * got.V_NB_B.linear;
        slip = larger(slip, (back_N - v_NB_N).norm());
        turn = larger(turn, apart(&got.X_NB, at(now)));
        assert_eq!((got.q, got.v), (state().q, state().v), "joints are known");
    }
    // The bias is not found yet. Measured 2.5e-6 m/s and 3.7e-6.
    assert!(slip < 2e-5 && turn < 3e-5, "{slip:e} m/s, {turn:e}");
}

/// The first reading is of the start, before any time has passed: a turning base is where it was said
/// to be, and a period later it has turned by one period. Measured 5.2e-16.
#[test]
fn the_first_reading_is_of_the_start() {
    let w_NB_B = vec3(0.03, -0.02, 0.04);
    let mut navigation = Navigation::<f64, 2>::new(&with_estimator());
    let mut worst = 0.0_f64;
    for k in 0..20 {
        let sensed = felt(w_NB_B, None, Vec3::zero());
        let got = navigation.estimate(&sensed, &[0.0; 2], PERIOD);
        let truth = start() * Quat::exp(w_NB_B * (PERIOD * f64::from(k)));
        worst = larger(worst, apart(&got.X_NB, truth));
    }
    assert!(worst < 1e-14, "{worst:e}");
}

/// A joint swings with a sine; its mean acceleration over each period is what was asked for. What the
/// mean leaves out, `T³/12` of the third derivative, moves the rate by 4.2e-5 rad/s at most, measured.
/// Its sister was not asked, and is found at the filter's bandwidth: measured 8.4e-9 rad/s off after
/// 1 s.
#[test]
fn encoders_give_rates() {
    let setup = NavigationSetup { joint_bandwidth: 20.0, ..NavigationSetup::perfect() };
    let mut navigation = Navigation::<f64, 2>::new(&setup);
    let position = |t: f64| 0.2 * (1.0 - t.cos());
    let rate = |t: f64| 0.2 * t.sin();
    let mut worst = 0.0_f64;
    for k in 0..100 {
        let t = PERIOD * f64::from(k);
        let read = [position(t), 0.3 * t];
        let asked = [(rate(t) - rate(t - PERIOD)) / PERIOD, 0.0];
        let joints = JointReading::Encoders(read);
        let sensed = Sensed { joints, ..Sensed::perfect(&state(), ActuatorReadings::default()) };
        let got = navigation.estimate(&sensed, &asked, PERIOD);
        if k == 0 {
            assert_eq!((got.q, got.v), (read, [0.0; 2]), "at rest where it stands");
        }
        worst = larger(worst, (got.v[0] - rate(t)).abs());
        assert!((got.q[0] - read[0]).abs() < 1e-5);
        assert_eq!(got.X_NB, state().X_NB);
        if k == 20 {
            assert!((got.v[1] - 0.3).abs() < 1e-6, "{} rad/s", got.v[1]);
        }
    }
    assert!(worst < 1e-4, "{worst:e} rad/s off");
}

/// A quarter turn to the left, moving along x of inertial space: to its right in base axes.
#[test]
fn a_base_that_has_turned_left_moves_to_its_right() {
    let setup = NavigationSetup {
        quat_NB: Quat::exp(vec3(0.0, 0.0, std::f64::consts::FRAC_PI_2)),
        ..with_estimator()
    };
    let mut navigation = Navigation::<f64, 2>::new(&setup);
    let sensed = felt(Vec3::zero(), None, vec3(1.0, 0.0, 0.0));
    let got = navigation.estimate(&sensed, &[0.0; 2], PERIOD);
    let off = got.V_NB_B.linear - vec3(0.0, -1.0, 0.0);
    assert!(Real::abs(off.norm()) < 1e-15, "{off:?}");
}

//! Profiles of one parameter: quintic and S-curve within their limits.

use super::{SHAPES, cases, limits};
use proptest::prelude::*;
use wrasse_flight::trajectory::{Motion, MotionLimits, Profile, Quantity, Quintic, SCurve};
use wrasse_testing::{larger, largest};

/// Random limits over six decades each, so that every degenerate case of the S-curve comes up.
fn any_limits() -> impl Strategy<Value = MotionLimits<f64>> {
    (-3.0..3.0, -3.0..3.0, -3.0..3.0)
        .prop_map(|(v, a, j)| limits(10_f64.powf(v), 10_f64.powf(a), 10_f64.powf(j)))
}

/// Central differences of a motion: errors of velocity and acceleration, relative to the scales.
#[track_caller]
fn derivative_errors(at: impl Fn(f64) -> Motion<f64>, t: f64, h: f64) -> (f64, f64) {
    let (before, now, after) = (at(t - h), at(t), at(t + h));
    let velocity = (after.position - before.position) / (2.0 * h);
    let acceleration = (after.velocity - before.velocity) / (2.0 * h);
    ((velocity - now.velocity).abs(), (acceleration - now.acceleration).abs())
}

#[test]
fn one_metre_at_a_tenth_of_a_metre_per_second_takes_the_quintic_18_75_seconds() {
    let quintic = Quintic::from_limits(1.0, &limits(0.1, 1.0, 1.0)).unwrap();
    assert!((quintic.duration() - 18.75).abs() < 1e-14, "{}", quintic.duration());
    // The peak of the acceleration is at u = 1/2 - 1/sqrt(12).
    let peak = quintic.at(18.75 * (0.5 - 1.0 / 12_f64.sqrt())).acceleration;
    assert!((peak - 0.0164).abs() < 5e-5, "0.0164 m/s², measured {peak}");
    assert!((peak - 10.0 / 3_f64.sqrt() / 18.75_f64.powi(2)).abs() < 1e-17, "{peak:e}");
    assert!((quintic.at(9.375).velocity - 0.1).abs() < 1e-16);
}

#[test]
fn each_limit_alone_sets_the_duration_of_the_quintic_by_its_peak() {
    let loose = 1e9;
    for (limits, u, peak) in [
        (limits(0.3, loose, loose), 0.5, [0.3, f64::NAN]),
        (limits(loose, 0.3, loose), 0.5 - 1.0 / 12_f64.sqrt(), [f64::NAN, 0.3]),
    ] {
        let quintic = Quintic::from_limits(2.0, &limits).unwrap();
        let motion = quintic.at(u * quintic.duration());
        for (found, expected) in [motion.velocity, motion.acceleration].into_iter().zip(peak) {
            // Measured 1.1e-16.
            assert!(expected.is_nan() || (found - expected).abs() < 1e-15, "{found} {expected}");
        }
    }
    let quintic = Quintic::from_limits(2.0, &limits(loose, loose, 0.3)).unwrap();
    let h = 1e-6;
    let jerk = (quintic.at(h).acceleration - quintic.at(0.0).acceleration) / h;
    assert!((jerk - 0.3).abs() < 3e-7, "measured 1.2e-7: {:e}", jerk - 0.3);
}

#[test]
fn profiles_start_and_end_at_rest_exactly() {
    for shape in SHAPES {
        let profile = Profile::within(shape, 0.7, &limits(0.13, 0.05, 0.3)).unwrap();
        let end = profile.duration();
        for t in [-1.0, 0.0] {
            assert_eq!(profile.at(t), Motion::default(), "{shape:?} at {t}");
        }
        for t in [end, end + 1e-9, end + 1.0] {
            let Motion { position, velocity, acceleration } = profile.at(t);
            assert_eq!((position, velocity, acceleration.abs()), (0.7, 0.0, 0.0), "{shape:?}");
        }
    }
}

#[test]
fn a_path_without_length_takes_no_time_and_stays_at_zero() {
    for shape in SHAPES {
        let profile = Profile::within(shape, 0.0, &limits(1.0, 1.0, 1.0)).unwrap();
        assert_eq!(profile.duration(), 0.0);
        assert_eq!(profile.at(0.0), Motion::default());
        assert_eq!(profile.at(3.0), Motion::default());
        assert_eq!(profile.fraction_at(3.0), Motion::default());
    }
}

#[test]
fn the_s_curve_takes_the_closed_form_time_in_each_of_its_four_cases() {
    // Full: Tj = a/j, T = L/v + v/a + a/j.
    let cases = [
        ("all limits reached", 10.0, limits(1.0, 0.5, 1.0), 10.0 + 2.0 + 0.5),
        // No constant acceleration: T = L/v + 2 sqrt(v/j).
        ("speed but not acceleration", 10.0, limits(1.0, 2.0, 1.0), 12.0),
        // No cruise: L = a Ta (Ta - Tj) with a = 1, Tj = 1, Ta = 3.
        ("acceleration but not speed", 6.0, limits(9.0, 1.0, 1.0), 6.0),
        // Neither: L = 2 j Tj³ with Tj = 1.
        ("neither", 2.0, limits(9.0, 9.0, 1.0), 4.0),
    ];
    for (name, length, limits, expected) in cases {
        let found = SCurve::new(length, &limits).unwrap().duration();
        assert!((found - expected).abs() < 4e-15, "{name}: measured {found}, expected {expected}");
    }
}

#[test]
fn numbers_that_cannot_be_a_motion_are_all_named() {
    let bad = limits(-0.1, f64::NAN, 0.0);
    for shape in SHAPES {
        let complaints = Profile::within(shape, -2.0, &bad).unwrap_err();
        let named: Vec<_> = complaints.iter().map(|bad| bad.quantity).collect();
        assert_eq!(
            named,
            [
                Quantity::Length,
                Quantity::SpeedLimit,
                Quantity::AccelerationLimit,
                Quantity::JerkLimit
            ]
        );
    }
    let text = Quintic::new(1.0, 0.0).unwrap_err().to_string();
    assert_eq!(text, "duration (s): found 0, expected a finite number above zero");
}

#[test]
fn the_s_curve_is_continuous_where_its_segments_join() {
    let mut worst = 0.0_f64;
    for limits in [limits(1.0, 0.5, 1.0), limits(1.0, 2.0, 1.0), limits(9.0, 1.0, 1.0)] {
        let curve = SCurve::new(10.0, &limits).unwrap();
        for t in curve.joins() {
            let h = 1e-9;
            let (before, after) = (curve.at(t - h), curve.at(t + h));
            let gap = Motion {
                position: after.position - before.position - 2.0 * h * curve.at(t).velocity,
                velocity: after.velocity - before.velocity - 2.0 * h * curve.at(t).acceleration,
                acceleration: after.acceleration - before.acceleration,
            };
            // Across a join the acceleration may change by the jerk's share of the step only.
            assert!(gap.acceleration.abs() <= 2.0 * h * limits.jerk * (1.0 + 1e-6), "{gap:?}");
            worst = largest([worst, gap.position.abs(), gap.velocity.abs()]);
        }
    }
    assert!(worst < 1e-14, "measured 2.6e-15: {worst:e}");
}

proptest! {
    #![proptest_config(cases())]

    /// Rounding only: the limits come back from a few products of ε each.
    #[test]
    fn no_profile_exceeds_its_limits(
        limits in any_limits(), decade in -4.0..3.0, shape in prop::sample::select(&SHAPES)
    ) {
        let length = 10_f64.powf(decade);
        let profile = Profile::within(shape, length, &limits).unwrap();
        let step = profile.duration() / 400.0;
        let (mut over, mut back, mut jerk_over) = (0.0_f64, 0.0_f64, 0.0_f64);
        for k in 0..=400 {
            let t = f64::from(k) * step;
            let motion = profile.at(t);
            let jerk = (profile.at(t + step).acceleration - motion.acceleration) / step;
            over = larger(over, motion.velocity.abs() / limits.speed - 1.0);
            over = larger(over, motion.acceleration.abs() / limits.acceleration - 1.0);
            back = larger(back, -motion.velocity / limits.speed);
            back = larger(back, motion.position / length - 1.0);
            let scale = limits.jerk + limits.acceleration / step;
            jerk_over = larger(jerk_over, (jerk.abs() - limits.jerk) / scale);
        }
        prop_assert!(over <= 1e-15, "measured 2.3e-16: {over:e}");
        // Never backwards, never beyond the end.
        prop_assert!(back <= 0.0, "measured 0: {back:e}");
        // The difference sees the rounding of the time, ε of the whole in each of 400 steps.
        prop_assert!(jerk_over <= 9e-14, "measured 2.2e-14: {jerk_over:e}");
    }

    /// Central differences: h²/6 of the jerk off in the velocity (measured 0.983 of the bound); in the
    /// acceleration the jerk times h where a join lies inside the step (measured 1e-5 of it).
    #[test]
    fn velocity_and_acceleration_are_the_derivatives(
        limits in any_limits(), decade in -4.0..3.0, u in 0.01..0.99,
        shape in prop::sample::select(&SHAPES)
    ) {
        let length = 10_f64.powf(decade);
        let profile = Profile::within(shape, length, &limits).unwrap();
        let T_ = profile.duration();
        let h = 1e-5 * T_;
        let (velocity, acceleration) = derivative_errors(|t| profile.at(t), u * T_, h);
        // Rounding of the position, ε L, over the two steps of 1e-5 T.
        let rounding = 1e-10 * length / T_;
        let truncation = limits.jerk * h * h / 6.0;
        prop_assert!(velocity <= truncation * 1.001 + rounding, "{velocity:e}");
        prop_assert!(acceleration <= limits.jerk * h + rounding / T_, "{acceleration:e}");
    }
}

#[test]
fn profiles_in_single_precision_end_exactly_too() {
    let limits = MotionLimits { speed: 0.1_f32, acceleration: 0.05, jerk: 0.2 };
    for shape in SHAPES {
        let profile = Profile::within(shape, 0.7_f32, &limits).unwrap();
        assert_eq!(profile.at(profile.duration()).position, 0.7);
    }
}

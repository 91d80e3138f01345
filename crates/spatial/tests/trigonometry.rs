//! Sine and cosine against many-digit values, and lanes against single numbers.

use wrasse_spatial::{Lanes, Real};
use wrasse_testing::{larger, largest};

const TABLE: &str = include_str!("../../../validation/sine_and_cosine.csv");

/// Angle, sine and its rest, cosine and its rest.
fn rows() -> Vec<[f64; 5]> {
    let number = |text: &str| text.parse::<f64>().expect("a table of numbers");
    let row = |line: &str| <[f64; 5]>::try_from(line.split(',').map(number).collect::<Vec<_>>());
    TABLE.lines().skip(2).map(|line| row(line).expect("a table of numbers")).collect()
}

/// Distance from the true value in units of the last place of the result.
fn ulps(found: f64, nearest: f64, rest: f64) -> f64 {
    let ulp = nearest.abs().next_up() - nearest.abs();
    ((found - nearest) - rest).abs() / ulp
}

/// Angles up to 1.6e6 rad, some of them as close to a multiple of a quarter turn as doubles come.
/// Half a unit is the best there is; the promise is one.
#[test]
fn sine_and_cosine_are_within_one_unit_in_the_last_place() {
    let mut worst: f64 = 0.0;
    for [x, sin, sin_rest, cos, cos_rest] in rows() {
        let (s, c) = Real::sin_cos(x);
        worst = largest([worst, ulps(s, sin, sin_rest), ulps(c, cos, cos_rest)]);
    }
    assert!(worst < 1.0, "measured 0.61: {worst}");
}

/// In single precision the promise is against the last place of 1.
#[test]
fn single_precision_is_within_one_unit_in_the_last_place_of_one() {
    let mut worst: f64 = 0.0;
    for k in -32_000_i16..32_000 {
        let x = 0.25 * f32::from(k);
        let (s, c) = Real::sin_cos(x);
        let (sin, cos) = Real::sin_cos(f64::from(x));
        let off = larger((f64::from(s) - sin).abs(), (f64::from(c) - cos).abs());
        worst = larger(worst, off / f64::from(f32::EPSILON));
    }
    assert!(worst < 1.0, "measured 0.48: {worst}");
}

/// Large, small, and NaN: each lane as alone, whatever stands beside it.
#[test]
fn every_lane_has_the_bits_of_the_single_number() {
    let mut angles: Vec<f64> = rows().iter().map(|row| row[0]).collect();
    angles.extend([1e7, -3e9, 1e300, f64::INFINITY, f64::NAN, 0.0, -0.0, 1e-310]);
    for start in 0..angles.len() {
        let at = |i: usize| angles[(start + i) % angles.len()];
        let x = Lanes::<8>::from_fn(at);
        let ((s, c), root, turn) = (x.sin_cos(), x.abs().sqrt(), x.atan2(Lanes::from_f64(0.7)));
        for i in 0..8 {
            let alone = Real::sin_cos(at(i));
            let same = |lane: f64, alone: f64| {
                assert!(lane.to_bits() == alone.to_bits() || lane.is_nan() && alone.is_nan());
            };
            same(s.lane(i), alone.0);
            same(c.lane(i), alone.1);
            same(root.lane(i), Real::sqrt(Real::abs(at(i))));
            same(turn.lane(i), Real::atan2(at(i), 0.7));
        }
    }
}

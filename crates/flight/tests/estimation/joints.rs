//! Positions and rates of the joints from encoders.

use super::truth::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use wrasse_flight::JointEstimator;
use wrasse_spatial::Real;

/// Position of a joint that speeds up evenly (rad), its rate (rad/s); the acceleration is 0.02.
fn speeding_up(t: f64) -> (f64, f64) {
    (0.3 + t * (0.05 + t * 0.01), 0.05 + t * 0.02)
}

/// Without the feed-forward the rate is behind by `a T (1 + 3 z)/(2 (1 - z))`, z the pole: about
/// twice the acceleration over the bandwidth. Measured 2e-16 rad, 2e-15 rad/s, and 9e-13 of the lag.
#[test]
fn a_joint_that_speeds_up_as_asked_is_followed_without_lag() {
    let (period, bandwidth, a) = (0.01, 10.0, 0.02);
    let mut fed = JointEstimator::new([speeding_up(0.0).0], bandwidth);
    let mut unfed = fed.clone();
    let (mut found, mut without) = (([0.0], [0.0]), ([0.0], [0.0]));
    let last = 1000;
    for k in 1..=last {
        let q = [speeding_up(f64::from(k) * period).0];
        found = fed.step(&q, &[a], period);
        without = unfed.step(&q, &[0.0], period);
    }
    let (q, v) = speeding_up(f64::from(last) * period);
    let z = (-bandwidth * period).exp();
    let lag = a * period * (1.0 + 3.0 * z) / (2.0 * (1.0 - z));
    let off = [found.0[0] - q, found.1[0] - v, (v - without.1[0]) / lag - 1.0];
    assert!(off[0].abs() < 4e-15 && off[1].abs() < 1e-13, "{off:?}");
    assert!(off[2].abs() < 1e-10, "{off:?}");
}

/// A joint that moves at once at a rate that nobody asked for. In continuous time the filter is
/// critically damped: the rate comes up as `1 - (1 + ωt) e^{-ωt}`. A period is 0.01/ω: measured
/// 0.002 off.
#[test]
fn a_surprise_dies_out_at_the_bandwidth() {
    let (period, bandwidth) = (0.001, 10.0);
    let mut filter = JointEstimator::new([0.0], bandwidth);
    for k in 1..=600 {
        let time = f64::from(k) * period;
        let rate = filter.step(&[time], &[0.0], period).1[0];
        let x = bandwidth * time;
        let expected = 1.0 - (1.0 + x) * (-x).exp();
        assert!((rate - expected).abs() < 0.01, "after {time} s {rate}, expected {expected}");
    }
}

/// Of white errors of position of standard deviation 1 the rate keeps
/// `√(2 β²/(α (4 - 2α - β)))/T`, the gain of a linear filter of second order. Measured 0.06 %
/// off, with some thousand independent numbers 5 % are allowed.
#[test]
fn of_white_noise_the_rate_keeps_what_an_alpha_beta_filter_keeps() {
    let (period, bandwidth) = (0.01, 10.0);
    let mut normal = Normal(ChaCha8Rng::seed_from_u64(11));
    let mut filter = JointEstimator::new([0.0], bandwidth);
    let (mut squares, mut count) = (0.0, 0.0);
    for k in 1..=200_000 {
        let rate = filter.step(&[normal.number()], &[0.0], period).1[0];
        if k > 1000 {
            squares += rate * rate;
            count += 1.0;
        }
    }
    let off = Real::sqrt(squares / count) / white_noise_gain(period, bandwidth) - 1.0;
    assert!(off.abs() < 0.05, "{off}");
}

fn white_noise_gain(period: f64, bandwidth: f64) -> f64 {
    let z = (-bandwidth * period).exp();
    let (alpha, beta) = (1.0 - z * z, (1.0 - z) * (1.0 - z));
    (2.0 * beta * beta / (alpha * (4.0 - 2.0 * alpha - beta))).sqrt() / period
}

/// An encoder of 16 bits on a joint at an even rate, 3.9 steps a period. Rounding is a saw tooth,
/// whose sharp edges the filter cuts better than white noise of the same size, `step/√12`. Measured
/// 88 times less than differences of readings; 69 times if it were white.
#[test]
fn the_noise_of_rounding_is_cut_by_the_filter() {
    let (period, bandwidth, step) = (0.01, 10.0, core::f64::consts::TAU / 65_536.0);
    let rate = 0.037_281_3;
    let mut filter = JointEstimator::new([0.0], bandwidth);
    let (mut before, mut plain, mut filtered, mut count) = (0.0, 0.0, 0.0, 0.0);
    for k in 1..=20_000 {
        let q = (f64::from(k) * period * rate / step).round() * step;
        let found = filter.step(&[q], &[0.0], period).1[0];
        if k > 1000 {
            let difference = (q - before) / period - rate;
            plain += difference * difference;
            filtered += (found - rate) * (found - rate);
            count += 1.0;
        }
        before = q;
    }
    let (plain, filtered) = (Real::sqrt(plain / count), Real::sqrt(filtered / count));
    let of_white = white_noise_gain(period, bandwidth) * step / Real::sqrt(12.0_f64);
    assert!(filtered < of_white, "{filtered:e} rad/s, of white noise {of_white:e}");
    assert!(plain / filtered > 80.0, "{} times", plain / filtered);
}

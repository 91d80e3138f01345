//! NaN, numbers at either end of the range, a clock that must not stall.

use super::pyramid::*;
use wrasse_flight::allocation::{CmgLaw, CmgSharing, Damping, Waves, cmg_rates};
use wrasse_hardware::CMGS;
use wrasse_spatial::vec3;
use wrasse_testing::larger;

/// Numbers that are none are refused; without CMGs all is missing.
#[test]
fn what_is_not_a_number_turns_no_gimbal() {
    let (cmgs, a) = (pyramid(1.0), angles([0.1, 0.2, 0.3, 0.4]));
    let wanted = vec3(0.02, -0.05, 0.04);
    for sharing in every_sharing() {
        let law = CmgLaw { sharing, null_gain: 0.1 };
        let told = cmg_rates(&cmgs, &ALL, &law, vec3(f64::NAN, 0.0, 0.0), &a, 0.0);
        assert_eq!(told.values, [0.0; CMGS]);
        let mut bad = a;
        bad[3] = f64::NAN;
        let told = cmg_rates(&cmgs, &ALL, &law, wanted, &bad, 0.0);
        assert!(told.values[3] == 0.0 && told.missing_B.norm() < 1e-3, "{told:?}");
        let told = cmg_rates(&[], &ALL, &law, wanted, &a, 0.0);
        assert_eq!((told.values, told.missing_B), ([0.0; CMGS], wanted));
    }
}

/// Numbers at either end of the range: rates within limits, or none.
#[test]
fn extreme_torques_and_angles_stay_within_limits() {
    let cmgs = pyramid(60.0);
    for sharing in every_sharing() {
        for size in [f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX] {
            for angle in [0.0, size, -size] {
                let law = CmgLaw { sharing, null_gain: 1.0 };
                let wanted = vec3(size, -size, 0.3 * size);
                let told = cmg_rates(&cmgs, &ALL, &law, wanted, &[angle; CMGS], size);
                let within = |rate: &f64| rate.abs() <= 1.0;
                assert!(told.values.iter().all(within), "{size:e} {angle:e}: {told:?}");
            }
        }
    }
}

/// 10,000 s in steps of 10 ms in single precision are 2,500 waves of 4 s. A plain clock would stand still
/// from 262,144 s on.
#[test]
fn the_clock_of_the_waves_never_stalls() {
    assert_eq!(262_144.0_f32 + 0.01, 262_144.0);
    let waves = Waves { height: 0.01_f32, frequency: 0.5 * std::f32::consts::PI, phases: [0.0; 3] };
    let sharing = CmgSharing::GeneralizedSingularityRobust(Damping::default(), waves);
    let law = CmgLaw { sharing, null_gain: 0.0 };
    let (mut time, mut count, mut most) = (0.0_f32, 0, 0.0);
    for _ in 0..1_000_000 {
        let next = law.within_a_wave(time + 0.01);
        count += i32::from(next < time);
        (time, most) = (next, larger(most, f64::from(next.abs())));
    }
    // Each step rounds by up to 1.2e-7 s, half a wave in 1e6 steps: measured 2,500 waves.
    assert!((count - 2500).abs() <= 1, "{count}");
    assert!(most <= 2.0 + 1e-6, "half a wave: {most}");
    // A law without waves has no clock, and NaN does not stay.
    let still = CmgLaw { sharing: CmgSharing::PseudoInverse, ..law };
    assert_eq!([still.within_a_wave(7.0), law.within_a_wave(f32::NAN)], [0.0, 0.0]);
}

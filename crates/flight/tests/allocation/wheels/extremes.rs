//! Single precision, NaN, numbers at either end of the range.

use super::arrays::*;
use wrasse_flight::allocation::{GroupAllocation, WheelLaw, WheelSharing, wheel_torques};
use wrasse_hardware::WHEELS;
use wrasse_spatial::{Scalar, Vec3, vec3};

/// Torques of 0.07 N·m to the 6e-8 of single precision, and some condition.
#[test]
fn single_precision_gives_the_same() {
    let wheels = pyramid();
    let narrow = wheels.map(|w| w.cast::<f32>());
    let wanted = vec3(0.05, 0.011, -0.023);
    for sharing in BOTH {
        let law_narrow = WheelLaw { sharing, null_gain: 0.0_f32 };
        let wide = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &STILL, PERIOD);
        let told: GroupAllocation<f32, WHEELS> =
            wheel_torques(&narrow, &ALL, &law_narrow, Vec3::from_f64(wanted), &[0.0; WHEELS], 0.01);
        for k in 0..WHEELS {
            let off = told.values[k].to_f64() - wide.values[k];
            assert!(off.abs() < 3e-8, "measured 6.6e-9: {off:e}");
        }
    }
}

/// Numbers that are none are refused, and nothing else is spoilt.
#[test]
fn what_is_not_a_number_moves_no_wheel() {
    let (wheels, one) = (pyramid(), law(WheelSharing::MinimumPeak));
    let told = wheel_torques(&wheels, &ALL, &one, vec3(f64::NAN, 0.1, 0.0), &STILL, PERIOD);
    assert_eq!(told.values, STILL);
    assert!(told.missing_B.x.is_nan());
    let mut speeds = STILL;
    speeds[2] = f64::INFINITY;
    let told = wheel_torques(&wheels, &ALL, &one, vec3(0.1, 0.0, 0.0), &speeds, PERIOD);
    assert_eq!(told.values[2], 0.0);
    assert!(told.missing_B.norm() < 1e-16);
}

/// Numbers at either end of the range: a command within limits, or none.
#[test]
fn extreme_torques_and_speeds_stay_within_limits() {
    let wheels = pyramid();
    for sharing in BOTH {
        for size in [f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX] {
            for speed in [0.0, size, -size] {
                let law = WheelLaw { sharing, null_gain: 1.0 };
                let wanted = vec3(size, -size, 0.3 * size);
                let told = wheel_torques(&wheels, &ALL, &law, wanted, &[speed; WHEELS], PERIOD);
                let within = |u: &f64| u.abs() <= 0.2;
                assert!(told.values.iter().all(within), "{size:e} {speed:e}: {told:?}");
            }
        }
    }
}

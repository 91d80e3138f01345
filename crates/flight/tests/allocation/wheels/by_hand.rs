//! Shares that can be worked out by hand.

use super::arrays::*;
use wrasse_flight::allocation::{WheelLaw, WheelSharing, wheel_torques};
use wrasse_spatial::{Vec3, vec3};

/// By hand: each of four wheels gives a quarter along x, against its direction cosine 1/√3.
#[test]
fn a_pyramid_shares_a_torque_along_its_axis_alike() {
    for sharing in BOTH {
        let told =
            wheel_torques(&pyramid(), &ALL, &law(sharing), vec3(0.1, 0.0, 0.0), &STILL, PERIOD);
        for u in &told.values[..4] {
            assert!((u - 0.025 * 3.0_f64.sqrt()).abs() < 1e-16, "{u}");
        }
    }
}

/// Along one wheel's own axis: the least norm takes 3/4 of it from that wheel; the least peak takes
/// 1/2 from it and as much from the others, since the sum of `|n·a|` over the steepest face is 2.
#[test]
fn the_least_peak_asks_less_of_the_wheel_that_lies_along_the_torque() {
    let wheels = pyramid();
    let along = wheels[0].axis_B * 0.1;
    let told = BOTH.map(|s| wheel_torques(&wheels, &ALL, &law(s), along, &STILL, PERIOD).values);
    assert!((told[0][0] - 0.075).abs() < 1e-15, "{:?}", told[0]);
    assert!(told[1][..4].iter().all(|u| (u.abs() - 0.05).abs() < 1e-15), "{:?}", told[1]);
}

/// One wheel along x has no choice; the three in the plane across it share at equal peaks, by hand
/// 0.1/(1 + 1/√2): the least peak of those that do not set the peak of all is least too.
#[test]
fn wheels_in_a_plane_share_at_equal_peaks() {
    let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 1.0, 1.0)];
    let wheels = axes.map(|axis| wheel(axis, 1.0, 0.1));
    let wanted = vec3(-0.7, 0.1, 0.1);
    let told =
        wheel_torques(&wheels, &ALL, &law(WheelSharing::MinimumPeak), wanted, &STILL, PERIOD);
    let share = 0.1 / (1.0 + 0.5_f64.sqrt());
    for (u, expected) in told.values.iter().zip([-0.7, share, share, share]) {
        assert!((u - expected).abs() < 1e-16, "{told:?}");
    }
}

/// Two axes give what lies in their plane, one axis what lies along it; the rest is missing.
#[test]
fn axes_that_do_not_span_give_their_part_and_report_the_rest() {
    let in_plane = [vec3(1.0, 0.0, 0.0), vec3(0.6, 0.8, 0.0), vec3(-0.8, 0.6, 0.0)];
    let wheels = in_plane.map(|axis| wheel(axis, 1.0, 0.1));
    let wanted = vec3(0.1, -0.2, 0.3);
    for sharing in BOTH {
        for (count, reached) in
            [(3, vec3(0.1, -0.2, 0.0)), (1, vec3(0.1, 0.0, 0.0)), (0, Vec3::zero())]
        {
            let told = wheel_torques(&wheels[..count], &ALL, &law(sharing), wanted, &STILL, PERIOD);
            assert!((told.missing_B - (wanted - reached)).norm() < 1e-16, "{count}: {told:?}");
        }
    }
}

/// The speeds come to those of least norm or least peak, while the momentum stays.
#[test]
fn speeds_even_out_in_time() {
    let wheels = pyramid();
    for (sharing, expected) in [
        (WheelSharing::PseudoInverse, [75.0, 25.0, -25.0, 25.0]),
        (WheelSharing::MinimumPeak, [50.0, 50.0, -50.0, 50.0]),
    ] {
        let law = WheelLaw { sharing, null_gain: 0.1 };
        let mut speeds = STILL;
        speeds[0] = 100.0;
        for _ in 0..20_000 {
            let told = wheel_torques(&wheels, &ALL, &law, Vec3::zero(), &speeds, PERIOD);
            assert!(told.missing_B.norm() < 1e-14);
            for k in 0..4 {
                speeds[k] += 0.01 * told.values[k] / wheels[k].inertia;
            }
        }
        // 200 s are 20 time constants, some lost at the torque limit: e⁻²⁰ of 50 rad/s is 1e-7,
        // measured 1.8e-7.
        for k in 0..4 {
            assert!((speeds[k] - expected[k]).abs() < 3e-7, "{sharing:?}: {speeds:?}");
        }
    }
}

//! Wheels at their speed limit.

use super::arrays::*;
use wrasse_flight::allocation::{WheelSharing, wheel_torques};
use wrasse_spatial::vec3;
use wrasse_testing::larger;

/// With one wheel of four at its limit the other three give the same torque: by hand, along -x plus
/// what they share.
#[test]
fn the_others_take_over_from_a_wheel_at_its_speed_limit() {
    let (wheels, wanted) = (pyramid(), vec3(0.05, 0.01, -0.02));
    let speeds = [600.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for sharing in BOTH {
        let free = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &STILL, PERIOD);
        assert!(free.values[0] > 0.01, "the wheel at its limit would be driven on");
        let told = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &speeds, PERIOD);
        assert_eq!(told.values[0], 0.0);
        assert!(told.missing_B.norm() < 1e-16, "{told:?}");
    }
}

/// Three seconds with a wheel that comes to its limit, as the world holds it there: changes of the torque
/// told to it (N·m in sum), and what the base felt beside what was wanted, at most (N·m).
fn at_the_limit(known: f64) -> (f64, f64) {
    let (wheels, wanted, drag) = (pyramid(), vec3(0.05, 0.01, -0.02), 0.002);
    let (mut speeds, mut last) = (STILL, None);
    speeds[0] = 599.8;
    let (mut changes, mut worst) = (0.0, 0.0_f64);
    for _ in 0..300 {
        let law = law(WheelSharing::PseudoInverse);
        let told = wheel_torques(&wheels, &ALL, &law, wanted, &speeds, known).values;
        let mut held = told;
        for k in 0..4 {
            let highest = (600.0 - speeds[k]) * wheels[k].inertia / PERIOD;
            held[k] = told[k].min(highest + drag);
            speeds[k] += (held[k] - drag) * PERIOD / wheels[k].inertia;
        }
        changes += last.map_or(0.0, |last| f64::abs(told[0] - last));
        last = Some(told[0]);
        worst = larger(worst, (given(&wheels, &held) - wanted).norm());
    }
    assert!(speeds[0] > 599.99, "{speeds:?}");
    (changes, worst)
}

/// Told without regard to the period, the wheel is told nothing at its limit and its whole share below
/// it, in turns, and the world cuts that. With it, the torque goes once from the share to the drag.
#[test]
fn a_wheel_at_its_speed_limit_does_not_chatter() {
    let (blind, with) = (at_the_limit(1e-9), at_the_limit(PERIOD));
    // Measured: changes of 2.93 N·m in sum and 0.0133 N·m off without the period; 0.0153 N·m, from the
    // share of 0.0173 N·m to the drag of 0.002 N·m, and 3.9e-18 N·m off with it.
    assert!(blind.0 > 1.0 && blind.1 > 0.01, "{blind:?}");
    assert!(with.0 < 0.016 && with.1 < 1e-16, "{with:?}");
}

/// From anywhere near the limits, no wheel ends the period beyond them by more than round-off.
#[test]
fn no_wheel_passes_its_speed_limit_within_a_period() {
    let wheels = pyramid();
    for below in [1e-9, 1e-4, 3e-3, 9e-3, 0.0199, 0.1] {
        for sharing in BOTH {
            for wanted in [vec3(0.05, 0.01, -0.02), vec3(3.0, -1.0, 2.0), vec3(-0.2, 0.2, 0.1)] {
                let speeds = [600.0 - below, 0.0, below - 600.0, 300.0, 0.0, 0.0, 0.0, 0.0];
                let told = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &speeds, PERIOD);
                for k in 0..4 {
                    let ends = speeds[k] + told.values[k] * PERIOD / wheels[k].inertia;
                    assert!(ends.abs() <= 600.0 * (1.0 + 1e-15), "{below} {k}: {ends}");
                    assert!(told.values[k].abs() <= 0.2);
                }
            }
        }
    }
}

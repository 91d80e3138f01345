//! Unloading: where it starts and stops, and what is left.

use wrasse_flight::allocation::Desaturation;
use wrasse_spatial::{Vec3, vec3};

/// Starts above 2, stops below 0.5 N·m·s, and pulls back towards the target.
#[test]
fn unloading_starts_late_and_stops_later() {
    let target_B = vec3(1.0, 0.0, 0.0);
    let mut law = Desaturation { target_B, gain: 0.1, start: 2.0, stop: 0.5, active: false };
    let asked = [2.9, 3.1, 2.0, 1.6, 1.4, 2.9, -1.1].map(|x| law.torque(vec3(x, 0.0, 0.0)).x);
    let wanted = [0.0_f64, -0.21, -0.1, -0.06, 0.0, 0.0, 0.21];
    for i in 0..7 {
        assert!((asked[i] - wanted[i]).abs() < 1e-15, "{asked:?}");
    }
    assert_eq!(law.torque(vec3(f64::NAN, 0.0, 0.0)), Vec3::zero());
}

/// What wheels hold fades as the gain says until it stops, and stays there. Periods of 0.1 s take
/// it off in steps of 1 %. Measured: over in 23.7 s, where the exponential takes 23.77 s.
#[test]
fn wheels_that_answer_the_thrusters_are_emptied() {
    let mut law =
        Desaturation { target_B: Vec3::zero(), gain: 0.1, start: 5.0, stop: 0.5, active: false };
    let (mut stored, mut fired) = (vec3(3.0_f64, -4.0, 2.0), 0.0_f64);
    let first: f64 = stored.norm();
    for _ in 0..2000 {
        let torque = law.torque(stored);
        stored += torque * 0.1;
        fired += if law.active { 0.1 } else { 0.0 };
    }
    assert!(!law.active && stored.norm() < 0.5 && stored.norm() > 0.49, "{stored:?}");
    let exponential = (first / 0.5).ln() / 0.1;
    assert!((fired / exponential - 1.0).abs() < 0.01, "{fired} s, not {exponential}");
}

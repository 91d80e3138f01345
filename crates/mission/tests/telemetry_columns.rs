//! Columns of the telemetry against each other: what is a derivative of what, and what was told.

use wrasse_document::render;
use wrasse_mission::{read_mission, run};
use wrasse_rehearsal::{CaseOutcome, RunOptions};
use wrasse_testing::{larger, largest};

fn flown(file: &str) -> CaseOutcome {
    let path = format!("{}/../../missions/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("a shipped mission");
    let mission = read_mission(&path, text).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    run(&mission, RunOptions::default(), &mut |_| {}).cases.remove(0)
}

fn column<'c>(case: &'c CaseOutcome, name: &str) -> &'c [f64] {
    let found = case.telemetry.channels.iter().find(|channel| channel.name == name);
    &found.unwrap_or_else(|| panic!("no channel {name}")).values
}

/// Largest difference of a rate from the central difference of what it is the rate of, away from the
/// samples beside a jump.
fn defect(case: &CaseOutcome, position: &[f64], rate: &[f64]) -> f64 {
    let time = &case.telemetry.time;
    let smooth = |i: &usize| case.telemetry.phase[i - 1] == case.telemetry.phase[i + 1];
    let inner = (1..time.len() - 1).filter(smooth);
    largest(inner.map(|i| {
        let found = (position[i + 1] - position[i - 1]) / (time[i + 1] - time[i - 1]);
        (found - rate[i]).abs()
    }))
}

/// Samples 0.05 s apart: differences are off by `h²/6` of the third derivative, measured 2e-6 m/s.
#[test]
fn velocities_are_the_derivatives_of_positions() {
    let case = flown("grasp-and-release.toml");
    for axis in ["x", "y", "z"] {
        let (p, v) =
            (format!("payload.module.position.{axis}"), format!("payload.module.velocity.{axis}"));
        let off = defect(&case, column(&case, &p), column(&case, &v));
        assert!(off < 1e-5, "{axis}: {off:e} m/s");
        let joint = defect(
            &case,
            column(&case, "joint.joint4.position"),
            column(&case, "joint.joint4.rate"),
        );
        assert!(joint < 1e-3, "{joint:e} deg/s");
    }
    // The base's velocity is in its own axes: turned by its quaternion it is the rate of its position.
    let part = |name: &str| ["x", "y", "z"].map(|axis| column(&case, &format!("{name}.{axis}")));
    let (v, q) = (part("base.velocity"), part("base.quaternion"));
    let w = column(&case, "base.quaternion.w");
    let turned: Vec<[f64; 3]> = (0..w.len())
        .map(|i| {
            let (s, q, v) = (w[i], q.map(|q| q[i]), v.map(|v| v[i]));
            let cross = |a: [f64; 3], b: [f64; 3]| {
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            };
            let t = cross(q, v).map(|x| 2.0 * x);
            let u = cross(q, t);
            std::array::from_fn(|k| v[k] + s * t[k] + u[k])
        })
        .collect();
    for (k, p) in part("base.position").into_iter().enumerate() {
        let rate: Vec<f64> = turned.iter().map(|v| v[k]).collect();
        let off = defect(&case, p, &rate);
        assert!(off < 1e-5, "{k}: {off:e} m/s");
    }
}

/// The first row is the start: nothing has moved, and what the first period is told is known.
#[test]
fn the_first_row_is_the_start() {
    let case = flown("base-control/wheels.toml");
    let telemetry = &case.telemetry;
    assert_eq!((telemetry.time[0], &*telemetry.phase[0]), (0.0, &*telemetry.phase[1]));
    assert_eq!(column(&case, "base.rotation.z")[0], 0.0);
    assert!(column(&case, "tool.position_error")[0].is_nan());
    assert!(telemetry.channels.iter().all(|c| c.values.len() == telemetry.time.len()));
    assert!(telemetry.channels.iter().all(|c| !c.meaning.is_empty()), "a meaning for each");
}

/// A wheel's speed changes as its motor drives it, less its friction: the shipped wheels lose at most
/// 0.5 mN·m and a twentieth of their torque to it.
#[test]
fn a_motor_drives_its_wheel_as_its_column_says() {
    let case = flown("base-control/wheels.toml");
    let names = case.telemetry.channels.iter().filter(|c| c.name.starts_with("wheel."));
    let wheels: Vec<_> = names.filter_map(|c| c.name.strip_suffix(".torque")).collect();
    assert!(!wheels.is_empty());
    for wheel in wheels {
        let torque = column(&case, &format!("{wheel}.torque"));
        let told = column(&case, &format!("{wheel}.commanded_torque"));
        let mut off = 0.0;
        for (a, b) in torque.iter().zip(told) {
            off = larger(off, (a - b).abs());
        }
        // Rounded to the step of the motor.
        assert!(off < 0.01, "{wheel}: {off} N·m");
        assert!(largest(torque.iter().map(|x| x.abs())) > 1e-3, "{wheel} does nothing");
    }
}

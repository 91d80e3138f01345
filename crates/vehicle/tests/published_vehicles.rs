//! The vehicles with published numbers, held against figures that their files do not contain.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_document::{Severity, render};
use wrasse_dynamics::{BodyId, State, jacobian, kinematics};
use wrasse_spatial::{At, Vec3};
use wrasse_testing::largest;
use wrasse_vehicle::{Grade, JOINTS, Vehicle, read_vehicle};

const FILES: [(&str, &str); 4] = [
    ("etsvii.toml", include_str!("../../../vehicles/etsvii.toml")),
    ("shuttle-rms.toml", include_str!("../../../vehicles/shuttle-rms.toml")),
    ("ssrms.toml", include_str!("../../../vehicles/ssrms.toml")),
    ("example-arm.urdf", include_str!("../../../vehicles/example-arm.urdf")),
];

#[track_caller]
fn vehicle(name: &str) -> Vehicle {
    let (_, text) = FILES.iter().find(|(file, _)| *file == name).expect("one of the files");
    read_vehicle(name, *text).unwrap_or_else(|why| panic!("{}", render(&why, false)))
}

/// Position of a frame on the base, at a posture (m).
fn position(vehicle: &Vehicle, frame: &str, q: &[f64]) -> Vec3<f64> {
    let mut state = State::<f64, JOINTS>::default();
    state.q[..q.len()].copy_from_slice(q);
    kinematics(&vehicle.robot, &state).pose(&vehicle.frame(frame).expect("a frame")).translation
}

fn mass_of_joints_bodies(vehicle: &Vehicle) -> f64 {
    vehicle.robot.joints().map(|j| vehicle.robot.inertia(BodyId::Link(j)).mass).sum()
}

#[test]
fn only_the_nonphysical_inertias_of_ets_vii_are_warned_of() {
    for (name, _) in FILES {
        let remarks = vehicle(name).remarks;
        let expected = if name == "etsvii.toml" { 3 } else { 0 };
        assert_eq!(remarks.len(), expected, "{name}: {}", render(&remarks, false));
        for remark in remarks {
            assert_eq!(remark.severity, Severity::Warning);
            assert!(remark.message.contains("breaks the triangle inequality"));
        }
    }
}

/// NASA JSC: 15.32 m from the shoulder to the tip.
#[test]
fn the_stretched_shuttle_arm_is_as_long_as_nasa_says() {
    let arm = vehicle("shuttle-rms.toml");
    let q = [0.0; 6];
    let length = (position(&arm, "tool", &q) - position(&arm, "B3", &q)).norm();
    assert!((length - 15.32).abs() < 0.01, "measured 15.3197: {length}");
    // It points aft along the sill.
    let along = position(&arm, "tool", &q) - position(&arm, "B3", &q);
    assert!(along.x < -15.3, "{along:?}");
}

/// NASA JSC: 410.5 kg. The transcribed links are 2.7 % heavier.
#[test]
fn the_shuttle_arm_weighs_what_nasa_says_within_three_percent() {
    let arm = vehicle("shuttle-rms.toml");
    let mass = arm.robot.mass() - 95_000.0;
    assert!((mass / 410.5 - 1.0).abs() < 0.03, "measured 421.76 kg: {mass}");
    assert!((mass_of_joints_bodies(&arm) - (421.76 - 63.24)).abs() < 1e-9);
}

/// The shoulder pitches upwards, out of the bay, through its whole travel.
#[test]
fn the_shuttle_arm_lifts_out_of_the_bay() {
    let arm = vehicle("shuttle-rms.toml");
    let height = |pitch: f64| -position(&arm, "tool", &[0.0, pitch, 0.0, 0.0, 0.0, 0.0]).z;
    assert!(height(0.5) > height(0.0) + 7.0);
    assert_eq!(arm.limits[1].travel.map(|(lower, _)| lower), Some(0.0));
}

/// CSA: 17 to 17.6 m and 1497 to 1800 kg, depending on the page.
#[test]
fn the_station_arm_is_as_long_and_heavy_as_published() {
    let arm = vehicle("ssrms.toml");
    let length = (position(&arm, "tool", &[0.0; 7]) - position(&arm, "B1", &[0.0; 7])).norm();
    assert!((16.9..17.6).contains(&length), "measured 17.0: {length}");
    let mass = arm.robot.mass() - 420_000.0;
    assert!((1497.0..1800.0).contains(&mass), "measured 1505.3 kg: {mass}");
}

/// The arm of ETS-VII is 2 m long and has 140.4 kg, 5.5 % of its base.
#[test]
fn the_arm_of_ets_vii_is_as_long_and_heavy_as_published() {
    let ets = vehicle("etsvii.toml");
    let mass = mass_of_joints_bodies(&ets);
    assert!((mass - 140.4).abs() < 1e-9, "{mass}");
    assert!((mass / ets.robot.inertia(BodyId::Base).mass - 0.055).abs() < 5e-4);
    // Greatest reach from the second joint, over a grid of postures of joints 3 and 5.
    let reach = |q3: f64, q5: f64| {
        let q = [0.0, 0.0, q3, 0.0, q5, 0.0];
        (position(&ets, "tool", &q) - position(&ets, "link2", &q)).norm()
    };
    let angles = || (0..72).map(|k| f64::from(k) * 5.0_f64.to_radians());
    let longest = angles().flat_map(|a| angles().map(move |b| (a, b)));
    let longest = largest(longest.map(|(a, b)| reach(a, b)));
    assert!((1.9..2.1).contains(&longest), "measured 2.09: {longest}");
}

#[test]
fn published_files_keep_assumed_numbers_apart() {
    for name in ["etsvii.toml", "shuttle-rms.toml", "ssrms.toml"] {
        let rows = vehicle(name).provenance;
        for row in &rows {
            assert!(row.source.len() > 20, "{name}: {row:?}");
            let from_memory = row.source.contains("memory");
            assert!(!from_memory || row.grade == Grade::Assumed, "{name}: {row:?}");
        }
        let com: Vec<_> = rows.iter().filter(|r| r.of.ends_with("centre_of_mass_m")).collect();
        assert!(com.len() >= 6, "{name}: {com:?}");
        assert!(com.iter().all(|row| row.grade != Grade::Published), "{name}: {com:?}");
    }
}

/// Named postures are for first runs: the tool can be moved in all directions from them.
#[test]
fn named_postures_are_within_the_travel_and_not_singular() {
    for name in ["etsvii.toml", "shuttle-rms.toml", "ssrms.toml"] {
        let vehicle = vehicle(name);
        let posture = vehicle.posture("bent").expect("a posture");
        for (q, limits) in posture.q.iter().zip(&vehicle.limits) {
            assert!(limits.travel.is_none_or(|(lower, upper)| lower < *q && *q < upper));
        }
        let least = least_singular_value(&vehicle, &posture.q);
        assert!(least > 0.4, "{name}: measured 0.438, 0.716, 0.820: {least}");
    }
}

/// Least singular value of the tool's Jacobian at a held base, lengths in units of 1 m.
fn least_singular_value(vehicle: &Vehicle, q: &[f64]) -> f64 {
    let mut state = State::<f64, JOINTS>::default();
    state.q[..q.len()].copy_from_slice(q);
    let k = kinematics(&vehicle.robot, &state);
    let J = jacobian(&k, &vehicle.frame("tool").expect("a tool"));
    let column = |j: usize| J.joints.at(j).to_array();
    let matrix = nalgebra::DMatrix::from_fn(6, q.len(), |i, j| column(j)[i]);
    matrix.singular_values().min()
}

//! MJCF models, read and held against what MuJoCo 4.0.0 computes for them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod golden_matrix;

use golden_matrix::{dense_mass_matrix, relative_difference};
use serde_json::Value;
use std::path::{Path, PathBuf};
use wrasse_document::Severity;
use wrasse_testing::larger;
use wrasse_vehicle::{Vehicle, read_vehicle};

/// Sums of a few hundred products, each off by ε = 2e-16 of the largest.
const ROUND_OFF: f64 = 1e-14;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mjcf").join(name)
}

#[track_caller]
fn read(name: &str) -> Vehicle {
    let path = data(&format!("{name}.xml"));
    let text = std::fs::read_to_string(&path).expect(name);
    read_vehicle(path, text).unwrap_or_else(|complaints| panic!("{name}: {complaints:#?}"))
}

/// Largest difference of all elements at both states, as a part of the largest element.
#[track_caller]
fn off(name: &str) -> f64 {
    let vehicle = read(name);
    let text = std::fs::read_to_string(data(&format!("{name}.json"))).expect(name);
    let golden: Value = serde_json::from_str(&text).expect(name);
    assert_eq!(Value::from(vehicle.joint_names.clone()), golden["joint_names"]);
    let states = golden["states"].as_array().expect("states");
    assert_eq!(states.len(), 2);
    let matrices = golden["mass_matrices"].as_array().expect("matrices");
    states.iter().zip(matrices).fold(0.0, |off, (state, expected)| {
        larger(off, relative_difference(&dense_mass_matrix(&vehicle, &state["joints"]), expected))
    })
}

/// Classes, degrees, geoms with density and mass, joints off the origin, references, sites.
#[test]
fn the_mass_matrix_of_a_servicer_is_mujocos() {
    let off = off("servicer");
    assert!(off < ROUND_OFF, "measured 1.4e-15: {off:e}");
}

/// Radians, another order of Euler angles, shells, frames, groups, least and balanced inertias, a
/// total mass.
#[test]
fn what_the_compiler_is_told_to_make_of_masses_is_made_of_them() {
    let off = off("conventions");
    assert!(off < ROUND_OFF, "measured 8e-16: {off:e}");
}

#[test]
fn a_model_in_three_files_is_read_as_one() {
    let off = off("included");
    assert!(off < ROUND_OFF, "measured 3.5e-16: {off:e}");
    let vehicle = read("included");
    let texts: Vec<_> = vehicle.files().map(|(_, text)| text).collect();
    let told = |what: &str| texts.iter().any(|text| text.contains(what));
    assert!(texts.len() == 3 && told("density=\"900\"") && told("0 0 0 0.9 0 0"));
    assert!(vehicle.frame("mark").is_some());
}

/// Pieces between two joints of a body have no mass.
#[test]
fn several_joints_in_a_body_move_it_one_after_the_other() {
    let off = off("several_joints");
    assert!(off < ROUND_OFF, "measured 1.8e-16: {off:e}");
}

#[test]
fn an_armature_is_the_rotor_of_its_joint() {
    let vehicle = read("servicer");
    assert!(vehicle.remarks.iter().all(|remark| remark.severity != Severity::Warning));
    let rotors: Vec<f64> =
        vehicle.robot.joints().map(|j| vehicle.robot.joint(j).rotor_inertia).collect();
    assert!(rotors.len() == 5 && rotors.iter().all(|rotor| *rotor > 0.0), "{rotors:?}");
}

#[test]
fn a_keyframe_is_a_posture_and_a_site_a_frame() {
    let vehicle = read("servicer");
    assert_eq!(vehicle.posture("home").expect("home").q, [0.1, -0.2, 0.3, 0.4, 0.05]);
    for frame in ["bus", "port", "left_tool", "right2"] {
        assert!(vehicle.frame(frame).is_some(), "{frame}");
    }
    let limits = vehicle.limits[2];
    assert_eq!(limits.effort, Some(20.0));
    assert!(limits.travel.is_some_and(|(lower, upper)| lower == -upper && upper > 2.6));
    assert_eq!(vehicle.limits[4].travel, Some((-0.2, 0.4)));
}

//! The golden robots, read and held against what Pinocchio 4.1.0 computes for them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod golden_matrix;

use golden_matrix::{dense_mass_matrix, relative_difference};
use serde_json::Value;
use std::path::{Path, PathBuf};
use wrasse_dynamics::BodyId;
use wrasse_testing::larger;
use wrasse_vehicle::{Vehicle, read_vehicle};

fn golden(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/golden").join(name)
}

#[track_caller]
fn read(name: &str) -> Vehicle {
    let text = std::fs::read_to_string(golden(name)).expect(name);
    read_vehicle(name, text).unwrap_or_else(|complaints| panic!("{name}: {complaints:#?}"))
}

fn answers(name: &str) -> Value {
    let text = std::fs::read_to_string(golden(name)).expect(name);
    serde_json::from_str(&text).expect(name)
}

#[test]
fn every_golden_robot_is_read_without_complaint() {
    let mut read_files = 0;
    for entry in std::fs::read_dir(golden("")).expect("the golden folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "urdf") {
            let vehicle = read(path.file_name().and_then(|n| n.to_str()).expect("a name"));
            assert_eq!(vehicle.remarks, [], "{}", vehicle.name);
            read_files += 1;
        }
    }
    assert_eq!(read_files, 6);
}

#[test]
fn joints_keep_the_order_of_the_file() {
    for name in ["one_arm", "two_arms"] {
        let (vehicle, answers) = (read(&format!("{name}.urdf")), answers(&format!("{name}.json")));
        assert_eq!(Value::from(vehicle.joint_names), answers["expect"]["joint_names"]);
    }
}

/// Mass matrices see every mass, centre of mass, inertia, rotated frame, joint pose and axis: a
/// number read wrongly anywhere in the file shows.
#[test]
fn mass_matrices_of_the_robots_as_read_agree_with_pinocchio() {
    let mut largest = 0.0_f64;
    for name in ["one_arm", "two_arms"] {
        let (vehicle, answers) = (read(&format!("{name}.urdf")), answers(&format!("{name}.json")));
        let states = answers["input"]["states"].as_array().expect("states");
        let results = answers["expect"]["results"].as_array().expect("results");
        assert_eq!(states.len(), 4);
        for (state, result) in states.iter().zip(results) {
            let M = dense_mass_matrix(&vehicle, &state["joints"]);
            largest = larger(largest, relative_difference(&M, &result["mass_matrix"]));
        }
    }
    // Sums of a few hundred products, each off by ε = 2e-16 of the largest.
    assert!(largest < 1e-14, "measured 4e-16: {largest:e}");
}

#[test]
fn links_fixed_to_each_other_are_one_body_with_the_mass_of_all() {
    let vehicle = read("atlas_class_200kg.urdf");
    let last = vehicle.robot.inertia(BodyId::Link(6));
    assert_eq!(vehicle.robot.joint_count(), 7);
    // Link 7 has 8 kg at 0.1 m, the payload 200 kg at 0.2 + 0.5 m.
    assert!((last.mass - 208.0).abs() < 1e-12);
    let x = last.centre_of_mass().x;
    assert!((x - (8.0 * 0.1 + 200.0 * 0.7) / 208.0).abs() < 1e-15, "{x}");
    let I_parts = vehicle.robot.inertia_of_parts(BodyId::Link(6));
    assert!((I_parts.xx - (0.0144 + 100.0 / 3.0)).abs() < 1e-13, "{I_parts:?}");
    let tool = vehicle.frame("tool").expect("the tool");
    assert_eq!((tool.body, tool.X_BF.translation.x), (BodyId::Link(6), 0.2));
}

//! The vehicles that come with wrasse.

#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use std::path::Path;
use wrasse_document::{Severity, render};
use wrasse_dynamics::{BodyId, State, generalized_jacobian, jacobian, kinematics, mass_matrix};
use wrasse_spatial::{At, Vec3};
use wrasse_testing::larger;
use wrasse_vehicle::{JOINTS, NoVehicle, Vehicle, catalogue, find_vehicle, read_vehicle};

fn vehicle(name: &str) -> Vehicle {
    match find_vehicle(name, None) {
        Ok(vehicle) => vehicle,
        Err(NoVehicle::Faulty(complaints)) => panic!("{}", render(&complaints, false)),
        Err(other) => panic!("{other:?}"),
    }
}

/// Largest difference between the numbers of two robots, relative to the larger of the two.
fn difference(a: &Vehicle, b: &Vehicle) -> f64 {
    assert_eq!(a.joint_names, b.joint_names);
    let mut worst: f64 = 0.0;
    let mut compare = |x: f64, y: f64| {
        let scale = larger(x.abs(), y.abs());
        worst = larger(worst, if scale > 0.0 { (x - y).abs() / scale } else { 0.0 });
    };
    for j in a.robot.joints() {
        let (a, b) = (a.robot.joint(j), b.robot.joint(j));
        assert_eq!((a.parent, a.kind), (b.parent, b.kind));
        let numbers = |joint: &wrasse_dynamics::Joint<f64>| {
            let [x, y, z] = joint.X_PB_zero.rotation.rows;
            [x, y, z, joint.X_PB_zero.translation, joint.axis_B].map(Vec3::to_array).concat()
        };
        numbers(a).iter().zip(numbers(b)).for_each(|(x, y)| compare(*x, y));
    }
    for body in a.robot.bodies() {
        let (a, b) = (a.robot.inertia(body).to_matrix(), b.robot.inertia(body).to_matrix());
        a.concat().iter().zip(b.concat()).for_each(|(x, y)| compare(*x, y));
    }
    worst
}

#[test]
fn every_vehicle_of_the_catalogue_is_read_without_error() {
    for entry in catalogue() {
        let vehicle = vehicle(entry.name);
        let errors = vehicle.remarks.iter().filter(|r| r.severity == Severity::Error).count();
        assert_eq!(errors, 0, "{}", entry.name);
        assert_eq!(vehicle.name, entry.name);
    }
}

#[test]
fn every_number_of_the_catalogue_says_where_it_comes_from() {
    for entry in catalogue() {
        let remarks = vehicle(entry.name).remarks;
        let without: Vec<_> = remarks.iter().filter(|r| r.message.contains("come from")).collect();
        assert!(without.is_empty(), "{}: {without:?}", entry.name);
    }
}

#[test]
fn every_file_in_vehicles_is_in_the_catalogue() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vehicles");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .filter(|name| Path::new(name).extension().is_some_and(|e| e != "md"))
        .collect();
    files.sort();
    let mut listed: Vec<_> = catalogue().iter().map(|entry| entry.file_name).collect();
    listed.sort_unstable();
    assert_eq!(files, listed);
}

#[test]
fn atlas_class_is_the_robot_of_the_golden_data() {
    let text = include_str!("../../../validation/golden/atlas_class_unladen.urdf");
    let golden = read_vehicle("atlas_class_unladen.urdf", text).unwrap();
    let ours = vehicle("atlas-class");
    // The golden file's numbers carry the round-off of the formulae they were made with.
    let off = difference(&ours, &golden);
    assert!(off <= 1e-15, "measured 2.2e-16: {off:e}");
    let tool = |v: &Vehicle| v.frame("tool").unwrap();
    assert_eq!(tool(&ours), tool(&golden));
    assert_eq!(ours.tools, ["tool"]);
}

#[test]
fn each_arm_of_the_two_armed_vehicle_is_the_arm_of_the_one_armed() {
    let (one, two) = (vehicle("atlas-class"), vehicle("atlas-class-two-arms"));
    for j in one.robot.joints() {
        for (arm, side) in [(j, 0.5), (j + 7, -0.5)] {
            let (a, b) = (one.robot.joint(j), two.robot.joint(arm));
            assert_eq!((a.axis_B, a.X_PB_zero.rotation), (b.axis_B, b.X_PB_zero.rotation));
            let on_mount = |y: f64| [0.9, y, 0.0];
            let expected = if j == 0 { on_mount(side) } else { a.X_PB_zero.translation.to_array() };
            assert_eq!(b.X_PB_zero.translation.to_array(), expected);
            let inertia = |v: &Vehicle, k| *v.robot.inertia(BodyId::Link(k));
            assert_eq!(inertia(&one, j), inertia(&two, arm));
        }
    }
    assert_eq!(one.robot.inertia(BodyId::Base), two.robot.inertia(BodyId::Base));
    assert_eq!(two.tools, ["a_tool", "b_tool"]);
    let (start, both) = (one.posture("sideways_1m").unwrap(), two.posture("sideways_1m").unwrap());
    assert_eq!(start.q[..], both.q[..7]);
}

/// Determinant of the generalized Jacobian's x and y rows (m²) at two joint angles (deg).
fn planar_determinant(vehicle: &Vehicle, deg: [f64; 2]) -> f64 {
    let mut state = State::<f64, JOINTS>::default();
    state.q[..2].copy_from_slice(&deg.map(f64::to_radians));
    let poses = kinematics(&vehicle.robot, &state);
    let J_tool = jacobian(&poses, &vehicle.frame("tool").expect("a tool"));
    let J = generalized_jacobian(&J_tool, &mass_matrix(&poses));
    let [first, second] = [0, 1].map(|j| J.linear.at(j));
    first.x * second.y - second.x * first.y
}

#[test]
fn the_planar_vehicle_is_singular_at_its_dynamic_singularity() {
    let planar = vehicle("planar-two-link");
    // Its posture is given to six decimals of a degree.
    let posture = planar.posture("dynamic_singularity").unwrap();
    let at_root = planar_determinant(&planar, [posture.q[0], posture.q[1]].map(f64::to_degrees));
    assert!(at_root.abs() < 1e-8, "measured 3.2e-9: {at_root:e}");
    // Elsewhere: figures of an independent calculation for the planar case alone.
    for (deg, expected) in
        [([0.0, 30.0], 0.156_718), ([0.0, 90.0], 0.376_019), ([-65.0, -5.0], 0.043_425)]
    {
        let found = planar_determinant(&planar, deg);
        assert!((found - expected).abs() < 5e-7, "rounded to six decimals: {found}");
    }
    assert!(planar_determinant(&planar, [-65.0, -20.0]) < -0.05);
}

#[test]
fn a_file_is_found_beside_the_file_that_names_it() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let vehicle = find_vehicle("data/small.toml", Some(&tests)).unwrap();
    assert_eq!(vehicle.name, "small");
}

#[test]
fn a_name_that_is_not_in_the_catalogue_finds_the_nearest() {
    let Err(NoVehicle::NotFound { help, .. }) = find_vehicle("atlas-clas", None) else {
        panic!("found")
    };
    assert_eq!(help, "did you mean \"atlas-class\"?");
    let Err(NoVehicle::NotFound { message, .. }) = find_vehicle("none.toml", Some(Path::new("x")))
    else {
        panic!("found")
    };
    assert!(message.contains("none.toml"), "{message}");
}

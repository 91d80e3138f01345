//! What every vehicle of the catalogue owes to whoever opens it: sources that say enough, postures to
//! start from, grips that can be taken.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_document::render;
use wrasse_dynamics::{State, jacobian, kinematics};
use wrasse_spatial::{At, Vec3, vec3};
use wrasse_vehicle::{Grade, JOINTS, ShapeKind, Vehicle, catalogue};

fn vehicles() -> impl Iterator<Item = Vehicle> {
    catalogue()
        .iter()
        .map(|entry| entry.read().unwrap_or_else(|why| panic!("{}", render(&why, false))))
}

/// Whether a number is one that nobody looked up.
fn is_from_memory(source: &str) -> bool {
    source.contains("memory") || source.contains("remembered") || source.contains("unverified")
}

#[test]
fn what_is_remembered_is_assumed_and_every_source_says_enough() {
    for vehicle in vehicles() {
        let name = &vehicle.name;
        for row in vehicle.provenance.iter().filter(|row| row.of != "everything") {
            assert!(row.source.len() > 20, "{name}: {row:?}");
            assert!(!is_from_memory(&row.source) || row.grade == Grade::Assumed, "{name}: {row:?}");
        }
    }
}

/// A document can be opened: it has an address, a year, or says that it is second-hand.
#[test]
fn what_is_published_names_its_document() {
    for vehicle in vehicles() {
        let published = |row: &&_| {
            let row: &wrasse_vehicle::Provenance = row;
            row.grade == Grade::Published
        };
        for row in vehicle.provenance.iter().filter(published) {
            let named =
                ["19", "20", ".com", ".gov", ".wiki", ".org", ".edu", ".ru", "esa.int", ".urdf"];
            let name = &vehicle.name;
            assert!(named.iter().any(|part| row.source.contains(part)), "{name}: {row:?}");
        }
    }
}

#[test]
fn centres_of_mass_of_links_are_published_nowhere() {
    for name in ["etsvii", "etsvii-repaired", "shuttle-rms", "ssrms"] {
        let vehicle = vehicles().find(|vehicle| vehicle.name == name).expect("it is there");
        let rows = &vehicle.provenance;
        let com: Vec<_> = rows.iter().filter(|r| r.of.ends_with("centre_of_mass_m")).collect();
        assert!(com.len() >= 6, "{name}: {com:?}");
        assert!(com.iter().all(|row| row.grade != Grade::Published), "{name}: {com:?}");
    }
}

#[test]
fn vehicles_of_real_systems_say_what_is_not_public() {
    for vehicle in vehicles() {
        let made_up = ["planar-two-link", "example-arm"].contains(&vehicle.name.as_str());
        assert_eq!(vehicle.not_public.is_empty(), made_up, "{}", vehicle.name);
    }
}

#[test]
fn drives_of_arms_are_limited_and_postures_are_within_the_travel() {
    for vehicle in vehicles().filter(|vehicle| vehicle.robot.joint_count() >= 6) {
        let name = &vehicle.name;
        for (joint, limits) in vehicle.joint_names.iter().zip(&vehicle.limits) {
            // Of ETS-VII as published no limit is known.
            let limited = limits.rate.is_some() && limits.effort.is_some();
            assert!(limited || name == "etsvii", "{name}: {joint}");
        }
        for posture in &vehicle.postures {
            for (q, limits) in posture.q.iter().zip(&vehicle.limits) {
                let within = limits.travel.is_none_or(|(lower, upper)| lower < *q && *q < upper);
                assert!(within, "{name}: {posture:?}");
            }
        }
    }
}

/// Named postures are for first runs: each tool can be moved in all directions from them.
#[test]
fn named_postures_are_not_singular() {
    for vehicle in vehicles().filter(|vehicle| vehicle.robot.joint_count() >= 6) {
        assert!(!vehicle.postures.is_empty(), "{}", vehicle.name);
        for posture in &vehicle.postures {
            for tool in &vehicle.tools {
                let condition = condition_number(&vehicle, tool, &posture.q);
                let what = format!("{}: {tool} at {}", vehicle.name, posture.name);
                assert!(condition < 9.0, "measured 8.2 at most: {what}: {condition}");
            }
        }
    }
}

/// Condition number of a tool's Jacobian at a held base, lengths in units of half the stretched arm.
fn condition_number(vehicle: &Vehicle, tool: &str, q: &[f64]) -> f64 {
    let mut state = State::<f64, JOINTS>::default();
    let frame = vehicle.frame(tool).expect("a tool");
    let stretched = kinematics(&vehicle.robot, &state);
    let J = jacobian(&stretched, &frame);
    let first = (0..q.len()).find(|j| J.joints.at(*j).to_array() != [0.0; 6]).expect("a joint");
    let root = stretched.pose(&wrasse_dynamics::Frame {
        body: wrasse_dynamics::BodyId::Link(first),
        X_BF: wrasse_spatial::Pose::identity(),
    });
    let length = 0.5 * (stretched.pose(&frame).translation - root.translation).norm();
    state.q[..q.len()].copy_from_slice(q);
    let J = jacobian(&kinematics(&vehicle.robot, &state), &frame);
    let column = |j: usize| J.joints.at(j).to_array();
    let scale = |i: usize| if i < 3 { 1.0 } else { 1.0 / length };
    let matrix = nalgebra::DMatrix::from_fn(6, q.len(), |i, j| column(j)[i] * scale(i));
    let values = matrix.singular_values();
    values.max() / values.min()
}

/// Whether a point in the base's frame is inside one of the outlines of the base.
fn is_inside(vehicle: &Vehicle, p: Vec3<f64>) -> bool {
    vehicle.shapes.iter().any(|shape| {
        let X = shape.frame.X_BF;
        let p = X.rotation.transpose() * (p - X.translation);
        match shape.kind {
            ShapeKind::Box(e) => {
                p.x.abs() <= e.x / 2.0 && p.y.abs() <= e.y / 2.0 && p.z.abs() <= e.z / 2.0
            }
            ShapeKind::Cylinder { radius, length } => {
                p.x.hypot(p.y) <= radius && p.z.abs() <= length / 2.0
            }
            ShapeKind::Sphere(radius) => p.norm() <= radius,
        }
    })
}

/// A hand comes along the x of the grip, at the target of ETS-VII along its z.
#[test]
fn grips_of_clients_lie_on_the_outline_and_point_into_it() {
    let mut grips = 0;
    let is_client = |vehicle: &Vehicle| {
        vehicle.robot.joint_count() == 0 && vehicle.equipment.thruster_names.is_empty()
    };
    for client in vehicles().filter(is_client) {
        assert!(client.tools.iter().any(|tool| tool == "grip"), "{}", client.name);
        let z = client.name == "etsvii-target";
        let along = if z { vec3(0.0, 0.0, 1.0) } else { vec3(1.0, 0.0, 0.0) };
        for tool in &client.tools {
            let X = client.pose_on_body(tool).expect("a tool");
            let step = X.rotation * along * 1e-3;
            assert!(is_inside(&client, X.translation + step), "{}: {tool}", client.name);
            assert!(!is_inside(&client, X.translation - step), "{}: {tool}", client.name);
            grips += 1;
        }
    }
    assert_eq!(grips, 7);
}

//! Mass matrices of vehicles beside those that another program computed.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use serde_json::Value;
use wrasse_dynamics::{State, kinematics, mass_matrix};
use wrasse_testing::larger;
use wrasse_vehicle::{JOINTS, Vehicle};

pub(crate) fn dense_mass_matrix(vehicle: &Vehicle, joints: &Value) -> Vec<Vec<f64>> {
    let mut state = State::<f64, JOINTS>::default();
    for (q, name) in state.q.iter_mut().zip(&vehicle.joint_names) {
        *q = joints[name]["position"].as_f64().unwrap_or(0.0);
    }
    let M = mass_matrix(&kinematics(&vehicle.robot, &state));
    let n = vehicle.robot.joint_count();
    (0..6 + n).map(|i| (0..6 + n).map(|k| M.element(i, k)).collect()).collect()
}

/// Largest difference as a part of the largest element.
pub(crate) fn relative_difference(M: &[Vec<f64>], expected: &Value) -> f64 {
    let (mut off, mut scale) = (0.0_f64, 0.0_f64);
    assert_eq!(expected.as_array().expect("rows").len(), M.len());
    for (i, row) in M.iter().enumerate() {
        for (k, &found) in row.iter().enumerate() {
            let wanted = expected[i][k].as_f64().expect("a number");
            off = larger(off, (found - wanted).abs());
            scale = larger(scale, wanted.abs());
        }
    }
    off / scale
}

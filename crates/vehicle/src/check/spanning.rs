//! Whether wheels and CMGs can make torque about every axis.

use crate::figures::figures;
use crate::table::Reading;
use nalgebra::{Matrix3, SymmetricEigen};
use std::ops::Range;
use wrasse_hardware::{Actuators, CMGS};
use wrasse_spatial::{Sym3, Vec3};

/// Below this (–) the axes lie in a plane: they are out of it by less than a thousandth of a radian.
const FLAT: f64 = 1e-6;
/// More than any decomposition of three by three takes.
const MOST_ITERATIONS: usize = 1000;

/// Complains of wheels and CMGs that cannot make torque about every axis, at the place of the first;
/// doubts CMGs that cannot do so at the start. With thrusters beside them it is all a doubt.
pub(crate) fn check_spanning(
    reading: &mut Reading<'_>,
    actuators: &Actuators<f64>,
    start: &[f64; CMGS],
    at: &Range<usize>,
) {
    let kinds = match (actuators.wheels.is_empty(), actuators.cmgs.is_empty()) {
        (true, true) => return,
        (false, true) => "wheels",
        (true, false) => "CMGs",
        (false, false) => "wheels and CMGs",
    };
    // What CMGs can do at best they can do at almost all angles.
    let somewhere: [f64; CMGS] = std::array::from_fn(|k| 0.4 + 1.1 * (k * k + k) as f64);
    let elsewhere: [f64; CMGS] = std::array::from_fn(|k| 2.0 - 0.37 * (k * k * k) as f64);
    let (first, second) = (torque_axes(actuators, &somewhere), torque_axes(actuators, &elsewhere));
    let best = if rank(&second).0 > rank(&first).0 { second } else { first };
    let (rank, told) = rank(&best);
    if rank == 3 {
        return doubt_start(reading, actuators, start, at);
    }
    let message = format!(
        "the {kinds} make torque in {rank} of 3 dimensions: {told}, whatever they are told"
    );
    let help = "three axes that do not lie in one plane are the least, one unit more makes up for one \
                that fails";
    if actuators.thrusters.is_empty() {
        reading.found.error(at, message, "and the others", help);
    } else {
        reading.found.warning(at, message, "and the others", "the thrusters must do the rest");
    }
}

/// Doubts CMGs that could make torque about every axis and cannot at the start.
fn doubt_start(
    reading: &mut Reading<'_>,
    actuators: &Actuators<f64>,
    angles: &[f64; CMGS],
    at: &Range<usize>,
) {
    let (rank, told) = rank(&torque_axes(actuators, angles));
    if rank == 3 {
        return;
    }
    let message = format!("at the start the CMGs are singular: {told}");
    let help = "other gimbal angles at the start, say 45, -45, 45, -45 deg, give torque every way";
    reading.found.warning(at, message, "these CMGs", help);
}

fn torque_axes(actuators: &Actuators<f64>, angles: &[f64; CMGS]) -> Vec<Vec3<f64>> {
    let wheels = actuators.wheels.iter().map(|wheel| wheel.axis_B);
    let cmgs = actuators.cmgs.iter().zip(angles);
    wheels.chain(cmgs.map(|(cmg, &angle)| cmg.torque_axis(angle))).collect()
}

/// How many dimensions unit vectors span, and which direction is missing or which alone is there.
fn rank(axes: &[Vec3<f64>]) -> (usize, String) {
    let sum = axes.iter().fold(Sym3::zero(), |sum, &a| sum + Sym3::symmetric_part(&a.outer(a)));
    let S = sum.to_mat3();
    let matrix = Matrix3::from_fn(|i, j| S.rows[i].to_array()[j]);
    let Some(eigen) = SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_ITERATIONS) else {
        return (3, String::new());
    };
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let direction = |k: usize| {
        let v = eigen.eigenvectors.column(order[k]);
        // A direction and its opposite are the same axis: the first component that counts is positive.
        let first = v.iter().find(|x| x.abs() > FLAT).copied().unwrap_or(1.0);
        let told = |x: f64| figures(if x.abs() > FLAT { x * first.signum() } else { 0.0 });
        format!("[{}, {}, {}]", told(v[0]), told(v[1]), told(v[2]))
    };
    let rank = eigen.eigenvalues.iter().filter(|value| **value > FLAT).count();
    match rank {
        3 => (3, String::new()),
        2 => (2, format!("none about {}", direction(0))),
        _ => (rank, format!("about {} alone", direction(2))),
    }
}

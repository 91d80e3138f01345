//! The condition of the mass matrix over postures within the travel.

use super::finding::{Finding, FindingKind, FindingSeverity, Fine};
use crate::check::{postures, travel_or_usual};
use crate::figures::figures;
use crate::vehicle::Vehicle;
use nalgebra::{DMatrix, SymmetricEigen};
use wrasse_dynamics::{JointKind, State, kinematics, mass_matrix};
use wrasse_hardware::follow;

/// Condition above which it is told (–): of the sixteen digits of a number ten are left.
/// The catalogue has 1 to 2.1e4.
const BOUND: f64 = 1e6;
/// When to give up on eigenvalues: nalgebra goes on until it converges unless told.
const MOST_ITERATIONS: usize = 10_000;
/// Joints of the worst posture that are named.
const NAMED: usize = 4;

/// The largest condition number of the mass matrix, scaled so that its diagonal is one: a ratio of
/// eigenvalues that no choice of units changes.
pub(super) fn condition_findings(vehicle: &Vehicle) -> (Vec<Finding>, Fine) {
    let travels: Vec<_> = vehicle.limits.iter().map(|limits| limits.travel).collect();
    let looked = postures(&travel_or_usual(&vehicle.robot, &travels));
    let count = looked.len();
    let mut worst = (0.0, vec![]);
    for mut q in looked {
        follow(&vehicle.followers, &mut q);
        let condition = condition(vehicle, &q);
        if condition > worst.0 {
            worst = (condition, q);
        }
    }
    let (most, q) = worst;
    let numbers = vec![("condition", most), ("postures", count as f64)];
    let message = format!("at most {} over {count} postures", figures(most));
    if most <= BOUND {
        return (vec![], Fine { kind: FindingKind::MassMatrixCondition, message, numbers });
    }
    let message = format!(
        "{}; bound {}; worst at {}",
        if most.is_finite() { message.clone() } else { "singular to the last digit".into() },
        figures(BOUND),
        posture_in_words(vehicle, &q)
    );
    let finding = Finding {
        kind: FindingKind::MassMatrixCondition,
        severity: FindingSeverity::Warning,
        subject: vehicle.name.clone(),
        place: None,
        message: message.clone(),
        numbers: numbers.clone(),
    };
    (vec![finding], Fine { kind: FindingKind::MassMatrixCondition, message, numbers })
}

/// Of the scaled matrix in a posture; infinite where it is not positive definite.
fn condition(vehicle: &Vehicle, q: &[f64]) -> f64 {
    let mut state = State::default();
    state.q.iter_mut().zip(q).for_each(|(to, from)| *to = *from);
    let M = mass_matrix(&kinematics(&vehicle.robot, &state));
    let rows = vehicle.robot.joint_count() + 6;
    let scale = |i: usize| M.element(i, i).sqrt();
    let scaled = DMatrix::from_fn(rows, rows, |i, k| M.element(i, k) / (scale(i) * scale(k)));
    if !scaled.iter().all(|x| x.is_finite()) {
        return f64::INFINITY;
    }
    let eigen = SymmetricEigen::try_new(scaled, f64::EPSILON, MOST_ITERATIONS);
    let values = eigen.map(|eigen| (eigen.eigenvalues.min(), eigen.eigenvalues.max()));
    match values {
        Some((least, largest)) if least > 0.0 => largest / least,
        _ => f64::INFINITY,
    }
}

fn posture_in_words(vehicle: &Vehicle, q: &[f64]) -> String {
    let turned = q.iter().enumerate().filter(|(_, q)| q.abs() > 1e-12);
    let told = turned.clone().take(NAMED).map(|(j, q)| {
        let (value, unit) = match vehicle.robot.joint(j).kind {
            JointKind::Revolute => (q.to_degrees(), "deg"),
            JointKind::Prismatic => (*q, "m"),
        };
        let name = vehicle.joint_names.get(j).map_or("", String::as_str);
        format!("{name} = {} {unit}", figures(value))
    });
    let told: Vec<_> = told.collect();
    match (told.len(), turned.count() - told.len()) {
        (0, _) => "zero".to_owned(),
        (_, 0) => told.join(", "),
        (_, more) => format!("{} and {more} joints more", told.join(", ")),
    }
}

//! Other joint positions that bring the tool of a case to where it is at the start.

use crate::case::Case;
use wrasse_dynamics::{State, kinematics};
use wrasse_flight::inverse_kinematics::{
    Anchor, ClosedForm, DampedLeastSquares, DampedOutcome, SphericalRevoluteSpherical,
    damped_least_squares,
};
use wrasse_spatial::Pose;
use wrasse_vehicle::JOINTS;

/// Joint positions nearer to each other than this are one posture (rad or m).
const APART: f64 = 0.1;
/// Most joints whose signs are turned round in all combinations.
const TURNED: usize = 8;
/// Arm angles of an arm that has one, beside its own (deg).
const ARM_ANGLES: [f64; 8] = [0.0, 30.0, -30.0, 60.0, -60.0, 120.0, -120.0, 180.0];
/// A tool is brought to where it was (m, rad).
const SETTINGS: DampedLeastSquares<f64> =
    DampedLeastSquares { position_tolerance: 1e-9, rotation_tolerance: 1e-9, iterations: 200 };

/// Postures within the travel of the joints, to a hundredth of a degree, the nearest to the one of the
/// case first.
pub(crate) fn other_postures(case: &Case) -> Vec<[f64; JOINTS]> {
    let start = &case.start.q;
    let mut found: Vec<[f64; JOINTS]> = vec![*start];
    for q in branches(case).unwrap_or_else(|| bent_otherwise(case)) {
        let q = rounded(case, &q);
        let is_new = found.iter().all(|known| largest(known, &q) > APART);
        if is_new && is_within(case, &q) {
            found.push(q);
        }
    }
    found.remove(0);
    found.sort_by(|a, b| largest(a, start).total_cmp(&largest(b, start)));
    found
}

/// All branches of an arm that has a closed form, at its own arm angle and at others.
fn branches(case: &Case) -> Option<Vec<[f64; JOINTS]>> {
    let (robot, tool) = (&case.vehicle.robot, &case.setup.assignment.tool);
    let start = State { X_NB: Pose::identity(), q: case.start.q, ..State::default() };
    let X_BE = kinematics(robot, &start).pose(tool);
    let arm = SphericalRevoluteSpherical::fixed_base(robot, tool).ok()?;
    let near = arm.positions(&start.q);
    let (own, _) = arm.arm_angle(&near);
    let mut all = vec![];
    for angle in ARM_ANGLES {
        if let ClosedForm::Solved(found) = arm.solve(&X_BE, own + angle.to_radians(), &near) {
            all.extend(found.iter().map(|one| arm.put(&one.q, &start.q)));
        }
    }
    Some(all)
}

/// Postures of any arm, sought from the case's own with joints bent the other way, in all combinations.
fn bent_otherwise(case: &Case) -> Vec<[f64; JOINTS]> {
    let (robot, tool) = (&case.vehicle.robot, &case.setup.assignment.tool);
    let (start, limits) = (&case.start, &case.setup.limits);
    let X_NE = kinematics(robot, start).pose(tool);
    let joints: Vec<usize> = robot.path_to_base(tool.body).take(TURNED).collect();
    let sought = (1..1_usize << joints.len()).filter_map(|signs| {
        let mut seed = State { X_NB: start.X_NB, q: start.q, ..State::default() };
        for (i, &j) in joints.iter().enumerate() {
            if signs >> i & 1 == 1 {
                seed.q[j] = -seed.q[j];
            }
        }
        let end = damped_least_squares(robot, tool, &seed, &X_NE, limits, Anchor::Base, &SETTINGS);
        match end {
            DampedOutcome::Converged(attempt) => Some(attempt.q),
            _ => None,
        }
    });
    sought.collect()
}

/// Turning joints to a hundredth of a degree, and a whole turn back where that brings them into travel.
fn rounded(case: &Case, q: &[f64; JOINTS]) -> [f64; JOINTS] {
    core::array::from_fn(|j| {
        let turns = j < case.vehicle.robot.joint_count() && case.turns(j);
        if !turns {
            return q[j];
        }
        let (lower, upper) =
            case.setup.limits[j].travel.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let told = |turn: f64| ((q[j].to_degrees() * 100.0).round() / 100.0 + turn).to_radians();
        let ways = [0.0, 360.0, -360.0].map(told);
        ways.into_iter().find(|q| (lower..=upper).contains(q)).unwrap_or(ways[0])
    })
}

fn is_within(case: &Case, q: &[f64; JOINTS]) -> bool {
    case.vehicle.robot.joints().all(|j| {
        let travel = case.setup.limits[j].travel;
        travel.is_none_or(|(lower, upper)| (lower..=upper).contains(&q[j]))
    })
}

/// Largest difference of a joint's position (rad or m).
fn largest(a: &[f64; JOINTS], b: &[f64; JOINTS]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

//! Joint positions for a tool pose: in closed form where the arm allows it, by damped least squares
//! otherwise.

use crate::interface::Axes;
use crate::inverse_kinematics::{
    Anchor, Attempt, ClosedForm, DampedLeastSquares, DampedOutcome, SphericalRevoluteSpherical,
    damped_least_squares,
};
use crate::law::ArmLaw;
use wrasse_dynamics::{Frame, Robot, State, kinematics};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Scalar};

/// A tool pose that no joint positions were found for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unreachable<T> {
    /// Distance of the tool from the pose at the best joint positions found (m).
    pub position_error: T,
    /// Angle that is left there (rad).
    pub rotation_error: T,
    /// The joint that stands at the end of its travel, where that is the reason.
    pub joint: Option<usize>,
}

/// Good enough for a set-point (m, rad), and when to give up.
const SETTINGS: (f64, f64, u32) = (1e-9, 1e-9, 300);

/// Joint positions (rad or m) that bring the tool to `X` (in `axes`), seen from `state`.
///
/// A law that takes the base for fixed solves for a fixed base; one that holds the attitude, or lets
/// the base float, for a held attitude and centre of mass. The arm keeps its arm angle.
///
/// # Errors
/// If the pose is out of reach, with what is left at the nearest.
pub fn joints_for_tool<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
    state: &State<T, J>,
    X: &Pose<T>,
    axes: Axes,
    law: ArmLaw,
    limits: &[JointLimits<T>; J],
) -> Result<[T; J], Unreachable<T>> {
    let (seen_from, anchor) = anchored(state, axes, law);
    if let Some(q) = closed_form(robot, tool, &seen_from, X, anchor, limits) {
        return Ok(q);
    }
    let c = T::from_f64;
    let settings = DampedLeastSquares {
        position_tolerance: c(SETTINGS.0),
        rotation_tolerance: c(SETTINGS.1),
        iterations: SETTINGS.2,
    };
    let unreachable = |a: Attempt<T, J>, joint| Unreachable {
        position_error: a.position_error,
        rotation_error: a.rotation_error,
        joint,
    };
    match damped_least_squares(robot, tool, &seen_from, X, limits, anchor, &settings) {
        DampedOutcome::Converged(attempt) => Ok(attempt.q),
        DampedOutcome::LimitsReached { attempt, joint } => Err(unreachable(attempt, Some(joint))),
        DampedOutcome::Stalled(a) | DampedOutcome::OutOfIterations(a) => Err(unreachable(a, None)),
        DampedOutcome::NotFinite => Err(Unreachable {
            position_error: c(f64::INFINITY),
            rotation_error: c(f64::INFINITY),
            joint: None,
        }),
    }
}

/// Distance of the wrist from the shoulder that the pose `X` (in `axes`) asks for, and the largest that
/// there is (m), where the first is more and the arm has a spherical shoulder and wrist. Where the base
/// gives way they are lengths from the common centre of mass: links weighed by what they carry along.
pub(crate) fn wrist_too_far<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
    state: &State<T, J>,
    X: &Pose<T>,
    axes: Axes,
    law: ArmLaw,
) -> Option<(T, T)> {
    let (seen_from, anchor) = anchored(state, axes, law);
    match solved(robot, tool, &seen_from, X, anchor)?.1 {
        ClosedForm::OutOfReach { distance, reach } => Some((distance, reach)),
        _ => None,
    }
}

/// Where the arm is seen from, and what stands still while it moves.
fn anchored<T: Scalar, const J: usize>(
    state: &State<T, J>,
    axes: Axes,
    law: ArmLaw,
) -> (State<T, J>, Anchor) {
    match (axes, law) {
        (Axes::Base, _) => (State { X_NB: Pose::identity(), ..*state }, Anchor::Base),
        (Axes::Inertial, ArmLaw::Terrestrial) => (*state, Anchor::Base),
        (Axes::Inertial, _) => (*state, Anchor::AttitudeAndCentreOfMass),
    }
}

fn closed_form<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
    state: &State<T, J>,
    X_NE: &Pose<T>,
    anchor: Anchor,
    limits: &[JointLimits<T>; J],
) -> Option<[T; J]> {
    let (arm, ClosedForm::Solved(solutions)) = solved(robot, tool, state, X_NE, anchor)? else {
        return None;
    };
    let travel = arm.joints().map(|j| limits[j].travel);
    solutions.nearest_within(&travel).map(|solution| arm.put(&solution.q, &state.q))
}

/// The arm, if it is of the kind that has a closed form, and what that says; the arm angle is kept.
fn solved<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
    state: &State<T, J>,
    X_NE: &Pose<T>,
    anchor: Anchor,
) -> Option<(SphericalRevoluteSpherical<T>, ClosedForm<T>)> {
    let (arm, X_NA) = match anchor {
        Anchor::Base => (SphericalRevoluteSpherical::fixed_base(robot, tool).ok()?, state.X_NB),
        Anchor::AttitudeAndCentreOfMass => {
            let (_, p_NScm) = kinematics(robot, state).centre_of_mass();
            let arm = SphericalRevoluteSpherical::attitude_held(robot, tool, &state.q).ok()?;
            (arm, Pose::new(state.X_NB.rotation, p_NScm))
        }
    };
    let near = arm.positions(&state.q);
    let (arm_angle, _) = arm.arm_angle(&near);
    let solved = arm.solve(&(X_NA.inverse() * *X_NE), arm_angle, &near);
    Some((arm, solved))
}

//! Damped least squares for any arm.

use proptest::prelude::*;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, Robot, State, kinematics};
use wrasse_flight::inverse_kinematics::{
    Anchor, DampedLeastSquares, DampedOutcome, damped_least_squares,
};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Mat3, Pose, Quat, Vec3, vec3};
use wrasse_testing::arms::{
    X, atlas_class, cases, cube, difference, tool_from_base, tool_from_centre_of_mass, two_arms,
};

const FINE: DampedLeastSquares<f64> =
    DampedLeastSquares { position_tolerance: 1e-9, rotation_tolerance: 1e-9, iterations: 200 };

fn free<const J: usize>() -> [JointLimits<f64>; J] {
    [JointLimits::default(); J]
}

fn travel<const J: usize>(around: &[f64; J], width: f64) -> [JointLimits<f64>; J] {
    around.map(|q| JointLimits { travel: Some((q - width, q + width)), ..JointLimits::default() })
}

fn state<const J: usize>(q: [f64; J]) -> State<f64, J> {
    State { q, ..State::default() }
}

fn posture() -> impl Strategy<Value = [f64; 7]> {
    let any = || -3.0..3.0_f64;
    let bent = || prop_oneof![0.4..2.4_f64, -2.4..-0.4_f64];
    (any(), bent(), any(), bent(), any(), bent(), any())
        .prop_map(|(a, b, c, d, e, f, g)| [a, b, c, d, e, f, g])
}

fn moved<const J: usize>(q: &[f64; J], by: &[f64; J]) -> [f64; J] {
    core::array::from_fn(|j| q[j] + by[j])
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn a_fixed_base_arm_converges_from_seeds_near_by(
        q in posture(), by in prop::array::uniform7(-0.3..0.3_f64)
    ) {
        let (robot, tool) = atlas_class();
        let X_NE = tool_from_base(&robot, &tool, &q);
        let seed = state(moved(&q, &by));
        let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &free(), Anchor::Base, &FINE);
        let DampedOutcome::Converged(found) = outcome else { panic!("{outcome:?}") };
        let (off, turned) = difference(&tool_from_base(&robot, &tool, &found.q), &X_NE);
        prop_assert!(off < 1e-9 && turned < 1e-9, "{off:e} {turned:e}");
        prop_assert!((off - found.position_error).abs() < 1e-14);
        prop_assert!(found.iterations <= 10, "measured 6: {}", found.iterations);
    }

    /// Not a law, but what the damping is worth: no local minimum was met in these cases.
    #[test]
    fn a_fixed_base_arm_without_limits_converges_from_seeds_far_away(q in posture(), seed in posture()) {
        let (robot, tool) = atlas_class();
        let X_NE = tool_from_base(&robot, &tool, &q);
        let outcome =
            damped_least_squares(&robot, &tool, &state(seed), &X_NE, &free(), Anchor::Base, &FINE);
        let DampedOutcome::Converged(found) = outcome else { panic!("{outcome:?}") };
        prop_assert!(found.iterations <= 40, "measured 28: {}", found.iterations);
    }

    /// The tool's place is counted from the centre of mass, by another route than the solver's.
    #[test]
    fn an_attitude_held_arm_converges_from_seeds_near_by(
        q in posture(), by in prop::array::uniform7(-0.3..0.3_f64),
        r in prop::array::uniform3(-1.5..1.5_f64)
    ) {
        let (robot, tool) = atlas_class();
        let robot = robot.with_payload(&tool, &cube(500.0, vec3(0.0, 0.1, 0.2)));
        let X_NB = Pose::from_quat(Quat::exp(Vec3::from_array(r)), vec3(1.0, 2.0, -3.0));
        let seed = State { X_NB, q: moved(&q, &by), ..State::default() };
        // The anchor stands still: its place now, with the base's axes.
        let X_NA = Pose::new(X_NB.rotation, kinematics(&robot, &seed).centre_of_mass().1);
        let X_NE = X_NA * tool_from_centre_of_mass(&robot, &tool, &q);
        let anchor = Anchor::AttitudeAndCentreOfMass;
        let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &free(), anchor, &FINE);
        let DampedOutcome::Converged(found) = outcome else { panic!("{outcome:?}") };
        let X_NE_found = X_NA * tool_from_centre_of_mass(&robot, &tool, &found.q);
        let (off, turned) = difference(&X_NE_found, &X_NE);
        prop_assert!(off < 1.1e-9 && turned < 1.1e-9, "{off:e} {turned:e}");
        prop_assert!((off - found.position_error).abs() < 1e-14);
        prop_assert!(found.iterations <= 10, "measured 5: {}", found.iterations);
    }

    /// Revolute and prismatic joints of another arm are not used as counterweights.
    #[test]
    fn joints_of_another_arm_stay_where_they_are(
        q in posture(), other in prop::array::uniform2(-1.0..1.0_f64),
        by in prop::array::uniform7(-0.2..0.2_f64)
    ) {
        let (robot, tool) = two_arms();
        let mut all = [0.0; 9];
        all[..2].copy_from_slice(&other);
        all[2..].copy_from_slice(&q);
        let mut seed = state(all);
        seed.q[2..].copy_from_slice(&moved(&q, &by));
        let p_cm = kinematics(&robot, &seed).centre_of_mass().1;
        let X_NE = Pose::new(Mat3::identity(), p_cm) * tool_from_centre_of_mass(&robot, &tool, &all);
        let anchor = Anchor::AttitudeAndCentreOfMass;
        let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &free(), anchor, &FINE);
        let DampedOutcome::Converged(found) = outcome else { panic!("{outcome:?}") };
        prop_assert_eq!(&found.q[..2], &other);
    }

    /// Whatever the end of a solve, its joints are within their travel.
    #[test]
    fn travel_is_kept_however_the_solve_ends(
        q in posture(), by in prop::array::uniform7(-0.1..0.1_f64),
        target in prop::array::uniform7(-0.35..0.35_f64)
    ) {
        let (robot, tool) = atlas_class();
        let X_NE = tool_from_base(&robot, &tool, &moved(&q, &target));
        let limits = travel(&q, 0.3);
        let seed = state(moved(&q, &by));
        let outcome =
            damped_least_squares(&robot, &tool, &seed, &X_NE, &limits, Anchor::Base, &FINE);
        let found = match outcome {
            DampedOutcome::LimitsReached { attempt, .. } => attempt,
            DampedOutcome::Converged(found)
            | DampedOutcome::Stalled(found)
            | DampedOutcome::OutOfIterations(found) => found,
            other => panic!("{other:?}"),
        };
        for j in 0..7 {
            let (lower, upper) = limits[j].travel.unwrap();
            prop_assert!(lower <= found.q[j] && found.q[j] <= upper, "joint {j}: {}", found.q[j]);
        }
        let (off, turned) = difference(&tool_from_base(&robot, &tool, &found.q), &X_NE);
        prop_assert!((off - found.position_error).abs() < 1e-14);
        prop_assert!((turned - found.rotation_error).abs() < 1e-14);
    }

    /// Whatever the direction and the turn: the error that is left is never smaller than what the
    /// arm is too short, and it is said so well before the iterations are spent.
    #[test]
    fn targets_out_of_reach_stall_before_the_iterations_are_spent(
        seed in posture(), toward in prop::array::uniform3(-1.0..1.0_f64),
        r in prop::array::uniform3(-1.5..1.5_f64)
    ) {
        let (robot, tool) = atlas_class();
        let toward = Vec3::from_array(toward);
        let shoulder = vec3(0.9, 0.5, 0.0);
        let p = shoulder + toward * (1.4 / toward.norm());
        let X_NE = Pose::from_quat(Quat::exp(Vec3::from_array(r)), p);
        let outcome =
            damped_least_squares(&robot, &tool, &state(seed), &X_NE, &free(), Anchor::Base, &FINE);
        let DampedOutcome::Stalled(found) = outcome else { panic!("{outcome:?}") };
        prop_assert!(found.position_error > 0.35 - 1e-12, "{found:?}");
        prop_assert!(found.iterations <= 80, "measured 53: {}", found.iterations);
    }

    /// With the target inside the travel, joints stopped on the way do not keep the others from it.
    #[test]
    fn a_target_within_the_travel_is_reached_past_stopped_joints(
        q in posture(), by in prop::array::uniform7(-0.1..0.1_f64)
    ) {
        let (robot, tool) = atlas_class();
        let X_NE = tool_from_base(&robot, &tool, &q);
        let limits = travel(&q, 0.1);
        let seed = state(moved(&q, &by));
        let outcome =
            damped_least_squares(&robot, &tool, &seed, &X_NE, &limits, Anchor::Base, &FINE);
        let DampedOutcome::Converged(found) = outcome else { panic!("{outcome:?}") };
        prop_assert!(found.iterations <= 10, "measured 5: {}", found.iterations);
    }
}

/// Straight ahead of the shoulder, tool along the line: the best is the stretched arm, and the
/// error that is left is what the arm is too short.
#[test]
fn a_target_out_of_reach_stalls_with_the_distance_that_is_missing() {
    let (robot, tool) = atlas_class();
    let X_NE = Pose::new(Mat3::identity(), vec3(0.9 + 1.05 + 0.25, 0.5, 0.0));
    let seed = state([0.3, 0.5, -0.2, -0.9, 0.4, 0.6, 0.1]);
    let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &free(), Anchor::Base, &FINE);
    let DampedOutcome::Stalled(found) = outcome else { panic!("{outcome:?}") };
    let (off, turned) = difference(&tool_from_base(&robot, &tool, &found.q), &X_NE);
    assert_eq!((off, turned), (found.position_error, found.rotation_error));
    assert!((off - 0.25).abs() < 1e-9, "measured 5e-13: {off}");
    assert!(turned < 1e-4, "measured 1.8e-5: {turned:e}");
}

/// The distance of the wrist depends on the elbow alone: an elbow that may not bend enough is
/// named.
#[test]
fn an_elbow_at_the_end_of_its_travel_is_named() {
    let (robot, tool) = atlas_class();
    let X_NE = tool_from_base(&robot, &tool, &[0.3, 0.5, -0.2, -1.4, 0.4, 0.6, 0.1]);
    let mut limits = free();
    limits[3].travel = Some((-0.8, 0.8));
    let seed = state([0.3, 0.5, -0.2, -0.7, 0.4, 0.6, 0.1]);
    let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &limits, Anchor::Base, &FINE);
    let DampedOutcome::LimitsReached { attempt, joint } = outcome else { panic!("{outcome:?}") };
    assert_eq!(joint, 3);
    assert_eq!(attempt.q[3], -0.8);
    // |w| at -0.8 less |w| at -1.4, by the law of cosines.
    let wrist = |bend: f64| (0.45_f64.powi(2) + 0.4 * 0.4 + 0.36 * bend.cos()).sqrt();
    let missing = wrist(0.8) - wrist(1.4);
    let left = (attempt.position_error.powi(2) + attempt.rotation_error.powi(2)).sqrt();

    // A little less: some of it is traded for a turn, a radian counting as a metre.
    assert!(
        left <= missing && left > 0.99 * missing,
        "measured 0.13201 of 0.13223: {left} {missing}"
    );
}

/// Two slides along the same line: the first may go 0.1 m of the metre, the second has to go 0.9 m in
/// the same step. The damping, a hundredth of the squared error, leaves 0.9/101 m.
#[test]
fn what_a_stopped_joint_leaves_the_others_take_over_at_once() {
    let matter = cube(10.0, Vec3::zero());
    let slide = |parent| Joint::new(parent, JointKind::Prismatic, Pose::identity(), X);
    let links = [(slide(BodyId::Base), matter), (slide(BodyId::Link(0)), matter)];
    let robot: Robot<f64, 2> = Robot::new(matter, &links).unwrap();
    let tool = Frame { body: BodyId::Link(1), X_BF: Pose::identity() };
    let mut limits = free();
    limits[0].travel = Some((-0.1, 0.1));
    let X_NE = Pose::new(Mat3::identity(), X);
    let once = DampedLeastSquares { iterations: 1, ..FINE };
    let seed = state([0.0; 2]);
    let outcome = damped_least_squares(&robot, &tool, &seed, &X_NE, &limits, Anchor::Base, &once);
    let DampedOutcome::OutOfIterations(found) = outcome else { panic!("{outcome:?}") };
    assert_eq!(found.q[0], 0.1);
    let left = found.position_error - 0.9 / 101.0;
    assert!(left.abs() < 1e-15, "measured 3.3e-16: {left:e}");
}

#[test]
fn no_iterations_and_no_numbers_are_outcomes() {
    let (robot, tool) = atlas_class();
    let q = [0.3, 0.5, -0.2, -1.4, 0.4, 0.6, 0.1];
    let X_NE = tool_from_base(&robot, &tool, &q);
    let none = DampedLeastSquares { iterations: 0, ..FINE };
    let solve = |seed: [f64; 7], X_NE: &Pose<f64>, settings: &DampedLeastSquares<f64>| {
        damped_least_squares(&robot, &tool, &state(seed), X_NE, &free(), Anchor::Base, settings)
    };
    let outcome = solve([0.1; 7], &X_NE, &none);
    assert!(matches!(outcome, DampedOutcome::OutOfIterations(found) if found.q == [0.1; 7]));
    let outcome = solve(q, &X_NE, &none);
    assert!(matches!(outcome, DampedOutcome::Converged(found) if found.iterations == 0));
    for bad in [f64::NAN, f64::INFINITY] {
        let away = Pose::new(Mat3::identity(), vec3(bad, 0.0, 0.0));
        let skew = Pose::new(Mat3::identity().scaled(bad), X_NE.translation);
        for outcome in
            [solve([bad; 7], &X_NE, &FINE), solve(q, &away, &FINE), solve(q, &skew, &FINE)]
        {
            assert!(matches!(outcome, DampedOutcome::NotFinite), "{outcome:?}");
        }
    }
}

#[test]
fn a_solve_repeats_bit_for_bit() {
    let (robot, tool): (Robot<f64, 7>, Frame<f64>) = atlas_class();
    let X_NE = tool_from_base(&robot, &tool, &[0.3, 0.5, -0.2, -1.4, 0.4, 0.6, 0.1]);
    let seed = state([0.1, 0.2, 0.3, -0.9, 0.2, 0.1, 0.0]);
    let solve = || {
        damped_least_squares(
            &robot,
            &tool,
            &seed,
            &X_NE,
            &free(),
            Anchor::AttitudeAndCentreOfMass,
            &FINE,
        )
    };
    assert_eq!(solve(), solve());
}

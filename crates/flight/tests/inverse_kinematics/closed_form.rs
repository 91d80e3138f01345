//! The closed form on a fixed base.

use proptest::prelude::*;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, Robot};
use wrasse_flight::inverse_kinematics::{
    ClosedForm, NotThisKind, Reference, Solutions, SphericalRevoluteSpherical,
};
use wrasse_spatial::{Mat3, Pose, vec3};
use wrasse_testing::arms::{X, Y, Z, atlas_class, cases, difference, tool_from_base, upright_arm};
use wrasse_testing::{largest, smaller};

#[track_caller]
#[allow(clippy::large_types_passed_by_value, reason = "the outcome ends here")]
fn solved(outcome: ClosedForm<f64>) -> Solutions<f64> {
    match outcome {
        ClosedForm::Solved(solutions) => solutions,
        other => panic!("expected solutions, found {other:?}"),
    }
}

/// Largest pose error of all solutions at the pose and arm angle of `q`, whether there are eight
/// different ones, and how near the nearest comes to `q`, times its smallest sine.
fn round_trip<const J: usize>(
    robot: &Robot<f64, J>,
    tool: &Frame<f64>,
    q: &[f64; 7],
) -> (f64, usize, f64) {
    let arm = SphericalRevoluteSpherical::fixed_base(robot, tool).expect("of this kind");
    let all = arm.put(q, &[0.0; J]);
    let X_BE = tool_from_base(robot, tool, &all);
    let (arm_angle, reference) = arm.arm_angle(q);
    let solutions = solved(arm.solve(&X_BE, arm_angle, q));
    assert_eq!(solutions.reference, reference);
    let mut worst = 0.0_f64;
    for solution in solutions.iter() {
        let (off, turned) =
            difference(&tool_from_base(robot, tool, &arm.put(&solution.q, &all)), &X_BE);
        let (again, _) = arm.arm_angle(&solution.q);
        let (sine, _) = (again - arm_angle).sin_cos();
        // Near the reference axis the arm angle is known to ε/0.02 only.
        worst = largest([worst, off, turned, sine.abs() * 0.02]);
    }
    let nearest = solutions.nearest().expect("solved");
    let way = largest((0..7).map(|i| (nearest.q[i] - q[i]).abs()));
    // Near a singular posture the joints are known to the rounding divided by the sine.
    let sine = nearest.sines.into_iter().fold(1.0, smaller);
    (worst, different(&solutions), way * sine)
}

/// Number of solutions that differ from all before them.
fn different(solutions: &Solutions<f64>) -> usize {
    let mut seen: Vec<[f64; 7]> = Vec::new();
    for solution in solutions.iter() {
        let same = |q: &[f64; 7]| {
            (0..7).all(|i| {
                (q[i] - solution.q[i]).sin().abs() < 1e-9 && (q[i] - solution.q[i]).cos() > 0.0
            })
        };
        if !seen.iter().any(same) {
            seen.push(solution.q);
        }
    }
    seen.len()
}

/// Joint positions away from the singular postures of shoulder, elbow and wrist.
fn posture() -> impl Strategy<Value = [f64; 7]> {
    let any = || -3.1..3.1_f64;
    (any(), bent(), any(), bent(), any(), bent(), any())
        .prop_map(|(a, b, c, d, e, f, g)| [a, b, c, d, e, f, g])
}

fn bent() -> impl Strategy<Value = f64> {
    prop_oneof![0.1..3.0_f64, -3.0..-0.1_f64]
}

proptest! {
    #![proptest_config(cases())]

    /// Rounding of a chain of twenty rotations over a metre.
    #[test]
    fn all_eight_solutions_of_the_atlas_class_arm_reach_the_pose(q in posture()) {
        let (robot, tool) = atlas_class();
        let (worst, count, way) = round_trip(&robot, &tool, &q);
        prop_assert!(worst < 1e-14, "measured 2.6e-15: {worst:e}");
        prop_assert_eq!(count, 8);
        prop_assert!(way < 1e-14, "measured 1.7e-15: {way:e}");
    }

    /// Oblique mount, frames off the meeting points, tool turned: only the axes count.
    #[test]
    fn all_eight_solutions_of_an_upright_arm_reach_the_pose(
        q in posture(), elbow_offset in prop_oneof![Just(0.0), 0.02..0.15_f64]
    ) {
        let (robot, tool) = upright_arm(elbow_offset);
        let (worst, count, way) = round_trip(&robot, &tool, &q);
        prop_assert!(worst < 1e-14, "measured 2.3e-15: {worst:e}");
        prop_assert_eq!(count, 8);
        prop_assert!(way < 1e-14, "measured 3e-15: {way:e}");
    }

    /// The pose that the geometry gives is the pose of the robot's kinematics.
    #[test]
    fn the_arm_as_the_closed_form_sees_it_is_the_robot(q in posture()) {
        let (robot, tool) = upright_arm(0.07);
        let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
        let (off, turned) =
            difference(&arm.tool_pose(&q), &tool_from_base(&robot, &tool, &arm.put(&q, &[0.0; 8])));
        prop_assert!(off < 2e-15 && turned < 5e-15, "measured 1.6e-15: {off:e} {turned:e}");
    }

    /// The elbow of the ATLAS-class arm stands where the arm angle says, in all solutions.
    #[test]
    fn the_elbow_stays_in_place_in_all_solutions(q in posture(), arm_angle in -3.0..3.0) {
        let (robot, tool) = atlas_class();
        let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
        let elbow = Frame { body: BodyId::Link(3), X_BF: Pose::identity() };
        let solutions = solved(arm.solve(&arm.tool_pose(&q), arm_angle, &q));
        let places: Vec<_> =
            solutions.iter().map(|s| tool_from_base(&robot, &elbow, &s.q).translation).collect();
        let spread = largest(places.iter().map(|p| (*p - places[0]).norm()));
        prop_assert!(spread < 1e-14, "measured 1.2e-15: {spread:e}");
    }
}

/// The line from shoulder to wrist is x, the reference axis is x: the second axis takes over.
#[test]
fn a_line_along_the_reference_axis_is_solved_with_the_other_axis() {
    let (robot, tool) = atlas_class();
    // Elbow up and wrist back so that the wrist is straight ahead of the shoulder.
    let (a, b, elbow) = (0.45_f64, 0.4_f64, 1.2_f64);
    let lift = (b * elbow.sin()).atan2(a + b * elbow.cos());
    let q = [0.3, -lift, 0.0, elbow, 0.2, 0.5, -0.1];
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let (_, reference) = arm.arm_angle(&q);
    assert_eq!(reference, Reference::SecondAxis);
    let (worst, count, way) = round_trip(&robot, &tool, &q);

    assert!(worst < 1e-14 && way < 1e-14, "measured 4e-16 and 4e-16: {worst:e} {way:e}");
    assert_eq!(count, 8);
    // A little off the axis the first reference is back.
    let (_, reference) = arm.arm_angle(&[0.3, -lift + 0.03, 0.0, elbow, 0.2, 0.5, -0.1]);
    assert_eq!(reference, Reference::FirstAxis);
}

#[test]
fn a_target_beyond_the_stretched_arm_is_out_of_reach_by_its_distance() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let at =
        |x: f64| arm.solve(&Pose::new(Mat3::identity(), vec3(0.9 + x, 0.5, 0.0)), 0.3, &[0.0; 7]);
    let ClosedForm::OutOfReach { distance, reach } = at(1.15) else { panic!("{:?}", at(1.15)) };
    assert!((distance - 0.95).abs() < 1e-15 && (reach - 0.85).abs() < 1e-15, "{distance} {reach}");
    let ClosedForm::TooClose { distance, nearest } = at(0.23) else { panic!("{:?}", at(0.23)) };
    assert!(
        (distance - 0.03).abs() < 1e-15 && (nearest - 0.05).abs() < 1e-15,
        "{distance} {nearest}"
    );
}

/// At the ends of the elbow's travel a rounding either way must not decide.
#[test]
fn the_stretched_and_the_folded_arm_are_solved_with_a_sine_of_zero() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let mut worst = 0.0_f64;
    for elbow in [0.0, core::f64::consts::PI] {
        for k in 0..50 {
            let a = f64::from(k) * 0.1;
            let q = [a, 0.7 - a, 0.4 + 2.0 * a, elbow, -0.2 * a, 0.6, 1.1];
            let X_BE = tool_from_base(&robot, &tool, &q);
            for solution in solved(arm.solve(&X_BE, arm.arm_angle(&q).0, &q)).iter() {
                let (off, turned) = difference(&tool_from_base(&robot, &tool, &solution.q), &X_BE);
                worst = largest([worst, off, turned]);
                // The end itself, not the root of the rounding of the distance.
                assert!(solution.sines[1] < 1e-15, "measured 1.3e-16: {:e}", solution.sines[1]);
            }
        }
    }
    assert!(worst < 1e-14, "measured 2.1e-15: {worst:e}");
}

/// All axes but the middle ones in one line: three singularities at once.
#[test]
fn the_straight_arm_keeps_the_joints_that_are_free_where_they_are() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let q = [0.4, 0.0, 0.0, 0.0, -0.3, 0.0, 0.2];
    let X_BE = tool_from_base(&robot, &tool, &q);
    let nearest = solved(arm.solve(&X_BE, arm.arm_angle(&q).0, &q)).nearest().unwrap();
    let (off, turned) = difference(&tool_from_base(&robot, &tool, &nearest.q), &X_BE);
    assert!(off < 1e-14 && turned < 1e-14, "measured 0 and 0: {off:e} {turned:e}");
    assert!(
        (nearest.q[0] - 0.4).abs() < 1e-15 && (nearest.q[4] + 0.3).abs() < 1e-15,
        "{nearest:?}"
    );
}

#[test]
fn a_wrist_in_the_shoulder_is_singular() {
    let (robot, tool) = equal_lengths();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let ahead = Pose::new(Mat3::identity(), vec3(0.2, 0.0, 0.0));
    let outcome = arm.solve(&ahead, 0.0, &[0.0; 7]);
    let ClosedForm::Singular { distance } = outcome else { panic!("{outcome:?}") };
    assert_eq!(distance, 0.0);
}

#[test]
fn numbers_that_are_not_finite_are_an_outcome() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let good = Pose::new(Mat3::identity(), vec3(1.5, 0.5, 0.2));
    for bad in [f64::NAN, f64::INFINITY] {
        let pose = Pose::new(Mat3::identity(), vec3(1.5, bad, 0.2));
        for outcome in [
            arm.solve(&pose, 0.0, &[0.0; 7]),
            arm.solve(&good, bad, &[0.0; 7]),
            arm.solve(&good, 0.0, &[bad; 7]),
            arm.solve(&Pose::new(Mat3::identity().scaled(bad), good.translation), 0.0, &[0.0; 7]),
        ] {
            assert!(matches!(outcome, ClosedForm::NotFinite), "{outcome:?}");
        }
    }
}

/// Solutions are turned to the joint positions asked for; travel narrows the choice.
#[test]
fn the_nearest_solution_is_the_one_that_was_gone_from() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let q = [4.0, 0.6, -3.9, 1.0, 0.5, -0.8, 7.0];
    let X_BE = tool_from_base(&robot, &tool, &q);
    let near = q.map(|q| q + 0.05);
    let solutions = solved(arm.solve(&X_BE, arm.arm_angle(&q).0, &near));
    let nearest = solutions.nearest().unwrap();
    let way = largest((0..7).map(|i| (nearest.q[i] - q[i]).abs()));
    assert!(way < 1e-14, "measured 2.3e-15: {way:e}");

    let mut travel = [None; 7];
    travel[3] = Some((-2.0, -0.1));
    travel[2] = Some((0.0, 6.0));
    travel[6] = Some((-3.2, 3.2));
    let other = solutions.nearest_within(&travel).unwrap();
    assert!((other.q[3] + 1.0).abs() < 1e-14 && other.q[6].abs() <= 3.2, "{other:?}");
    assert!((0.0..=6.0).contains(&other.q[2]), "a whole turn added: {other:?}");
    travel[3] = Some((-0.1, 0.1));
    assert_eq!(solutions.nearest_within(&travel), None);
}

#[test]
fn single_precision_reaches_the_pose_to_its_own_rounding() {
    let (robot, tool) = atlas_class();
    let q = [0.5_f32, 0.6, -0.9, 1.0, 0.5, -0.8, 0.3];
    let tool32 = Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) };
    let arm = SphericalRevoluteSpherical::fixed_base(&robot.cast::<f32>(), &tool32).unwrap();
    let X_BE = arm.tool_pose(&q);
    let ClosedForm::Solved(solutions) = arm.solve(&X_BE, arm.arm_angle(&q).0, &q) else {
        panic!("no solution");
    };
    let nearest = solutions.nearest().unwrap();
    let way = largest((0..7).map(|i| f64::from((nearest.q[i] - q[i]).abs())));
    assert!(way < 3e-6, "measured 3.6e-7: {way:e}");
}

/// A chain with the given axes, 0.3 m along x before joints 4 and 6, and `shift` (m) before joint 3.
fn chain(
    axes: [wrasse_spatial::Vec3<f64>; 7],
    shift: f64,
    slides: Option<usize>,
) -> (Robot<f64, 7>, Frame<f64>) {
    let (like, tool) = atlas_class();
    let mut links = Vec::new();
    for j in 0..7 {
        let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j - 1) };
        let kind = if slides == Some(j) { JointKind::Prismatic } else { JointKind::Revolute };
        let x = if j == 3 || j == 5 { 0.3 } else { 0.0 };
        let p = vec3(x, if j == 2 { shift } else { 0.0 }, 0.0);
        let joint = Joint::new(parent, kind, Pose::new(Mat3::identity(), p), axes[j]);
        links.push((
            joint,
            wrasse_dynamics::MassProperties {
                M_F_F: *like.inertia(BodyId::Link(j)),
                ..Default::default()
            },
        ));
    }
    let base = wrasse_dynamics::MassProperties {
        M_F_F: *like.inertia(BodyId::Base),
        ..Default::default()
    };
    (Robot::new(base, &links).expect("parents come first"), tool)
}

fn equal_lengths() -> (Robot<f64, 7>, Frame<f64>) {
    chain([X, Y, X, Y, X, Y, X], 0.0, None)
}

#[test]
fn an_arm_of_another_kind_is_refused_with_what_makes_it_so() {
    let refused = |(robot, tool): (Robot<f64, 7>, Frame<f64>)| {
        SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap_err()
    };
    let axes = [X, Y, X, Y, X, Y, X];
    let (robot, tool) = atlas_class();
    let on_link_5 = Frame { body: BodyId::Link(5), ..tool };
    let short = SphericalRevoluteSpherical::fixed_base(&robot, &on_link_5).unwrap_err();
    assert_eq!(short, NotThisKind::JointCount { found: 6 });
    assert_eq!(refused(chain(axes, 0.0, Some(2))), NotThisKind::Slides { joint: 2 });
    let skew = vec3(0.6, 0.8, 0.0);
    let found = refused(chain([X, skew, X, Y, X, Y, X], 0.0, None));
    let NotThisKind::NotPerpendicular { joints: [0, 1], cosine } = found else { panic!("{found}") };
    assert!((cosine - 0.6).abs() < 1e-15, "{cosine}");
    // Axis 3 passes 0.02 m beside the meeting point; along axis 2 that would not matter.
    let found = refused(chain([X, Z, X, Y, X, Y, X], 0.02, None));
    let NotThisKind::AxesDoNotMeet { joints: [0, 1, 2], gap } = found else { panic!("{found}") };
    assert!((gap - 0.02).abs() < 1e-15, "{gap}");
    let text = found.to_string();
    assert_eq!(text, "the axes of joints 0, 1 and 2 miss each other by 0.02 m, expected to meet");
    let found = refused(chain([X, Y, X, X, X, Y, X], 0.0, None));
    assert_eq!(found, NotThisKind::NoElbow { upper: 0.0, fore: 0.0 });
}

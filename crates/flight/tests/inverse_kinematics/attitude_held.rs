//! The closed form with base attitude and system centre of mass held.

use proptest::prelude::*;
use wrasse_dynamics::{Frame, Robot};
use wrasse_flight::inverse_kinematics::{ArmChain, ClosedForm, SphericalRevoluteSpherical};
use wrasse_spatial::{Mat3, Pose, Quat, Vec3, vec3};
use wrasse_testing::arms::{
    atlas_class, atlas_class_with_offset, cases, cube, difference, tool_from_centre_of_mass,
    two_arms, upright_arm,
};
use wrasse_testing::{larger, largest};

/// Largest pose error, largest number of passes, and number of solutions, at the pose of `q`.
fn round_trip<const J: usize>(
    robot: &Robot<f64, J>,
    tool: &Frame<f64>,
    q: &[f64; J],
) -> (f64, u32, usize) {
    let arm = SphericalRevoluteSpherical::attitude_held(robot, tool, q).expect("of this kind");
    let X_AE = tool_from_centre_of_mass(robot, tool, q);
    let near = arm.positions(q);
    let outcome = arm.solve(&X_AE, arm.arm_angle(&near).0, &near);
    let ClosedForm::Solved(solutions) = outcome else { panic!("{outcome:?}") };
    let (mut worst, mut passes, mut count) = (0.0_f64, 0, 0);
    for solution in solutions.iter() {
        let found = tool_from_centre_of_mass(robot, tool, &arm.put(&solution.q, q));
        let (off, turned) = difference(&found, &X_AE);
        worst = largest([worst, off, turned]);
        passes = passes.max(solution.passes);
        count += 1;
    }
    (worst, passes, count)
}

/// Postures whose elbow is clear of the stretched arm, where a shift of the target might put it out
/// of reach.
fn posture() -> impl Strategy<Value = [f64; 7]> {
    let any = || -3.1..3.1_f64;
    let bent = || prop_oneof![0.3..2.5_f64, -2.5..-0.3_f64];
    (any(), bent(), any(), bent(), any(), bent(), any())
        .prop_map(|(a, b, c, d, e, f, g)| [a, b, c, d, e, f, g])
}

proptest! {
    #![proptest_config(cases())]

    /// The virtual arm has the same axes, so the closed form is exact: nothing is left to pass over.
    #[test]
    fn on_axis_masses_need_no_pass_with_any_payload(
        q in posture(), mass in prop_oneof![Just(0.0), 1.0..500.0_f64]
    ) {
        let (robot, tool) = atlas_class();
        let robot = robot.with_payload(&tool, &cube(mass, Vec3::zero()));
        let (worst, passes, count) = round_trip(&robot, &tool, &q);
        prop_assert!(worst < 1e-14, "measured 2.4e-15: {worst:e}");
        prop_assert_eq!((passes, count), (0, 8));
    }

    /// A payload gripped off its centre is fixed in the last link, whose vector may be any.
    #[test]
    fn a_payload_off_the_axis_needs_no_pass_either(
        q in posture(), aside in prop::array::uniform3(-0.4..0.4_f64)
    ) {
        let (robot, tool) = atlas_class();
        let robot = robot.with_payload(&tool, &cube(500.0, Vec3::from_array(aside)));
        let (worst, passes, count) = round_trip(&robot, &tool, &q);
        prop_assert!(worst < 1e-14, "measured 1.8e-15: {worst:e}");
        prop_assert_eq!((passes, count), (0, 8));
    }

    /// Links off their axes by up to 5 cm: m_link/m_total of that is passed over, each pass gaining
    /// the ratio of that to the arm's length.
    #[test]
    fn links_off_their_axes_are_solved_in_a_few_passes(
        q in posture(), off in prop::array::uniform3(-0.05..0.05_f64)
    ) {
        let (robot, tool) = atlas_class_with_offset(Vec3::from_array(off));
        let robot = robot.with_payload(&tool, &cube(200.0, vec3(0.0, 0.1, -0.2)));
        let (worst, passes, count) = round_trip(&robot, &tool, &q);
        prop_assert!(worst < 1e-14, "measured 2.2e-15: {worst:e}");
        prop_assert!((1..=6).contains(&passes), "measured 6: {passes}");
        prop_assert_eq!(count, 8);
    }

    /// Turned mount, oblique frames, masses 0.1 m off every axis on a base of 400 kg.
    #[test]
    fn an_oblique_arm_on_a_light_base_is_solved_in_a_few_passes(q in posture()) {
        let (robot, tool) = upright_arm(0.05);
        let mut all = [0.0; 8];
        all[..7].copy_from_slice(&q);
        let (worst, passes, count) = round_trip(&robot, &tool, &all);
        prop_assert!(worst < 1e-14, "measured 2.5e-15: {worst:e}");
        prop_assert!((1..=14).contains(&passes), "measured 12: {passes}");
        // A bend that the first pass puts out of reach is not among them.
        prop_assert!(count >= 4, "measured 4: {count}");
    }

    /// What the other arm holds moves the centre of mass; its joints stay where they are.
    #[test]
    fn another_arm_counts_where_it_stands(q in posture(), other in prop::array::uniform2(-3.0..3.0_f64)) {
        let (robot, tool) = two_arms();
        let mut all = [0.0; 9];
        all[..2].copy_from_slice(&other);
        all[2..].copy_from_slice(&q);
        let (worst, passes, count) = round_trip(&robot, &tool, &all);
        prop_assert!(worst < 1e-14, "measured 2.4e-15: {worst:e}");
        prop_assert_eq!((passes, count), (0, 8));
    }

    /// The anchor turns and moves with neither: the inertial target comes in by the stated formula.
    #[test]
    fn an_inertial_target_is_reached_whatever_the_base_pose(
        q in posture(), r in prop::array::uniform3(-1.5..1.5_f64)
    ) {
        let (robot, tool) = atlas_class();
        let robot = robot.with_payload(&tool, &cube(200.0, Vec3::zero()));
        let X_NB = Pose::from_quat(Quat::exp(Vec3::from_array(r)), vec3(3.0, -2.0, 1.0));
        let state = wrasse_dynamics::State { X_NB, q, ..Default::default() };
        let k = wrasse_dynamics::kinematics(&robot, &state);
        let (_, p_NScm) = k.centre_of_mass();
        let X_NA = Pose::new(X_NB.rotation, p_NScm);
        let arm = SphericalRevoluteSpherical::attitude_held(&robot, &tool, &q).unwrap();
        let (off, turned) = difference(&(X_NA * arm.tool_pose(&q)), &k.pose(&tool));
        prop_assert!(off < 5e-15 && turned < 5e-15, "measured 2e-15: {off:e} {turned:e}");
    }
}

/// Lengths of the closed form's arm shrink by the mass that moves with them; worked out by hand
/// from `λ_i = (Σ_{j≤i} m_j l_i - m_i r_i)/m_T`, m_T = 1756 kg.
#[test]
fn the_lengths_shorten_as_the_equations_say() {
    let (robot, tool) = atlas_class();
    let robot = robot.with_payload(&tool, &cube(200.0, Vec3::zero()));
    let chain = ArmChain::attitude_held(&robot, &tool, &[0.0; 7]).unwrap();
    let m_T = 1756.0;
    let expected = [
        0.9 * 1500.0 / m_T,
        0.0,
        -10.0 * 0.05 / m_T,
        (1528.0 * 0.45 - 8.0 * 0.225) / m_T,
        -8.0 * 0.05 / m_T,
        (1542.0 * 0.4 - 6.0 * 0.2) / m_T,
        -6.0 * 0.03 / m_T,
        0.2 - (8.0 * 0.1 + 200.0 * 0.7) / m_T,
    ];
    for (i, x) in expected.into_iter().enumerate() {
        assert!((chain.vectors[i].x - x).abs() < 3e-16, "vector {i}: {} {x}", chain.vectors[i].x);
    }
}

/// Further than the shortened arm, though the arm on a fixed base would reach it.
#[test]
fn the_shortened_arm_reaches_less() {
    let (robot, tool) = atlas_class();
    let robot = robot.with_payload(&tool, &cube(500.0, Vec3::zero()));
    let fixed = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let held = SphericalRevoluteSpherical::attitude_held(&robot, &tool, &[0.0; 7]).unwrap();
    // λ2 + … + λ5 of m_T = 2056 kg.
    let reach = (1528.0 * 0.45 + 1542.0 * 0.4 - 0.5 - 1.8 - 0.4 - 1.2) / 2056.0;
    assert!((fixed.reach() - 0.85).abs() < 1e-15);
    assert!((held.reach() - reach).abs() < 1e-15, "{} {reach}", held.reach());
    let X_AE = held.tool_pose(&[0.0; 7]);
    let further = Pose::new(X_AE.rotation, X_AE.translation + vec3(0.01, 0.0, 0.0));
    let outcome = held.solve(&further, 0.0, &[0.0; 7]);
    let ClosedForm::OutOfReach { distance, .. } = outcome else { panic!("{outcome:?}") };
    assert!((distance - reach - 0.01).abs() < 1e-15, "{distance}");
}

/// Start postures of the three miss-distance moves: tool from the mount (m), direction, distance (m), and the
/// joint positions (deg) that another code found for the tool parallel to the base.
const MOVES: [(Vec3<f64>, Vec3<f64>, [f64; 7]); 3] = [
    (
        vec3(0.7, -0.5, -0.1),
        vec3(0.0, 1.0, 0.0),
        [
            55.619_702_321,
            -35.191_746_917,
            -90.459_688_812,
            65.812_613_568,
            -37.635_466_16,
            -70.693_674_402,
            49.244_939_521,
        ],
    ),
    (
        vec3(0.65, -0.2, -0.1),
        vec3(0.0, 0.3, 0.0),
        [
            10.310_339_413,
            -35.907_341_878,
            -34.307_016_688,
            107.791_590_573,
            -19.778_031_938,
            -77.655_586_423,
            23.013_651_172,
        ],
    ),
    (
        vec3(0.45, -0.05, -0.15),
        vec3(0.3, 0.0, 0.0),
        [
            2.317_925_347,
            -29.576_694_11,
            -12.535_063_33,
            139.808_243_691,
            -6.575_752_463,
            -110.695_890_423,
            6.293_140_398,
        ],
    ),
];

/// The joint positions are given to 1e-9 deg, 2e-11 rad.
#[test]
fn the_start_postures_are_found_again_from_their_tool_poses() {
    let (robot, tool) = atlas_class();
    let arm = SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap();
    let mut worst = 0.0_f64;
    for (tool_from_mount, _, degrees) in MOVES {
        let q = degrees.map(f64::to_radians);
        let X_BE = Pose::new(Mat3::identity(), vec3(0.9, 0.5, 0.0) + tool_from_mount);
        let outcome = arm.solve(&X_BE, arm.arm_angle(&q).0, &q);
        let ClosedForm::Solved(solutions) = outcome else { panic!("{outcome:?}") };
        let nearest = solutions.nearest().unwrap();
        worst = larger(worst, largest((0..7).map(|j| (nearest.q[j] - q[j]).abs())));
    }
    assert!(worst < 1e-10, "measured 2.2e-11: {worst:e}");
}

/// With 200 kg every move ends within the shortened arm; with 500 kg the one of a metre does not.
#[test]
fn a_metre_sideways_with_500_kg_ends_out_of_reach_and_nothing_else_does() {
    let (unladen, tool) = atlas_class();
    for mass in [0.0, 200.0, 500.0] {
        let robot = unladen.with_payload(&tool, &cube(mass, Vec3::zero()));
        for (k, (_, way, degrees)) in MOVES.into_iter().enumerate() {
            let q = degrees.map(f64::to_radians);
            let arm = SphericalRevoluteSpherical::attitude_held(&robot, &tool, &q).unwrap();
            let start = arm.tool_pose(&q);
            let end = Pose::new(start.rotation, start.translation + way);
            match arm.solve(&end, arm.arm_angle(&q).0, &q) {
                ClosedForm::OutOfReach { distance, reach } => {
                    assert_eq!((mass, k), (500.0, 0));
                    assert!(distance > reach, "measured 0.733 and 0.633: {distance} {reach}");
                }
                ClosedForm::Solved(_) => assert_ne!((mass, k), (500.0, 0)),
                other => panic!("{mass} kg, move {k}: {other:?}"),
            }
        }
    }
}

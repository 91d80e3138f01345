//! Whatever numbers come in: an outcome comes out, finite where it says so, and nothing panics.

use proptest::num::f64::{ANY, INFINITE, NEGATIVE, NORMAL, POSITIVE, QUIET_NAN, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
use wrasse_flight::inverse_kinematics::{
    Anchor, ClosedForm, DampedLeastSquares, DampedOutcome, SphericalRevoluteSpherical,
    damped_least_squares,
};
use wrasse_flight::trajectory::{
    JointMove, Motion, MotionLimits, Profile, ProfileShape, Quintic, StraightLine,
};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Mat3, Pose, Sym3, Vec3, vec3};

fn cases() -> ProptestConfig {
    ProptestConfig {
        cases: 1024,
        rng_seed: RngSeed::Fixed(20_040_901),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Any number at all, most often a decent one.
fn number() -> impl Strategy<Value = f64> {
    let odd = POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO | INFINITE | QUIET_NAN;
    prop_oneof![6 => -3.0..3.0_f64, 1 => odd, 1 => ANY]
}

fn three() -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()]
}

/// Any matrix, but half of the time none that turns at all.
fn pose() -> impl Strategy<Value = Pose<f64>> {
    let rows =
        [three(), three(), three()].prop_map(|rows| Mat3 { rows: rows.map(Vec3::from_array) });
    let rotation = prop_oneof![Just(Mat3::identity()), rows];
    (rotation, three()).prop_map(|(R, p)| Pose::new(R, Vec3::from_array(p)))
}

fn finite(motion: &Motion<f64>) -> bool {
    motion.position.is_finite() && motion.velocity.is_finite() && motion.acceleration.is_finite()
}

fn arm() -> (Robot<f64, 7>, Frame<f64>) {
    let matter = |mass: f64| {
        MassProperties::from_central(mass, vec3(0.1, 0.0, 0.0), Sym3::diagonal(1.0, 1.0, 1.0))
    };
    let links: Vec<_> = (0..7)
        .map(|j| {
            let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j - 1) };
            let x = if j == 3 || j == 5 { 0.4 } else { 0.0 };
            let axis = if j % 2 == 0 { vec3(1.0, 0.0, 0.0) } else { vec3(0.0, 1.0, 0.0) };
            let X_PB = Pose::new(Mat3::identity(), vec3(x, 0.0, 0.0));
            (Joint::new(parent, JointKind::Revolute, X_PB, axis), matter(5.0))
        })
        .collect();
    let X_BF = Pose::new(Mat3::identity(), vec3(0.2, 0.0, 0.0));
    let robot = Robot::new(matter(500.0), &links).expect("parents come first");
    (robot, Frame { body: BodyId::Link(6), X_BF })
}

proptest! {
    #![proptest_config(cases())]

    /// Limits so far apart that a duration underflows or overflows included.
    #[test]
    fn a_profile_is_refused_or_arrives(
        length in number(), speed in number(), acceleration in number(), jerk in number()
    ) {
        for shape in [ProfileShape::Quintic, ProfileShape::SCurve] {
            let limits = MotionLimits { speed, acceleration, jerk };
            let Ok(profile) = Profile::within(shape, length, &limits) else { continue };
            let T_ = profile.duration();
            prop_assert!(T_.is_finite() && T_ >= 0.0, "{T_}");
            prop_assert_eq!(profile.at(T_).position, length);
            for part in [-1.0, 0.0, 0.3, 0.5, 0.8, 2.0] {
                let motion = profile.at(part * T_);
                prop_assert!(finite(&motion), "{shape:?} {limits:?} {motion:?}");
            }
        }
    }

    #[test]
    fn a_line_between_any_poses_is_refused_or_starts_at_the_first(
        from in pose(), to in pose(), length in number(), duration in number()
    ) {
        let Ok(quintic) = Quintic::new(length, duration) else { return Ok(()) };
        if let Ok(line) = StraightLine::new(from, to, Profile::Quintic(quintic)) {
            prop_assert_eq!(line.at(0.0).X_NE.translation, from.translation);
        }
    }

    #[test]
    fn a_joint_move_between_any_postures_is_refused_or_starts_at_the_first(
        from in three(), to in three(), limits in [three(), three(), three()]
    ) {
        let limits = limits.map(|[speed, acceleration, jerk]| {
            MotionLimits { speed, acceleration, jerk }
        });
        for shape in [ProfileShape::Quintic, ProfileShape::SCurve] {
            if let Ok(motion) = JointMove::within(from, to, shape, &limits) {
                prop_assert_eq!(motion.at(0.0).q, from);
                prop_assert!(motion.duration().is_finite());
            }
        }
    }

    #[test]
    fn the_closed_form_answers_any_pose_with_finite_numbers(
        X_AE in pose(), arm_angle in number(), near in prop::array::uniform7(number())
    ) {
        let (robot, tool) = arm();
        for arm in [
            SphericalRevoluteSpherical::fixed_base(&robot, &tool).unwrap(),
            SphericalRevoluteSpherical::attitude_held(&robot, &tool, &[0.0; 7]).unwrap(),
        ] {
            match arm.solve(&X_AE, arm_angle, &near) {
                ClosedForm::Solved(solutions) => {
                    let all = solutions.iter().all(|s| s.q.iter().all(|q| q.is_finite()));
                    prop_assert!(all, "{solutions:?}");
                }
                ClosedForm::OutOfReach { distance, reach } => prop_assert!(distance > reach),
                ClosedForm::TooClose { distance, nearest } => prop_assert!(distance < nearest),
                ClosedForm::Singular { distance } => prop_assert!(distance.is_finite(), "{distance}"),
                ClosedForm::Unsettled { residual, .. } => prop_assert!(residual.is_finite()),
                _ => {}
            }
        }
    }

    #[test]
    fn damped_least_squares_answers_any_pose_with_finite_numbers(
        X_NE in pose(), q in prop::array::uniform7(number())
    ) {
        let (robot, tool) = arm();
        let state = State { q, ..State::default() };
        let limits = [JointLimits { travel: Some((-2.5, 2.5)), ..JointLimits::default() }; 7];
        let settings = DampedLeastSquares {
            position_tolerance: 1e-9, rotation_tolerance: 1e-9, iterations: 60
        };
        for anchor in [Anchor::Base, Anchor::AttitudeAndCentreOfMass] {
            let outcome =
                damped_least_squares(&robot, &tool, &state, &X_NE, &limits, anchor, &settings);
            let (DampedOutcome::Converged(attempt)
            | DampedOutcome::Stalled(attempt)
            | DampedOutcome::OutOfIterations(attempt)
            | DampedOutcome::LimitsReached { attempt, .. }) = outcome else { continue };
            prop_assert!(attempt.q.iter().all(|q| q.abs() <= 2.5), "{attempt:?}");
            let error = attempt.position_error + attempt.rotation_error;
            prop_assert!(error.is_finite(), "{attempt:?}");
        }
    }
}

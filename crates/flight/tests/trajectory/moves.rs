//! Lines and joint moves that follow a profile.

use super::{SHAPES, cases, limits};
use proptest::prelude::*;
use wrasse_flight::trajectory::{
    Expected, JointMove, MotionLimits, Profile, ProfileShape, Quintic, StraightLine,
};
use wrasse_spatial::{Pose, Quat, vec3};
use wrasse_testing::{larger, largest};

proptest! {
    #![proptest_config(cases())]

    /// Twist and acceleration of the line are the derivatives of its pose.
    #[test]
    fn the_line_moves_as_its_twist_says(
        r0 in prop::array::uniform3(-1.7..1.7), r in prop::array::uniform3(-1.7..1.7),
        p in prop::array::uniform3(-1.0..1.0), u in 0.05..0.95
    ) {
        let start = pose(r0, [0.3, -0.2, 0.9]);
        let end = start * pose(r, p);
        let line = StraightLine::new(start, end, Profile::Quintic(Quintic::new(1.0, 8.0).unwrap()))
            .unwrap();
        let (t, h) = (8.0 * u, 1e-4);
        let (before, now, after) = (line.at(t - h), line.at(t), line.at(t + h));
        let R = after.X_NE.rotation * before.X_NE.rotation.transpose();
        let w = Quat::from_matrix(&R).log() * (0.5 / h);
        let v = (after.X_NE.translation - before.X_NE.translation) * (0.5 / h);
        let off = larger((w - now.V_NE_N.angular).norm(), (v - now.V_NE_N.linear).norm());
        prop_assert!(off < 1e-9, "h²/6 of the jerk, measured 3.4e-10: {off:e}");
        let rate = (after.V_NE_N - before.V_NE_N) * (0.5 / h);
        let off = largest((rate - now.Vdot_NE_N).to_array().into_iter().map(f64::abs));
        prop_assert!(off < 1e-9, "measured 2.9e-10: {off:e}");
        // Straight: the cross product of the way gone with the whole way.
        let (gone, whole) = (now.X_NE.translation - start.translation, end.translation - start.translation);
        prop_assert!(gone.cross(whole).norm() < 1e-15, "{:e}", gone.cross(whole).norm());
        let arrived = line.at(8.0).X_NE;
        let off = (arrived.translation - end.translation).norm();
        let R = arrived.rotation.transpose() * end.rotation;
        let turned = Quat::from_matrix(&R).log().norm();
        prop_assert!(off < 1e-15 && turned < 1e-14, "measured 0 and 1.7e-15: {off:e} {turned:e}");
    }

    /// No joint exceeds its own limits, all arrive together, and one is at a limit.
    #[test]
    fn joints_move_together_within_their_own_limits(
        from in prop::array::uniform4(-2.0..2.0), to in prop::array::uniform4(-2.0..2.0),
        limits in prop::array::uniform4((-1.0..1.0, -1.0..1.0, -1.0..1.0)),
        shape in prop::sample::select(&SHAPES)
    ) {
        let limits = limits.map(|(v, a, j)| {
            MotionLimits {
                speed: 10_f64.powf(v), acceleration: 10_f64.powf(a), jerk: 10_f64.powf(j)
            }
        });
        let motion = JointMove::within(from, to, shape, &limits).unwrap();
        let T_ = motion.duration();
        for k in 0..=200 {
            let point = motion.at(T_ * f64::from(k) / 200.0);
            for j in 0..4 {
                prop_assert!(point.v[j].abs() <= limits[j].speed * (1.0 + 1e-14));
                prop_assert!(point.vdot[j].abs() <= limits[j].acceleration * (1.0 + 1e-14));
            }
        }
        prop_assert_eq!(motion.at(0.0).q, from);
        let off = largest((0..4).map(|j| (motion.at(T_).q[j] - to[j]).abs()));
        prop_assert!(off < 5e-16, "measured 2.3e-16: {off:e}");
        prop_assert_eq!(motion.at(T_).v, [0.0; 4]);
        // A hundredth faster and one of the joints alone could not follow on this shape.
        let alone = (0..4).map(|j| {
            Profile::within(shape, (to[j] - from[j]).abs(), &limits[j]).unwrap().duration()
        });
        let slowest = largest(alone);
        prop_assert!(T_ >= slowest * (1.0 - 1e-14), "{T_} {slowest}");
    }
}

fn pose(r: [f64; 3], p: [f64; 3]) -> Pose<f64> {
    Pose::from_quat(Quat::exp(vec3(r[0], r[1], r[2])), vec3(p[0], p[1], p[2]))
}

#[test]
fn a_line_under_limits_is_as_slow_as_the_slower_of_way_and_turn() {
    let (slow, fast) = (limits(0.1, 1.0, 10.0), limits(10.0, 100.0, 1000.0));
    let (start, end) = (Pose::identity(), pose([0.0, 0.0, 0.5], [2.0, 0.0, 0.0]));
    for shape in SHAPES {
        let alone = |length| Profile::within(shape, length, &slow).unwrap().duration();
        for (linear, angular, expected) in [(slow, fast, alone(2.0)), (fast, slow, alone(0.5))] {
            let line = StraightLine::within(start, end, shape, &linear, &angular).unwrap();
            assert!((line.duration() - expected).abs() < 1e-13, "{} {expected}", line.duration());
        }
        let turn_only = pose([0.0, 0.0, 1.0], [0.0; 3]);
        let line = StraightLine::within(start, turn_only, shape, &fast, &slow).unwrap();
        let expected = alone(1.0);
        assert!((line.duration() - expected).abs() < 1e-13, "a pure turn: {}", line.duration());
        assert_eq!(line.at(1.0).X_NE.translation, vec3(0.0, 0.0, 0.0));
    }
}

#[test]
fn a_profile_without_length_is_refused_where_the_ends_differ() {
    let still = Profile::Quintic(Quintic::new(0.0, 0.0).unwrap());
    let complaints = JointMove::new([0.0], [1.0], still).unwrap_err();
    assert_eq!(complaints.iter().next().unwrap().expected, Expected::PositiveSinceTheEndsDiffer);
    assert!(StraightLine::new(Pose::identity(), pose([0.0; 3], [1.0, 0.0, 0.0]), still).is_err());
    assert!(JointMove::new([1.0], [1.0], still).is_ok());
    // The relative rotation of a pose to itself is the identity to rounding only.
    let here = pose([0.3, -0.8, 1.1], [1.0, 0.0, 0.0]);
    assert!(StraightLine::new(here, here, still).is_ok());
}

#[test]
fn a_joint_limit_that_is_no_number_is_named_with_its_joint() {
    let good = limits(1.0, 1.0, 1.0);
    let bad = MotionLimits { speed: f64::NAN, ..good };
    let complaints =
        JointMove::within([0.0; 2], [1.0; 2], ProfileShape::SCurve, &[good, bad]).unwrap_err();
    let text = complaints.to_string();
    assert_eq!(text, "speed limit of joint 1: found NaN, expected a finite number above zero");
}

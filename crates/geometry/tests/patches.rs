//! Places where shapes meet: shares, gradients, and what a patch of points says of a flat.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use wrasse_geometry::{Meeting, Patch, Shape, nearest};
use wrasse_spatial::{Pose, Quat, Vec3, vec3};

fn meetings(patch: &Patch, X_NA: &Pose<f64>, X_NB: &Pose<f64>) -> Vec<Meeting> {
    let mut all = vec![Meeting::default(); patch.len()];
    patch.meet(X_NA, X_NB, &mut all);
    all
}

fn pose(turn: Vec3<f64>, p: Vec3<f64>) -> Pose<f64> {
    Pose::from_quat(Quat::exp(turn), p)
}

const BORE: Shape = Shape::Bore {
    radius: 0.025_05,
    depth: 0.1,
    block_radius: 0.06,
    chamfer_depth: 0.001,
    chamfer_angle: core::f64::consts::FRAC_PI_4,
};

/// Pairs in poses in which they overlap a little.
fn pairs() -> Vec<(Shape, Pose<f64>, Shape, Pose<f64>)> {
    let tilted = vec3(0.1, -0.2, 0.3);
    let sphere = Shape::Sphere { radius: 0.1 };
    let cube = Shape::Box { edges: vec3(0.3, 0.2, 0.4), rounding: 0.01 };
    let rod = Shape::Capsule { radius: 0.03, length: 0.4 };
    let peg = Shape::Cylinder { radius: 0.025, length: 0.08 };
    let cone = Shape::Cone { bottom_radius: 0.05, top_radius: 0.2, length: 0.2, wall: Some(0.01) };
    let ring = Shape::Torus { radius: 0.1, tube: 0.005 };
    let rail = Shape::Rail { width: 0.05, height: 0.03, wall: 0.005, length: 0.5 };
    let at = |x, y, z| pose(tilted, vec3(x, y, z));
    vec![
        (
            sphere.clone(),
            at(0.0, 0.0, 0.095),
            Shape::Plane,
            pose(vec3(0.01, 0.02, 0.0), Vec3::zero()),
        ),
        (sphere.clone(), at(0.24, 0.0, 0.02), cube.clone(), at(0.0, 0.0, 0.0)),
        (
            rod.clone(),
            at(0.0, 0.0, 0.0),
            rod.clone(),
            pose(vec3(1.2, 0.4, 0.0), vec3(0.04, 0.03, 0.05)),
        ),
        (rod.clone(), at(0.0, 0.0, 0.22), Shape::Plane, pose(vec3(0.0, 0.1, 0.0), Vec3::zero())),
        (Shape::Plane, Pose::identity(), cube.clone(), at(0.0, 0.0, 0.2)),
        (
            cube.clone(),
            at(0.0, 0.0, 0.0),
            Shape::Box { edges: vec3(1.0, 1.0, 0.5), rounding: 0.0 },
            pose(vec3(0.0, 0.05, 0.0), vec3(0.0, 0.0, -0.48)),
        ),
        (
            peg.clone(),
            pose(vec3(0.011, 0.004, 0.3), vec3(1e-4, 2e-5, 0.01)),
            BORE,
            Pose::identity(),
        ),
        (
            BORE,
            pose(tilted, vec3(1.0, 2.0, 3.0)),
            peg,
            pose(tilted, vec3(1.0, 2.0, 3.0)) * pose(vec3(0.02, 0.0, 0.0), vec3(0.0, 1e-4, 0.02)),
        ),
        (rod.clone(), pose(vec3(0.0, 0.01, 0.0), vec3(0.065, 0.001, 0.18)), cone, Pose::identity()),
        (sphere, pose(tilted, vec3(0.02, 0.03, 0.001)), ring, Pose::identity()),
        (rod, pose(vec3(0.0, 1.5, 0.0), vec3(0.0, 0.003, 0.02)), rail, Pose::identity()),
    ]
}

/// The rate of a depth is the approach of the two points along the normal, however the shapes move: then the
/// elastic force has a potential. Central differences over 1e-7, for the
/// deepest point of a rim in a narrow bore wanders fast: measured 6e-9 of rates about 1.
#[test]
fn a_depth_changes_as_its_points_approach() {
    for (A, X_NA, B, X_NB) in pairs() {
        let patch = Patch::new(&A, &B, 16).unwrap();
        let moves = [
            (vec3(0.3, -0.2, 0.5), vec3(0.1, 0.4, -0.3)),
            (vec3(-0.4, 0.6, 0.1), vec3(-0.2, 0.1, 0.5)),
        ];
        let moved = |X: &Pose<f64>, (w, v): (Vec3<f64>, Vec3<f64>), t: f64| {
            Pose::new(Quat::exp(w * t).to_matrix() * X.rotation, X.translation + v * t)
        };
        let at = |t: f64| meetings(&patch, &moved(&X_NA, moves[0], t), &moved(&X_NB, moves[1], t));
        let (h, now) = (1e-7, at(0.0));
        let (after, before) = (at(h), at(-h));
        // One metre apart is what faces feel that look another way.
        for (i, m) in now.iter().enumerate().filter(|(_, m)| m.depth != -1.0) {
            let velocity =
                |X: &Pose<f64>, (w, v): (Vec3<f64>, Vec3<f64>)| v + w.cross(m.on_A - X.translation);
            let rate = -m.normal.dot(velocity(&X_NA, moves[0]) - velocity(&X_NB, moves[1]));
            let seen = (after[i].depth - before[i].depth) / (2.0 * h);
            assert!((rate - seen).abs() < 1e-7, "{A:?} {B:?} place {i}: {rate} {seen}");
        }
    }
}

/// The two points are on the surfaces, a depth apart along the normal. Measured 6e-17 m.
#[test]
fn places_are_on_both_surfaces() {
    for (A, X_NA, B, X_NB) in pairs() {
        let patch = Patch::new(&A, &B, 16).unwrap();
        for m in meetings(&patch, &X_NA, &X_NB).iter().filter(|m| m.depth > 0.0) {
            assert!((m.normal.norm() - 1.0).abs() < 1e-14);
            assert!((m.on_A + m.normal * m.depth - m.on_B).norm() < 1e-15);
            let off = [(&A, &X_NA, m.on_A), (&B, &X_NB, m.on_B)]
                .map(|(shape, X, p)| nearest(shape, X.inverse().point(p)).distance.abs());
            // The ball of a rounded edge, or of the end of a rod, has its lowest point within the shape where
            // that is tilted.
            let has_core = |shape: &Shape| match shape {
                Shape::Box { rounding, .. } => *rounding > 0.0,
                Shape::Capsule { .. } => true,
                _ => false,
            };
            for (shape, off) in [&A, &B].into_iter().zip(off) {
                let most = if has_core(shape) { 3e-4 } else { 1e-14 };
                assert!(off < most, "{A:?} {B:?}: {off:?}");
            }
        }
    }
}

/// Exchanged, a pair meets at the same places with the normal turned.
#[test]
fn it_does_not_matter_which_is_called_a() {
    for (A, X_NA, B, X_NB) in pairs() {
        let (one, other) = (Patch::new(&A, &B, 16).unwrap(), Patch::new(&B, &A, 16).unwrap());
        let sum = |all: &[Meeting], sign: f64| {
            let deep = all.iter().filter(|m| m.depth > 0.0);
            deep.fold(Vec3::zero(), |sum, m| sum + m.normal * (sign * m.share * m.depth))
        };
        let (a, b) = (meetings(&one, &X_NA, &X_NB), meetings(&other, &X_NB, &X_NA));
        assert!((sum(&a, 1.0) - sum(&b, -1.0)).norm() < 1e-15, "{A:?} {B:?}");
    }
}

/// Force of a face pressed evenly, per stiffness: depth, however many places there are.
#[test]
fn the_places_of_a_face_share_the_stiffness() {
    let cube = Shape::Box { edges: vec3(0.1, 0.1, 0.1), rounding: 0.0 };
    let disc = Shape::Cylinder { radius: 0.1, length: 0.1 };
    for places in [4, 16, 64, 256] {
        for shape in [&cube, &disc] {
            for depth in [0.002, 0.01] {
                let patch = Patch::new(shape, &Shape::Plane, places).unwrap();
                let X = pose(vec3(0.0, 0.0, 0.7), vec3(0.3, 0.4, 0.05 - depth));
                let all = meetings(&patch, &X, &Pose::identity());
                let force: f64 = all.iter().map(|m| m.share * m.depth.max(0.0)).sum();
                assert!((force / depth - 1.0).abs() < 1e-13, "{places}: {force} {depth}");
            }
        }
        let table = Shape::Box { edges: vec3(1.0, 1.0, 0.2), rounding: 0.0 };
        let patch = Patch::new(&cube, &table, places).unwrap();
        let X = pose(Vec3::zero(), vec3(0.0, 0.0, 0.149));
        let all = meetings(&patch, &X, &Pose::identity());
        let force: f64 = all.iter().map(|m| m.share * m.depth.max(0.0)).sum();
        assert!((force / 0.001 - 1.0).abs() < 1e-12, "{places}: {force}");
    }
}

/// Moment of a tilted disc, all of it pressed in: that of the even pressure of an elastic layer, `k R²/4` for
/// each radian, exact from 16 places on; of a square face `k a²/12`, where the trapezoidal rule gives too much:
/// by 1/3·… = 2/(m-1)² of it with m points along an edge: 22 %, 4.1 %, 0.89 %.
#[test]
fn the_moment_of_a_tilted_face_is_off_by_what_is_stated() {
    let tilt = 1e-4;
    let moment = |shape: &Shape, places: usize| {
        let patch = Patch::new(shape, &Shape::Plane, places).unwrap();
        let X = pose(vec3(tilt, 0.0, 0.0), vec3(0.0, 0.0, -0.01))
            * pose(Vec3::zero(), vec3(0.0, 0.0, 0.05));
        let all = meetings(&patch, &X, &Pose::identity());
        let torque = all.iter().filter(|m| m.depth > 0.0).fold(Vec3::zero(), |sum, m| {
            sum + (m.on_A - vec3(0.0, 0.0, m.on_A.z)).cross(m.normal * (m.share * m.depth))
        });
        -torque.x / tilt
    };
    let disc = Shape::Cylinder { radius: 0.1, length: 0.1 };
    let square = Shape::Box { edges: vec3(0.1, 0.1, 0.1), rounding: 0.0 };
    for (places, off) in [(16, 2.0 / 9.0), (64, 2.0 / 49.0), (256, 2.0 / 225.0)] {
        let found = moment(&disc, places) / (0.1 * 0.1 / 4.0);
        assert!((found - 1.0).abs() < 1e-6, "{places} on a disc: {found}");
        let found = moment(&square, places) / (0.1 * 0.1 / 12.0);
        assert!((found - 1.0 - off).abs() < 1e-5, "{places} on a square: {found}");
    }
}

/// Pairs without a rule say so.
#[test]
fn a_pair_without_a_rule_has_no_patch() {
    let cone = Shape::Cone { bottom_radius: 0.1, top_radius: 0.2, length: 0.3, wall: None };
    assert!(Patch::new(&cone, &cone, 16).is_none());
    assert!(Patch::new(&Shape::Plane, &Shape::Plane, 16).is_none());
}

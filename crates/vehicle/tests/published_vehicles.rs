//! The vehicles with published numbers, held against figures that their files do not contain.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_document::{Severity, render};
use wrasse_dynamics::{BodyId, State, kinematics};
use wrasse_spatial::Vec3;
use wrasse_testing::largest;
use wrasse_vehicle::{JOINTS, ShapeKind, Vehicle, catalogue, find_vehicle, read_vehicle};

const FILES: [(&str, &str); 4] = [
    ("etsvii.toml", include_str!("../../../vehicles/etsvii.toml")),
    ("shuttle-rms.toml", include_str!("../../../vehicles/shuttle-rms.toml")),
    ("ssrms.toml", include_str!("../../../vehicles/ssrms.toml")),
    ("example-arm.urdf", include_str!("../../../vehicles/example-arm.urdf")),
];

#[track_caller]
fn vehicle(name: &str) -> Vehicle {
    let (_, text) = FILES.iter().find(|(file, _)| *file == name).expect("one of the files");
    read_vehicle(name, *text).unwrap_or_else(|why| panic!("{}", render(&why, false)))
}

#[track_caller]
fn of_catalogue(name: &str) -> Vehicle {
    find_vehicle(name, None).unwrap_or_else(|why| panic!("{name}: {why:?}"))
}

/// Position of a frame on the base, at a posture (m).
fn position(vehicle: &Vehicle, frame: &str, q: &[f64]) -> Vec3<f64> {
    let mut state = State::<f64, JOINTS>::default();
    state.q[..q.len()].copy_from_slice(q);
    kinematics(&vehicle.robot, &state).pose(&vehicle.frame(frame).expect("a frame")).translation
}

fn mass_of_joints_bodies(vehicle: &Vehicle) -> f64 {
    vehicle.robot.joints().map(|j| vehicle.robot.inertia(BodyId::Link(j)).mass).sum()
}

#[test]
fn only_the_nonphysical_inertias_of_ets_vii_are_warned_of() {
    for entry in catalogue() {
        let name = entry.name;
        let remarks = of_catalogue(name).remarks;
        let expected = if name == "etsvii" { 3 } else { 0 };
        assert_eq!(remarks.len(), expected, "{name}: {}", render(&remarks, false));
        for remark in remarks {
            assert_eq!(remark.severity, Severity::Warning);
            assert!(remark.message.contains("breaks the triangle inequality"));
        }
    }
}

/// NASA JSC: 15.32 m from the shoulder to the tip.
#[test]
fn the_stretched_shuttle_arm_is_as_long_as_nasa_says() {
    let arm = vehicle("shuttle-rms.toml");
    let q = [0.0; 6];
    let length = (position(&arm, "tool", &q) - position(&arm, "B3", &q)).norm();
    assert!((length - 15.32).abs() < 0.01, "measured 15.3197: {length}");
    // It points aft along the sill.
    let along = position(&arm, "tool", &q) - position(&arm, "B3", &q);
    assert!(along.x < -15.3, "{along:?}");
}

/// NASA JSC: 410.5 kg. The transcribed links are 2.7 % heavier.
#[test]
fn the_shuttle_arm_weighs_what_nasa_says_within_three_percent() {
    let arm = vehicle("shuttle-rms.toml");
    let mass = arm.robot.mass() - 95_000.0;
    assert!((mass / 410.5 - 1.0).abs() < 0.03, "measured 421.76 kg: {mass}");
    assert!((mass_of_joints_bodies(&arm) - (421.76 - 63.24)).abs() < 1e-9);
}

/// The shoulder pitches upwards, out of the bay, through its whole travel.
#[test]
fn the_shuttle_arm_lifts_out_of_the_bay() {
    let arm = vehicle("shuttle-rms.toml");
    let height = |pitch: f64| -position(&arm, "tool", &[0.0, pitch, 0.0, 0.0, 0.0, 0.0]).z;
    assert!(height(0.5) > height(0.0) + 7.0);
    assert_eq!(arm.limits[1].travel.map(|(lower, _)| lower), Some(0.0));
}

/// CSA: 17 to 17.6 m and 1497 to 1800 kg, depending on the page.
#[test]
fn the_station_arm_is_as_long_and_heavy_as_published() {
    let arm = vehicle("ssrms.toml");
    let length = (position(&arm, "tool", &[0.0; 7]) - position(&arm, "B1", &[0.0; 7])).norm();
    assert!((16.9..17.6).contains(&length), "measured 17.0: {length}");
    let mass = arm.robot.mass() - 420_000.0;
    assert!((1497.0..1800.0).contains(&mass), "measured 1505.3 kg: {mass}");
}

/// The arm of ETS-VII is 2 m long and has 140.4 kg, 5.5 % of its base.
#[test]
fn the_arm_of_ets_vii_is_as_long_and_heavy_as_published() {
    let ets = vehicle("etsvii.toml");
    let mass = mass_of_joints_bodies(&ets);
    assert!((mass - 140.4).abs() < 1e-9, "{mass}");
    assert!((mass / ets.robot.inertia(BodyId::Base).mass - 0.055).abs() < 5e-4);
    // Greatest reach from the second joint, over a grid of postures of joints 3 and 5.
    let reach = |q3: f64, q5: f64| {
        let q = [0.0, 0.0, q3, 0.0, q5, 0.0];
        (position(&ets, "tool", &q) - position(&ets, "link2", &q)).norm()
    };
    let angles = || (0..72).map(|k| f64::from(k) * 5.0_f64.to_radians());
    let longest = angles().flat_map(|a| angles().map(move |b| (a, b)));
    let longest = largest(longest.map(|(a, b)| reach(a, b)));
    assert!((1.9..2.1).contains(&longest), "measured 2.09: {longest}");
}

/// Kilograms of a pound, and metres of a foot.
const LB: f64 = 0.453_592_37;
const FT: f64 = 0.3048;

/// Distance of a tool from the origin of another frame with all joints at zero (m).
fn stretched(vehicle: &Vehicle, from: &str, tool: &str) -> f64 {
    let q = vec![0.0; vehicle.robot.joint_count()];
    (position(vehicle, tool, &q) - position(vehicle, from, &q)).norm()
}

#[track_caller]
fn assert_near(what: &str, found: f64, published: f64, within: f64) {
    assert!((found - published).abs() <= within, "{what}: {found} for {published}");
}

/// Masses that a document gives for the whole, as sums of what the files parted (kg).
#[test]
fn masses_add_up_to_what_is_published() {
    let of_arm = |name: &str, base: f64| of_catalogue(name).robot.mass() - base;
    assert_near("ERA, ESA", of_arm("era-class", 420_000.0), 630.0, 1e-6);
    assert_near("Kibo's arms, JAXA", of_arm("jemrms-class", 420_000.0), 780.0 + 190.0, 1e-6);
    assert_near("Dextre", of_arm("dextre-class", 420_000.0), 1662.0, 1e-6);
    let with_propellant = |name: &str| {
        let vehicle = of_catalogue(name);
        vehicle.robot.mass() + vehicle.equipment.actuators.tank.map_or(0.0, |tank| tank.propellant)
    };
    assert_near("OMV", with_propellant("omv-class"), 17_500.0 * LB, 0.5);
    assert_near("AERCam Sprint", with_propellant("aercam-sprint-class"), 35.0 * LB, 1e-3);
    assert_near("ASTRO", of_catalogue("orbital-express-class").robot.mass(), 2100.0 * LB, 3.0);
    let bus = of_catalogue("fts-class").robot.inertia(BodyId::Base).mass;
    assert_near("OMV, short range", bus, 6500.0 * LB, 0.5);
    assert_near("Hubble", of_catalogue("hubble-class").robot.mass(), 27_000.0 * LB, 0.5);
    // At launch 8211 kg, 319 of them fuel; in the e.Deorbit studies a little less than what is left.
    assert_near("Envisat", of_catalogue("envisat-class").robot.mass(), 8211.0 - 319.0, 65.0);
    // Together 2860 kg: base, arm and target as published one by one are 8 % heavier.
    let both =
        of_catalogue("etsvii-repaired").robot.mass() + of_catalogue("etsvii-target").robot.mass();
    assert_near("ETS-VII with its target", both, 2860.0, 0.09 * 2860.0);
}

/// Lengths that a document gives for a whole arm, as the stretched arms of the files (m).
#[test]
fn arms_are_as_long_as_published() {
    let era = of_catalogue("era-class");
    assert_near("ERA, ESA", stretched(&era, "foot", "tool"), 11.3, 0.021);
    assert_near("ERA's reach, ESA", stretched(&era, "limb1", "tool"), 9.7, 0.013);
    let kibo = of_catalogue("jemrms-class");
    assert_near("Kibo's main arm, JAXA", stretched(&kibo, "shoulder", "main_tool"), 10.0, 1e-9);
    assert_near("Kibo's small fine arm", stretched(&kibo, "fine_box", "fine_tool"), 2.2, 1e-9);
    let dextre = of_catalogue("dextre-class");
    for side in ["a", "b"] {
        let (from, tool) = (format!("{side}_shoulder1"), format!("{side}_tool"));
        assert_near("Dextre, CSA", stretched(&dextre, &from, &tool), 3.35, 1e-9);
    }
    let astro = of_catalogue("orbital-express-class");
    assert_near("Orbital Express", stretched(&astro, "link1", "tool"), 10.0 * FT, 0.003);
}

#[test]
fn joints_are_as_many_as_published() {
    for (name, joints) in [
        ("era-class", 7),
        ("jemrms-class", 6 + 6),
        // And the waist.
        ("dextre-class", 7 + 7 + 1),
        ("etsvii-repaired", 6),
    ] {
        assert_eq!(of_catalogue(name).robot.joint_count(), joints, "{name}");
    }
}

/// What is drawn has the outer size that is published (m).
#[test]
fn outlines_are_as_large_as_published() {
    let first = |name: &str| of_catalogue(name).shapes[0].kind;
    assert_eq!(first("solar-max-class"), ShapeKind::Cylinder { radius: 2.3 / 2.0, length: 4.0 });
    assert_eq!(first("hubble-class"), ShapeKind::Cylinder { radius: 4.2 / 2.0, length: 13.2 });
    let ShapeKind::Sphere(radius) = first("aercam-sprint-class") else { panic!("no sphere") };
    assert_near("AERCam Sprint, 14 inches", radius, 7.0 * FT / 12.0, 1e-12);
    let ShapeKind::Cylinder { radius, length } = first("omv-class") else { panic!("no cylinder") };
    assert_near("OMV, diameter", 2.0 * radius, 15.0 * FT, 1e-9);
    assert_near("OMV, thickness", length, 6.0 * FT, 2e-3);
}

/// The repaired ETS-VII is the published one, but for three tensors, of which no moment shrinks and
/// the largest stays.
#[test]
fn the_repair_of_ets_vii_changes_three_tensors_and_shrinks_no_moment() {
    let (published, repaired) = (of_catalogue("etsvii"), of_catalogue("etsvii-repaired"));
    let mut changed = vec![];
    for body in published.robot.bodies() {
        let [was, is] = [&published, &repaired].map(|vehicle| vehicle.robot.inertia(body));
        assert_eq!((was.mass, was.first_moment), (is.mass, is.first_moment));
        let [was, is] = [was, is].map(|M| {
            let I = M.central();
            let mut moments = [I.xx, I.yy, I.zz];
            moments.sort_by(f64::total_cmp);
            moments
        });
        if largest(was.iter().zip(is).map(|(a, b)| (a - b).abs())) > 1e-9 {
            changed.push(body);
            assert!(was.iter().zip(is).all(|(was, is)| is >= was - 1e-12), "{was:?} {is:?}");
            assert!((was[2] - is[2]).abs() < 1e-12);
            assert!((is[0] + is[1] - is[2]).abs() < 1e-9, "equality: {is:?}");
        }
    }
    assert_eq!(changed, [0, 1, 2].map(BodyId::Link));
    for j in published.robot.joints() {
        assert_eq!(published.robot.joint(j).X_PB_zero, repaired.robot.joint(j).X_PB_zero);
    }
}

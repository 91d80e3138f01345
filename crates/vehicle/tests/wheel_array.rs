//! Arrays of reaction wheels, as a table `[actuators]` gives them.

use wrasse_document::{Document, Step, at, render};
use wrasse_spatial::{Vec3, vec3};
use wrasse_testing::largest;
use wrasse_vehicle::{Equipment, EquipmentFile, read_equipment};

const RPM: f64 = core::f64::consts::TAU / 60.0;

fn read(array: &str) -> (Equipment, String) {
    let text = format!("[[wheel_array]]\nname = 'w'\nmodel = 'honeywell-hr16-100'\n{array}\n");
    let document = Document::parse("table.toml", &text).expect("a table");
    let file = document.read::<EquipmentFile>().unwrap_or_else(|c| panic!("{}", render(&c, false)));
    let path: &[Step<'_>] = at![];
    let (equipment, complaints) = read_equipment(&document, path, &file);
    (equipment, render(&complaints, false))
}

#[track_caller]
fn equipment(array: &str) -> Equipment {
    let (equipment, said) = read(array);
    assert_eq!(said, "");
    equipment
}

fn axes(equipment: &Equipment) -> Vec<Vec3<f64>> {
    equipment.actuators.wheels.iter().map(|wheel| wheel.axis_B).collect()
}

#[track_caller]
fn assert_axes(array: &str, expected: &[Vec3<f64>]) {
    let found = axes(&equipment(array));
    assert_eq!(found.len(), expected.len());
    let off = largest(found.iter().zip(expected).map(|(a, b)| (*a - *b).norm()));
    assert!(off < 4.0 * f64::EPSILON, "measured 2.3e-16: {off:e} {found:?}");
}

/// The array gives one error, which says all these words.
#[track_caller]
fn assert_says(array: &str, words: &[&str]) {
    let (_, said) = read(array);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with("\n1 error\n"), "not one error:\n{said}");
}

#[test]
fn orthogonal_wheels_lie_along_the_axes() {
    let [x, y, z] = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
    assert_axes("arrangement = 'orthogonal'", &[x, y, z]);
    let turned = "arrangement = 'orthogonal'\norientation.rpy_deg = [0, 0, 90]";
    assert_axes(turned, &[y, -x, z]);
}

#[test]
fn wheels_of_a_pyramid_stand_evenly_about_its_axis() {
    let (s, c) = (0.6_f64, 0.8_f64);
    let skew = s.asin().to_degrees();
    let four = [vec3(s, 0.0, c), vec3(0.0, s, c), vec3(-s, 0.0, c), vec3(0.0, -s, c)];
    assert_axes(&format!("arrangement = 'pyramid'\nskew_deg = {skew}"), &four);
    let h = 0.75_f64.sqrt() * s;
    let three = [vec3(s, 0.0, c), vec3(-0.5 * s, h, c), vec3(-0.5 * s, -h, c)];
    assert_axes(&format!("arrangement = 'pyramid'\ncount = 3\nskew_deg = {skew}"), &three);
}

#[test]
fn the_wheels_of_a_tetrahedron_make_equal_angles_and_no_momentum_at_equal_speeds() {
    let tetrahedron = equipment("arrangement = 'tetrahedron'\nspeed_rpm = 600");
    let axes = axes(&tetrahedron);
    let part = 1.0 / 3.0_f64.sqrt();
    assert_eq!(axes[1], vec3(part, -part, -part));
    for (i, a) in axes.iter().enumerate() {
        assert!(axes[..i].iter().all(|b| (a.dot(*b) + 1.0 / 3.0).abs() < 1e-15));
    }
    let sum = axes.iter().fold(Vec3::zero(), |sum, axis| sum + *axis);
    assert_eq!(sum, Vec3::zero());
    assert_eq!(
        tetrahedron.wheel_speed[..5],
        [600.0 * RPM, 600.0 * RPM, 600.0 * RPM, 600.0 * RPM, 0.0]
    );
}

#[test]
fn wheels_of_an_array_are_numbered_and_have_their_own_speeds_and_the_models_numbers() {
    let text = "arrangement = 'orthogonal'\nspeed_rpm = [100, -200, 0]\nmomentum_nms = 50";
    let array = equipment(text);
    assert_eq!(array.wheel_names, ["w-1", "w-2", "w-3"]);
    assert_eq!(array.wheel_speed[..3], [100.0 * RPM, -200.0 * RPM, 0.0]);
    let wheel = array.actuators.wheels[1];
    assert_eq!((wheel.torque_limit, wheel.momentum_limit()), (0.2, 50.0));
    assert_eq!(array.name, "3 x honeywell-hr16-100");
    assert_eq!(array.mass, Some(36.0));
}

#[test]
fn wheels_of_arrays_come_after_single_ones() {
    let single = "[[wheel]]\nname = 'lone'\nmodel = 'honeywell-hr16-100'\naxis = [0, 0, 1]";
    let both = equipment(&format!("arrangement = 'orthogonal'\n{single}"));
    assert_eq!(both.wheel_names, ["lone", "w-1", "w-2", "w-3"]);
}

#[test]
fn what_an_array_says_wrong_is_told_once() {
    for (array, words) in [
        ("arrangement = 'pyramid'", ["has no `skew_deg`", "the angle between spin axes and z"]),
        ("arrangement = 'pyramid'\nskew_deg = 0", ["between 0 and 90", "found 0"]),
        ("arrangement = 'pyramid'\nskew_deg = 90", ["between 0 and 90", "found 90"]),
        ("arrangement = 'orthogonal'\ncount = 3", ["has `count`", "says nothing of this"]),
        ("arrangement = 'tetrahedron'\nskew_deg = 30", ["has `skew_deg`", "leave it out"]),
        (
            "arrangement = 'orthogonal'\nspeed_rpm = [1, 2]",
            ["has 3 wheels and 2 speeds", "in order"],
        ),
        (
            "arrangement = 'orthogonal'\nspeed_rpm = [1, -9000, 2]",
            ["starts at -9000 rpm", "6000 rpm"],
        ),
        ("arrangement = 'orthogonal'\ntorque_limit_nm = 0.0004", ["never turns", "0.0005"]),
    ] {
        assert_says(array, &words);
    }
}

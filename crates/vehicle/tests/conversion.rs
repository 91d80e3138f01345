//! A URDF as a TOML file, read again: the same vehicle.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_testing::largest;
use wrasse_vehicle::{ConvertOptions, Vehicle, convert_to_toml, read_vehicle};

/// Rounded tensors, a slide, quaternions, limits of awkward numbers, joints that follow.
const HAND: &str = r#"<robot name="hand">
  <link name="palm"><inertial><origin xyz="0.1 -0.2 0.333333333"/><mass value="2.1"/>
    <inertia ixx="0.11" ixy="0.013" ixz="-0.0021" iyy="0.12" iyz="1e-3" izz="0.1"/></inertial></link>
  <link name="slide"><inertial><mass value="1.7"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.23" iyz="0" izz="0.34"/></inertial>
    <visual><origin xyz="0 0 1" rpy="0.1 1.5707963267948966 -3"/>
      <geometry><cylinder radius="0.1" length="0.3"/></geometry></visual></link>
  <link name="finger"><inertial><mass value="0.3"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <link name="thumb"><inertial><mass value="0.3"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <link name="tip"/>
  <joint name="slide" type="prismatic"><parent link="palm"/><child link="slide"/>
    <origin xyz="0.1 0.2 0.3" quat_xyzw="0.5 0.5 0.5 0.5"/><axis xyz="1 2 3"/>
    <limit lower="-0.1" upper="0.3333" effort="12.3" velocity="0.07"/></joint>
  <joint name="finger" type="continuous"><parent link="slide"/><child link="finger"/>
    <origin rpy="0.1 0.2 0.3"/><axis xyz="0 0 1"/>
    <mimic joint="slide" multiplier="7.3" offset="0.1"/></joint>
  <joint name="thumb" type="revolute"><parent link="slide"/><child link="thumb"/>
    <origin rpy="1.5708 -1.5708 3.1416"/><axis xyz="0 1 0"/>
    <limit lower="-1.2345678901234567" upper="0.7" effort="1" velocity="2.2"/></joint>
  <joint name="tip" type="fixed"><parent link="thumb"/><child link="tip"/>
    <origin xyz="0 0 0.1" rpy="0 -1.5707963267948966 0"/></joint>
</robot>"#;

fn both(name: &str, text: &str) -> (Vehicle, Vehicle) {
    let read = read_vehicle(name, text).unwrap_or_else(|why| panic!("{why:#?}"));
    let options = ConvertOptions::default();
    let converted = convert_to_toml(name, text, &options).unwrap_or_else(|why| panic!("{why:#?}"));
    let again = read_vehicle("again.toml", &*converted.0).unwrap_or_else(|why| panic!("{why:#?}"));
    (read, again)
}

/// Largest difference of two lists of numbers.
fn off(a: impl IntoIterator<Item = f64>, b: impl IntoIterator<Item = f64>) -> f64 {
    largest(a.into_iter().zip(b).map(|(a, b)| (a - b).abs()))
}

#[test]
fn a_converted_file_has_the_same_numbers() {
    let arm = include_str!("../../../vehicles/example-arm.urdf");
    for (name, text) in [("example-arm.urdf", arm), ("hand.urdf", HAND)] {
        let (a, b) = both(name, text);
        assert_eq!((&a.joint_names, &a.followers.len()), (&b.joint_names, &b.followers.len()));
        for (a, b) in a.matter.iter().zip(&b.matter) {
            assert_eq!(
                (a.mass, a.p_cm, a.inertia),
                (b.mass, b.p_cm, b.inertia),
                "{name}: {}",
                a.link
            );
        }
        for (j, joint) in a.joint_names.iter().enumerate() {
            let (X, Y) = (a.robot.joint(j), b.robot.joint(j));
            assert_eq!(X.X_PB_zero.translation, Y.X_PB_zero.translation, "{joint}");
            let rows =
                |R: &wrasse_spatial::Mat3<f64>| R.rows.map(wrasse_spatial::Vec3::to_array).concat();
            let turned = off(rows(&X.X_PB_zero.rotation), rows(&Y.X_PB_zero.rotation));
            assert!(turned <= 1e-15, "{joint} is turned by {turned:e}");
            assert_eq!(X.axis_B, Y.axis_B, "{joint}");
            let numbers = |v: &Vehicle| {
                let limits = v.limits[j];
                let (lower, upper) = limits.travel.unwrap_or_default();
                [lower, upper, limits.rate.unwrap_or(-1.0), limits.effort.unwrap_or(-1.0)]
            };
            assert!(off(numbers(&a), numbers(&b)) <= 1e-15, "{joint}: {:?}", numbers(&b));
        }
        for (a, b) in a.followers.iter().zip(&b.followers) {
            assert_eq!((a.joint, a.leader, a.ratio), (b.joint, b.leader, b.ratio));
            assert!((a.offset - b.offset).abs() <= 1e-15);
        }
        let frames = a.frames.iter().zip(&b.frames);
        for (a, b) in frames {
            assert_eq!((&a.name, a.frame.body), (&b.name, b.frame.body));
            let p = |f: &wrasse_dynamics::Frame<f64>| f.X_BF.translation.to_array();
            assert!(off(p(&a.frame), p(&b.frame)) <= 1e-15, "{}", a.name);
        }
    }
}

/// The digits that a tensor was written with are gone after it is turned: the file says so.
#[test]
fn what_passed_by_its_rounding_passes_after_conversion() {
    let rounded = HAND.replace("izz=\"0.34\"", "izz=\"0.35\"").replace(
        "ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.23\"",
        "ixx=\"0.11\" ixy=\"0\" ixz=\"0\" iyy=\"0.23\"",
    );
    let (_, again) = both("hand.urdf", &rounded);
    assert_eq!(again.matter.len(), 4);
    let beyond = HAND.replace("izz=\"0.34\"", "izz=\"0.45\"");
    assert!(read_vehicle("hand.urdf", beyond).is_err());
}

//! Links that are fixed to each other become one body, and joints keep their order.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_dynamics::BodyId;
use wrasse_testing::largest;
use wrasse_vehicle::{ShapeKind, Vehicle, read_vehicle};

const BALL: &str = "<inertial><mass value=\"2\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" \
                    iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial>";
/// Mass properties without symmetry, at a place and in axes to be filled in.
const LUMP: &str = "<inertial><origin xyz=\"XYZ\" rpy=\"RPY\"/><mass value=\"7\"/><inertia \
                    ixx=\"0.5\" ixy=\"0.03\" ixz=\"-0.02\" iyy=\"0.6\" iyz=\"0.05\" izz=\"0.7\"/>\
                    </inertial>";

#[track_caller]
fn read(inside: &str) -> Vehicle {
    let text = format!("<robot name=\"r\">{inside}</robot>");
    read_vehicle("r.urdf", text).unwrap_or_else(|why| panic!("{why:#?}"))
}

fn link(name: &str, inside: &str) -> String {
    format!("<link name=\"{name}\">{inside}</link>")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, origin: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/>{origin}<axis xyz=\"0 1 0\"/></joint>"
    )
}

/// Largest difference of the elements of two bodies' inertias.
fn difference(a: &Vehicle, b: &Vehicle, body: BodyId) -> f64 {
    let (a, b) = (a.robot.inertia(body).to_matrix(), b.robot.inertia(body).to_matrix());
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    largest(pairs.map(|(x, y)| (x - y).abs()))
}

#[test]
fn a_lump_on_a_turned_mount_is_the_same_lump_in_a_turned_inertial_frame() {
    let mount = "<origin xyz=\"0.3 -0.2 0.5\" rpy=\"0.4 -0.9 1.3\"/>";
    let lump = LUMP.replace("XYZ", "0 0 0").replace("RPY", "0 0 0");
    let mounted = read(
        &[link("bus", BALL), link("lump", &lump), joint("m", "fixed", "bus", "lump", mount)]
            .concat(),
    );
    let turned = LUMP.replace("XYZ", "0.3 -0.2 0.5").replace("RPY", "0.4 -0.9 1.3");
    let inside =
        read(&[link("bus", ""), link("ball", BALL), link("lump", &turned)].concat().replace(
            "<link name=\"lump\">",
            &(joint("b", "fixed", "bus", "ball", "")
                + &joint("l", "fixed", "bus", "lump", "")
                + "<link name=\"lump\">"),
        ));
    let off = difference(&mounted, &inside, BodyId::Base);
    assert!(off < 1e-15, "measured 0: {off:e}");
    // Both lumps and the ball count as parts, each about its own centre of mass.
    let parts = [&mounted, &inside].map(|v| *v.robot.inertia_of_parts(BodyId::Base));
    let trace = parts.map(|I| I.xx + I.yy + I.zz);
    assert!(trace.iter().all(|t| (t - 2.1).abs() < 1e-14), "{trace:?}");
}

#[test]
fn joints_come_in_the_order_of_the_file_but_parents_before_children() {
    let links = ["bus", "a", "b", "c", "d"].map(|name| link(name, BALL)).concat();
    let joints = [
        joint("to_d", "continuous", "c", "d", ""),
        joint("to_b", "continuous", "a", "b", ""),
        joint("to_a", "continuous", "bus", "a", ""),
        joint("to_c", "continuous", "bus", "c", ""),
    ];
    let vehicle = read(&(joints.concat() + &links));
    assert_eq!(vehicle.joint_names, ["to_a", "to_b", "to_c", "to_d"]);
    let parents: Vec<_> = vehicle.robot.joints().map(|j| vehicle.robot.joint(j).parent).collect();
    let expected = [BodyId::Base, BodyId::Link(0), BodyId::Base, BodyId::Link(2)];
    assert_eq!(parents, expected);
    let names: Vec<_> = vehicle.frames.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["bus", "a", "b", "c", "d"]);
}

#[test]
fn a_joint_on_a_fixed_link_is_mounted_on_the_body_that_carries_it() {
    let vehicle = read(
        &[
            link("bus", BALL),
            link("mount", ""),
            link("arm", BALL),
            joint("m", "fixed", "bus", "mount", "<origin xyz=\"1 0 0\" rpy=\"0 0 1.5707963267948966\"/>"),
            joint("j", "prismatic", "mount", "arm", "<origin xyz=\"0.5 0 0\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"),
        ]
        .concat(),
    );
    let joint = vehicle.robot.joint(0);
    assert_eq!(joint.parent, BodyId::Base);
    // Half a metre along the mount's x, which is the base's y.
    let off = joint.X_PB_zero.translation - wrasse_spatial::vec3(1.0, 0.5, 0.0);
    assert!(off.norm() < 1e-15, "{off:?}");
    assert_eq!(vehicle.limits[0].travel, Some((0.0, 1.0)));
}

#[test]
fn the_axis_is_x_where_the_file_gives_none() {
    let joint = joint("j", "continuous", "bus", "arm", "").replace("<axis xyz=\"0 1 0\"/>", "");
    let vehicle = read(&[link("bus", BALL), link("arm", BALL), joint].concat());
    assert_eq!(vehicle.robot.joint(0).axis_B.to_array(), [1.0, 0.0, 0.0]);
}

#[test]
fn boxes_cylinders_and_balls_are_outlines_where_the_file_puts_them() {
    let visual = |origin: &str, shape: &str| {
        format!("<visual>{origin}<geometry>{shape}</geometry></visual>")
    };
    let shapes = [
        visual("", "<box size=\"1 2 3\"/>"),
        visual("<origin xyz=\"0 0 1\"/>", "<cylinder radius=\"0.1\" length=\"2\"/>"),
        visual("", "<sphere radius=\"0.5\"/>"),
    ];
    let tip = link("tip", &shapes.concat());
    let on = joint("m", "fixed", "bus", "tip", "<origin xyz=\"1 0 0\"/>");
    let vehicle = read(&[link("bus", BALL), tip, on].concat());
    let kinds: Vec<_> = vehicle.shapes.iter().map(|s| s.kind).collect();
    assert_eq!(kinds[0], ShapeKind::Box(wrasse_spatial::vec3(1.0, 2.0, 3.0)));
    assert_eq!(
        kinds[1..],
        [ShapeKind::Cylinder { radius: 0.1, length: 2.0 }, ShapeKind::Sphere(0.5)]
    );
    assert_eq!(vehicle.shapes[1].frame.X_BF.translation.to_array(), [1.0, 0.0, 1.0]);
    assert!(vehicle.shapes.iter().all(|s| s.link == "tip" && s.frame.body == BodyId::Base));
}

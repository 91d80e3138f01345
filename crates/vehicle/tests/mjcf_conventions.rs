//! Each convention of MJCF by an example that can be worked by hand.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use core::f64::consts::{FRAC_PI_6, PI};
use wrasse_dynamics::BodyId;
use wrasse_spatial::{Pose, Sym3, Vec3, vec3};
use wrasse_vehicle::{ShapeKind, Vehicle, read_vehicle};

/// Off by a few rounding errors of numbers near one.
const CLOSE: f64 = 1e-15;

#[track_caller]
fn read(compiler: &str, body: &str) -> Vehicle {
    let text = format!(
        "<mujoco><compiler {compiler}/><default><geom mass=\"1\"/></default><worldbody><body \
         name=\"bus\"><freejoint/>{body}</body></worldbody></mujoco>"
    );
    read_vehicle("m.xml", text).unwrap_or_else(|why| panic!("{why:#?}"))
}

/// The pose of a site whose orientation is given.
#[track_caller]
fn site(compiler: &str, orientation: &str) -> Pose<f64> {
    let site = format!("<geom size=\"1\"/><site name=\"s\" {orientation}/>");
    read(compiler, &site).pose_on_body("s").expect("the site")
}

#[track_caller]
fn assert_turned(X_BS: &Pose<f64>, x: Vec3<f64>, z: Vec3<f64>) {
    let off = (X_BS.rotation * vec3(1.0, 0.0, 0.0) - x).norm()
        + (X_BS.rotation * vec3(0.0, 0.0, 1.0) - z).norm();
    assert!(off < 4.0 * CLOSE, "{off:e}: {X_BS:?}");
}

#[track_caller]
fn inertia(vehicle: &Vehicle) -> (f64, Vec3<f64>, Sym3<f64>) {
    let M = vehicle.robot.inertia(BodyId::Base);
    (M.mass, M.centre_of_mass(), M.central())
}

#[track_caller]
fn assert_inertia(geom: &str, mass: f64, moments: [f64; 3]) {
    let (m, p, I) = inertia(&read("", geom));
    assert!((m - mass).abs() < 4.0 * CLOSE * mass && p.norm() < CLOSE, "{m} {p:?}");
    let off = [I.xx - moments[0], I.yy - moments[1], I.zz - moments[2], I.xy, I.xz, I.yz];
    let off = off.into_iter().map(f64::abs).fold(0.0, f64::max);
    assert!(off < 4.0 * CLOSE * mass.max(1.0), "{off:e}: {I:?} {moments:?}");
}

const X: Vec3<f64> = Vec3 { x: 1.0, y: 0.0, z: 0.0 };
const Y: Vec3<f64> = Vec3 { x: 0.0, y: 1.0, z: 0.0 };
const Z: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

/// A quarter turn about x, then one about z: about the new z, which is -y, that takes x to z; about the
/// old z it takes x to y.
#[test]
fn small_letters_turn_about_axes_that_turn_along_and_large_ones_about_fixed_axes() {
    assert_turned(&site("", "euler=\"90 0 90\""), Z, -Y);
    assert_turned(&site("eulerseq=\"XYZ\"", "euler=\"90 0 90\""), Y, X);
    assert_turned(&site("eulerseq=\"zyx\"", "euler=\"90 0 90\""), Y, X);
    assert_turned(&site("eulerseq=\"ZYX\"", "euler=\"90 0 90\""), Z, -Y);
    let right = PI / 2.0;
    assert_turned(&site("angle=\"radian\"", &format!("euler=\"{right} 0 {right}\"")), Z, -Y);
}

#[test]
fn five_ways_give_the_same_orientation() {
    let ways = [
        "quat=\"2 0 2 0\"",
        "axisangle=\"0 3 0 90\"",
        // Of the second axis counts what is across the first.
        "xyaxes=\"0 0 -2 0 3 5\"",
        "zaxis=\"5 0 0\"",
        "euler=\"0 90 0\"",
    ];
    for orientation in ways {
        assert_turned(&site("", orientation), -Z, X);
    }
    assert_turned(&site("", "zaxis=\"0 0 -1\""), X, -Z);
}

#[test]
fn sizes_are_half_sizes_and_density_is_that_of_water() {
    let text = "<mujoco><worldbody><body><freejoint/><geom type=\"box\" size=\"0.1 0.2 0.3\"/></body>\
                </worldbody></mujoco>";
    let vehicle = read_vehicle("m.xml", text).expect("a vehicle");
    assert!((vehicle.robot.mass() - 1000.0 * 0.2 * 0.4 * 0.6).abs() < 1e-13);
    let ShapeKind::Box(edges) = vehicle.shapes[0].kind else { panic!("a box") };
    assert!((edges - vec3(0.2, 0.4, 0.6)).norm() < CLOSE);
    assert_eq!(vehicle.frames[0].name, "body1");
}

#[test]
fn moments_of_even_solids_are_those_of_the_textbook() {
    let box_ = "<geom type=\"box\" size=\"0.1 0.2 0.3\" mass=\"6\"/>";
    assert_inertia(box_, 6.0, [0.16 + 0.36, 0.04 + 0.36, 0.04 + 0.16].map(|sum| 6.0 / 12.0 * sum));
    assert_inertia("<geom size=\"0.5\" mass=\"2\"/>", 2.0, [0.4 * 2.0 * 0.25; 3]);
    let rod = "<geom type=\"cylinder\" size=\"0.2 0.6\" mass=\"3\"/>";
    let across = 3.0 * (3.0 * 0.04 + 1.44) / 12.0;
    assert_inertia(rod, 3.0, [across, across, 0.06]);
    let egg = "<geom type=\"ellipsoid\" size=\"1 2 3\" mass=\"5\"/>";
    assert_inertia(egg, 5.0, [13.0, 10.0, 5.0]);
    // Two half balls of 2/3 π kg and a cylinder of 2π kg, of unit radius, half length and density.
    let caps = 4.0 / 3.0 * PI;
    let across = 2.0 * PI * (3.0 + 4.0) / 12.0 + caps * (0.4 + 1.0 + 0.75);
    let capsule = "<geom type=\"capsule\" size=\"1 1\" density=\"1\"/>";
    let without = "<mujoco><worldbody><body><freejoint/>".to_owned() + capsule;
    let vehicle = read_vehicle("m.xml", without + "</body></worldbody></mujoco>").expect("one");
    let (m, _, I) = inertia(&vehicle);
    assert!((m - 10.0 / 3.0 * PI).abs() < 1e-14, "{m}");
    assert!((I.xx - across).abs() < 1e-13 && (I.zz - (PI + 0.4 * caps)).abs() < 1e-13, "{I:?}");
}

#[test]
fn from_to_lays_the_axis_and_puts_the_middle_between_the_ends() {
    let (_, p, I) =
        inertia(&read("", "<geom type=\"capsule\" size=\"0.1\" fromto=\"1 0 0 1 2 0\"/>"));
    assert!((p - vec3(1.0, 1.0, 0.0)).norm() < CLOSE);
    // The long axis lies along y.
    assert!(I.yy < 0.1 * I.xx && (I.xx - I.zz).abs() < CLOSE, "{I:?}");
}

#[test]
fn an_inertia_in_turned_axes_is_turned_into_those_of_the_body() {
    let inertial = "<inertial pos=\"0 0 1\" mass=\"2\" diaginertia=\"1 2 2.5\" euler=\"0 0 90\"/>";
    let (m, p, I) = inertia(&read("", inertial));
    assert!(m == 2.0 && (p - Z).norm() < CLOSE);
    assert!((I.xx - 2.0).abs() < CLOSE && (I.yy - 1.0).abs() < CLOSE && (I.zz - 2.5).abs() < CLOSE);
    let full = "<inertial pos=\"0 0 0\" mass=\"2\" fullinertia=\"1 2 2.5 0.1 0.2 0.3\"/>";
    let (_, _, I) = inertia(&read("", full));
    assert_eq!([I.xx, I.yy, I.zz, I.xy, I.xz, I.yz], [1.0, 2.0, 2.5, 0.1, 0.2, 0.3]);
}

#[test]
fn geoms_give_the_inertia_when_the_compiler_says_so() {
    let both =
        "<geom size=\"0.5\" mass=\"2\"/><inertial pos=\"0 0 0\" mass=\"7\" diaginertia=\"1 1 1\"/>";
    assert_eq!(read("", both).robot.mass(), 7.0);
    assert_eq!(read("inertiafromgeom=\"auto\"", both).robot.mass(), 7.0);
    assert_eq!(read("inertiafromgeom=\"false\"", both).robot.mass(), 7.0);
    assert_eq!(read("inertiafromgeom=\"true\"", both).robot.mass(), 2.0);
    let groups = "<geom size=\"0.5\" mass=\"2\"/><geom size=\"0.5\" mass=\"3\" group=\"4\"/>";
    assert_eq!(read("", groups).robot.mass(), 5.0);
    assert_eq!(read("inertiagrouprange=\"0 1\"", groups).robot.mass(), 2.0);
    assert_eq!(read("settotalmass=\"40\"", groups).robot.mass(), 40.0);
}

#[test]
fn a_class_says_what_an_element_does_not_and_a_nested_one_goes_first() {
    let text = "<mujoco><default><geom mass=\"3\" size=\"0.5\"/><default class=\"a\"><geom mass=\"4\"/>\
                <default class=\"b\"><geom size=\"0.2\"/></default></default></default><worldbody>\
                <body name=\"bus\"><freejoint/><geom/><body name=\"c\" childclass=\"a\"><joint/><geom/>\
                <body name=\"d\"><joint/><geom class=\"b\"/></body></body></body></worldbody></mujoco>";
    let vehicle = read_vehicle("m.xml", text).expect("a vehicle");
    let mass = |j| vehicle.robot.inertia(BodyId::Link(j)).mass;
    assert_eq!((vehicle.robot.inertia(BodyId::Base).mass, mass(0), mass(1)), (3.0, 4.0, 4.0));
    let I = vehicle.robot.inertia(BodyId::Link(1)).central();
    assert!((I.xx - 0.4 * 4.0 * 0.04).abs() < CLOSE);
    assert_eq!(vehicle.joint_names, ["joint1", "joint2"]);
}

/// A joint whose axis goes through a point of the body, at 30 deg where the file draws it.
#[test]
fn a_joint_turns_about_its_point_and_is_at_its_reference_as_the_file_draws_it() {
    let arm = "<geom size=\"1\"/><body name=\"arm\" pos=\"2 0 0\"><joint name=\"j\" pos=\"0.5 0 0\" \
               ref=\"30\" range=\"-90 60\"/><geom size=\"0.5\"/></body>";
    let vehicle = read("", arm);
    let zero = vehicle.robot.joint(0).X_PB_zero;
    assert!((zero.translation - vec3(2.5, 0.0, 0.0)).norm() < CLOSE);
    let back = zero.rotation * X;
    assert!((back - vec3(FRAC_PI_6.cos(), -FRAC_PI_6.sin(), 0.0)).norm() < CLOSE, "{back:?}");
    // The body's own frame is half a metre behind the axis, on the moving piece.
    let frame = vehicle.frame("arm").expect("the arm");
    assert_eq!(frame.body, BodyId::Link(0));
    assert!((frame.X_BF.translation - vec3(-0.5, 0.0, 0.0)).norm() < CLOSE);
    let (lower, upper) = vehicle.limits[0].travel.expect("limits");
    assert!((lower + PI / 2.0).abs() < CLOSE && (upper - PI / 3.0).abs() < CLOSE);
    let radians = read("angle=\"radian\"", &arm.replace("30", "0.1").replace("-90 60", "-1 1"));
    assert_eq!(radians.limits[0].travel, Some((-1.0, 1.0)));
    let off = read("autolimits=\"false\"", arm);
    assert_eq!(off.limits[0].travel, None);
}

#[test]
fn an_equality_of_joints_makes_one_follow_the_other_from_where_the_file_draws_both() {
    let arm = |name: &str, reference: f64| {
        format!(
            "<body name=\"{name}\"><joint name=\"{name}-j\" ref=\"{reference}\"/>\
             <geom size=\"0.5\"/></body>"
        )
    };
    let (lead, follow) = (arm("lead", 10.0), arm("follow", 30.0));
    let text = format!(
        "<mujoco><worldbody><body name=\"bus\"><geom size=\"1\"/>{lead}{follow}</body></worldbody>\
         <equality><joint joint1=\"follow-j\" joint2=\"lead-j\" polycoef=\"0.1 -2 0 0 0\"/>\
         </equality></mujoco>"
    );
    let vehicle = read_vehicle("m.xml", text).unwrap_or_else(|why| panic!("{why:#?}"));
    let [follower] = vehicle.followers[..] else { panic!("{:?}", vehicle.followers) };
    assert_eq!((follower.leader, follower.joint, follower.ratio), (0, 1, -2.0));
    // q - 30 deg = 0.1 - 2 (p - 10 deg).
    let offset = 50f64.to_radians() + 0.1;
    assert!((follower.offset - offset).abs() < 4.0 * CLOSE, "{follower:?}");
}

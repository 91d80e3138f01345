//! What is judged of a model after merging: points and frames, massless pieces, digits, orientations.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod mistakes;

use core::f64::consts::FRAC_1_SQRT_2;
use mistakes::told_of;
use wrasse_document::Severity;
use wrasse_vehicle::{Vehicle, read_vehicle};

const BUS: &str = r#"<link name="bus"><inertial><mass value="100"/>
<inertia ixx="10" iyy="11" izz="12" ixy="0" ixz="0" iyz="0"/></inertial></link>"#;
const BOOM: &str = r#"<link name="boom"><inertial><origin xyz="0.5 0 0"/><mass value="4"/>
<inertia ixx="0.01" iyy="0.4" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial></link>"#;

fn robot(content: &str) -> String {
    format!("<robot name=\"r\">{BUS}{content}</robot>")
}

/// A hinge about an axis, at a place.
fn hinge(name: &str, parent: &str, child: &str, axis: &str, place: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/><origin {place}/><axis xyz=\"{axis}\"/></joint>"
    )
}

fn fixed(parent: &str, child: &str) -> String {
    format!(
        "<joint name=\"to {child}\" type=\"fixed\"><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/><origin xyz=\"1 0 0\"/></joint>"
    )
}

fn link(name: &str, mass: f64, moments: [&str; 3]) -> String {
    let [xx, yy, zz] = moments;
    format!(
        "<link name=\"{name}\"><inertial><mass value=\"{mass}\"/><inertia ixx=\"{xx}\" iyy=\"{yy}\" \
         izz=\"{zz}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
    )
}

fn read(text: &str) -> Vehicle {
    read_vehicle("r.urdf", text).unwrap_or_else(|why| panic!("{why:#?}"))
}

/// Errors and warnings.
fn told(text: &str) -> Vec<(Severity, String)> {
    let all = told_of("r.urdf", text).into_iter();
    all.filter(|c| c.severity != Severity::Note).map(|c| (c.severity, c.message)).collect()
}

#[track_caller]
fn one(text: &str, severity: Severity, words: &str) {
    let all = told(text);
    let [(found, message)] = &all[..] else { panic!("not one: {all:#?}") };
    assert!(*found == severity && message.contains(words), "{all:#?}");
}

fn boom_on(place: &str) -> String {
    robot(&(BOOM.to_owned() + &hinge("yaw", "bus", "boom", "0 0 1", place)))
}

#[test]
fn a_point_fixed_to_a_boom_is_mass_of_the_boom() {
    let boom = BOOM.to_owned() + &hinge("yaw", "bus", "boom", "0 0 1", "xyz=\"0 0 0\"");
    let point = link("point", 0.5, ["0", "0", "0"]) + &fixed("boom", "point");
    let with_point = robot(&(boom + &point));
    assert_eq!(told(&with_point), []);
    let M = *read(&with_point).robot.inertia(wrasse_dynamics::BodyId::Link(0));
    // The boom's 0.4 + 4 × 0.5², and the point at 1 m.
    assert!((M.rotational.zz - (1.4 + 0.5)).abs() < 1e-15 && M.mass == 4.5, "{M:?}");
}

#[test]
fn a_point_that_a_hinge_turns_about_itself_is_singular_and_off_its_axis_is_not() {
    let point = |origin: &str| {
        let inertial = link("point", 0.5, ["0", "0", "0"])
            .replace("<inertial>", &format!("<inertial><origin xyz=\"{origin}\"/>"));
        robot(&(inertial + &hinge("yaw", "bus", "point", "0 0 1", "xyz=\"1 0 0\"")))
    };
    one(&point("0 0 0.3"), Severity::Error, "moves what has no inertia about its axis");
    assert_eq!(told(&point("0.3 0 0")), []);
}

#[test]
fn a_massless_piece_between_crossed_hinges_is_read_and_one_at_the_tip_is_not() {
    let cross = "<link name=\"cross\"/>".to_owned()
        + BOOM
        + &hinge("yaw", "bus", "cross", "0 0 1", "xyz=\"0.6 0 0\"")
        + &hinge("pitch", "cross", "boom", "0 1 0", "xyz=\"0 0 0\"");
    assert_eq!(told(&robot(&cross)), []);
    let tip = "<link name=\"cross\"/>".to_owned()
        + &hinge("yaw", "bus", "cross", "0 0 1", "xyz=\"0.6 0 0\"");
    one(&robot(&tip), Severity::Error, "neither 'cross' nor anything fixed to it has any");
}

/// A gimbal of three hinges: singular at a right angle of the middle one, unless its travel ends before.
#[test]
fn gimbal_lock_is_named_with_its_posture_and_a_shorter_travel_is_told_to_be_unproved() {
    let gimbal = |middle: &str| {
        robot(
            &("<link name=\"a\"/><link name=\"b\"/>".to_owned()
                + BOOM
                + &hinge("yaw", "bus", "a", "0 0 1", "xyz=\"0.6 0 0\"")
                + middle
                + &hinge("roll", "b", "boom", "1 0 0", "xyz=\"0 0 0\"")),
        )
    };
    let pitch = hinge("pitch", "a", "b", "0 1 0", "xyz=\"0 0 0\"");
    one(&gimbal(&pitch), Severity::Error, "singular at 'pitch' = -90 deg");
    let short = pitch.replace("continuous", "revolute").replace(
        "</joint>",
        "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>",
    );
    one(&gimbal(&short), Severity::Warning, "it is not proved for all");
}

#[test]
fn what_is_no_body_alone_may_be_a_part_of_one_and_is_told() {
    let boom = BOOM.to_owned() + &hinge("yaw", "bus", "boom", "0 0 1", "xyz=\"0 0 0\"");
    let part = link("part", 0.5, ["0.001", "0.001", "0.01"]);
    one(
        &robot(&(boom.clone() + &part + &fixed("boom", "part"))),
        Severity::Warning,
        "inertia of 'part' breaks the triangle inequality",
    );
    one(
        &robot(&(part + &hinge("yaw", "bus", "part", "0 0 1", "xyz=\"0 0 0\""))),
        Severity::Error,
        "inertia of 'part' breaks the triangle inequality",
    );
    let no_mass = link("part", 0.0, ["0.1", "0.1", "0.1"]);
    one(
        &robot(&(boom.clone() + &no_mass + &fixed("boom", "part"))),
        Severity::Warning,
        "'part' has an inertia and no mass",
    );
    one(
        &robot(&(no_mass + &hinge("yaw", "bus", "part", "0 0 1", "xyz=\"0 0 0\""))),
        Severity::Error,
        "mass of 'part' must be positive, found 0 kg",
    );
}

/// A panel 2 m × 1 m × 1 mm of 10 kg: 0.833334, 3.333334, 4.166667 kg·m².
#[test]
fn a_tensor_passes_to_the_digits_it_is_written_with_and_no_further() {
    let panel = |moments| {
        robot(
            &(link("panel", 10.0, moments)
                + &hinge("drive", "bus", "panel", "1 0 0", "xyz=\"1 0 0\"")),
        )
    };
    one(&panel(["0.8333", "3.3333", "4.1667"]), Severity::Warning, "within the digits");
    // The same excess of 0.0001 with a digit more is four times what rounding explains.
    one(&panel(["0.83330", "3.33330", "4.16670"]), Severity::Error, "triangle inequality");
    assert_eq!(told(&panel(["0.833334", "3.333334", "4.166667"])), []);
    one(&panel(["1", "3", "5"]), Severity::Error, "triangle inequality");
}

#[test]
fn a_quaternion_of_an_origin_turns_as_the_same_angles_do() {
    let rpy = read(&boom_on("rpy=\"0 0 1.5707963267948966\""));
    let half = FRAC_1_SQRT_2;
    let quaternion = read(&boom_on(&format!("quat_xyzw=\"0 0 {half} {half}\"")));
    let R_PB = |v: &Vehicle| v.robot.joint(0).X_PB_zero.rotation;
    let (a, b) = (R_PB(&rpy), R_PB(&quaternion));
    let off = (0..3).map(|i| (a.rows[i] - b.rows[i]).norm()).fold(0.0, f64::max);
    assert!(off < 1e-15, "measured 2.2e-16: {off:e}");
    one(&boom_on("quat_xyzw=\"0 0 1 1\""), Severity::Error, "must have length 1");
    one(&boom_on("quat_xyzw=\"0 0 1\""), Severity::Error, "must be 4 numbers, found 3");
    let both = boom_on("rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"");
    one(&both, Severity::Error, "both `rpy` and `quat_xyzw`");
}

#[test]
fn a_follower_that_its_leader_takes_beyond_its_travel_is_told() {
    let finger = |name: &str| BOOM.replace("boom", name);
    let joint = |name: &str, more: &str| {
        hinge(name, "bus", name, "0 0 1", "xyz=\"0 0 0\"")
            .replace("continuous", "revolute")
            .replace(
                "</joint>",
                &format!(
                    "<limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>{more}</joint>"
                ),
            )
    };
    let hand = |ratio: f64| {
        let mimic = format!("<mimic joint=\"left\" multiplier=\"{ratio}\"/>");
        robot(&(finger("left") + &finger("right") + &joint("left", "") + &joint("right", &mimic)))
    };
    assert_eq!(told(&hand(0.9)), []);
    one(&hand(1.1), Severity::Warning, "from 0 to 1.1, beyond its own travel from 0 to 1");
    let follower = read(&hand(0.9)).followers[0];
    assert_eq!((follower.joint, follower.leader, follower.ratio), (1, 0, 0.9));
}

//! What a user is told about an MJCF that is wrong: which complaint, where, and nothing besides.

mod mistakes;

use mistakes::{Mistake, each_alone_in, line, told_of, under_the_caret};
use wrasse_document::{Complaint, Severity};
use wrasse_vehicle::read_vehicle;

const ARM: &str = r#"<mujoco model="arm">
  <compiler angle="radian"/>
  <default>
    <default class="arm">
      <joint axis="0 0 1"/>
    </default>
  </default>
  <worldbody>
    <body name="bus">
      <freejoint/>
      <geom type="box" size="0.5 0.4 0.3" mass="100"/>
      <body name="upper" pos="0.5 0 0" childclass="arm">
        <joint name="shoulder" range="-2 2"/>
        <inertial pos="0.5 0 0" mass="5" diaginertia="0.01 0.42 0.425"/>
        <body name="lower" pos="1 0 0" euler="0 0 0.3">
          <joint name="elbow" axis="0 1 0"/>
          <geom type="capsule" size="0.04" fromto="0 0 0 0.8 0 0"/>
          <site name="tool" pos="0.8 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"#;

fn told(text: &str) -> Vec<Complaint> {
    told_of("arm.xml", text)
}

#[track_caller]
fn each_alone(severity: Severity, mistakes: &[Mistake]) {
    each_alone_in(("arm.xml", ARM), severity, mistakes);
}

#[test]
fn a_good_file_draws_no_complaint() {
    assert_eq!(told(ARM), []);
}

#[rustfmt::skip]
#[test]
fn each_number_that_cannot_be_is_told_at_its_place() {
    each_alone(Severity::Error, &[
        Mistake(r#"mass="5""#, r#"mass="-5""#, 14, "-5", "must be positive, found -5 kg"),
        Mistake(r#"mass="5""#, r#"mass="5,0""#, 14, "5,0", "decimal sign is a point"),
        Mistake(r#"mass="5" "#, "", 14, "inertial", "<inertial> has no attribute `mass`"),
        Mistake(r#"mass="5""#, r#"mass="5" quat="0 0 0 0""#, 14, "0 0 0 0", "`quat` of <inertial> gives no direction"),
        Mistake(r#"diaginertia="0.01 0.42 0.425""#, "", 14, "inertial", "neither `diaginertia` nor `fullinertia`"),
        Mistake("0.01 0.42 0.425", "0.01 0.42 0.5", 14, "0.01 0.42 0.5", "breaks the triangle inequality"),
        Mistake("0.01 0.42 0.425", "0.01 0.42", 14, "0.01 0.42", "must be three numbers, found 2"),
        Mistake(r#"diaginertia="0.01 0.42 0.425""#, r#"fullinertia="0.01 0.42 0.425 0 0 0" euler="1 0 0""#, 14, "1 0 0", "both `fullinertia` and `euler`"),
        Mistake("0.5 0.4 0.3", "0.5 0.4", 11, "0.5 0.4", "a box has 3 in `size`, found 2"),
        Mistake("0.5 0.4 0.3", "0.5 -0.4 0.3", 11, "0.5 -0.4 0.3", "a size of -0.4 m"),
        Mistake(r#"mass="100""#, r#"mass="-1""#, 11, "-1", "must not be negative, found -1 kg"),
        Mistake("0 0 0 0.8 0 0", "0 0 0 0 0 0", 17, "0 0 0 0 0 0", "the same point"),
        Mistake("0 0 0 0.8 0 0", "0 0 0", 17, "0 0 0", "must be 6 numbers, found 3"),
        Mistake(r#"type="capsule" size="0.04""#, r#"size="0.04""#, 17, "0 0 0 0.8 0 0", "a sphere has no ends"),
        Mistake(r#"size="0.04""#, r#"size="0.04" pos="1 0 0""#, 17, "0 0 0 0.8 0 0", "both `pos` and `fromto`"),
        Mistake(r#"axis="0 1 0""#, r#"axis="0 0 0""#, 16, "0 0 0", "is zero: it has no direction"),
        Mistake(r#"range="-2 2""#, r#"range="2 -2""#, 13, "2 -2", "reversed: lower 2, upper -2"),
        Mistake(r#"range="-2 2""#, r#"limited="true""#, 13, "joint", "limited=\"true\" and no `range`"),
        Mistake(r#"euler="0 0 0.3""#, r#"xyaxes="1 0 0 2 0 0""#, 15, "1 0 0 2 0 0", "gives no direction"),
        Mistake(r#"euler="0 0 0.3""#, r#"euler="0 0 0.3" zaxis="1 0 0""#, 15, "0 0 0.3", "its orientation in two ways"),
    ]);
}

#[rustfmt::skip]
#[test]
fn each_unknown_word_is_told_at_its_place_with_what_was_meant() {
    each_alone(Severity::Error, &[
        Mistake(r#"angle="radian""#, r#"angle="radians""#, 2, "radians", "did you mean \"radian\"?"),
        Mistake(r#"angle="radian""#, r#"angle="radian" eulerseq="xyw""#, 2, "xyw", "three of x, y, z"),
        Mistake(r#"angle="radian""#, r#"angle="radian" coordinate="global""#, 2, "global", "not supported"),
        Mistake(r#"childclass="arm""#, r#"childclass="amr""#, 12, "amr", "did you mean 'arm'?"),
        Mistake(r#"<joint name="elbow""#, r#"<joint class="wrist" name="elbow""#, 16, "wrist", "classes are arm, main"),
        Mistake(r#"type="capsule""#, r#"type="capsul""#, 17, "capsul", "did you mean \"capsule\"?"),
        Mistake("<inertial pos", "<inertial pso", 14, "pso", "did you mean `pos`?"),
        Mistake("<site name", "<sitee name", 18, "sitee", "did you mean <site>?"),
    ]);
}

#[rustfmt::skip]
#[test]
fn what_would_change_how_it_moves_and_is_not_modelled_is_refused() {
    each_alone(Severity::Error, &[
        Mistake("</worldbody>", "</worldbody><equality><joint joint1=\"elbow\" joint2=\"shoulder\" polycoef=\"0 1 2\"/></equality>", 22, "joint", "write active=\"false\""),
        Mistake("</worldbody>", "</worldbody><equality><joint joint1=\"elbow\"/></equality>", 22, "joint", "follows no other joint"),
        Mistake("</worldbody>", "</worldbody><equality><joint joint1=\"elbow\" joint2=\"shuolder\"/></equality>", 22, "shuolder", "did you mean 'shoulder'?"),
        Mistake("</worldbody>", "</worldbody><equality><connect body1=\"bus\" anchor=\"0 0 0\"/></equality>", 22, "connect", "couples what moves"),
        Mistake("</worldbody>", "</worldbody><deformable/>", 22, "deformable", "bodies are rigid"),
        Mistake("<site name", "<composite/><site name", 18, "composite", "bodies it makes are not written out"),
        Mistake("<site name", "<replicate count=\"2\"/><site name", 18, "replicate", "mj_saveLastXML"),
        Mistake(r#"<joint name="elbow""#, r#"<joint type="ball" name="elbow""#, 16, "ball", "write three hinges"),
        Mistake(r#"<joint name="elbow""#, r#"<joint type="free" name="elbow""#, 16, "free", "only the base floats"),
        Mistake("<freejoint/>", "<joint name=\"pole\"/>", 10, "pole", "holds the base 'bus' to the world"),
        Mistake(r#"type="capsule""#, r#"type="mesh" mesh="boom""#, 17, "geom", "and one of them is a mesh"),
        Mistake(r#"type="capsule""#, r#"type="ellipsoid" shellinertia="true""#, 17, "geom", "the shell of an ellipsoid"),
        Mistake("<worldbody>", "<worldbody><body name=\"moon\"/>", 9, "body", "the world holds 2 bodies: moon, bus"),
        Mistake(r#"<body name="lower" pos="1 0 0""#, r#"<body name="bus" pos="1 0 0""#, 15, "bus", "two bodies are called 'bus'; the other is on line 9"),
    ]);
}

#[rustfmt::skip]
#[test]
fn what_is_not_used_is_a_note_and_what_is_doubtful_a_warning() {
    each_alone(Severity::Note, &[
        Mistake(r#"name="shoulder""#, r#"name="shoulder" damping="1""#, 13, "damping", "no friction, no damping"),
        Mistake("<worldbody>", "<contact/><contact/><worldbody>", 8, "contact", "<contact> is not used (2 times)"),
        Mistake("</worldbody>", "</worldbody><actuator><motor joint=\"elbow\"/></actuator>", 22, "actuator", "its own drive"),
        Mistake("</worldbody>", "</worldbody><equality><weld active=\"false\" body1=\"bus\"/></equality>", 22, "weld", "switched off"),
        Mistake("<worldbody>", "<worldbody><body mocap=\"true\"/>", 8, "body", "a mocap body"),
        Mistake(r#"name="tool""#, r#"name="upper""#, 18, "upper", "a site with the name of a body"),
    ]);
    each_alone(Severity::Warning, &[
        Mistake("      <freejoint/>\n", "", 9, "bus", "'bus' is fixed to the world, but floats here"),
        Mistake(r#"axis="0 1 0""#, r#"axis="0 1 0" actuatorfrcrange="-3 5""#, 16, "-3 5", "read as 3"),
        Mistake(r#"range="-2 2""#, r#"range="-180 180""#, 13, "-180 180", "are the limits in degrees?"),
        Mistake("0.01 0.42 0.425\"/>", "0.01 0.42 0.425\"/><banana/>", 14, "banana", "holds no <banana>: not used"),
        Mistake(r#"angle="radian""#, r#"angle="radian" boundmass="4.5""#, 17, "geom", "raised to what <compiler> asks for"),
    ]);
}

#[test]
fn keys_have_as_many_numbers_as_the_model_has_positions() {
    let key = |qpos: &str| {
        let keys = format!("</worldbody><keyframe><key qpos=\"{qpos}\"/></keyframe>");
        read_vehicle("arm.xml", ARM.replace("</worldbody>", &keys))
    };
    let postures = key("0 0 0 1 0 0 0 0.1 0.2").expect("a vehicle").postures;
    assert_eq!((postures[0].name.as_str(), &postures[0].q[..]), ("key0", &[0.1, 0.2][..]));
    let complaints = key("0.1 0.2").expect_err("too few");
    assert_eq!(complaints[0].message, "`qpos` of <key> must be 9 numbers, found 2");
}

#[test]
fn a_complaint_about_an_included_file_points_into_that_file() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/mjcf/arm.xml");
    let read = |tag: &str| {
        let text = ARM.replace("<site name", &format!("{tag}<site name"));
        read_vehicle(folder, text).expect_err("mistakes")
    };
    let complaints = read("<geom type=\"bax\"/><include file=\"wrong_part.xml\"/>");
    let [first, second] = &complaints[..] else { panic!("{complaints:#?}") };
    assert_eq!((line(first), under_the_caret(first)), (18, "bax"));
    assert!(first.source.path.ends_with("arm.xml"));
    assert_eq!((line(second), under_the_caret(second)), (2, "five"));
    assert!(second.source.path.ends_with("wrong_part.xml"));
    for (tag, caret, message) in [
        ("<include file=\"none.xml\"/>", "none.xml", "cannot read the included"),
        ("<include/>", "include", "names no file"),
        ("<include file=\"/etc/hostname\"/>", "/etc/hostname", "is not included"),
        ("<include file=\"boom.xml\"/><include file=\"boom.xml\"/>", "boom.xml", "included twice"),
        ("<include file=\"boom.xml\"><geom/></include>", "include", "holds something"),
    ] {
        let complaints = read(tag);
        let [complaint] = &complaints[..] else { panic!("{tag}: {complaints:#?}") };
        assert!(complaint.message.contains(message), "{complaint:?}");
        assert_eq!(under_the_caret(complaint), caret);
    }
}

#[test]
fn the_root_of_a_file_says_which_xml_it_is() {
    assert!(read_vehicle("arm.mjcf", ARM).is_ok());
    let urdf = "<robot name=\"r\"><link name=\"b\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" \
                ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link></robot>";
    assert!(read_vehicle("arm.xml", urdf).is_ok());
    let help = |path: &str, text: &str| {
        let complaints = read_vehicle(path, text).expect_err("refused");
        complaints[0].help.clone().expect("a help")
    };
    assert!(help("arm.mjcf", urdf).contains("the ending .urdf"));
    assert!(help("arm.urdf", ARM).contains("the ending .mjcf"));
    for path in ["arm.mjcf", "arm.xml", "arm.urdf"] {
        assert!(help(path, "<sdf version='1.6'/>").contains("convert it to URDF or MJCF"));
    }
    assert!(help("arm.sdf", "").contains("convert SDF to URDF"));
    let not_closed = told("<mujoco>\n  <worldbody>\n</mujoco>");
    assert_eq!(line(&not_closed[0]), 3);
}

/// MuJoCo moves the frame of a body that floats and carries none, where it is told to.
#[test]
fn a_base_whose_frame_would_be_moved_is_refused_unless_it_carries_others() {
    let alone = |compiler: &str, align: &str, child: &str| {
        told(&format!(
            "<mujoco><compiler {compiler}/><worldbody><body name=\"b\"><freejoint{align}/>\
             <geom size=\"1\" pos=\"0.1 0 0\"/>{child}</body></worldbody></mujoco>"
        ))
        .len()
    };
    let child = "<body name=\"c\"><joint/><geom size=\"1\"/></body>";
    assert_eq!(alone("", "", ""), 0);
    assert_eq!(alone("", " align=\"true\"", ""), 1);
    assert_eq!(alone("alignfree=\"true\"", "", ""), 1);
    assert_eq!(alone("alignfree=\"true\"", " align=\"false\"", ""), 0);
    assert_eq!(alone("", " align=\"true\"", child), 0);
}

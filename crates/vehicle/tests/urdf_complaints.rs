//! What a user is told about a URDF that is wrong: which complaint, where, and nothing besides.

mod mistakes;

use mistakes::{Mistake, each_alone_in, line, told_of, under_the_caret};
use wrasse_document::{Complaint, Severity, render};
use wrasse_vehicle::{JOINTS, read_vehicle};

const ARM: &str = r#"<robot name="arm">
  <link name="bus">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 0 0.2"/>
      <mass value="100"/>
      <inertia ixx="20" ixy="0.5" ixz="0" iyy="22" iyz="0" izz="25"/>
    </inertial>
    <visual><geometry><box size="1 1 1"/></geometry></visual>
  </link>
  <link name="upper">
    <inertial>
      <origin xyz="0.5 0 0"/>
      <mass value="5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.42" iyz="0" izz="0.425"/>
    </inertial>
  </link>
  <link name="lower">
    <inertial>
      <mass value="4"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.33" iyz="0" izz="0.335"/>
    </inertial>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="bus"/>
    <child link="upper"/>
    <origin xyz="0.5 0 0"/>
    <axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="50" velocity="0.5"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="lower"/>
    <origin xyz="1 0 0"/>
    <axis xyz="0 1 0"/>
  </joint>
  <joint name="grip" type="fixed">
    <parent link="lower"/>
    <child link="tool"/>
    <origin xyz="0.8 0 0"/>
  </joint>
</robot>
"#;

fn told(text: &str) -> Vec<Complaint> {
    told_of("arm.urdf", text)
}

#[track_caller]
fn each_alone(severity: Severity, mistakes: &[Mistake]) {
    each_alone_in(("arm.urdf", ARM), severity, mistakes);
}

#[test]
fn a_good_file_draws_no_complaint() {
    assert_eq!(told(ARM), []);
}

#[rustfmt::skip]
#[test]
fn each_number_that_cannot_be_is_told_at_its_place() {
    each_alone(Severity::Error, &[
        Mistake(r#"value="5""#, r#"value="-5""#, 13, "-5", "must be positive, found -5 kg"),
        Mistake(r#"value="5""#, r#"value="0""#, 13, "0", "must be positive, found 0 kg"),
        Mistake(r#"value="5""#, r#"value="nan""#, 13, "nan", "'nan' is not finite"),
        Mistake(r#"value="5""#, r#"value="1e999""#, 13, "1e999", "'1e999' is not finite"),
        Mistake(r#"value="5""#, r#"value="5,0""#, 13, "5,0", "decimal sign is a point"),
        Mistake(r#"value="5""#, r#"value="five""#, 13, "five", "'five' is not a number"),
        Mistake(r#"value="5""#, r#"value="5 kg""#, 13, "5 kg", "must be one number, found 2"),
        Mistake(r#"value="5""#, r#"value="""#, 13, "", "an empty attribute `value`"),
        Mistake(r#"xyz="0.5 0 0"/>
      <mass"#, r#"xyz="0.5 0"/>
      <mass"#, 12, "0.5 0", "must be three numbers, found 2"),
        Mistake(r#"xyz="0.5 0 0"/>
      <mass"#, r#"xyz="0.5 O 0"/>
      <mass"#, 12, "O", "'O' is not a number"),
        Mistake(r#"ixx="0.01" ixy="0" ixz="0" iyy="0.42""#, r#"ixx="0.01" ixy="0" ixz="0" iyy="-0.42""#,
            14, "inertia", "not positive definite: its principal moments are -0.42, 0.01, 0.425 kg·m²"),
        Mistake(r#"izz="0.425""#, r#"izz="0.5""#, 14, "inertia",
            "of its principal moments 0.01, 0.42, 0.5 kg·m² the largest exceeds the sum of the others by 0.07 kg·m²"),
        Mistake(r#"ixy="0.5""#, r#"ixy="21""#, 6, "inertia", "not positive definite"),
        Mistake(r#"<axis xyz="0 0 1"/>"#, r#"<axis xyz="0 0 0"/>"#, 28, "0 0 0", "is zero"),
        Mistake(r#"lower="-2" upper="2""#, r#"lower="2" upper="-2""#, 29, "limit", "reversed: lower 2, upper -2"),
        Mistake(r#"effort="50""#, r#"effort="-50""#, 29, "limit", "effort limit of joint 'shoulder' is negative: -50"),
        Mistake(r#"velocity="0.5""#, r#"velocity="-0.5""#, 29, "limit", "rate limit of joint 'shoulder' is negative"),
        Mistake(r#"size="1 1 1""#, r#"size="1 1""#, 8, "1 1", "`size` of <box> must be three numbers"),
    ]);
}

#[rustfmt::skip]
#[test]
fn each_fault_of_the_tree_is_told_at_its_place() {
    each_alone(Severity::Error, &[
        Mistake(r#"<link name="tool"/>"#, r#"<link name="tool"/><link name="tool"/>"#, 23, "tool", "two links are called 'tool'; the other is on line 23"),
        Mistake(r#"<joint name="elbow""#, r#"<joint name="shoulder""#, 31, "shoulder", "two joints are called 'shoulder'; the other is on line 24"),
        Mistake(r#"<parent link="lower"/>"#, r#"<parent link="lowr"/>"#, 38, "lowr", "did you mean 'lower'?"),
        Mistake(r#"<child link="tool"/>"#, r#"<child link="gripper"/>"#, 39, "gripper", "links are 'bus', 'lower', 'tool', 'upper'"),
        Mistake(r#"<child link="tool"/>"#, r#"<child link="upper"/>"#, 39, "upper", "'upper' is the child of 'grip' and already of 'shoulder' on line 26"),
        Mistake(r#"<parent link="bus"/>"#, r#"<parent link="tool"/>"#, 25, "tool", "closes a loop"),
        Mistake(r#"<parent link="bus"/>"#, r#"<parent link="upper"/>"#, 25, "upper", "upper → upper"),
        Mistake("</robot>", "<link name=\"other\"/></robot>", 42, "other", "links 'bus' (line 2) and 'other' both have no parent"),
        Mistake(r#"<link name="tool"/>"#, r#"<link name="tool"/>
  <link name="world"/><joint name="x" type="floating"><parent link="tool"/><child link="world"/></joint>"#, 24, "floating", "only the base floats"),
        Mistake(r#"type="continuous""#, r#"type="planar""#, 31, "planar", "planar joints are not supported"),
        Mistake(r#"type="continuous""#, r#"type="continous""#, 31, "continous", "did you mean \"continuous\"?"),
        Mistake(r#"type="continuous""#, r#"type="helical""#, 31, "helical", "types are revolute, continuous"),
        Mistake(r#"type="continuous">"#, r#"type="continuous"><mimic joint="shoulderr"/>"#, 31, "shoulderr", "did you mean 'shoulder'?"),
        Mistake(r#"type="continuous">"#, r#"type="continuous"><mimic joint="elbow"/>"#, 31, "elbow", "joint 'elbow' follows itself"),
    ]);
}

#[rustfmt::skip]
#[test]
fn each_missing_or_misspelt_name_is_told_at_its_place() {
    each_alone(Severity::Error, &[
        Mistake(r#"<robot name="arm">"#, "<robot>", 1, "robot", "<robot> has no attribute `name`"),
        Mistake(r#"<mass value="4"/>"#, "<mass/>", 19, "mass", "<mass> has no attribute `value`"),
        Mistake(r#"<mass value="4"/>"#, r#"<mass vaule="4"/>"#, 19, "vaule", "did you mean `value`?"),
        Mistake(r#"<mass value="4"/>"#, "", 18, "inertial", "<inertial> has no <mass>"),
        Mistake(r#"<mass value="4"/>"#, r#"<mass value="4"/><mass value="5"/>"#, 19, "mass", "a second <mass>"),
        Mistake(r#"iyy="22""#, r#"iyx="22""#, 6, "iyx", "did you mean `iyy`?"),
        Mistake("<visual>", "<visal/><visual>", 8, "visal", "did you mean <visual>?"),
        Mistake(r#"<axis xyz="0 1 0"/>"#, r#"<axes xyz="0 1 0"/>"#, 35, "axes", "did you mean <axis>?"),
        Mistake(r#"<parent link="lower"/>"#, "<parent/>", 38, "parent", "<parent> has no attribute `link`"),
        Mistake(r#"<parent link="lower"/>"#, "", 37, "joint", "<joint> has no <parent>"),
        Mistake(r#"<child link="tool"/>"#, "", 37, "joint", "<joint> has no <child>"),
        Mistake(r#"<joint name="grip""#, "<joint", 37, "joint", "<joint> has no attribute `name`"),
    ]);
}

#[rustfmt::skip]
#[test]
fn what_is_implausible_or_unknown_is_a_warning_at_its_place() {
    each_alone(Severity::Warning, &[
        Mistake(r#"    <limit lower="-2" upper="2" effort="50" velocity="0.5"/>"#, "", 24, "joint", "'shoulder' has no <limit>: read as not limited"),
        Mistake(r#"lower="-2" upper="2" "#, "", 29, "limit", "no lower and no upper"),
        Mistake(r#" effort="50""#, "", 29, "limit", "has no effort: read as not limited"),
        Mistake(r#"effort="50""#, r#"effort="0""#, 29, "limit", "effort limit of joint 'shoulder' is 0"),
        Mistake(r#"lower="-2" upper="2""#, r#"lower="-180" upper="180""#, 29, "limit", "are the limits in degrees?"),
        Mistake(r#"lower="-2" upper="2""#, r#"lower="1" upper="1""#, 29, "limit", "has no travel"),
        Mistake(r#"rpy="0 0 0.2""#, r#"rpy="0 0 20""#, 4, "0 0 20", "angles are in radians"),
        Mistake(r#"xyz="0.5 0 0"/>
      <mass"#, r#"xyz="500 0 0"/>
      <mass"#, 10, "upper", "centre of mass of 'upper' is 500 m from its frame"),
        Mistake(r#"ixx="0.01" ixy="0" ixz="0" iyy="0.42" iyz="0" izz="0.425""#, r#"ixx="100" ixy="0" ixz="0" iyy="4200" iyz="0" izz="4250""#, 14, "inertia", "radius of gyration of 'upper' is 29.15 m"),
        Mistake(r#"ixx="0.01" ixy="0" ixz="0" iyy="0.42" iyz="0" izz="0.425""#, r#"ixx="1e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="4e-4""#, 14, "inertia", "denser than osmium"),
        Mistake(r#"<link name="tool"/>"#, r#"<link name="tool"/><banana/>"#, 23, "banana", "<robot> holds no <banana>: not used"),
        Mistake(r#"<link name="tool"/>"#, r#"<link name="tool" colour="red"/>"#, 23, "colour", "no attribute `colour`: not used"),
        Mistake(r#"<link name="tool"/>"#, r#"<link name="tool">gripper</link>"#, 23, "gripper", "text inside <link> is not used"),
    ]);
}

#[rustfmt::skip]
#[test]
fn what_is_known_and_not_used_is_a_note_with_its_count() {
    each_alone(Severity::Note, &[
        Mistake(r#"<axis xyz="0 1 0"/>"#, r#"<axis xyz="0 1 0"/><dynamics damping="1" friction="2"/>"#, 35, "dynamics", "joints are ideal: no friction, no damping"),
        Mistake("</robot>", "<gazebo/><gazebo/><gazebo reference=\"bus\"><mu1>1</mu1></gazebo></robot>", 42, "gazebo", "<gazebo> is not used (3 times)"),
        Mistake(r#"<box size="1 1 1"/>"#, r#"<mesh filename="bus.stl"/>"#, 8, "mesh", "<mesh> is not used"),
        Mistake(r#"<axis xyz="0 1 0"/>"#, r#"<axis xyz="0 1 0"/><limit lower="-1" effort="5" velocity="1"/>"#, 35, "-1", "travel limit of a continuous"),
    ]);
}

#[test]
fn a_file_with_ten_mistakes_draws_ten_complaints() {
    let mistakes = [
        (r#"rpy="0 0 0.2""#, r#"rpy="0 0""#, 4),
        (r#"ixy="0.5""#, r#"ixy="21""#, 6),
        (r#"value="5""#, r#"value="-5""#, 13),
        (r#"izz="0.425""#, r#"izz="0.5""#, 14),
        ("<mass value=\"4\"/>", "<mass valu=\"4\"/>", 19),
        (r#"<link name="tool"/>"#, r#"<link name="tool"/><link name="upper"/>"#, 23),
        (r#"<axis xyz="0 0 1"/>"#, r#"<axis xyz="0 0 0"/>"#, 28),
        (r#"lower="-2" upper="2""#, r#"lower="2" upper="-2""#, 29),
        (r#"type="continuous""#, r#"type="continous""#, 31),
        (r#"<child link="tool"/>"#, r#"<child link="tol"/>"#, 39),
    ];
    let text = mistakes.iter().fold(ARM.to_owned(), |text, (right, wrong, _)| {
        assert_eq!(text.matches(right).count(), 1, "{right}");
        text.replace(right, wrong)
    });
    let complaints = told(&text);
    let lines: Vec<_> = complaints.iter().map(line).collect();
    assert_eq!(lines, mistakes.map(|(_, _, line)| line), "{complaints:#?}");
    assert!(complaints.iter().all(|c| c.severity == Severity::Error));
}

#[test]
fn a_link_whose_mass_properties_are_all_zero_is_a_frame() {
    let zero = "<link name=\"tool\"><inertial><mass value=\"0\"/><inertia ixx=\"0\" ixy=\"0\" \
                ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>";
    let complaints = told(&ARM.replace("<link name=\"tool\"/>", zero));
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    assert_eq!(complaint.severity, Severity::Warning);
    assert_eq!(complaint.message, "mass and inertia are zero: read as a mere frame");
}

/// An ideal rod meets the triangle inequality with equality; rounding must not break it.
#[test]
fn a_thin_rod_is_possible_within_the_rounding_of_its_file() {
    let rod = |izz: &str| told(&ARM.replace("izz=\"0.425\"", &format!("izz=\"{izz}\"")));
    assert_eq!(rod("0.4300000001"), []);
    assert_eq!(rod("0.43000001").len(), 1);
}

#[test]
fn a_moving_body_without_mass_is_an_error() {
    let inertial = ARM.find("<inertial>\n      <mass value=\"4\"/>").expect("there");
    let end = inertial + ARM[inertial..].find("</inertial>").expect("there") + 11;
    let complaints = told(&[&ARM[..inertial], &ARM[end..]].concat());
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    assert!(complaint.message.contains("neither 'lower' nor anything fixed to it has any"));
    assert_eq!(under_the_caret(complaint), "lower");
}

#[test]
fn mass_on_a_tool_is_mass_of_the_body_that_it_is_fixed_to() {
    let inertial = ARM.find("<inertial>\n      <mass value=\"4\"/>").expect("there");
    let end = inertial + ARM[inertial..].find("</inertial>").expect("there") + 11;
    let moved = [&ARM[..inertial], &ARM[end..]].concat().replace(
        "<link name=\"tool\"/>",
        &format!("<link name=\"tool\">{}</link>", &ARM[inertial..end]),
    );
    assert_eq!(told(&moved), []);
}

#[test]
fn too_many_moving_joints_are_an_error_at_the_first_that_does_not_fit() {
    let mut more = String::new();
    let mut last = "tool".to_owned();
    let matter = "<inertial><mass value=\"1\"/><inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" \
                  iyy=\"0.01\" iyz=\"0\" izz=\"0.01\"/></inertial>";
    for k in 3..=JOINTS + 1 {
        more += &joined_to(&last, k, matter);
        last = format!("l{k}");
    }
    let complaints = told(&ARM.replace("</robot>", &(more + "</robot>")));
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    let many = format!("{} moving joints: a vehicle has at most {JOINTS}", JOINTS + 1);
    assert_eq!(complaint.message, many);
    assert_eq!(under_the_caret(complaint), format!("j{}", JOINTS + 1));
}

fn joined_to(parent: &str, k: usize, matter: &str) -> String {
    format!(
        "<link name=\"l{k}\">{matter}</link>\n<joint name=\"j{k}\" type=\"continuous\">\
         <parent link=\"{parent}\"/><child link=\"l{k}\"/></joint>\n"
    )
}

#[test]
fn a_base_that_floats_on_a_world_is_the_base() {
    let world = "<link name=\"world\"/><joint name=\"free\" type=\"floating\">\
                 <parent link=\"world\"/><child link=\"bus\"/></joint>\n</robot>";
    let text = ARM.replace("</robot>", world);
    let vehicle = read_vehicle("arm.urdf", text).expect("a vehicle");
    assert_eq!(vehicle.joint_names, ["shoulder", "elbow"]);
    assert_eq!(vehicle.frame("world"), None);
    let plain = read_vehicle("arm.urdf", ARM).expect("a vehicle");
    assert_eq!(vehicle.robot, plain.robot);
}

#[test]
fn a_base_that_stands_on_the_ground_is_warned_of() {
    let world = "<link name=\"world\"/><joint name=\"ground\" type=\"fixed\">\
                 <parent link=\"world\"/><child link=\"bus\"/></joint>\n</robot>";
    let complaints = told(&ARM.replace("</robot>", world));
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    assert_eq!(complaint.severity, Severity::Warning);
    assert!(complaint.message.contains("'bus' is fixed to 'world', but floats here"));
}

#[test]
fn a_xacro_file_is_refused_with_what_to_do() {
    let text = "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n  \
                <xacro:property name=\"l\" value=\"1\"/>\n</robot>";
    let complaints = told(text);
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    assert_eq!((line(complaint), under_the_caret(complaint)), (2, "xacro:property"));
    let says_what_to_do =
        |c: &Complaint| c.help.as_deref().is_some_and(|h| h.contains("expand it"));
    assert!(says_what_to_do(complaint));
    let undeclared = text.replace(" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"", "");
    assert!(says_what_to_do(&told(&undeclared)[0]));
}

#[test]
fn what_is_not_xml_is_told_where_it_ends_to_be() {
    let complaints = told("<robot name=\"ä\">\n  <link name='ü' &>\n</robot>");
    let [complaint] = &complaints[..] else { panic!("{complaints:#?}") };
    assert_eq!((line(complaint), under_the_caret(complaint)), (2, "&"));
    let complaints = told("<sdf version='1.6'/>");
    assert!(complaints[0].message.contains("expected <robot>, found <sdf>"));
    assert!(complaints[0].help.as_deref().is_some_and(|help| help.contains("SDF")));
}

#[test]
fn the_numbers_under_an_entity_are_read_and_told_as_a_whole() {
    assert_eq!(told(&ARM.replace("value=\"5\"", "value=\"&#53;\"")), []);
    let complaints = told(&ARM.replace("value=\"5\"", "value=\"&#53;x\""));
    assert_eq!(under_the_caret(&complaints[0]), "&#53;x");
}

#[test]
fn a_user_sees_each_mistake_with_its_line_its_caret_and_how_to_mend_it() {
    let text = include_str!("data/many_mistakes.urdf");
    let complaints = read_vehicle("many_mistakes.urdf", text).expect_err("mistakes");
    let shown = include_str!("data/many_mistakes_urdf.txt");
    assert_eq!(render(&complaints, false), shown);
}

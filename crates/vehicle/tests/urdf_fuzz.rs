//! No text makes the URDF reader panic, and a refusal always says why.

mod xml_fuzz;

use xml_fuzz::Format;

const SEEDS: &[&str] = &[
    include_str!("../../../validation/golden/atlas_class_200kg.urdf"),
    include_str!("../../../validation/golden/two_arms.urdf"),
    r#"<?xml version="1.0"?>
<robot name="ärm"><link name="world"/><joint name="f" type="floating"><parent link="world"/>
<child link="bus"/></joint><link name="bus"><inertial><mass value="3"/><inertia ixx="1" ixy="0"
ixz="0" iyy="1" iyz="0" izz="1"/></inertial><visual><origin rpy="0 0 1"/><geometry><sphere
radius="1"/></geometry></visual></link><joint name="g" type="fixed"><mimic joint="f"/><limit/>
<parent link="bus"/><child link="tip"/></joint><link name="tip"/><gazebo/></robot>"#,
];

/// Words that turn one valid file into another, or into a mistake that is nearly one.
const WORDS: &[&str] = &[
    "\"",
    "<",
    "/>",
    "</link>",
    "<link name=\"bus\">",
    "<joint",
    "name=\"link1\"",
    "type=\"fixed\"",
    "type=\"floating\"",
    "world",
    "xyz",
    "nan",
    "-inf",
    "1e308",
    "-1e-320",
    "0",
    "&#48;",
    "ä\u{301}",
    "<!--",
    "]]>",
    "xmlns:xacro=\"xacro\"",
    "<mimic/>",
    "<limit lower=\"3\"/>",
    "<child link=\"bus\"/>",
];

const URDF: Format = Format {
    file: "fuzz.urdf",
    seeds: SEEDS,
    words: WORDS,
    around: ("<robot name=\"r\">", "</robot>"),
    tags: &["link", "a"],
};

#[test]
fn arbitrary_text_never_panics() {
    URDF.survives_arbitrary_text();
}

#[test]
fn changed_files_never_panic() {
    URDF.survives_changes();
}

#[test]
fn exchanged_attributes_never_panic() {
    URDF.survives_exchanged_attributes();
}

#[test]
fn attributes_of_arbitrary_text_never_panic() {
    URDF.survives_attributes_of_arbitrary_text();
}

#[test]
fn deep_nesting_never_panics() {
    URDF.survives_deep_nesting();
}

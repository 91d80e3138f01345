//! No text makes the MJCF reader panic, and a refusal always says why.

mod xml_fuzz;

use xml_fuzz::Format;

const SEEDS: &[&str] = &[
    include_str!("data/mjcf/servicer.xml"),
    include_str!("data/mjcf/conventions.xml"),
    r#"<mujoco><compiler settotalmass="9" boundmass="1"/><default><default class="ä"><joint ref="3"/>
</default></default><worldbody><body name="bus"><freejoint/><geom size="1"/><frame euler="1 2 3">
<body childclass="ä"><joint type="slide" range="0 1"/><geom type="box" size="1 1 1" density="3"/>
</body></frame></body><body mocap="true"/></worldbody><keyframe><key qpos="1"/></keyframe></mujoco>"#,
];

/// Words that turn one valid file into another, or into a mistake that is nearly one.
const WORDS: &[&str] = &[
    "\"",
    "<",
    "/>",
    "</body>",
    "<body name=\"bus\">",
    "<joint type=\"ball\"/>",
    "<frame>",
    "<include file=\"x\"/>",
    "<inertial/>",
    "mass=\"-1\"",
    "fromto",
    "nan",
    "-inf",
    "1e308",
    "-1e-320",
    "0",
    "&#48;",
    "ä\u{301}",
    "<!--",
    "]]>",
    "class=\"arm\"",
    "<default>",
    "eulerseq=\"xyz\"",
    "<equality><weld/></equality>",
];

const MJCF: Format = Format {
    file: "fuzz.xml",
    seeds: SEEDS,
    words: WORDS,
    around: ("<mujoco><worldbody>", "</worldbody></mujoco>"),
    tags: &["body", "frame", "default", "a"],
};

#[test]
fn arbitrary_text_never_panics() {
    MJCF.survives_arbitrary_text();
}

#[test]
fn changed_files_never_panic() {
    MJCF.survives_changes();
}

#[test]
fn exchanged_attributes_never_panic() {
    MJCF.survives_exchanged_attributes();
}

#[test]
fn attributes_of_arbitrary_text_never_panic() {
    MJCF.survives_attributes_of_arbitrary_text();
}

#[test]
fn deep_nesting_never_panics() {
    MJCF.survives_deep_nesting();
}

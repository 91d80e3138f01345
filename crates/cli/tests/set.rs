//! `--set`: one value of a mission is another, and all that a run leaves behind says so.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, at};
use serde_json::Value;

const MISSION: &str = r#"
name = "small"
vehicle = "planar-two-link"
requirements = ["base.rotation.max <= 45 deg"]

[[phase]]
name = "bend"
move_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }

[[disperse]]
quantity = "initial.joints_deg.joint1"
sigma = 1.0
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.put("m.toml", MISSION);
    folder
}

fn summary(folder: &Folder, name: &str) -> Value {
    serde_json::from_slice(&folder.bytes(&format!("out/{name}/summary.json"))).unwrap()
}

#[test]
fn a_run_flies_what_is_set_and_says_so() {
    let folder = folder();
    let words = ["--set", "phase[bend].move_joints.duration_s=2.5", "--set=name=slow"];
    let said = folder.wrasse(&[&["run", "m.toml"], &words[..]].concat());
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    let whole = summary(&folder, "slow");
    let whence = &whole["provenance"];
    assert_eq!(whence["set"], serde_json::json!([words[1], "name=slow"]));
    assert_eq!(whence["mission"]["text"], MISSION, "the file is what it is");
    assert!(whence["command_line"].as_array().unwrap().contains(&words[1].into()));
    let report = String::from_utf8(folder.bytes("out/slow/report.html")).unwrap();
    let told = "m.toml, --set phase[bend].move_joints.duration_s=2.5, --set name=slow";
    assert!(report.contains(told));
}

#[test]
fn a_set_value_is_the_same_as_one_in_the_file() {
    let folder = folder();
    folder.put("other.toml", &MISSION.replace("duration_s = 1.0", "duration_s = 2"));
    let set = ["--set", "phase[0].move_joints.duration_s=2.0"];
    folder.wrasse(&[&["run", "m.toml", "--out", "out/a"], &set[..]].concat());
    folder.wrasse(&["run", "other.toml", "--out", "out/b"]);
    let [a, b] = ["a", "b"].map(|name| summary(&folder, name)["cases"].clone());
    assert_eq!(a, b);
}

#[test]
fn a_sweep_of_another_value_is_another_sweep() {
    let folder = folder();
    let sweep =
        |more: &[&str]| folder.wrasse(&[&["sweep", "m.toml", "--samples", "2"], more].concat());
    assert_eq!(sweep(&[]).code, 0);
    let said = sweep(&["--set", "phase[0].move_joints.duration_s=2"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("fingerprint"), "{}", said.err);
    // The same value, and a word, change nothing of what is flown.
    for same in ["phase[0].move_joints.duration_s=1", "summary=told anew"] {
        let said = sweep(&["--set", same]);
        assert_eq!(said.code, 0, "{}", said.err);
    }
    assert_eq!(summary(&folder, "small-sweep")["provenance"]["set"][0], "summary=told anew");
}

#[test]
fn a_study_is_of_what_is_set() {
    let folder = folder();
    let mission = at("missions/atlas-reach.toml");
    let set = ["--set", "name=light", "--set", "payload.module.mass_kg=20"];
    let said = folder.wrasse(&[&["size", &mission], &set[..]].concat());
    assert_eq!(said.code, 0, "{}", said.err);
    assert_eq!(folder.names("out"), ["light-size"]);
    let set = &summary(&folder, "light-size")["provenance"]["set"];
    assert_eq!(set[1], "payload.module.mass_kg=20");
    let report = String::from_utf8(folder.bytes("out/light-size/report.html")).unwrap();
    assert!(report.contains("--set payload.module.mass_kg=20"));
}

#[test]
fn what_was_flown_tells_a_set_value_from_one_of_the_file() {
    let folder = folder();
    let said = folder.wrasse(&["run", "m.toml", "--set", "world.step_s=0.001"]);
    assert_eq!(said.code, 0, "{}", said.err);
    let whole = summary(&folder, "small");
    let flown = whole["cases"][0]["as_flown"].as_array().unwrap().clone();
    let step = flown.iter().find(|row| row["key"] == "world.step_s").unwrap();
    assert_eq!((&step["value"], &step["origin"]), (&"0.001".into(), &"--set".into()));
}

#[test]
fn a_complaint_about_a_set_value_points_into_it() {
    let folder = folder();
    for (set, words) in [
        ("x", "an equals sign is missing"),
        ("phase[bend].move_joints.duratoin_s=2", "did you mean `duration_s`?"),
        ("world.step=0.1", "write `step_s`"),
        ("phase[bned].name=a", "did you mean phase[bend]?"),
        ("phase.bend.name=a", "`phase` is a list: say which of its values"),
        ("phase[7].name=a", "`phase` has 1 value(s), counted from zero"),
        ("name.first=a", "`name` is a string: nothing lies below it"),
        ("control.rate_hz=1 kHz", "a number stands alone: its key says the unit"),
        ("control.rate_hz=-1", "`rate_hz`"),
        ("requirements[0]=base.rotation.mx <= 1 deg", "did you mean base.rotation.max?"),
        ("vehicle=atlas-clas", "did you mean \"atlas-class\"?"),
    ] {
        for command in ["check", "run", "sweep", "size"] {
            let said = folder.wrasse(&[command, "m.toml", "--set", set]);
            assert_eq!((said.code, said.out.as_str()), (2, ""), "{command} {set}");
            assert!(said.err.contains(words), "{command} {set}:\n{}", said.err);
            assert!(said.err.contains("--> --set:1:"), "{command} {set}:\n{}", said.err);
            assert!(said.err.contains(&format!("1 | {set}\n")), "{command} {set}:\n{}", said.err);
        }
    }
    assert_eq!(folder.names(""), ["m.toml"]);
}

#[test]
fn a_set_value_that_a_compared_row_replaces_gets_a_warning() {
    let folder = Folder::new();
    let laws = at("missions/miss-distance/laws.toml");
    let said = folder.wrasse(&["check", &laws, "--set", "control.arm_law=terrestrial"]);
    assert_eq!(said.code, 0);
    assert!(said.err.contains("of [[compare]] replaces this value"), "{}", said.err);
    let said = folder.wrasse(&["check", &laws, "--set", "control.rate_hz=50"]);
    assert!(!said.err.contains("replaces this value"), "{}", said.err);
}

#[test]
fn nothing_is_set_of_a_vehicle() {
    let said = Folder::new().wrasse(&["check", &at("vehicles/ssrms.toml"), "--set", "name=x"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("a value can be set of a mission only"), "{}", said.err);
}

//! `wrasse size` as a user meets it: exit codes, files, words.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;
use serde_json::Value;

/// A second of one joint of the planar free-flyer, and two sets for it.
const SMALL: &str = r#"
name = "small"
vehicle = "planar-two-link"

[study]
claim = "Wheels suffice."
sets = "set"
reference = "ideal"

[world]
base_attitude = "held"

[control]
arm_law = "attitude-held"
task = "position"

[[phase]]
name = "bend"
move_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }

[[compare]]
axis = "set"

[[compare.row]]
name = "ideal"

[[compare.row]]
name = "wheels"
set.world.base_attitude = "controlled"
set.actuators.wheel = [
  { name = "x", model = "honeywell-hr16-100", axis = [1, 0, 0] },
  { name = "y", model = "honeywell-hr16-100", axis = [0, 1, 0] },
  { name = "z", model = "honeywell-hr16-100", axis = [0, 0, 1] },
]
"#;

fn with_study(text: &str) -> Folder {
    let folder = Folder::new();
    folder.put("study.toml", text);
    folder
}

#[test]
fn a_study_ends_with_0_and_leaves_a_report_and_a_summary() {
    let folder = with_study(SMALL);
    let said = folder.wrasse(&["size", "study.toml"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert_eq!(folder.names("out/small-size"), ["report.html", "summary.json"]);
    for word in ["wheels", "N·m·s", "claim: Wheels suffice.", "2 flights; their ledgers close"] {
        assert!(said.out.contains(word), "no `{word}` in\n{}", said.out);
    }
    assert!(said.out.trim_end().ends_with("report: out/small-size/report.html"), "{}", said.out);
}

#[test]
fn the_report_of_a_run_of_the_same_mission_is_left_alone() {
    let folder = with_study(SMALL);
    let said = folder.wrasse(&["run", "study.toml"]);
    assert_ne!(said.code, 2, "{}{}", said.out, said.err);
    let before = folder.bytes("out/small/report.html");
    let said = folder.wrasse(&["size", "study.toml"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert!(folder.bytes("out/small/report.html") == before, "it is another");
    assert_eq!(folder.names("out"), ["small", "small-size"]);
}

/// No set suffices: that is an answer.
#[test]
fn a_study_of_which_no_set_suffices_ends_with_0_too() {
    let folder = with_study(SMALL);
    let said = folder.wrasse(&["size", "study.toml", "--json", "--threads", "1", "--out", "here"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    let summary: Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(summary["tasks"][0]["verdicts"][1]["torque"], "no");
    assert_eq!(folder.names("here"), ["report.html", "summary.json"]);
}

#[test]
fn the_output_is_the_same_for_any_number_of_threads() {
    let folder = with_study(SMALL);
    let told = |threads| folder.wrasse(&["size", "study.toml", "--json", "--threads", threads]).out;
    assert_eq!(told("1"), told("4"));
}

#[test]
fn bad_input_ends_with_2_and_teaches() {
    let folder = with_study(&SMALL.replace("reference = \"ideal\"", "reference = \"idael\""));
    let said = folder.wrasse(&["size", "study.toml"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("did you mean \"ideal\"?"), "{}", said.err);
    let none = folder.wrasse(&["size", "nothing.toml"]);
    assert!(none.code == 2 && none.err.contains("nothing.toml"), "{}", none.err);
    assert_eq!(folder.names(""), ["study.toml"]);
}

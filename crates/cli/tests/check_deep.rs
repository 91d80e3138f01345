//! `wrasse check --deep` and `--json`: what is printed, and the exit codes.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, Said};
use serde_json::Value;
use std::path::Path;

/// A rod drawn along x whose small moment is about z, and a cube of 0.1 m and 0.5 kg with 2 kg·m².
const SHAPES: &str = r#"<robot name="shapes">
  <link name="bus"><inertial><mass value="100"/>
    <inertia ixx="10" iyy="11" izz="12" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="rod">
    <inertial><origin xyz="0.5 0 0"/><mass value="2"/>
      <inertia ixx="0.17" iyy="0.17" izz="0.004" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><origin xyz="0.5 0 0" rpy="0 1.5708 0"/>
      <geometry><cylinder radius="0.03" length="1"/></geometry></visual></link>
  <link name="cube"><inertial><mass value="0.5"/>
    <inertia ixx="2" iyy="2" izz="2" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <joint name="j1" type="continuous"><parent link="bus"/><child link="rod"/>
    <origin xyz="0.5 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="j2" type="continuous"><parent link="rod"/><child link="cube"/>
    <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.put("shapes.urdf", SHAPES);
    folder
}

#[track_caller]
fn objects(said: &Said) -> Vec<Value> {
    said.out.lines().map(|line| serde_json::from_str(line).expect("an object a line")).collect()
}

#[test]
fn blatant_contradictions_of_shape_and_inertia_are_warned_of_in_every_reading() {
    let said = folder().wrasse(&["check", "shapes.urdf"]);
    assert_eq!(said.code, 0);
    assert!(said.err.contains("the inertia of 'rod' lies across its shape"), "{}", said.err);
    assert!(said.err.contains("the inertia of 'cube' is beyond its shape"), "{}", said.err);
    assert!(said.err.contains("2 warnings"), "{}", said.err);
    assert!(!said.out.contains("deep check"), "{}", said.out);
}

#[test]
fn the_report_of_a_deep_check_fits_a_terminal_and_does_not_change_the_exit_code() {
    let said = folder().wrasse(&["check", "shapes.urdf", "--deep"]);
    assert_eq!(said.code, 0);
    let long = said.out.lines().find(|line| line.chars().count() > 80);
    assert_eq!(long, None);
    assert!(said.out.contains("deep check: 2 findings"), "{}", said.out);
    assert!(said.out.contains("warning: cube (shapes.urdf:10)"), "{}", said.out);
    assert!(said.out.contains("energy and momentum of a coast: energy drifts"), "{}", said.out);
}

#[test]
fn json_tells_complaints_and_findings_with_their_places() {
    let folder = folder();
    let said = folder.wrasse(&["check", "shapes.urdf", "--deep", "--json"]);
    assert_eq!((said.code, &*said.err), (0, ""));
    let [object] = &objects(&said)[..] else { panic!("{}", said.out) };
    assert_eq!(object["usable"], true);
    let complaints = object["complaints"].as_array().expect("a list");
    assert_eq!(complaints.len(), 2);
    assert_eq!(
        (&complaints[0]["severity"], &complaints[0]["line"]),
        (&"warning".into(), &6.into())
    );
    assert_eq!(complaints[0]["column"], 8);
    let findings = object["findings"].as_array().expect("a list");
    let kinds: Vec<_> = findings.iter().map(|found| found["kind"].as_str()).collect();
    assert_eq!(kinds, [Some("unit_slip"), Some("inertia_across_shape")]);
    for found in findings {
        for key in ["severity", "subject", "message", "why", "file", "line", "column", "numbers"] {
            assert!(!found[key].is_null(), "{key}: {found}");
        }
    }
    assert_eq!(findings[1]["numbers"]["angle_deg"].as_f64().map(f64::round), Some(90.0));
    let drift = object["fine"].as_array().and_then(|fine| fine.last()).expect("the coast");
    assert_eq!((&drift["kind"], &drift["numbers"]["seed"]), (&"coast_drift".into(), &1.0.into()));
    // Without --deep there are no findings to tell.
    let plain = objects(&folder.wrasse(&["check", "shapes.urdf", "--json"]));
    assert_eq!(plain[0]["complaints"], object["complaints"]);
    assert!(plain[0].get("findings").is_none());
}

#[test]
fn json_has_a_line_for_each_file_and_unusable_ones_end_with_2() {
    let folder = folder();
    folder.put("broken.toml", "name = 3\n");
    folder.put("mission.toml", "vehicle = 'atlas-class'\n");
    let files = ["shapes.urdf", "broken.toml", "missing.urdf", "mission.toml"];
    let said = folder.wrasse(&[&["check", "--json", "--deep"][..], &files].concat());
    assert_eq!((said.code, &*said.err), (2, ""));
    let objects = objects(&said);
    let usable: Vec<_> = objects.iter().map(|object| object["usable"].as_bool()).collect();
    assert_eq!(usable, [Some(true), Some(false), Some(false), Some(false)]);
    for (object, file) in objects.iter().zip(files) {
        assert_eq!(object["file"], file);
        let errors = object["complaints"].as_array().expect("a list").iter();
        let any_error = errors.into_iter().any(|complaint| complaint["severity"] == "error");
        assert_eq!(any_error, object["usable"] == false, "{object}");
    }
}

#[test]
fn a_deep_check_of_a_mission_says_that_it_is_of_vehicles() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mission = root.join("missions/atlas-reach.toml");
    let said = Folder::new().wrasse(&["check", &mission.to_string_lossy(), "--deep"]);
    assert_eq!(said.code, 0);
    assert!(said.out.contains("deep check: only of vehicle files"), "{}", said.out);
}

/// The page shows the example's files as they are, and what is printed of them but for the round-off of
/// the coast's drifts.
#[test]
fn the_guide_shows_what_is_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = std::fs::read_to_string(root.join("book/src/guide/checking_a_model.md")).unwrap();
    let block = |language: &str| {
        let after = page.split(&format!("```{language}\n")).nth(1).expect("a block");
        after.split("```").next().expect("its end").to_owned()
    };
    let folder = Folder::new();
    folder.put("shapes.urdf", &block("xml"));
    let said = folder.wrasse(&["check", "shapes.urdf", "--deep"]);
    assert_eq!(said.code, 0);
    let but_coast = |text: &str| text.split("  energy and momentum").next().map(str::to_owned);
    assert_eq!(but_coast(&block("text")), but_coast(&said.out));
    let json = folder.wrasse(&["check", "shapes.urdf", "--deep", "--json"]);
    let shown: Value = serde_json::from_str(&block("json")).expect("JSON");
    assert_eq!(shown, objects(&json)[0]["findings"][0]);
}

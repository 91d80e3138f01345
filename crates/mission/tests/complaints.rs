//! What a user reads when a mission says what cannot be.

use wrasse_document::{Complaint, render};
use wrasse_mission::read_mission;

/// A small mission without mistakes.
const GOOD: &str = r#"name = "small"
vehicle = "planar-two-link"
requirements = [
    "base.rotation.max <= 45 deg during bend once",
]

[[phase]]
name = "bend once"
move_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }
"#;

fn complaints(file: &str, text: &str) -> Vec<Complaint> {
    match read_mission(file, text) {
        Ok(mission) => panic!("{} was read without complaint", mission.name),
        Err(complaints) => complaints,
    }
}

/// GOOD with `from` replaced by `to` gives one error, which says all these words.
#[track_caller]
fn assert_says(from: &str, to: &str, words: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must be there once");
    let said = render(&complaints("small.toml", &GOOD.replace(from, to)), false);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with("\n1 error\n"), "not one error:\n{said}");
}

/// Complaints are what the file beside the mission holds, and each has its place.
#[track_caller]
fn assert_all(file: &str, text: &str, expected: &str) {
    let complaints = complaints(file, text);
    let said = render(&complaints, false);
    assert!(said == expected, "{file} is answered by\n{said}");
    for complaint in &complaints {
        let span = complaint.span.clone().unwrap_or_else(|| panic!("{} where?", complaint.message));
        assert!(text.get(span).is_some_and(|there| !there.is_empty()), "{}", complaint.message);
    }
}

#[test]
fn a_mission_without_mistakes_is_read() {
    let mission =
        read_mission("small.toml", GOOD).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    assert_eq!((mission.name.as_str(), mission.cases.len()), ("small", 1));
}

#[test]
fn all_mistakes_of_shape_are_reported_at_once() {
    let text = include_str!("data/misshapen.toml");
    assert_all("misshapen.toml", text, include_str!("data/misshapen.txt"));
}

#[test]
fn all_mistakes_of_meaning_are_reported_at_once() {
    let text = include_str!("data/many_mistakes.toml");
    assert_all("many_mistakes.toml", text, include_str!("data/many_mistakes.txt"));
}

#[test]
fn a_mistake_of_shape_does_not_hide_one_of_meaning() {
    let text = GOOD.replace("vehicle =", "summry = \"\"\nvehicle =").replace("45 deg", "45 lb");
    let said = render(&complaints("small.toml", &text), false);
    assert!(said.contains("`summry`") && said.contains("lb is no unit"), "{said}");
    assert!(said.ends_with("\n2 errors\n"), "{said}");
}

#[test]
fn a_vehicle_that_is_not_there_is_named() {
    let words = ["small.toml:2:11", "\"planar-twolink\"", "did you mean \"planar-two-link\"?"];
    assert_says("planar-two-link", "planar-twolink", &words);
    let words = ["small.toml:2:11", "cannot read the vehicle file mine/bus.toml"];
    assert_says("planar-two-link", "mine/bus.toml", &words);
}

#[test]
fn a_tool_that_no_joint_moves_is_refused() {
    let words = ["small.toml:8:8", "base is fixed to the base: no joint moves it", "tool: tool"];
    assert_says("[[phase]]", "[control]\ntool = \"base\"\n\n[[phase]]", &words);
}

#[test]
fn a_text_that_is_not_toml_is_answered_with_its_place() {
    assert_says("duration_s = 1.0", "duration_s = 1 s", &["not TOML", "small.toml:9"]);
}

#[test]
fn an_empty_file_lacks_what_every_mission_has() {
    let said = render(&complaints("empty.toml", ""), false);
    for key in ["`name`", "`vehicle`"] {
        assert!(said.contains(&format!("has no {key}")), "{said}");
    }
}

#[test]
fn a_mission_has_phases_and_no_more_than_fit() {
    let at = GOOD.find("[[phase]]").expect("it has a phase");
    let said = |text: &str| render(&complaints("small.toml", text), false);
    let none = said(&GOOD[..at].replace(" during bend once", ""));
    assert!(none.contains("a mission without phases"), "{none}");
    let phase = |i| format!("[[phase]]\nname = \"{i}\"\nhold = {{ duration_s = 1.0 }}\n");
    let many: String = (0..32).map(phase).collect();
    let many = said(&[GOOD, &many].concat());
    assert!(many.contains("33 phases, at most 32 fit"), "{many}");
}

#[test]
fn a_comparison_of_too_many_cases_is_refused() {
    let rows: Vec<String> = (0..32).map(|i| format!("{{ name = \"{i}\" }}")).collect();
    let axis =
        |name: &str| format!("[[compare]]\naxis = \"{name}\"\nrow = [{}]\n", rows.join(", "));
    let text = [GOOD, &axis("a"), &axis("b")].concat();
    let said = render(&complaints("small.toml", &text), false);
    assert!(said.contains("1024 cases, at most 1000 can be compared"), "{said}");
}

#[test]
fn a_mistake_in_what_rows_share_is_said_once() {
    let rows = "[[compare]]\naxis = \"a\"\nrow = [{ name = \"1\" }, { name = \"2\" }]\n";
    let text = [&GOOD.replace("45 deg", "45 lb"), rows].concat();
    let said = render(&complaints("small.toml", &text), false);
    assert!(said.ends_with("\n1 error\n"), "{said}");
}

#[test]
fn a_number_that_would_take_for_ever_is_refused() {
    assert_says(
        "duration_s = 1.0",
        "duration_s = 1e9",
        &["1000000000 s at 100 control", "at most 864000 s"],
    );
    assert_says(
        "[[phase]]\nname = \"bend once\"\nmove_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }",
        "[control]\nrate_hz = 10000\n[[phase]]\nname = \"bend once\"\nhold = { duration_s = 9000 }",
        &["9000 s at 10000 control periods per second", "at most 8640 s"],
    );
    let world = |line: &str| format!("{line}\n\n[[phase]]");
    assert_says("[[phase]]", &world("[world]\nstep_s = 1e-12"), &["`step_s`", "0.000001"]);
    assert_says("[[phase]]", &world("[control]\nrate_hz = 1e12"), &["`rate_hz`", "10000"]);
    let tolerance = world("[world]\nadaptive_tolerance = 1e-30");
    assert_says("[[phase]]", &tolerance, &["`adaptive_tolerance`", "rounding"]);
}

#[test]
fn a_requirement_is_marked_where_it_is_wrong_and_not_where_the_same_letters_stand_first() {
    // The unit "s" stands in "base", too.
    assert_says(
        "45 deg during",
        "45 s during",
        &["s is no unit of base.rotation", "small.toml:4:30"],
    );
    assert_says(
        "bend once\",",
        "bend\",",
        &["there is no phase called \"bend\"", "small.toml:4:41"],
    );
}

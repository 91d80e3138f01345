//! Defaults decide the physics: each is said.

use std::path::Path;
use wrasse_mission::{Mission, mission_schema, read_mission};
use wrasse_rehearsal::{RunOptions, run_case};

fn read(text: &str) -> Mission {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/test.toml");
    read_mission(file, text)
        .unwrap_or_else(|complaints| panic!("{}", wrasse_document::render(&complaints, false)))
}

const SHORT: &str = r#"
name = "short"
vehicle = "atlas-class"
[initial]
posture = "forward_300mm"
WORLD
[[phase]]
name = "p"
move_tool = { by_m = [0.01, 0.0, 0.0], duration_s = 1.0 }
"#;

/// Settings as flown: (key, value, origin).
fn as_flown(world: &str) -> Vec<(String, String, &'static str)> {
    let mission = read(&SHORT.replace("WORLD", world));
    let case = run_case(&mission.cases[0], RunOptions::default(), &mut |_, _| {});
    case.as_flown.into_iter().map(|s| (s.key, s.value, s.origin)).collect()
}

#[track_caller]
fn find(settings: &[(String, String, &'static str)], key: &str) -> (String, &'static str) {
    let found = settings.iter().find(|(name, ..)| name == key);
    let (_, value, origin) = found.unwrap_or_else(|| panic!("no {key} in {settings:?}"));
    (value.clone(), origin)
}

#[test]
fn what_a_mission_leaves_unsaid_stands_in_its_outcome() {
    let settings = as_flown("");
    for (key, value) in [
        ("world.base_attitude", "free"),
        ("world.joints", "prescribed"),
        ("world.step_s", "0.005"),
        ("control.arm_law", "free-floating"),
        ("control.rate_hz", "100.0"),
        ("control.measurement", "base"),
        ("control.task", "pose"),
        ("control.tool_gain_per_s", "2.0"),
        ("control.actuators", "none: the base floats"),
        ("control.sensing", "perfect"),
        ("control.redundancy", "none: joint rates of least norm"),
    ] {
        assert_eq!(find(&settings, key), (value.to_owned(), "default"), "{key}");
    }
    // Nothing reads these in such a flight.
    for key in ["control.attitude_bandwidth_rad_s", "control.joint_bandwidth_rad_s"] {
        assert!(settings.iter().all(|(name, ..)| name != key), "{key}");
    }
}

#[test]
fn what_a_mission_says_is_told_from_its_defaults() {
    let settings = as_flown(
        "[world]\nbase_attitude = \"controlled\"\njoints = \"torque\"\n[control]\nrate_hz = 200",
    );
    assert_eq!(find(&settings, "control.rate_hz"), ("200.0".into(), "mission file"));
    assert_eq!(find(&settings, "world.joints"), ("torque".into(), "mission file"));
    assert_eq!(find(&settings, "control.joint_bandwidth_rad_s"), ("10.0".into(), "default"));
    let ideal = "ideal, 236 N·m, 236 N·m·s".to_owned();
    assert_eq!(find(&settings, "control.actuators"), (ideal, "default"));
}

/// The default of each key stands in the schema, and the guide's table of defaults is made of it.
#[test]
fn the_guide_states_the_defaults_of_the_schema() {
    let schema = mission_schema();
    let mut rows = vec![];
    for (table, definition) in [
        ("world", "WorldFile"),
        ("control", "ControlFile"),
        ("control.steering", "SteeringFile"),
        ("control.steering.modulation", "ModulationFile"),
        ("control.estimation", "EstimationFile"),
        ("output", "OutputFile"),
    ] {
        let properties = schema["$defs"][definition]["properties"].as_object().expect("a table");
        for (key, property) in properties {
            let default = property.get("default").unwrap_or_else(|| panic!("{table}.{key}"));
            if !default.is_object() {
                rows.push(format!("| `{table}.{key}` | {} |", shown(default)));
            }
        }
    }
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/guide/defaults.md");
    let page = std::fs::read_to_string(page).expect("the page is there");
    let found: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    let stated: Vec<String> = found
        .iter()
        .map(|line| line.splitn(4, '|').take(3).collect::<Vec<_>>().join("|") + "|")
        .collect();
    let wanted: Vec<String> = rows.iter().map(|row| row.trim_end_matches(' ').to_owned()).collect();
    assert_eq!(stated, wanted, "the table should begin\n{}", wanted.join("\n"));
    assert!(
        found.iter().all(|line| line.split('|').nth(3).is_some_and(|what| what.trim().len() > 8))
    );
}

fn shown(default: &serde_json::Value) -> String {
    match default {
        serde_json::Value::Null => "none".into(),
        serde_json::Value::String(word) => format!("`{word}`"),
        other => other.to_string(),
    }
}

#[test]
fn fitted_units_that_do_nothing_are_remarked_on() {
    let units = "[actuators]\nname = \"g\"\n[[actuators.cmg_array]]\nname = \"g\"\n\
                 model = \"airbus-cmg-15-45s\"\narrangement = \"pyramid\"\nskew_deg = 53.13\n";
    let remarks = |text: &str| -> Vec<String> {
        read(&SHORT.replace("WORLD", text)).remarks.iter().map(|c| c.message.clone()).collect()
    };
    let says = |text: &str, words: &str| {
        let all = remarks(text);
        assert!(all.iter().any(|r| r.contains(words)), "{all:?}");
    };
    says(units, "fitted and do nothing: the base floats, by default");
    let held = format!("[world]\nbase_attitude = \"held\"\n{units}");
    says(&held, "fitted and do nothing: the base is held from outside;");
    let unlimited = format!(
        "[world]\nbase_attitude = \"controlled\"\n[control]\nactuators = \"unlimited\"\n{units}"
    );
    says(&unlimited, "an ideal actuator turns the base");
    let used = format!("[world]\nbase_attitude = \"controlled\"\n{units}");
    assert!(remarks(&used).iter().all(|r| !r.contains("do nothing")));
}

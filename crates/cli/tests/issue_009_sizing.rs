//! Sizing left the vehicle's own units and the catalogue out, and `check` did not read `[study]`.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;
use serde_json::Value;

/// A second of one joint of the planar free-flyer with the smallest wheels and a tank.
const OWN: &str = r#"
name = "own"
vehicle = "planar-two-link"

[world]
base_attitude = "controlled"

[control]
arm_law = "attitude-held"
task = "position"

[[phase]]
name = "bend"
move_joints = { to_deg = { joint1 = 2.0 }, duration_s = 20.0 }

[[actuators.wheel]]
name = "x"
model = "honeywell-hr12-12"
axis = [1, 0, 0]
[[actuators.wheel]]
name = "y"
model = "honeywell-hr12-12"
axis = [0, 1, 0]
[[actuators.wheel]]
name = "z"
model = "honeywell-hr12-12"
axis = [0, 0, 1]
[actuators.tank]
propellant_kg = 5
position_m = [0, 0, 0]
"#;

fn summary(text: &str, more: &[&str]) -> (Value, String) {
    let folder = Folder::new();
    folder.put("mission.toml", text);
    let said = folder.wrasse(&[&["size", "mission.toml", "--json"], more].concat());
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    (serde_json::from_str(&said.out).unwrap(), said.err)
}

fn sets(summary: &Value) -> Vec<String> {
    let all = summary["sets"].as_array().unwrap();
    all.iter().map(|set| set["name"].as_str().unwrap().to_owned()).collect()
}

fn finding<'a>(summary: &'a Value, about: &str) -> &'a str {
    let all = summary["findings"].as_array().unwrap();
    let found = all.iter().find(|finding| finding["about"] == about);
    found.map_or("", |finding| finding["text"].as_str().unwrap())
}

#[test]
fn what_a_vehicle_has_is_weighed_as_fitted_and_every_set_has_its_tank() {
    let (summary, _) = summary(OWN, &[]);
    assert_eq!(sets(&summary)[..2], ["ideal", "as fitted"]);
    let fitted = &summary["sets"][1];
    assert_eq!((fitted["kind"].as_str(), fitted["mass_kg"].as_f64()), (Some("wheels"), Some(18.0)));
    assert!(summary["tasks"][0]["verdicts"][1]["flown"].is_object());
    for set in &summary["sets"].as_array().unwrap()[1..] {
        assert_eq!(set["propellant_kg"], 5.0, "{set}");
    }
    let told = finding(&summary, "lightest");
    assert!(told.starts_with("For the task the lightest set that suffices: "), "{told}");
}

#[test]
fn the_catalogue_is_weighed_kind_by_kind() {
    let (summary, _) = summary(OWN, &["--catalogue", "cmgs,wheels"]);
    let names = sets(&summary);
    assert_eq!(names[..2], ["ideal", "as fitted"]);
    let told = finding(&summary, "left out");
    for unit in wrasse_vehicle::hardware() {
        let of_kind = ["reaction wheel", "control moment gyro"].contains(&unit.kind);
        let name = format!("4 x {}", unit.name);
        let there = names.iter().any(|set| set.starts_with(&name)) || told.contains(&name);
        assert_eq!(there, of_kind, "{name}: {names:?} {told}");
    }
    let masses = summary["sets"].as_array().unwrap().iter().filter(|s| s["mass_kg"].is_f64());
    assert!(masses.count() > 5, "{names:?}");
}

/// No units: the ideal actuator of the vehicle within its limits, or nothing.
#[test]
fn a_vehicle_without_units_has_a_row_as_fitted_too() {
    let bare = OWN.split("[[actuators").next().unwrap().replace("controlled", "held");
    let (planar, _) = summary(&bare, &[]);
    assert_eq!(
        (sets(&planar)[1].as_str(), planar["sets"][1]["kind"].as_str()),
        ("as fitted", Some("nothing"))
    );
    assert_eq!(planar["tasks"][0]["verdicts"][1]["suffices"], "no");
    let atlas = bare.replace("planar-two-link", "atlas-class");
    let (atlas, _) = summary(&atlas, &["--catalogue", "cmgs"]);
    assert_eq!(atlas["sets"][1]["kind"], "actuator");
    assert_eq!(atlas["sets"][1]["torque_nm"][0]["plain"], 236.0);
}

#[test]
fn a_study_with_its_own_sets_is_not_weighed_against_the_catalogue() {
    let folder = Folder::new();
    let study = "[study]\nsets = \"s\"\nreference = \"r\"\n[[compare]]\naxis = \"s\"\n\
                 [[compare.row]]\nname = \"r\"\nset.world.base_attitude = \"held\"\n";
    folder.put("mission.toml", &format!("{OWN}{study}"));
    let said = folder.wrasse(&["size", "mission.toml", "--catalogue", "wheels"]);
    assert!(said.code == 2 && said.err.contains("brings its own sets"), "{}", said.err);
    // Its own units, which are none of its sets, stand beside them.
    let said = folder.wrasse(&["size", "mission.toml", "--json"]);
    assert_eq!(said.code, 0, "{}", said.err);
    assert_eq!(sets(&serde_json::from_str(&said.out).unwrap()), ["r", "as fitted"]);
}

#[test]
fn check_reads_the_study_and_complains_of_all_of_it_at_once() {
    let folder = Folder::new();
    let study = "[study]\nsets = \"nope\"\nreference = \"neither\"\ntasks = \"x\"\nclosed_loop = [\"y\"]\n\
                 mass_limit_kg = -1\npower_limit_w = -1\n[[compare]]\naxis = \"s\"\n\
                 [[compare.row]]\nname = \"r\"\n";
    folder.put("mission.toml", &format!("{OWN}{study}"));
    for command in ["check", "size"] {
        let said = folder.wrasse(&[command, "mission.toml"]);
        assert_eq!(said.code, 2, "{}", said.out);
        for word in [
            "there is no compared axis \"nope\"",
            "there is no compared axis \"x\"",
            "mass_limit_kg must be positive and finite, found -1",
            "power_limit_w must be positive and finite, found -1",
        ] {
            assert!(said.err.contains(word), "{command}: no `{word}` in {}", said.err);
        }
    }
    let good = study.replace("nope", "s").replace("neither", "r").replace("tasks = \"x\"\n", "");
    let good = good.replace("closed_loop = [\"y\"]\n", "").replace("-1", "100");
    folder.put("mission.toml", &format!("{OWN}{good}"));
    let said = folder.wrasse(&["check", "mission.toml"]);
    assert_eq!(said.code, 0, "{}", said.err);
}

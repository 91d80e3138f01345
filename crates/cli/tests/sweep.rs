//! `wrasse sweep` and `wrasse run --sample`, by their bytes and exit codes.

#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Short, with a sensor that is noisy, and a requirement that some fail.
const MISSION: &str = r#"
name = "quick"
vehicle = "atlas-class"
seed = 3
requirements = ["tool.position_error.max <= 0.1 mm", "tool.position_error.rms <= 1 m"]

[initial]
posture = "sideways_300mm"

[payload.module]
mass_kg = 200.0
uniform_box_m = [1.0, 1.0, 1.0]
held_by = "tool"

[world]
base_attitude = "controlled"
joints = "torque"

[control]
arm_law = "attitude-held"

[sensors]
encoder_step_deg = 0.0003
source.assumed = "an encoder of 20 bits"

[[phase]]
name = "reach"
move_tool = { by_m = [0.0, 0.02, 0.0], duration_s = 1.0 }

[[disperse]]
quantity = "payload.module.mass_kg"
sigma = 10.0
within = 30.0

[[disperse]]
quantity = "initial.joints_deg"
sigma = 0.5
within = 2.0
"#;

/// A folder with the mission in it.
fn place() -> Folder {
    let place = Folder::new();
    place.put("quick.toml", MISSION);
    place
}

fn json(place: &Folder, file: &str) -> serde_json::Value {
    serde_json::from_slice(&place.bytes(file)).unwrap()
}

/// How many parts are whole.
fn parts(place: &Folder, folder: &str) -> usize {
    place.names(folder).iter().filter(|name| name.starts_with("case-")).count()
}

#[test]
fn a_sample_run_alone_has_the_values_of_its_row_to_the_last_bit() {
    let place = place();
    let swept = place.wrasse(&["sweep", "quick.toml", "--samples", "9", "--threads", "2"]);
    assert_eq!((swept.code, swept.err.as_str()), (0, ""));
    let summary = json(&place, "out/quick-sweep/summary.json");
    let requirement = &summary["cases"][0]["requirements"][0];
    let worst = &requirement["worst"][0];
    let command = worst["command"].as_str().expect("a command");
    let alone: Vec<&str> = command.split(' ').skip(1).collect();
    let flown = place.wrasse(&alone);
    let sample = worst["sample"].as_u64().expect("a number");
    let report = json(&place, &format!("out/quick-sample-{sample}/summary.json"));
    let value = &report["cases"][0]["verdicts"][0]["value"];
    // Both are written so that they read back as the same bits.
    assert_eq!(value.as_f64().map(f64::to_bits), worst["value"].as_f64().map(f64::to_bits));
    assert!(value.as_f64().is_some_and(|value| value > 0.0));
    assert_eq!(flown.code, i32::from(requirement["holds"]["passed"] != 9));
    let told = report["summary"].as_str().expect("words");
    assert!(told.contains(&format!("Sample {sample} of seed 3")), "{told}");
}

#[test]
fn a_killed_sweep_goes_on_and_ends_with_the_same_bytes() {
    let place = place();
    let all = ["sweep", "quick.toml", "--samples", "200", "--threads", "1"];
    let whole = [&all[..], &["--out", "whole"]].concat();
    assert_eq!(place.wrasse(&whole).code, 0);

    let broken = [&all[..], &["--out", "broken"]].concat();
    let mut child =
        place.command(&broken).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while parts(&place, "broken/parts") == 0 && began.elapsed() < Duration::from_mins(1) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(parts(&place, "broken/parts") > 0, "it kept what was done");
    assert!(!place.names("broken").contains(&"samples.parquet".to_owned()), "killed too late");

    // By more threads, too.
    let more = ["sweep", "quick.toml", "--samples", "200", "--threads", "2", "--out", "broken"];
    assert_eq!(place.wrasse(&more).code, 0);
    for file in ["samples.parquet", "summary.json", "report.html"] {
        let read = |folder: &str| place.bytes(&format!("{folder}/{file}"));
        assert!(read("broken") == read("whole"), "{file}");
    }
}

#[test]
fn another_seed_in_the_same_folder_is_refused_and_a_wanted_pass_rate_decides_the_exit_code() {
    let place = place();
    let few = ["sweep", "quick.toml", "--samples", "4"];
    assert_eq!(place.wrasse(&few).code, 0);
    let other = place.wrasse(&[&few[..], &["--seed", "4"]].concat());
    assert_eq!(other.code, 2);
    assert!(other.err.contains("its seed is 3, here it is 4"), "{}", other.err);
    assert!(other.err.contains("--out"), "{}", other.err);
    // Four samples cannot show that 99 of 100 pass.
    assert_eq!(place.wrasse(&[&few[..], &["--pass-rate", "0.99"]].concat()).code, 1);
    assert_eq!(place.wrasse(&[&few[..], &["--pass-rate", "99"]].concat()).code, 2);
}

#[test]
fn a_seed_without_a_sample_is_refused() {
    assert_eq!(place().wrasse(&["run", "quick.toml", "--seed", "4"]).code, 2);
}

#[test]
fn a_sweep_that_draws_nothing_is_refused_and_leaves_nothing_behind() {
    let place = place();
    let nothing = &MISSION[..MISSION.find("[[disperse]]").unwrap()];
    place.put("nothing.toml", &nothing.replace("\"quick\"", "\"nothing\""));
    let told = place.wrasse(&["sweep", "nothing.toml", "--samples", "300", "--pass-rate", "0.98"]);
    assert_eq!(told.code, 2);
    assert!(
        told.err.contains("draws nothing") && told.err.contains("[[disperse]]"),
        "{}",
        told.err
    );
    assert!(place.names("out").is_empty());
}

#[test]
fn of_two_sweeps_in_one_folder_the_second_is_refused_until_the_first_is_killed() {
    let place = place();
    let long = ["sweep", "quick.toml", "--samples", "5000", "--threads", "1", "--out", "both"];
    let mut first =
        place.command(&long).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while parts(&place, "both/parts") == 0 && began.elapsed() < Duration::from_mins(1) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let short = ["sweep", "quick.toml", "--samples", "4", "--threads", "1", "--out", "both"];
    let second = place.wrasse(&short);
    assert_eq!(second.code, 2);
    assert!(second.err.contains("another sweep is being flown in both"), "{}", second.err);
    assert!(second.err.contains("--out"), "{}", second.err);
    first.kill().unwrap();
    first.wait().unwrap();
    assert_eq!(place.wrasse(&short).code, 0, "what a killed one leaves holds nobody up");
}

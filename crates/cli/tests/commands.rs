//! The commands as a user meets them: exit codes, files, words.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, at, files};
use serde_json::Value;
use std::io::Read;
use std::process::Stdio;
use std::time::Duration;

/// A second of one joint of the planar free-flyer; the requirement holds.
const SMALL: &str = r#"
name = "small"
vehicle = "planar-two-link"
requirements = ["base.rotation.max <= 45 deg"]

[[phase]]
name = "bend"
move_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }
"#;

const RESULTS: [&str; 3] = ["report.html", "summary.json", "telemetry.parquet"];

fn with_mission(text: &str) -> Folder {
    let folder = Folder::new();
    folder.put("mission.toml", text);
    folder
}

#[test]
fn a_run_whose_requirements_hold_ends_with_0_and_leaves_three_files_in_out() {
    let folder = with_mission(SMALL);
    let said = folder.wrasse(&["run", "mission.toml"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert_eq!(folder.names("out"), ["small"]);
    assert_eq!(folder.names("out/small"), RESULTS);
    assert_eq!(folder.names(""), ["mission.toml", "out"]);
    for word in ["base.rotation.max", "45", "deg", "pass", "report: out/small/report.html"] {
        assert!(said.out.contains(word), "no `{word}` in\n{}", said.out);
    }
}

#[test]
fn a_run_with_a_requirement_that_fails_ends_with_1_and_leaves_its_results() {
    let folder = with_mission(&SMALL.replace("45 deg", "0.001 deg"));
    let said = folder.wrasse(&["run", "mission.toml"]);
    assert_eq!(said.code, 1, "{}{}", said.out, said.err);
    assert!(said.out.to_lowercase().contains("fail"), "{}", said.out);
    assert_eq!(folder.names("out/small"), RESULTS);
}

#[test]
fn a_run_whose_way_cannot_be_gone_ends_with_1_and_says_why() {
    let text = SMALL.replace(
        "move_joints = { to_deg = { joint1 = 20.0 }",
        "move_tool = { by_m = [5.0, 0.0, 0.0]",
    );
    let text = text.replace("[[phase]]", "[control]\ntask = \"position\"\n\n[[phase]]");
    let folder = with_mission(&text);
    let said = folder.wrasse(&["run", "mission.toml"]);
    assert_eq!(said.code, 1, "{}{}", said.out, said.err);
    assert!(said.out.contains("falls behind its reference"), "{}", said.out);
    assert_eq!(folder.names("out/small"), RESULTS);
}

#[test]
fn a_run_of_bad_input_ends_with_2_and_writes_nothing() {
    let broken = [
        SMALL.replace("deg\"", "kg\""),
        SMALL.replace("vehicle = \"planar-two-link\"", ""),
        SMALL.replace("planar-two-link", "vehicle.toml"),
        "name = ".to_owned(),
        String::new(),
    ];
    for text in broken {
        let folder = with_mission(&text);
        let said = folder.wrasse(&["run", "mission.toml", "--out", "results"]);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{text}");
        assert!(said.err.contains("mission.toml"), "the file is named:\n{}", said.err);
        assert!(said.err.contains("error"), "{}", said.err);
        assert_eq!(folder.names(""), ["mission.toml"]);
    }
}

#[test]
fn a_file_that_cannot_be_read_is_answered_with_a_sentence() {
    let folder = Folder::new();
    std::fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe, 0x00]).unwrap();
    for command in ["run", "check"] {
        for (file, words) in
            [("none.toml", "there is no file none.toml"), ("bytes.toml", "bytes.toml is not UTF-8")]
        {
            let said = folder.wrasse(&[command, file]);
            assert_eq!((said.code, said.out.as_str()), (2, ""));
            assert!(said.err.starts_with(&format!("error: {words}")), "{}", said.err);
        }
        let said = folder.wrasse(&[command, "."]);
        assert_eq!(said.code, 2);
        assert!(said.err.starts_with("error: . cannot be read"), "{}", said.err);
    }
}

#[test]
fn results_go_to_out_if_it_is_given() {
    let folder = with_mission(SMALL);
    let said = folder.wrasse(&["run", "mission.toml", "--out", "deep/down here"]);
    assert_eq!(said.code, 0);
    assert_eq!(folder.names("deep/down here"), RESULTS);
    assert_eq!(folder.names(""), ["deep", "mission.toml"]);
    assert!(said.out.contains("deep/down here/report.html"), "{}", said.out);
}

#[test]
fn results_that_cannot_be_written_end_with_2_and_a_sentence_before_a_long_flight() {
    let folder = with_mission(&SMALL.replace("duration_s = 1.0", "duration_s = 500000.0"));
    folder.put("in the way", "");
    for out in ["in the way", "in the way/deeper"] {
        let said = folder.wrasse(&["run", "mission.toml", "--out", out]);
        assert_eq!(said.code, 2);
        assert!(said.err.starts_with("error: "), "{}", said.err);
        assert!(said.err.contains(out) && said.err.contains("--out"), "{}", said.err);
        assert_eq!(folder.names(""), ["in the way", "mission.toml"]);
    }
}

#[test]
fn results_that_a_folder_of_the_same_name_keeps_out_end_with_2_and_leave_nothing() {
    let folder = with_mission(SMALL);
    std::fs::create_dir_all(folder.path().join("results/summary.json")).unwrap();
    let said = folder.wrasse(&["run", "mission.toml", "--out", "results"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert!(said.err.starts_with("error: the results cannot be written: "), "{}", said.err);
    assert!(
        said.err.contains("cannot replace")
            && said.err.contains("summary.json")
            && said.err.contains("--out"),
        "{}",
        said.err
    );
    assert_eq!(folder.names("results"), ["summary.json"]);
}

#[test]
fn a_vehicle_file_is_seen_from_the_folder_of_its_mission() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    folder.put("mine/bus.toml", &folder.wrasse(&["vehicles", "planar-two-link", "--file"]).out);
    folder.put("mine/mission.toml", &SMALL.replace("planar-two-link", "bus.toml"));
    let said = folder.wrasse(&["run", "mine/mission.toml", "--json"]);
    assert_eq!(said.code, 0, "{}", said.err);
    let summary: Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(summary["vehicle"]["file"], "bus.toml");
}

#[test]
fn json_on_standard_output_is_the_summary_and_nothing_else() {
    let folder = with_mission(SMALL);
    let said = folder.wrasse(&["run", "mission.toml", "--json", "--out", "results"]);
    assert_eq!(said.code, 0);
    let printed: Value = serde_json::from_str(&said.out).unwrap();
    let written: Value = serde_json::from_slice(&folder.bytes("results/summary.json")).unwrap();
    assert_eq!(printed, written);
    assert_eq!(printed["mission"], "small");
    assert_eq!(said.err, "");
}

#[test]
fn the_same_mission_run_twice_leaves_the_same_bytes() {
    let folder = with_mission(SMALL);
    let [first, second] = ["one", "two"].map(|out| {
        let said = folder.wrasse(&["run", "mission.toml", "--out", out]);
        assert_eq!(said.code, 0);
        RESULTS.map(|name| folder.bytes(&format!("{out}/{name}")))
    });
    for (name, (a, b)) in RESULTS.iter().zip(first.iter().zip(&second)) {
        assert!(!a.is_empty() && a == b, "{name} differs");
    }
}

#[test]
fn a_second_run_replaces_the_results_of_the_first() {
    let folder = with_mission(SMALL);
    assert_eq!(folder.wrasse(&["run", "mission.toml"]).code, 0);
    let before = folder.bytes("out/small/summary.json");
    folder.put("mission.toml", &SMALL.replace("45 deg", "44 deg"));
    assert_eq!(folder.wrasse(&["run", "mission.toml"]).code, 0);
    assert_eq!(folder.names("out/small"), RESULTS);
    assert_ne!(folder.bytes("out/small/summary.json"), before);
}

#[test]
fn an_error_estimate_is_in_the_summary_when_it_is_asked_for() {
    let folder = with_mission(SMALL);
    let estimate = |arguments: &[&str]| {
        let said = folder.wrasse(&[&["run", "mission.toml", "--json"], arguments].concat());
        let summary: Value = serde_json::from_str(&said.out).unwrap();
        summary["cases"][0]["error_estimate"].as_array().map_or(0, Vec::len)
    };
    assert_eq!(estimate(&[]), 0);
    assert_eq!(estimate(&["--error-estimate"]), 5);
}

#[test]
fn check_accepts_every_vehicle_and_every_mission_that_is_shipped() {
    let folder = Folder::new();
    for (files, what) in [
        (files("vehicles", &["toml", "urdf"]), "vehicle "),
        (files("missions", &["toml"]), "a mission "),
    ] {
        for file in files {
            let said = folder.wrasse(&["check", file.to_str().unwrap()]);
            assert_eq!(said.code, 0, "{}", said.err);
            assert_eq!(said.out, format!("{}: {}", file.display(), after(&said.out, ": ")));
            assert!(after(&said.out, ": ").starts_with(what), "{}", said.out);
        }
    }
}

#[test]
fn check_says_what_lists_of_hardware_and_of_sets_are() {
    let folder = Folder::new();
    for (file, what) in [
        ("vehicles/hardware/wheels.toml", "model(s) of hardware"),
        ("vehicles/hardware/cmgs.toml", "model(s) of hardware"),
        ("vehicles/hardware/thrusters.toml", "model(s) of hardware"),
        ("vehicles/hardware/sensors.toml", "model(s) of hardware"),
        ("studies/sets.toml", "set(s) without a vehicle"),
    ] {
        let said = folder.wrasse(&["check", &at(file)]);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{file}");
        assert!(said.out.contains(what) && !said.out.contains(" 0 "), "{}", said.out);
    }
    // A list that is no TOML, and a vehicle without a name.
    folder.put("list.toml", "[[wheel]]\nname = \n");
    folder.put("vehicle.toml", "[[wheel]]\nname = \"a\"\n[[body]]\nname = \"b\"\n");
    for file in ["list.toml", "vehicle.toml"] {
        let said = folder.wrasse(&["check", file]);
        assert!(said.code == 2 && said.err.contains(file), "{}{}", said.out, said.err);
    }
}

/// What stands behind the first `mark`.
fn after<'a>(text: &'a str, mark: &str) -> &'a str {
    text.split_once(mark).unwrap_or_else(|| panic!("no `{mark}` in {text}")).1
}

#[test]
fn check_goes_through_all_files_and_ends_with_2_if_one_cannot_be_used() {
    let folder = with_mission(SMALL);
    folder.put("bad.toml", "name = \"x\"\nvehicel = \"atlas-class\"\n\n[[phase]]\nname = \"a\"\n");
    let said = folder.wrasse(&["check", "none.toml", "bad.toml", "mission.toml"]);
    assert_eq!(said.code, 2);
    assert!(said.out.starts_with("mission.toml: a mission of 1 case(s); "), "{}", said.out);
    assert!(said.out.contains("\n  tool 2 1/s at 100 Hz"), "a line for each loop:\n{}", said.out);
    for words in ["there is no file none.toml", "bad.toml:2", "`vehicle`"] {
        assert!(said.err.contains(words), "no `{words}` in\n{}", said.err);
    }
}

#[test]
fn a_warning_does_not_make_a_file_unusable() {
    let folder = Folder::new();
    let said = folder.wrasse(&["check", &at("vehicles/etsvii.toml")]);
    assert_eq!(said.code, 0);
    assert!(said.err.contains("warning"), "ETS-VII's published data deserve one:\n{}", said.err);
}

#[test]
fn the_help_of_each_command_says_what_it_does_and_how_it_ends() {
    let folder = Folder::new();
    let whole = folder.wrasse(&["--help"]);
    assert_eq!(whole.code, 0);
    let asked = [
        ("run", vec!["Fly a mission", "--out", "--json", "--error-estimate", "Exit code 0"]),
        ("check", vec!["every complaint at once", "Exit code 0"]),
        ("vehicles", vec!["List the vehicles", "NAME"]),
        ("hardware", vec!["List the wheels, CMGs, thrusters and sensors", "NAME"]),
        ("eval", vec!["at given states", "--states"]),
        ("schema", vec!["JSON Schema", "vehicle", "mission"]),
    ];
    for (command, words) in asked {
        assert!(whole.out.contains(&format!("\n  {command} ")), "{}", whole.out);
        let said = folder.wrasse(&[command, "--help"]);
        assert_eq!((said.code, said.err.as_str()), (0, ""));
        // A sentence may be broken over lines.
        let one_line = said.out.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in words {
            assert!(one_line.contains(word), "no `{word}` in\n{}", said.out);
        }
    }
}

#[test]
fn odd_arguments_are_refused_with_2_and_never_with_a_panic() {
    let folder = with_mission(SMALL);
    let odd: &[&[&str]] = &[
        &[],
        &["fly"],
        &["run"],
        &["run", ""],
        &["run", "/dev/null"],
        &["run", "mission.toml", "--out"],
        &["run", "mission.toml", "mission.toml"],
        &["run", "mission.toml", "--jsn"],
        &["check"],
        &["check", ""],
        &["check", "/dev/null"],
        &["vehicles", ""],
        &["vehicles", "a", "b"],
        &["vehicles", "\u{1F420}"],
        &["vehicles", "--file"],
        &["vehicles", "etsvii", "--file", "--json"],
        &["eval"],
        &["eval", "atlas-class"],
        &["eval", "", "--states", ""],
        &["eval", ".", "--states", "mission.toml"],
        &["eval", "atlas-class", "--states", "mission.toml"],
        &["eval", "mission.toml", "--states", "mission.toml"],
        &["schema"],
        &["schema", "Vehicle"],
        &["schema", "vehicle", "mission"],
    ];
    for arguments in odd {
        let said = folder.wrasse(arguments);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{arguments:?}");
        assert!(said.err.trim().len() > 10, "{arguments:?} is refused without a word");
    }
    assert_eq!(folder.names(""), ["mission.toml"]);
}

#[cfg(unix)]
#[test]
fn an_argument_that_is_not_text_is_no_panic() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let odd = std::ffi::OsStr::from_bytes(b"\xff\xfe.toml");
    for command in ["run", "check", "vehicles", "eval", "schema"] {
        let output = folder.command(&[command]).arg(odd).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}");
    }
}

#[test]
fn a_reader_who_goes_away_is_no_error() {
    let folder = with_mission(SMALL);
    let atlas = at("vehicles/atlas-class.toml");
    for arguments in [
        &["vehicles"][..],
        &["vehicles", "etsvii"],
        &["schema", "mission"],
        &["check", &atlas],
        &["run", "mission.toml"],
        &["run", "mission.toml", "--json"],
    ] {
        let mut command = folder.command(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{arguments:?}: {said}");
    }
    assert_eq!(folder.names("out/small"), RESULTS);
}

#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_cannot_be_written_out_is_not_a_success() {
    let folder = with_mission(SMALL);
    folder.put("states.json", r#"{ "frame": "tool", "states": [{}] }"#);
    for arguments in [
        &["vehicles"][..],
        &["schema", "mission"],
        &["eval", "atlas-class", "--states", "states.json"],
        &["run", "mission.toml", "--json"],
    ] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = folder.command(arguments).stdout(full).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.starts_with("error: standard output cannot be written: "), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_no_half_results_and_spares_the_former_ones() {
    let folder = with_mission(&SMALL.replace("duration_s = 1.0", "duration_s = 5000.0"));
    let interrupt = || {
        let mut command = folder.command(&["run", "mission.toml"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(300));
        assert!(child.try_wait().unwrap().is_none(), "over before it could be interrupted");
        let id = child.id().to_string();
        let told = std::process::Command::new("kill").args(["-INT", &id]).status().unwrap();
        assert!(told.success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains("interrupted: nothing is kept"), "{said}");
    };
    interrupt();
    assert_eq!(folder.names(""), ["mission.toml"]);

    folder.put("short.toml", SMALL);
    assert_eq!(folder.wrasse(&["run", "short.toml"]).code, 0);
    let former = RESULTS.map(|name| folder.bytes(&format!("out/small/{name}")));
    interrupt();
    assert_eq!(folder.names("out/small"), RESULTS);
    assert!(former == RESULTS.map(|name| folder.bytes(&format!("out/small/{name}"))));
}

//! What hostile or careless input does to the program: issue 9, section Robustness.
#![allow(clippy::unwrap_used, reason = "a test that finds nothing to unwrap has failed")]

mod binary;

use binary::{Folder, Said};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A vehicle of one joint, with this name.
fn vehicle(name: &str) -> String {
    format!(
        r#"name = "{name}"
summary = "tiny"
source.assumed = "test"
[[body]]
name = "bus"
mass_kg = 100
centre_of_mass_m = [0, 0, 0]
inertia_kgm2 = {{ about = "centre-of-mass", axes = "body", xx = 20, yy = 20, zz = 20 }}
[[body]]
name = "l1"
mass_kg = 4
centre_of_mass_m = [0.5, 0, 0]
inertia_kgm2 = {{ about = "centre-of-mass", axes = "body", xx = 0.1, yy = 0.4, zz = 0.4 }}
[[joint]]
name = "j1"
kind = "revolute"
parent = "bus"
child = "l1"
position_m = [0.5, 0, 0]
axis = [0, 0, 1]
travel_deg = [-90, 90]
rate_deg_s = 10
effort_nm = 50
[[tool]]
name = "tool"
on = "l1"
position_m = [1, 0, 0]
[[posture]]
name = "ready"
joints_deg = {{ j1 = 10 }}
[attitude_actuator]
torque_limit_nm = 20
momentum_limit_nms = 40
"#
    )
}

fn mission(name: &str, duration: f64) -> String {
    format!(
        r#"name = "{name}"
vehicle = "t.toml"
requirements = ["base.rotation.max <= 90 deg"]
[initial]
posture = "ready"
[world]
base_attitude = "controlled"
joints = "torque"
[[phase]]
name = "a"
move_joints = {{ to_deg = {{ j1 = 11 }}, duration_s = {duration} }}
"#
    )
}

fn folder() -> Folder {
    let folder = Folder::new();
    folder.put("t.toml", &vehicle("t"));
    folder
}

#[track_caller]
fn refused(said: &Said, words: &[&str]) {
    assert_eq!((said.code, said.out.as_str()), (2, ""), "{}", said.err);
    for word in words {
        assert!(said.err.contains(word), "no {word:?} in\n{}", said.err);
    }
}

#[test]
fn six_thousand_mistakes_take_seconds_and_a_screenful() {
    let folder = folder();
    let wrong = vec!["\"base.rotatoin.max <= 5 deg\""; 6000].join(",");
    let text = mission("t", 1.0);
    let text = text.replace("\"base.rotation.max <= 90 deg\"", &wrong);
    folder.put("many.toml", &text);
    let began = Instant::now();
    let said = folder.wrasse(&["check", "many.toml"]);
    refused(&said, &["the first 100 are shown, 5900 more are not\n6000 errors\n"]);
    // Measured 2.8 s of processor time; the square of the number took some 13 s without being drawn
    // whole, and more than a minute with it.
    assert!(began.elapsed() < Duration::from_secs(40), "{:?}", began.elapsed());
    assert!(said.err.len() < 100_000, "{}", said.err.len());
}

#[test]
fn no_name_of_a_file_reaches_the_terminal_as_a_command() {
    let folder = Folder::new();
    let evil = r"V\u001b[31mRED\u0007\u009b1m\u202e\u200b";
    folder.put("t.toml", &vehicle(evil));
    let text = mission("m", 0.2);
    folder.put("m.toml", &text.replace("summary", "x"));
    let obeyed = |text: &str| {
        text.contains(|c: char| c != '\n' && (c.is_control() || "\u{202e}\u{200b}".contains(c)))
    };
    let seen = r"V\u{1b}[31mRED\u{7}\u{9b}1m\u{202e}\u{200b}";
    let said = folder.wrasse(&["check", "t.toml"]);
    assert!(said.code == 0 && said.out.contains(seen) && !obeyed(&said.out), "{:?}", said.out);
    let json = folder.wrasse(&["run", "m.toml", "--json"]);
    assert!(json.code == 0 && !obeyed(&json.out), "{:?}", json.out);
    let summary: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(summary["vehicle"]["name"], "V\u{1b}[31mRED\u{7}\u{9b}1m\u{202e}\u{200b}");
    for arguments in
        [["check", "no\u{1b}[31m\u{9b}.toml"], ["vehicles", "\u{9b}31m"], ["\u{1b}c", "x"]]
    {
        let said = folder.wrasse(&arguments);
        assert!(said.code == 2 && !obeyed(&said.err), "{:?}", said.err);
    }
}

#[test]
fn both_rounds_of_complaints_come_at_once() {
    let folder = folder();
    let text = mission("both", 1.0)
        .replace(
            "posture = \"ready\"",
            "posture = \"redy\"\n[control]\narm_law = \"freefloating\"\nbandwidth = 3",
        )
        .replace("base.rotation.max <= 90 deg", "base.rotatoin.max <= 5 deg")
        .replace(
            "[[phase]]",
            "[[phase]]\nmove_tool = { by_mm = [0, 1, 0], duration = 6 }\n[[phase]]",
        )
        + "[[phase]]\nname = \"b\"\nmove_joints = { to = \"stow\" }\n";
    folder.put("both.toml", &text);
    let words = [
        "found \"freefloating\"",
        "`bandwidth`",
        "`by_mm`",
        "has no `name`",
        "unknown key `to`",
        "no posture called \"redy\"",
        "no metric called base.rotatoin.max",
    ];
    let said = folder.wrasse(&["check", "both.toml"]);
    refused(&said, &words);
    assert!(!said.err.contains("unknown\""), "no name that is made up:\n{}", said.err);
}

#[test]
fn a_joint_without_a_parent_does_not_hide_what_is_behind_it() {
    let folder = folder();
    let text = vehicle("t")
        .replace("parent = \"bus\"\n", "")
        .replace("mass_kg = 100", "mass_kg = -100")
        .replace("joints_deg = { j1 = 10 }", "joints_deg = { j2 = 10 }");
    folder.put("t.toml", &text);
    let said = folder.wrasse(&["check", "t.toml"]);
    refused(
        &said,
        &["has no `parent`", "found -100 kg", "no joint that moves is called 'j2'", "\n3 errors\n"],
    );
    folder.put(
        "t.toml",
        &vehicle("t").replace("name = \"l1\"\n", "").replace("effort_nm = 50", "effort_nm = -50"),
    );
    let said = folder.wrasse(&["check", "t.toml"]);
    refused(&said, &["has no `name`", "negative: -50", "\n2 errors\n"]);
    // The vehicle that is meant stands in for one that is misspelt.
    folder.put(
        "m.toml",
        &mission("m", 1.0).replace("t.toml", "atlas-klass").replace("max <= 90 deg", "max <= 90"),
    );
    refused(
        &folder.wrasse(&["check", "m.toml"]),
        &["did you mean \"atlas-class\"?", "\n4 errors\n"],
    );
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_refused_wherever_a_file_is_read() {
    let folder = folder();
    folder.put("m.toml", &mission("m", 1.0).replace("t.toml", "/dev/zero"));
    for command in ["run", "check", "size", "sweep"] {
        refused(
            &folder.wrasse(&[command, "m.toml"]),
            &["/dev/zero", "a device, a pipe or a socket"],
        );
        refused(
            &folder.wrasse(&[command, "/dev/zero"]),
            &["/dev/zero cannot be read: it is a device"],
        );
    }
    refused(&folder.wrasse(&["eval", "/dev/zero", "--states", "s.json"]), &["/dev/zero"]);
    refused(&folder.wrasse(&["eval", "t.toml", "--states", "/dev/zero"]), &["it is a device"]);
    let large = std::fs::File::create(folder.path().join("large.toml")).unwrap();
    large.set_len((16 << 20) + 1).unwrap();
    refused(&folder.wrasse(&["check", "large.toml"]), &["larger than 16 MiB"]);
}

#[test]
fn an_attitude_may_be_given_by_its_angles() {
    let folder = folder();
    let summary = |attitude: &str| {
        let initial = format!("posture = \"ready\"\nattitude = {attitude}");
        folder.put("m.toml", &mission("m", 0.2).replace("posture = \"ready\"", &initial));
        let said = folder.wrasse(&["run", "m.toml", "--json"]);
        assert_eq!(said.code, 0, "{}", said.err);
        let mut summary: serde_json::Value = serde_json::from_str(&said.out).unwrap();
        summary.as_object_mut().unwrap().remove("mission_text");
        summary["cases"].to_string()
    };
    // Half a turn about y: the same bits either way.
    let turned = summary("{ rpy_deg = [0, 180, 0] }");
    assert_eq!(turned, summary("{ w = 0, x = 0, y = 1, z = 0 }"));
    assert_eq!(turned, summary("{ quaternion = { w = 0, x = 0, y = 1, z = 0 } }"));
    let wrong =
        mission("m", 0.2).replace("posture = \"ready\"", "attitude = { rpy = [0, 180, 0] }");
    folder.put("m.toml", &wrong);
    refused(&folder.wrasse(&["check", "m.toml"]), &["`rpy_deg`"]);
}

#[test]
fn states_in_the_wrong_order_or_twice_are_refused_with_their_places_all_at_once() {
    let folder = folder();
    let said = |states: &str| {
        folder.put("s.json", states);
        folder.wrasse(&["eval", "t.toml", "--states", "s.json"])
    };
    refused(&said(r#"["tool", [{}]]"#), &["s.json:1:1", "must be an object, found a list"]);
    refused(
        &said(r#"{"frame": "tool", "states": [{"joints": {"j1": [5, 6, 7, 8]}, "base": [1]}]}"#),
        &[
            "s.json:1:48",
            "`j1` must be a table, found a list",
            "`base` must be a table",
            "\n2 errors\n",
        ],
    );
    refused(
        &said(r#"{"frame": "tool", "states": [{"joints": {"j1": {}, "j1": {}}, "joints": {}}]}"#),
        &["\"j1\" is given twice", "\"joints\" is given twice", "\n2 errors\n"],
    );
    refused(
        &said(
            r#"{"frame": "tol", "frane": 1, "states": [{"joints": {"j2": {}}, "base_velocity": {"linear": [1, "x", 2]}}]}"#,
        ),
        &[
            "unknown key `frane`",
            "no link called \"tol\"",
            "no moving joint called \"j2\"",
            "must be a number",
        ],
    );
}

#[test]
fn moments_of_inertia_that_are_not_positive_are_refused_whatever_the_file_accepts() {
    let folder = folder();
    for moments in ["xx = -1e9, yy = -1, zz = -1", "xx = 1, yy = 1, zz = 1, xy = 2"] {
        let text = vehicle("t").replace("xx = 20, yy = 20, zz = 20", moments).replacen(
            "name = \"bus\"",
            "name = \"bus\"\naccept_nonphysical = \"x\"",
            1,
        );
        folder.put("t.toml", &text);
        refused(&folder.wrasse(&["check", "t.toml"]), &["not positive definite", "kg·m²"]);
    }
}

#[test]
fn shapes_of_negative_size_are_refused_and_those_without_one_are_not_drawn() {
    let folder = Folder::new();
    let urdf = |shape: &str| {
        format!(
            r#"<robot name="a"><link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><visual><geometry>{shape}</geometry></visual></link></robot>"#
        )
    };
    for shape in [
        r#"<box size="1 -2 1"/>"#,
        r#"<cylinder radius="-2" length="1"/>"#,
        r#"<sphere radius="-2"/>"#,
    ] {
        folder.put("a.urdf", &urdf(shape));
        refused(&folder.wrasse(&["check", "a.urdf"]), &["a size of -2 m"]);
    }
    folder.put("a.urdf", &urdf(r#"<box size="1 0 1"/>"#));
    let said = folder.wrasse(&["check", "a.urdf"]);
    assert!(said.code == 0 && said.err.contains("not drawn"), "{}", said.err);
}

#[test]
fn a_name_that_no_file_system_takes_is_refused_before_anything_is_written() {
    let folder = folder();
    let long = "x".repeat(101);
    for name in ["CON", "nul", "com1", "a.", "a/b", "..", "", long.as_str()] {
        folder.put("m.toml", &mission(name, 0.2));
        for command in ["run", "check", "size", "sweep"] {
            refused(&folder.wrasse(&[command, "m.toml"]), &["m.toml:1:8"]);
        }
    }
    folder.put("m.toml", &mission("m", 500_000.0));
    let long = "x".repeat(300);
    for command in ["run", "size", "sweep"] {
        for out in [long.as_str(), "", "t.toml", "t.toml/deeper"] {
            let said = folder.wrasse(&[command, "m.toml", "--out", out]);
            assert_eq!(said.code, 2, "{command} {out}: {}", said.err);
        }
    }
    assert_eq!(folder.names(""), ["m.toml", "t.toml"]);
}

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_whole_results_and_the_next_one_tidies_up() {
    let folder = folder();
    folder.put("m.toml", &mission("m", 0.2));
    let set = || {
        ["report.html", "summary.json", "telemetry.parquet"]
            .map(|n| folder.bytes(&format!("out/m/{n}")))
    };
    assert_eq!(folder.wrasse(&["run", "m.toml"]).code, 0);
    let old = set();
    folder.put("m.toml", &mission("m", 0.3));
    assert_eq!(folder.wrasse(&["run", "m.toml"]).code, 0);
    let new = set();
    assert!((0..3).all(|i| old[i] != new[i]));
    for i in 0..30 {
        folder.put("m.toml", &mission("m", if i % 2 == 0 { 0.2 } else { 0.3 }));
        let mut command = folder.command(&["run", "m.toml"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(5 + 4 * i));
        child.kill().unwrap();
        child.wait().unwrap();
        if folder.names("out/m").is_empty() {
            continue;
        }
        let found = set();
        assert!(found == old || found == new, "a mixture after the kill number {i}");
    }
    assert_eq!(folder.wrasse(&["run", "m.toml"]).code, 0);
    assert_eq!(folder.names("out"), ["m"]);
    assert_eq!(folder.names("out/m"), ["report.html", "summary.json", "telemetry.parquet"]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_says_what_it_keeps_and_ends_with_130() {
    let folder = folder();
    let disperse = "[[disperse]]\nquantity = \"body.bus.mass_kg\"\nsigma = 1\n";
    folder.put("m.toml", &(mission("m", 2.0) + disperse));
    let mut command = folder.command(&["sweep", "m.toml", "--samples", "100000"]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    let told = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(told.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(
        said.contains("flights are kept in out/m-sweep/parts; the same command goes on"),
        "{said}"
    );
}

#[test]
fn complaints_take_the_time_of_their_number_and_not_of_its_square() {
    let folder = Folder::new();
    let toml = |count: usize| {
        let all: Vec<_> = (0..count).map(|i| format!("k{i} = 1\n")).collect();
        all.concat()
    };
    let urdf = |count: usize| {
        let each = |i| {
            format!(
                "<link name='l'/><joint name='j' type='fixed'><parent link='p{i}'/>\
                 <child link='c{i}'/></joint>\n"
            )
        };
        let all: Vec<_> = (0..count).map(each).collect();
        format!("<robot name='a'>{}</robot>", all.concat())
    };
    let time = |file: &str, text: String| {
        folder.put(file, &text);
        let began = Instant::now();
        refused(&folder.wrasse(&["check", file]), &["the first 100 are shown"]);
        began.elapsed().as_secs_f64()
    };
    let times = [
        ("toml", time("a.toml", toml(4000)), time("a.toml", toml(32_000))),
        ("urdf", time("a.urdf", urdf(1000)), time("a.urdf", urdf(8000))),
    ];
    // Eight times the mistakes; sixty-four times would be the square.
    for (format, few, many) in times {
        assert!(many < 30.0 * few, "{format}: {few} s for some, {many} s for eight times as many");
    }
}

//! `-` in place of a file: standard input.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, at};
use std::io::Write;
use std::process::Stdio;

const MISSION: &str = r#"
name = "small"
vehicle = "VEHICLE"
requirements = ["base.rotation.max <= 45 deg"]

[[phase]]
name = "bend"
move_joints = { to_deg = { joint1 = 20.0 }, duration_s = 1.0 }

[[disperse]]
quantity = "initial.joints_deg.joint1"
sigma = 1.0
"#;

/// Exit code, output and errors of a command with this on its standard input.
fn fed(folder: &Folder, arguments: &[&str], input: &[u8]) -> (i32, String, String) {
    let mut command = folder.command(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // Whoever refuses a part does not read the rest.
    let _ = child.stdin.take().unwrap().write_all(input);
    let said = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (said.status.code().unwrap(), text(said.stdout), text(said.stderr))
}

#[test]
fn a_mission_from_standard_input_finds_its_vehicle_from_the_working_folder() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("v")).unwrap();
    std::fs::copy(at("vehicles/planar-two-link.toml"), folder.path().join("v/two.toml")).unwrap();
    let mission = MISSION.replace("VEHICLE", "v/two.toml");
    for (command, result) in
        [("check", None), ("run", Some("small")), ("sweep", Some("small-sweep"))]
    {
        let more: &[&str] = if command == "sweep" { &["--samples", "2"] } else { &[] };
        let (code, out, err) = fed(&folder, &[&[command, "-"], more].concat(), mission.as_bytes());
        assert_eq!((code, err.as_str()), (0, ""), "{command}: {out}");
        if let Some(result) = result {
            assert!(folder.names("out").contains(&result.to_owned()));
        }
    }
    let summary: serde_json::Value =
        serde_json::from_slice(&folder.bytes("out/small/summary.json")).unwrap();
    assert_eq!(summary["provenance"]["mission"]["file"], "stdin.toml");
    assert_eq!(summary["provenance"]["mission"]["text"], mission);
}

#[test]
fn a_study_comes_from_standard_input_too() {
    let folder = Folder::new();
    let text = std::fs::read(at("missions/atlas-reach.toml")).unwrap();
    let (code, _, err) = fed(&folder, &["size", "-"], &text);
    assert_eq!(code, 0, "{err}");
    assert_eq!(folder.names("out"), ["atlas-reach-size"]);
}

#[test]
fn check_tells_vehicles_of_both_formats_from_missions() {
    let folder = Folder::new();
    for (file, what) in [
        ("vehicles/planar-two-link.toml", "stdin.toml: vehicle planar-two-link"),
        ("vehicles/example-arm.urdf", "stdin.xml: vehicle example-arm"),
        ("missions/atlas-reach.toml", "stdin.toml: a mission of 1 case(s)"),
    ] {
        let (code, out, err) = fed(&folder, &["check", "-"], &std::fs::read(at(file)).unwrap());
        assert_eq!(code, 0, "{file}: {err}");
        assert!(out.starts_with(what), "{file}: {out}");
    }
}

#[test]
fn what_is_wrong_on_standard_input_ends_with_2() {
    let folder = Folder::new();
    let large = vec![b'#'; (16 << 20) + 1];
    for (input, words) in [
        (&b"name = 3 kg"[..], "--> stdin.toml:1:"),
        (b"\xff\xff", "error: standard input is not UTF-8 text"),
        (&large, "error: standard input cannot be read: it is larger than 16 MiB"),
        (b"", "--> stdin.toml"),
        (b"<robot", "--> stdin.xml"),
    ] {
        let (code, out, err) = fed(&folder, &["check", "-"], input);
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(words), "{words}: {err}");
    }
    let (code, _, err) = fed(&folder, &["check", "-", "-"], MISSION.as_bytes());
    assert_eq!(code, 2);
    assert!(err.contains("standard input can be read once"), "{err}");
    assert!(folder.names("").is_empty());
}

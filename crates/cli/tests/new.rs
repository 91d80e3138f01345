//! `wrasse new`: what a user starts from can be used as it stands.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, at};

fn text(folder: &Folder, name: &str) -> String {
    String::from_utf8(folder.bytes(name)).unwrap()
}

#[test]
fn a_new_vehicle_and_its_mission_check_without_a_word_and_pass() {
    let folder = Folder::new();
    folder.put("my.toml", &folder.wrasse(&["new", "vehicle"]).out);
    folder.put("m.toml", &folder.wrasse(&["new", "mission", "--vehicle", "my.toml"]).out);
    let said = folder.wrasse(&["check", "my.toml", "m.toml"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    let said = folder.wrasse(&["run", "m.toml"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    assert_eq!(folder.names("out"), ["my-mission"]);
}

#[test]
fn a_new_mission_alone_flies_a_vehicle_of_the_catalogue() {
    let folder = Folder::new();
    folder.put("m.toml", &folder.wrasse(&["new", "mission", "first"]).out);
    let said = folder.wrasse(&["check", "m.toml"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    let said = folder.wrasse(&["run", "m.toml"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    assert_eq!(folder.names("out"), ["first"]);
}

#[test]
fn every_key_of_the_new_files_has_a_comment_above_its_first_use() {
    for what in ["vehicle", "mission"] {
        let text = Folder::new().wrasse(&["new", what]).out;
        let mut explained = false;
        let mut seen = vec![];
        for line in text.lines() {
            let key = line.split([' ', '=']).next().unwrap_or_default().to_owned();
            // A comment speaks of all lines up to the next blank one.
            explained = !line.is_empty() && (explained || line.starts_with('#'));
            let is_key = line.contains('=') && line.starts_with(|c: char| c.is_ascii_lowercase());
            if is_key && !seen.contains(&key) {
                assert!(explained, "{what}: nothing is said about {line}");
                seen.push(key);
            }
        }
        assert!(seen.len() > 5, "{what}: {seen:?}");
    }
}

#[test]
fn a_new_file_never_takes_the_place_of_another() {
    let folder = Folder::new();
    let said = folder.wrasse(&["new", "vehicle", "chaser", "--out", "v.toml"]);
    assert_eq!((said.code, said.out.as_str()), (0, "written: v.toml\n"), "{}", said.err);
    let first = text(&folder, "v.toml");
    assert!(first.contains("\nname = \"chaser\"\n"), "{first}");
    let said = folder.wrasse(&["new", "mission", "--out", "v.toml"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert!(said.err.starts_with("error: v.toml is there already"), "{}", said.err);
    assert_eq!(text(&folder, "v.toml"), first);
    let said = folder.wrasse(&["new", "mission", "--out", "none/m.toml"]);
    assert_eq!(said.code, 2);
    assert!(said.err.starts_with("error: none/m.toml cannot be written"), "{}", said.err);
    assert_eq!(folder.names(""), ["v.toml"]);
}

#[test]
fn a_mission_in_another_folder_finds_its_vehicle() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path().join("missions/mine")).unwrap();
    folder.wrasse(&["new", "vehicle", "--out", "missions/v.toml"]);
    for (out, named) in [("missions/a.toml", Some("v.toml")), ("missions/mine/b.toml", None)] {
        let said = folder.wrasse(&["new", "mission", "--vehicle", "missions/v.toml", "--out", out]);
        assert_eq!(said.code, 0, "{}", said.err);
        assert_eq!(folder.wrasse(&["check", out]).code, 0);
        if let Some(named) = named {
            assert!(text(&folder, out).contains(&format!("\nvehicle = \"{named}\"\n")));
        }
    }
}

#[test]
fn a_mission_for_any_vehicle_of_the_catalogue_can_be_used() {
    let folder = Folder::new();
    for vehicle in binary::files("vehicles", &["toml", "urdf"]) {
        let vehicle = vehicle.to_str().unwrap();
        folder.put("m.toml", &folder.wrasse(&["new", "mission", "--vehicle", vehicle]).out);
        let said = folder.wrasse(&["check", "m.toml"]);
        assert_eq!(said.code, 0, "{vehicle}:\n{}", said.err);
    }
}

#[test]
fn what_cannot_be_a_name_or_a_vehicle_is_a_complaint() {
    let folder = Folder::new();
    for (arguments, words) in [
        (vec!["new", "mission", "two words"], "found ' ' in \"two words\""),
        (vec!["new", "vehicle", ""], "name"),
        (vec!["new", "mission", "--vehicle", "none.toml"], "there is no file none.toml"),
        (vec!["new", "mission", "--vehicle", "atlas-clas"], "did you mean \"atlas-class\"?"),
        (vec!["new", "mission", "--vehicle", &at("missions/coast.toml")], "unknown key"),
        (vec!["new", "ship"], "unrecognized subcommand"),
    ] {
        let said = folder.wrasse(&arguments);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{arguments:?}");
        assert!(said.err.contains(words), "{arguments:?}: {}", said.err);
    }
    assert!(folder.names("").is_empty());
}

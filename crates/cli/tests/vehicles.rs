//! `wrasse vehicles` as a user meets it.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, files};
use serde_json::Value;

fn json(arguments: &[&str]) -> Value {
    let said = Folder::new().wrasse(arguments);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{arguments:?}");
    serde_json::from_str(&said.out).unwrap()
}

/// Names of the files in `vehicles/`, in order.
fn shipped() -> Vec<String> {
    let stem = |file: &std::path::PathBuf| file.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut names: Vec<_> = files("vehicles", &["toml", "urdf"]).iter().map(stem).collect();
    names.sort();
    names
}

#[test]
fn the_catalogue_is_listed_by_kind_in_columns_of_a_terminal() {
    let said = Folder::new().wrasse(&["vehicles"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    assert!(said.out.lines().all(|line| line.chars().count() <= 80), "{}", said.out);
    let heads = ["servicers", "free-flyers", "clients"];
    let (mut listed, mut under) = (vec![], String::new());
    let mut ends = vec![];
    for line in said.out.lines().filter(|line| !line.starts_with(' ') && !line.is_empty()) {
        let words: Vec<_> = line.split_whitespace().collect();
        if heads.contains(&words[0]) {
            under = words[0].to_owned();
            ends = ["joints", "mass (kg)"].map(|head| line.find(head).unwrap() + head.len()).into();
        } else if let [name, joints, mass] = words[..] {
            assert!(line[..ends[0]].ends_with(joints) && line[..ends[1]].ends_with(mass), "{line}");
            assert!(mass.parse::<f64>().is_ok());
            assert_eq!(joints.parse::<u32>().unwrap() > 0, under == "servicers", "{line}");
            listed.push(name.to_owned());
        }
    }
    listed.sort();
    assert_eq!(listed, shipped());
}

#[test]
fn the_list_as_json_tells_servicers_free_flyers_and_clients() {
    let list = json(&["vehicles", "--json"]);
    let kind = |name: &str| {
        let found = list.as_array().unwrap().iter().find(|entry| entry["name"] == name);
        found.unwrap_or_else(|| panic!("no {name}"))["kind"].as_str().unwrap().to_owned()
    };
    assert_eq!(kind("atlas-class"), "servicer");
    assert_eq!(kind("omv-class"), "free-flyer");
    assert_eq!(kind("hubble-class"), "client");
    assert_eq!(list.as_array().unwrap().len(), shipped().len());
}

#[test]
fn a_vehicle_is_shown_with_its_parts_its_sources_by_grade_and_what_is_not_public() {
    let said = Folder::new().wrasse(&["vehicles", "era-class"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    let mut rest = said.out.as_str();
    for word in [
        "era-class: servicer\n",
        "mass: 420630 kg, 420000 kg of it the base",
        "\njoints ",
        "shoulder_roll      -180 to 180 deg       3 deg/s       600 N·m",
        "\ntools\n  tool, moved by wrist_roll",
        "\npostures\n  bent",
        "ideal: 1032 N·m and 19520 N·m·s about each axis",
        "\npublished\n  all else: ",
        "\nderived\n  joint.wrist_roll.position_m: part of the published 1.228 m",
        "\nassumed\n",
        "body.foot.mass_kg, body.shoulder.mass_kg",
        "\nnot public\n  masses, centres of mass and inertias of the links",
    ] {
        let at =
            rest.find(word).unwrap_or_else(|| panic!("no `{word}` in its place in\n{}", said.out));
        rest = &rest[at + word.len()..];
    }
}

#[test]
fn every_page_fits_a_terminal_and_every_number_is_in_the_json_too() {
    let folder = Folder::new();
    for name in shipped() {
        let said = folder.wrasse(&["vehicles", &name]);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{name}");
        // An address of a document is one word, and may be long.
        let long = |line: &&str| line.chars().count() > 80 && line.split_whitespace().count() > 1;
        assert_eq!(said.out.lines().find(long), None, "{name}");
        let facts = json(&["vehicles", &name, "--json"]);
        let kg = facts["mass_kg"].as_f64().unwrap();
        assert!(said.out.contains(&format!("mass: {} kg", (kg * 1e3).round() / 1e3)), "{name}");
        let count = |key: &str| facts[key].as_array().unwrap().len();
        assert_eq!(said.out.contains("\ntools\n"), count("tools") > 0, "{name}");
        assert_eq!(said.out.contains("\nnot public\n"), count("not_public") > 0, "{name}");
        assert_eq!(count("provenance"), 3);
    }
}

#[test]
fn facts_of_joints_and_postures_are_in_the_units_of_the_file() {
    let facts = json(&["vehicles", "shuttle-rms", "--json"]);
    let pitch = &facts["joints"][1];
    assert_eq!(pitch["name"], "shoulder_pitch");
    assert_eq!(pitch["travel"], serde_json::json!([0.0, 142.4]));
    assert_eq!((pitch["rate"].as_f64(), pitch["effort"].as_f64()), (Some(2.29), Some(1570.0)));
    assert_eq!(facts["postures"][0]["joints"]["elbow_pitch"], -80.0);
    assert_eq!(facts["tools"][0]["moved_by"], "wrist_roll");
    assert_eq!(json(&["vehicles", "omv-class", "--json"])["propellant_kg"], 500.0);
}

#[test]
fn the_file_of_a_vehicle_is_printed_as_a_file_that_check_accepts() {
    let folder = Folder::new();
    for file in files("vehicles", &["toml", "urdf"]) {
        let name = file.file_stem().unwrap().to_str().unwrap();
        let said = folder.wrasse(&["vehicles", name, "--file"]);
        assert_eq!((said.code, said.err.as_str()), (0, ""));
        assert_eq!(said.out.trim_end(), std::fs::read_to_string(&file).unwrap().trim_end());
        let mine = format!("mine.{}", file.extension().unwrap().to_str().unwrap());
        folder.put(&mine, &said.out);
        let said = folder.wrasse(&["check", &mine]);
        assert_eq!(said.code, 0, "{name}: {}", said.err);
        assert!(said.out.starts_with(&format!("{mine}: vehicle ")), "{}", said.out);
    }
}

#[test]
fn a_file_of_ones_own_is_shown_as_those_of_the_catalogue_are() {
    let folder = Folder::new();
    folder.put("mine.toml", &folder.wrasse(&["vehicles", "nextsat-class", "--file"]).out);
    let said = folder.wrasse(&["vehicles", "mine.toml"]);
    assert_eq!(said.out, folder.wrasse(&["vehicles", "nextsat-class"]).out);
    folder.put("broken.toml", "name = 'x'\nsummary = 'x'\n[[body]]\nname = 'b'\nmas_kg = 1\n");
    let said = folder.wrasse(&["vehicles", "broken.toml"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert!(said.err.contains("broken.toml:5:1") && said.err.contains("mass_kg"), "{}", said.err);
}

#[test]
fn a_vehicle_that_is_not_in_the_catalogue_is_answered_with_the_nearest_that_is() {
    for (name, help) in [
        ("atlas-klass", "did you mean \"atlas-class\"?"),
        ("teapot", "the catalogue has atlas-class, "),
        ("teapot.toml", "is the path right?"),
    ] {
        let said = Folder::new().wrasse(&["vehicles", name]);
        assert_eq!((said.code, said.out.as_str()), (2, ""));
        assert!(said.err.contains(name) && said.err.contains(help), "{}", said.err);
    }
}

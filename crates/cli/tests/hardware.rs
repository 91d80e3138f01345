//! `wrasse hardware` as a user meets it.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;

#[test]
fn the_hardware_is_listed_kind_by_kind_and_what_is_not_published_is_marked() {
    let said = Folder::new().wrasse(&["hardware"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    let line = |name: &str| {
        let found = said.out.lines().find(|line| line.starts_with(name));
        found.map(|line| line.split_whitespace().collect::<Vec<_>>()).unwrap_or_default()
    };
    assert_eq!(line("reaction wheel")[2..], ["N·m", "N·m·s", "kg", "W"]);
    assert_eq!(line("honeywell-hr16-100")[1..5], ["0.2", "100", "12", "126*"]);
    assert_eq!(line("cmg-class-250")[1..3], ["250*", "250*"]);
    assert_eq!(line("moog-monarc-22-6")[1..4], ["22", "229.5", "0.02"]);
    // Inertia times speed: 0.00136 kg·m² at 7000 rpm.
    assert_eq!(line("small-servicer-2024")[1..4], ["0.1", "0.997*", "0.9"]);
    assert_eq!(line("airbus-cmg-75-75s")[1..4], ["75~", "75~", "33*"]);
    assert!(said.out.contains("* assumed or derived") && said.out.contains("~ published, but"));
}

#[test]
fn each_number_of_a_unit_is_shown_with_its_source() {
    let said = Folder::new().wrasse(&["hardware", "airbus-cmg-75-75s"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    for word in [
        "airbus-cmg-75-75s: control moment gyro",
        "torque_limit_nm                  = 75",
        "all else: published: Airbus",
        "servo_bandwidth_rad_s: assumed: a rate servo of 5 Hz",
    ] {
        assert!(said.out.contains(word), "no `{word}` in\n{}", said.out);
    }
}

#[test]
fn hardware_that_is_not_there_is_an_error() {
    let said = Folder::new().wrasse(&["hardware", "airbus-cmg"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert!(said.err.contains("no hardware is called \"airbus-cmg\""), "{}", said.err);
    assert!(said.err.contains("did you mean one of airbus-cmg-15-45s, "), "{}", said.err);
    for (name, help) in [
        ("honeywell-hr16-10", "did you mean \"honeywell-hr16-100\"?"),
        ("flywheel", "`wrasse hardware` lists what there is"),
        ("", "`wrasse hardware` lists what there is"),
    ] {
        let said = Folder::new().wrasse(&["hardware", name]);
        assert!(said.code == 2 && said.err.contains(help), "{name}: {}", said.err);
    }
}

#[test]
fn the_help_shows_how_a_file_names_a_unit() {
    let said = Folder::new().wrasse(&["hardware", "--help"]);
    assert_eq!(said.code, 0);
    assert!(said.out.contains("\n  model = \"honeywell-hr16-100\"\n"), "{}", said.out);
}

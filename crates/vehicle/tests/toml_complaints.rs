//! What a user sees when a TOML vehicle file says what cannot be.

use wrasse_document::{Severity, render};
use wrasse_vehicle::{catalogue, read_vehicle, vehicle_schema};

/// A small vehicle without mistakes.
const GOOD: &str = include_str!("data/small.toml");

/// All that is said about a text.
fn said(text: &str) -> String {
    match read_vehicle("small.toml", text) {
        Ok(vehicle) => render(&vehicle.remarks, false),
        Err(complaints) => render(&complaints, false),
    }
}

/// The vehicle with `from` replaced by `to` gives one complaint, which says all these words.
#[track_caller]
fn assert_says(from: &str, to: &str, severity: &str, words: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must be there once");
    let said = said(&GOOD.replace(from, to));
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with(&format!("\n1 {severity}\n")), "not one {severity}:\n{said}");
}

#[test]
fn a_file_without_mistakes_has_no_remarks() {
    assert_eq!(said(GOOD), "");
}

#[test]
fn all_that_a_file_says_wrong_is_reported_at_once() {
    let text = include_str!("data/many_mistakes.toml");
    let complaints = render(&read_vehicle("many_mistakes.toml", text).unwrap_err(), false);
    assert_eq!(complaints, include_str!("data/many_mistakes.txt"));
}

#[test]
fn a_name_is_not_empty() {
    assert_says("parent = \"carriage\"", "parent = \"\"", "error", &["`parent` must not be empty"]);
    assert_says("\"enough\"", "\"\"", "error", &["`assumed` must not be empty"]);
}

#[test]
fn mass_properties_come_together() {
    assert_says(
        "mass_kg = 5\n",
        "",
        "error",
        &["has `centre_of_mass_m` and `inertia_kgm2`, but not `mass_kg`"],
    );
}

#[test]
fn limits_belong_to_the_kind_of_the_joint() {
    assert_says(
        "rate_m_s = 0.1",
        "rate_deg_s = 10",
        "error",
        &["small.toml:54:1", "joint 'push' slides, and has `rate_deg_s`", "write `rate_m_s`"],
    );
    assert_says(
        "travel_deg = [-90, 90]\n",
        "",
        "error",
        &["joint 'turn' turns, and has no `travel_deg`", "\"continuous\""],
    );
    assert_says(
        "travel_m = [0, 0.5]",
        "travel_m = [0.5, 0]",
        "error",
        &["reversed: lower 0.5 m, upper 0 m"],
    );
    assert_says("kind = \"revolute\"", "kind = \"continuous\"", "error", &["is \"revolute\""]);
    assert_says("axis = [1, 0, 0]\n", "", "error", &["joint 'push' has no `axis`"]);
}

#[test]
fn a_quaternion_has_length_one() {
    assert_says(
        "{ w = 0, x = 0, y = 1, z = 0 }",
        "{ w = 1, x = 0, y = 1, z = 0 }",
        "error",
        &["found 1.414", "w = 0.707106781, x = 0.000000000, y = 0.707106781"],
    );
}

#[test]
fn postures_name_joints_that_move_in_their_unit() {
    assert_says("joints_deg.turn", "joints_deg.trun", "error", &["did you mean 'turn'?"]);
    assert_says("joints_m.push", "joints_deg.push", "error", &["write it in `joints_m`"]);
    assert_says("turn = 45", "turn = 135", "warning", &["beyond its travel from -90 to 90 deg"]);
}

#[test]
fn a_tool_on_no_body_is_a_complaint() {
    assert_says("on = \"boom\"", "on = \"bom\"", "error", &["did you mean 'boom'?"]);
}

#[test]
fn a_shape_is_one_outline() {
    assert_says("box_m = [1, 1, 1]", "position_m = [1, 1, 1]", "error", &["has 0 outlines"]);
    assert_says("box_m = [1, 1, 1]", "box_m = [1, 0, 1]", "error", &["a size of 0 m"]);
}

#[test]
fn an_actuator_that_can_do_nothing_is_a_complaint() {
    assert_says("torque_limit_nm = 20", "torque_limit_nm = 0", "error", &["must be positive"]);
}

#[test]
fn numbers_without_source_are_one_warning() {
    assert_says(
        "source.assumed = \"numbers for a test\"\n",
        "",
        "warning",
        &["body.bus, body.carriage, body.boom, joint.turn, joint.push, tool.tip"],
    );
}

#[test]
fn a_source_of_a_number_that_is_not_there_is_a_complaint() {
    assert_says("source_of.mass_kg", "source_of.mas_kg", "error", &["did you mean `mass_kg`?"]);
}

#[test]
fn published_data_that_cannot_be_are_accepted_with_a_reason() {
    let bad = "xx = 0.1, yy = 1, zz = 3";
    let (good, at_boom) = ("xx = 0.1, yy = 1, zz = 1", "name = \"boom\"\n");
    assert_says(good, bad, "error", &["triangle inequality"]);
    let text = GOOD.replace(good, bad);
    let accepted = format!("{at_boom}accept_nonphysical = \"printed so in the paper\"\n");
    let said = said(&text.replacen(at_boom, &accepted, 1));
    assert!(said.contains("because the file says: printed so in the paper"), "{said}");
    assert!(said.ends_with("\n1 warning\n"), "{said}");
}

#[test]
fn every_source_is_in_the_provenance() {
    let vehicle = read_vehicle("small.toml", GOOD).unwrap();
    let of: Vec<_> = vehicle.provenance.iter().map(|p| p.of.as_str()).collect();
    assert_eq!(
        of,
        ["all else", "body.bus.mass_kg", "joint.sight", "posture.ready", "attitude_actuator"]
    );
}

#[test]
fn what_the_file_says_arrives_in_si() {
    let vehicle = read_vehicle("small.toml", GOOD).unwrap();
    let quarter = core::f64::consts::FRAC_PI_2;
    assert_eq!(vehicle.joint_names, ["turn", "push"]);
    assert_eq!(vehicle.limits[0].travel, Some((-quarter, quarter)));
    assert_eq!(vehicle.limits[0].rate, Some(10.0_f64.to_radians()));
    assert_eq!((vehicle.limits[1].rate, vehicle.limits[1].effort), (Some(0.1), Some(50.0)));
    assert_eq!(vehicle.posture("ready").unwrap().q, [quarter / 2.0, 0.2]);
    assert_eq!(vehicle.attitude_actuator.unwrap().momentum_limit, 40.0);
    assert_eq!(vehicle.tools, ["tip"]);
    assert_eq!(vehicle.shapes.len(), 1);
}

#[test]
fn the_schema_describes_every_key() {
    let schema = vehicle_schema();
    let blocks = schema["$defs"].as_object().unwrap().values().chain([&schema]);
    for block in blocks {
        for (key, property) in block["properties"].as_object().into_iter().flatten() {
            assert!(property["description"].is_string(), "`{key}` has no description");
        }
    }
}

mod never_panics {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    /// Pieces that turn one valid file into another, or into a mistake that is nearly one.
    const PIECES: [&str; 20] = [
        "\n[[body]]\n",
        "\n[[arm.row]]\n",
        "\nkind = \"fixed\"\n",
        "\nname = \"bus\"\n",
        "\"",
        "[",
        "}",
        "1e308",
        "-1e-320",
        "nan",
        "0",
        "99999999999999999999",
        ".deg",
        "ä\u{301}漢",
        "source_of.",
        "axes = { quaternion = { w = 0, x = 0, y = 0, z = 0 } }",
        "rpy_deg",
        "_m",
        "\r\n",
        "#",
    ];

    fn survives(text: &str) -> Result<(), TestCaseError> {
        let complaints = match read_vehicle("fuzz.toml", text) {
            Ok(vehicle) => {
                prop_assert!(vehicle.robot.mass() > 0.0);
                vehicle.remarks
            }
            Err(complaints) => {
                prop_assert!(complaints.iter().any(|c| c.severity == Severity::Error));
                complaints
            }
        };
        prop_assert_eq!(render(&complaints, false).is_empty(), complaints.is_empty());
        Ok(())
    }

    /// One slice of the text deleted, doubled or replaced.
    fn changed(text: &str, what: u8, places: [prop::sample::Index; 2], piece: &str) -> String {
        let chars: Vec<char> = text.chars().collect();
        let [a, length] = places;
        let a = a.index(chars.len().max(1)).min(chars.len());
        let b = (a + length.index(60)).min(chars.len());
        let part = |slice: &[char]| slice.iter().collect::<String>();
        let (before, slice, after) = (part(&chars[..a]), part(&chars[a..b]), part(&chars[b..]));
        match what {
            0 => before + &after,
            1 => before + &slice + &slice + &after,
            2 => before + piece + &after,
            _ => before + piece + &slice + &after,
        }
    }

    fn seeds() -> Vec<&'static str> {
        let arms = include_str!("data/denavit_hartenberg.toml");
        let files = catalogue().iter().filter(|entry| !entry.text.starts_with('<'));
        let equipped = include_str!("data/servicer.toml");
        [GOOD, arms, equipped].into_iter().chain(files.map(|entry| entry.text)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            rng_seed: RngSeed::Fixed(2),
            failure_persistence: None,
            ..ProptestConfig::default()
        })]
        #[test]
        fn arbitrary_text(text in "\\PC*") {
            survives(&text)?;
        }
        #[test]
        fn a_changed_vehicle(
            seed in any::<prop::sample::Index>(),
            changes in prop::collection::vec((0_u8..4, any::<[prop::sample::Index; 2]>(), 0..20_usize), 1..4),
        ) {
            let seeds = seeds();
            let mut text = seeds[seed.index(seeds.len())].replace("CONVENTION", "standard");
            for (what, places, piece) in changes {
                text = changed(&text, what, places, PIECES[piece]);
            }
            survives(&text)?;
        }
    }
}

//! An attitude is written in three ways, and each means the same wherever one is taken.

use std::path::Path;
use wrasse_document::render;
use wrasse_mission::read_mission;

/// A mission whose base, payload, tool and joints are all turned by this attitude.
fn text(attitude: &str) -> String {
    format!(
        "name = \"turned\"\nvehicle = \"two-fingers.toml\"\n\
         [initial]\nposture = \"bent\"\nattitude = {attitude}\n\
         [payload.cube]\nmass_kg = 5\nuniform_box_m = [0.1, 0.1, 0.1]\n\
         free = {{ position_m = [3, 0, 0], attitude = {attitude} }}\n\
         [[phase]]\nname = \"line\"\n\
         move_tool = {{ to_position_m = [1, 1, 0], to_attitude = {attitude}, duration_s = 9 }}\n\
         [[phase]]\nname = \"joints\"\n\
         move_joints = {{ to_tool = {{ position_m = [1, 1, 0], attitude = {attitude}, axes = \"base\" }}, \
         duration_s = 9 }}\n"
    )
}

/// Everything that the attitudes became, as text of five digits.
fn became(attitude: &str) -> Result<String, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/turned.toml");
    let mission = read_mission(file, text(attitude)).map_err(|found| render(&found, false))?;
    let case = &mission.cases[0];
    let motions: Vec<_> =
        case.phases.iter().map(|p| p.step.tasks().next().map(|t| t.motion)).collect();
    Ok(format!("{:.5?} {:.5?} {motions:.5?}", case.start.X_NB, case.payloads[0].start))
}

/// Roll 90 deg, then pitch 90 deg about the fixed y: half the sum of both quaternions and their product,
/// `(1 + j)(1 + i) / 2 = (1 + i + j - k) / 2`.
#[test]
fn roll_pitch_yaw_and_both_quaternions_turn_the_same_way_everywhere() {
    let parts = "{ w = 0.5, x = 0.5, y = 0.5, z = -0.5 }";
    let by_parts = became(parts).expect("a unit quaternion");
    for other in ["{ rpy_deg = [90, 90, 0] }", &format!("{{ quaternion = {parts} }}")] {
        // Zeros may differ in sign.
        let plain = |text: &str| text.replace("-0.00000", "0.00000");
        let found = became(other).unwrap_or_else(|said| panic!("{said}"));
        assert_eq!(plain(&found), plain(&by_parts), "{other}");
    }
    assert_ne!(by_parts, became("{ rpy_deg = [90, 0, 90] }").expect("other angles"));
}

#[test]
fn what_is_no_attitude_is_told_with_what_would_be() {
    for (attitude, words) in [
        ("{ w = 2.0, x = 0.0, y = 0.0, z = 0.0 }", "of length 1 it would be { w = 1.000000000, x"),
        ("{ quaternion = { w = 0, x = 0, y = 0, z = 0 } }", "no rotation is { w = 1, x = 0"),
        ("{ rpy = [0, 0, 0] }", "write `rpy_deg`"),
        ("{ rpy_deg = [0, 0] }", "3"),
    ] {
        let Err(said) = became(attitude) else { panic!("{attitude} is read") };
        assert!(said.contains(words), "no `{words}` in\n{said}");
        assert!(said.ends_with("\n4 errors\n"), "{said}");
    }
}

//! What a user reads when wheels, CMGs, thrusters, sensors or failures are not as they can be.

use wrasse_document::{Complaint, render};
use wrasse_mission::{Mission, read_mission};

/// A mission with all there is, and without mistakes.
const GOOD: &str = r#"name = "small"
vehicle = "atlas-class"

[initial]
posture = "sideways_300mm"

[world]
base_attitude = "controlled"
step_s = 0.005

[[world.applied_wrench]]
on = "tool"
force_n = [5.0, 0.0, 0.0]
from_s = 1.0
duration_s = 4.0
ramp_s = 0.5

[control]
position_hold = { bandwidth_rad_s = 0.2 }

[control.steering.modulation]
lag_s = 0.5

[control.steering.unloading]
begins_at_nms = 15.0
ends_at_nms = 5.0
gain_per_s = 0.5

[actuators]
wheel = [{ name = "w1", model = "honeywell-hr16-100", axis = [1.0, 0.0, 0.0] }]
cmg_array = [{ name = "g", model = "airbus-cmg-15-45s", arrangement = "pyramid", skew_deg = 53.13 }]

[[actuators.thruster_set]]
name = "t"
model = "moog-monarc-5"
arrangement = "box"
count = 12
edges_m = [1.8, 1.6, 1.6]
position_m = [0.0, 0.0, 0.0]

[sensors]
source.assumed = "for this test"
gyro = { model = "rate-gyro-class-fine" }
star_tracker = { boresight = [-1.0, 0.0, 0.0], noise_across_arcsec = 3.0, noise_about_arcsec = 20.0, rate_hz = 4.0, rate_limit_deg_s = 1.0 }

[[failure]]
unit = "g-2"
kind = "stuck"
at_s = 3.0
reported_after_s = 0.5

[[phase]]
name = "hold"
hold = { duration_s = 10.0 }
"#;

fn answer(text: &str) -> Result<Mission, Vec<Complaint>> {
    read_mission("small.toml", text)
}

#[track_caller]
fn complaints(text: &str) -> Vec<Complaint> {
    match answer(text) {
        Ok(mission) => panic!("{} was read without complaint", mission.name),
        Err(complaints) => complaints,
    }
}

/// GOOD with one passage replaced.
#[track_caller]
fn changed(from: &str, to: &str) -> String {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must be there once");
    GOOD.replace(from, to)
}

/// GOOD with one passage replaced gives one error, in the line of what replaces it, which says all these
/// words.
#[track_caller]
fn assert_says(from: &str, to: &str, words: &[&str]) {
    assert_refused(&changed(from, to), to, words);
}

/// A mission gives one error, in the line where `place` stands, which says all these words.
#[track_caller]
fn assert_refused(text: &str, place: &str, words: &[&str]) {
    let line = text.lines().position(|line| line.contains(place)).expect("it is there") + 1;
    let said = render(&complaints(text), false);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.contains(&format!("small.toml:{line}:")), "not at line {line}:\n{said}");
    assert!(said.contains('^'), "no caret:\n{said}");
    assert!(said.ends_with("\n1 error\n"), "not one error:\n{said}");
}

/// A changed mission is read, with one remark that says all these words.
#[track_caller]
fn assert_doubts(text: &str, words: &[&str]) {
    let mission = answer(text).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    let said = render(&mission.remarks, false);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with("\n1 warning\n"), "not one warning:\n{said}");
}

/// From a table's head to the next empty line, left out.
fn without(head: &str) -> String {
    let from = GOOD.find(head).expect("it is there");
    let length = GOOD[from..].find("\n\n").expect("it ends") + 2;
    [&GOOD[..from], &GOOD[from + length..]].concat()
}

#[test]
fn a_mission_with_all_kinds_of_units_is_read_without_a_remark() {
    let mission = answer(GOOD).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    assert!(mission.remarks.is_empty(), "{}", render(&mission.remarks, false));
    let actuators = mission.cases[0].equipment.actuators;
    assert_eq!(
        (actuators.wheels.len(), actuators.cmgs.len(), actuators.thrusters.len()),
        (1, 4, 12)
    );
}

/// A mission with these actuators alone.
fn fitted(actuators: &str) -> String {
    format!(
        "name = \"small\"\nvehicle = \"atlas-class\"\n[world]\nbase_attitude = \"controlled\"\n\
         [actuators]\n{actuators}\n[[phase]]\nname = \"hold\"\nhold = {{ duration_s = 10.0 }}\n"
    )
}

#[test]
fn wheels_whose_axes_lie_in_a_plane_are_refused() {
    let wheel = |name: &str, axis: &str| {
        format!("{{ name = \"{name}\", model = \"honeywell-hr16-100\", axis = {axis} }}")
    };
    let two = [wheel("a", "[1.0, 0.0, 0.0]"), wheel("b", "[0.0, 1.0, 0.0]")].join(", ");
    let words = ["torque in 2 of 3 dimensions", "none about [0, 0, 1]", "three axes"];
    assert_refused(&fitted(&format!("wheel = [{two}]")), "wheel", &words);
}

#[test]
fn thrusters_that_cannot_turn_the_base_about_an_axis_are_refused() {
    let thruster = |i: usize, y: f64, x: f64| {
        format!(
            "{{ name = \"t{i}\", model = \"moog-monarc-5\", position_m = [0.0, {y:?}, 0.0], direction = \
             [{x:?}, 0.0, 0.0] }}"
        )
    };
    let four = [
        thruster(1, 0.8, 1.0),
        thruster(2, 0.8, -1.0),
        thruster(3, -0.8, 1.0),
        thruster(4, -0.8, -1.0),
    ];
    let text = fitted(&format!("thruster = [{}]", four.join(", ")));
    assert_refused(&text, "thruster", &["cannot make a torque about", "+x", "they only push"]);
}

#[test]
fn a_model_that_is_not_in_the_catalogue_is_answered_with_one_that_is() {
    let words = ["honeywell-hr16-1000", "did you mean \"honeywell-hr16-100\""];
    assert_says("hr16-100\"", "hr16-1000\"", &words);
    assert_says("moog-monarc-5", "moog-monark-5", &["did you mean \"moog-monarc-5\""]);
}

#[test]
fn a_unit_that_is_not_there_cannot_fail() {
    let words = ["no wheel, CMG or thruster called \"g2\"", "did you mean \"g-2\"?"];
    assert_says("unit = \"g-2\"", "unit = \"g2\"", &words);
    let nothing = format!(
        "name = \"small\"\nvehicle = \"atlas-class\"\n[[failure]]\nunit = \"w1\"\nkind = \"dead\"\n\
         at_s = 1.0\n[[phase]]\nname = \"hold\"\n{}",
        "hold = { duration_s = 10.0 }\n"
    );
    assert_refused(&nothing, "unit", &["there is no wheel, CMG or thruster at all"]);
}

#[test]
fn a_unit_fails_in_the_way_of_its_kind() {
    let words = ["g-2 cannot fail in this way", "a CMG \"stuck\""];
    assert_says("kind = \"stuck\"", "kind = \"dead\"", &words);
    assert_says(
        "kind = \"stuck\"",
        "kind = \"stucked\"",
        &["\"stucked\"", "did you mean \"stuck\"?"],
    );
    assert_says("at_s = 3.0", "at_s = -3.0", &["`at_s` must not be below zero, found -3"]);
    let words = ["`reported_after_s` must not be below zero"];
    assert_says("reported_after_s = 0.5", "reported_after_s = -0.5", &words);
}

#[test]
fn a_wrench_acts_on_a_frame_that_is_there_and_rises_in_half_its_time_at_most() {
    let words = ["no tool or frame called \"tol\"", "did you mean \"tool\"?"];
    assert_says("on = \"tool\"", "on = \"tol\"", &words);
    let words = ["rises in 2.5 s and falls in 2.5 s, and lasts 4 s", "at most half of duration_s"];
    assert_says("ramp_s = 0.5", "ramp_s = 2.5", &words);
    assert_says("duration_s = 4.0", "duration_s = 0.0", &["`duration_s` must be above zero"]);
}

#[test]
fn unloading_ends_below_where_it_begins() {
    let words = ["would end at 20 N·m·s, before it begins at 15"];
    assert_says("ends_at_nms = 5.0", "ends_at_nms = 20.0", &words);
}

#[test]
fn unloading_takes_thrusters_and_something_to_empty() {
    let bare = changed("position_hold = { bandwidth_rad_s = 0.2 }\n", "");
    let part = |text: &str, head: &str| {
        let from = text.find(head).expect("it is there");
        let length = text[from..].find("\n\n").expect("it ends") + 2;
        [&text[..from], &text[from + length..]].concat()
    };
    let place = "[control.steering.unloading]";
    let no_thrusters = part(&bare, "[[actuators.thruster_set]]");
    assert_refused(&no_thrusters, place, &["unloading takes thrusters: there are none"]);
    let only_thrusters: String = bare
        .lines()
        .filter(|line| !line.starts_with("wheel =") && !line.starts_with("cmg_array ="))
        .map(|line| line.to_owned() + "\n")
        .collect();
    let only_thrusters = part(&only_thrusters, "[[failure]]");
    let words = ["unloading takes wheels or CMGs to empty: there are none"];
    assert_refused(&only_thrusters, place, &words);
    let unlimited = bare.replace("[control]\n", "[control]\nactuators = \"unlimited\"\n");
    assert!(answer(&unlimited).is_ok(), "a comparison with ideal torque keeps its laws");
}

#[test]
fn fitted_actuators_and_sensors_must_be_there() {
    let bare = |control: &str| {
        format!(
            "name = \"small\"\nvehicle = \"atlas-class\"\n[world]\nbase_attitude = \"controlled\"\n\
             [control]\n{control}\n[[phase]]\nname = \"hold\"\nhold = {{ duration_s = 10.0 }}\n"
        )
    };
    let words = ["atlas-class has no wheels, CMGs or thrusters", "add [actuators]"];
    assert_refused(&bare("actuators = \"fitted\""), "actuators", &words);
    assert_refused(&bare("sensing = \"fitted\""), "sensing", &["has no sensors", "add [sensors]"]);
    let words = ["only thrusters can hold a position", "[[actuators.thruster]]"];
    assert_refused(&bare("position_hold = { bandwidth_rad_s = 0.1 }"), "position_hold", &words);
}

/// The estimator reaches back 128 control periods: at 100 Hz a latency of 1.28 s is taken.
#[test]
fn a_star_tracker_that_is_later_than_the_estimator_remembers_is_refused() {
    assert_says(
        "rate_limit_deg_s = 1.0",
        "latency_s = 1.3, rate_limit_deg_s = 1.0",
        &["1.3 s old", "reaches back 1.280 s", "128 control periods at 100 Hz", "at most 98.5"],
    );
    let late = changed("rate_limit_deg_s = 1.0", "latency_s = 1.28, rate_limit_deg_s = 1.0");
    let mission = answer(&late).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    assert!(mission.remarks.is_empty(), "{}", render(&mission.remarks, false));
}

#[test]
fn a_gyro_without_a_star_tracker_is_refused() {
    let from = GOOD.find("star_tracker = ").expect("it is there");
    let length = GOOD[from..].find('\n').expect("it ends") + 1;
    let text = [&GOOD[..from], &GOOD[from + length..]].concat();
    assert_refused(
        &text,
        "gyro = {",
        &["have `gyro`, but not `star_tracker`", "attitude takes both"],
    );
}

#[test]
fn a_step_that_is_too_long_for_a_servo_is_refused() {
    let array = "skew_deg = 53.13 }";
    let fast =
        "skew_deg = 53.13, servo_bandwidth_rad_s = 1000.0, source.assumed = \"for this test\" }";
    let words = [
        "a step of 0.005 s is too long for the servo of CMG g-4, 1000 rad/s",
        "within 0.001 s",
        "set world.step_s to 0.001 or less",
    ];
    assert_refused(&changed(array, fast), "step_s = 0.005", &words);
    let fine = changed(array, fast).replace("step_s = 0.005", "step_s = 0.001");
    assert!(answer(&fine).is_ok());
    let adaptive = changed(array, fast).replace("step_s = 0.005", "adaptive_tolerance = 1e-9");
    assert!(answer(&adaptive).is_ok());
}

#[test]
fn a_modulation_that_does_not_suit_the_thrusters_is_doubted() {
    let words = ["pulses down to 0.01 s", "opens for 0.02 s at least", "raise lag_s"];
    assert_doubts(&changed("lag_s = 0.5", "lag_s = 0.2"), &words);
    let slow = changed("[control]\n", "[control]\nrate_hz = 10.0\n");
    assert_doubts(
        &slow,
        &["lag of the modulation is 0.5 s, and a control period 0.1 s", "1 s, or more"],
    );
    let words = ["it opens at 0.25 and would shut at 0.5"];
    assert_says("lag_s = 0.5", "shuts_at = 0.5", &words);
    assert_says("lag_s = 0.5", "gain = -1.0", &["`gain` must be above zero, found -1"]);
}

#[test]
fn what_is_doubted_in_several_cases_is_said_once() {
    let rows = "[[compare]]\naxis = \"a\"\nrow = [{ name = \"1\" }, { name = \"2\" }]\n";
    let text = [&changed("lag_s = 0.5", "lag_s = 0.2"), rows].concat();
    assert_doubts(&text, &["pulses down to 0.01 s"]);
}

#[test]
fn numbers_that_cannot_be_are_refused_wherever_they_stand() {
    for (from, key) in [
        ("force_n = [5.0,", "force_n = ["),
        ("from_s = 1.0", "from_s = "),
        ("ramp_s = 0.5", "ramp_s = "),
        ("begins_at_nms = 15.0", "begins_at_nms = "),
        ("gain_per_s = 0.5", "gain_per_s = "),
        ("bandwidth_rad_s = 0.2", "bandwidth_rad_s = "),
        ("lag_s = 0.5", "lag_s = "),
        ("at_s = 3.0", "at_s = "),
    ] {
        for bad in ["nan", "inf", "-inf", "\"1\""] {
            let to = format!("{key}{bad}{}", if from.ends_with(',') { "," } else { "" });
            let said = render(&complaints(&changed(from, &to)), false);
            assert!(said.contains("small.toml:") && said.contains('^'), "{to}:\n{said}");
        }
    }
    let seed = "name = \"small\"\nseed = -1";
    let said = render(&complaints(&changed("name = \"small\"", seed)), false);
    assert!(said.contains("seed") && said.contains("small.toml:2:8"), "{said}");
}

#[test]
fn all_mistakes_of_base_control_are_said_at_once() {
    let text = GOOD
        .replace("on = \"tool\"", "on = \"tol\"")
        .replace("ramp_s = 0.5", "ramp_s = 2.5")
        .replace("ends_at_nms = 5.0", "ends_at_nms = 20.0")
        .replace("unit = \"g-2\"", "unit = \"g2\"")
        .replace("at_s = 3.0", "at_s = -3.0")
        .replace("bandwidth_rad_s = 0.2", "bandwidth_rad_s = 0.0");
    let said = render(&complaints(&text), false);
    assert!(said.ends_with("\n6 errors\n"), "{said}");
}

#[test]
fn of_actuators_that_cannot_be_read_nothing_is_said_to_be_missing() {
    let text = changed("moog-monarc-5", "moog-monark-5")
        .replace("unit = \"g-2\"\nkind = \"stuck\"", "unit = \"t-2\"\nkind = \"shut\"");
    assert_refused(&text, "moog-monark-5", &["did you mean \"moog-monarc-5\""]);
}

#[test]
fn failures_of_units_that_do_not_act_are_doubted() {
    let held = changed("base_attitude = \"controlled\"", "base_attitude = \"held\"");
    let held = held.replace("position_hold = { bandwidth_rad_s = 0.2 }\n", "");
    assert_doubts(&held, &["the base is held exactly", "their failures change nothing"]);
}

#[test]
fn actuators_without_a_source_are_read_with_the_catalogues() {
    let text = without("[sensors]");
    let mission = answer(&text).unwrap_or_else(|c| panic!("{}", render(&c, false)));
    let sources = &mission.cases[0].equipment.provenance;
    assert!(sources.iter().any(|p| p.source.contains("Honeywell")), "{sources:?}");
}

#[test]
fn names_that_control_moment_gyros_had_are_answered_with_those_they_have() {
    assert_says(
        "cmg_array = ",
        "gyro_array = ",
        &["unknown key `gyro_array`", "`gyro_array` was renamed: write `cmg_array`"],
    );
    for (old, value) in [("gyros", "\"pseudo-inverse\""), ("gyro_null_gain_rad_s", "0.1")] {
        let new = old.replace("gyro", "cmg");
        let line = format!("[control.steering]\n{old} = {value}\n\n[sensors]");
        let help = format!("`{old}` was renamed: write `{new}`");
        assert_refused(&changed("[sensors]", &line), &format!("{old} ="), &[&help]);
    }
    let asked = "requirements = [\"gyros.rate_use.max <= 50 %\"]\n\n[initial]";
    let help = "gyros.rate_use.max was renamed: write cmgs.rate_use.max";
    assert_refused(&changed("[initial]", asked), "gyros.rate_use", &[help]);
}

#[test]
fn keys_that_were_renamed_are_answered_with_their_new_names() {
    let renamed = |old: &str, new: &str| format!("`{old}` was renamed: write `{new}`");
    let help = renamed("told_after_s", "reported_after_s");
    assert_says("reported_after_s", "told_after_s", &[&help]);
    let help = renamed("feel_tool_wrench", "measure_tool_wrench");
    let text = changed("[control]", "[control]\nfeel_tool_wrench = true");
    assert_refused(&text, "feel_tool_wrench", &[&help]);
    let phase = "[[phase]]\nname = \"lean\"\nrelieve = { duration_s = 9.0 }\n\n[[phase]]";
    let text =
        changed("[[phase]]", phase).replace("[control]", "[control]\nmeasure_tool_wrench = true");
    assert_refused(&text, "relieve =", &[&renamed("relieve", "unload_by_posture")]);
}

//! What a user sees when actuators and sensors of a vehicle file cannot be.

use wrasse_document::render;
use wrasse_vehicle::read_vehicle;

/// A servicer without mistakes.
const GOOD: &str = include_str!("data/servicer.toml");

/// The servicer's bus and nothing else.
fn bus() -> &'static str {
    GOOD.split_once("[[actuators.wheel]]").expect("a wheel").0
}

/// All that is said about a text.
fn said(text: &str) -> String {
    match read_vehicle("servicer.toml", text) {
        Ok(vehicle) => render(&vehicle.remarks, false),
        Err(complaints) => render(&complaints, false),
    }
}

/// The text gives one complaint, which says all these words.
#[track_caller]
fn assert_said(text: &str, severity: &str, words: &[&str]) {
    let said = said(text);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with(&format!("\n1 {severity}\n")), "not one {severity}:\n{said}");
}

/// The servicer with `from` replaced by `to` gives one complaint, which says all these words.
#[track_caller]
fn assert_says(from: &str, to: &str, severity: &str, words: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must be there once");
    assert_said(&GOOD.replace(from, to), severity, words);
}

/// The bus with these actuators alone gives one complaint, which says all these words.
#[track_caller]
fn assert_bus_says(actuators: &str, severity: &str, words: &[&str]) {
    assert_said(&format!("{}{actuators}", bus()), severity, words);
}

fn wheel(name: &str, axis: &str) -> String {
    format!(
        "[[actuators.wheel]]\nname = \"{name}\"\nmodel = \"honeywell-hr14-50\"\naxis = {axis}\n"
    )
}

fn cmg(name: &str, gimbal: &str, spin: &str) -> String {
    format!(
        "[[actuators.cmg]]\nname = \"{name}\"\nmodel = \"airbus-cmg-15-45s\"\ngimbal_axis = \
         {gimbal}\nspin_axis = {spin}\n"
    )
}

fn thruster(name: &str, position: &str, direction: &str) -> String {
    format!(
        "[[actuators.thruster]]\nname = \"{name}\"\nmodel = \"moog-monarc-22-6\"\nposition_m = \
         {position}\ndirection = {direction}\n"
    )
}

#[test]
fn equipment_without_mistakes_has_no_remarks() {
    assert_eq!(said(GOOD), "");
}

#[test]
fn all_that_actuators_say_wrong_is_reported_at_once() {
    let text = include_str!("data/wrong_equipment.toml");
    let complaints = render(&read_vehicle("wrong_equipment.toml", text).unwrap_err(), false);
    assert_eq!(complaints, include_str!("data/wrong_equipment.txt"));
}

#[test]
fn a_model_that_is_not_there_finds_the_nearest() {
    assert_says(
        "model = \"honeywell-hr16-100\"\naxis = [2, 0, 0]",
        "model = \"honeywel-hr16-100\"\naxis = [2, 0, 0]",
        "error",
        &[
            "servicer.toml:13:9",
            "no reaction wheel of the hardware catalogue is called \"honeywel-hr16-100\"",
            "did you mean \"honeywell-hr16-100\"?",
        ],
    );
    assert_says(
        "\"airbus-cmg-15-45s\"",
        "\"moog-monarc-1\"",
        "error",
        &["no control moment gyro", "\"moog-monarc-1\" is a thruster"],
    );
    assert_says("\"moog-monarc-445\"", "\"F-1\"", "error", &["the catalogue has moog-monarc-1,"]);
    assert_says("rate-gyro-class-usual", "rate-gyro-usual", "error", &["no rate gyro"]);
}

#[test]
fn numbers_that_are_missing_are_named() {
    assert_says(
        "inertia_kgm2 = 0.16\n",
        "",
        "error",
        &["wheel 'wheel-y' has no `inertia_kgm2`", "name a `model`"],
    );
    assert_says("specific_impulse_s = 220\n", "", "error", &["has no `specific_impulse_s`"]);
    let lone = "gimbal_axis = [0, 0, 1]\nspin_axis = [0, -3, 0]";
    let without = GOOD.replace(&format!("model = \"airbus-cmg-15-45s\"\n{lone}"), lone);
    assert_said(
        &without,
        "error",
        &["CMG 'lone' has no `momentum_nms`, no `gimbal_acceleration_limit_deg_s2`, no"],
    );
}

#[test]
fn numbers_that_follow_from_each_other_agree() {
    assert_says(
        "inertia_kgm2 = 0.16\n",
        "inertia_kgm2 = 0.16\nmomentum_nms = 90\n",
        "error",
        &["0.16 kg·m² at 6000 rpm are 100.5 N·m·s, and `momentum_nms` says 90"],
    );
    assert_says(
        "torque_limit_nm = 30\n",
        "torque_limit_nm = 30\ngimbal_rate_limit_deg_s = 57.3\n",
        "error",
        &["its momentum at 57.3 deg/s makes 15 N·m, and `torque_limit_nm` says 30"],
    );
}

#[test]
fn a_number_that_cannot_be_is_an_error_and_one_that_no_unit_has_a_warning() {
    assert_says("force_n = 20", "force_n = -20", "error", &["must be positive, found -20"]);
    assert_says(
        "friction_nm = 0",
        "friction_nm = -1",
        "error",
        &["must be zero or more, found -1"],
    );
    assert_says("propellant_kg = 120", "propellant_kg = -1", "error", &["zero or more, found -1"]);
    assert_says("rate_hz = 4", "rate_hz = 0", "error", &["`rate_hz` of the star tracker"]);
    assert_says("step_deg = 0.01", "step_deg = -0.01", "error", &["zero or more, found -0.01"]);
    assert_says(
        "torque_limit_nm = 0.2\n",
        "torque_limit_nm = 1e4\n",
        "warning",
        &["is 10000: units that are known have 1e-5 to 10"],
    );
    assert_says("position_m = [-0.9, 0, 0]", "position_m = [-900, 0, 0]", "warning", &["is 900 m"]);
}

#[test]
fn a_direction_is_not_zero() {
    assert_says("axis = [2, 0, 0]", "axis = [0, 0, 0]", "error", &["`axis` of wheel 'wheel-x'"]);
    assert_says("direction = [3, 0, 0]", "direction = [0, 0, 0]", "error", &["has no direction"]);
    assert_says("boresight = [0, 0, -2]", "boresight = [0, 0, 0]", "error", &["`boresight`"]);
}

#[test]
fn a_spin_axis_is_across_its_gimbal_axis() {
    assert_says(
        "spin_axis = [0, -3, 0]",
        "spin_axis = [0, 1, 1]",
        "error",
        &["found 45 deg between them", "the nearest direction across it is [0, 1, 0]"],
    );
    assert_says("spin_axis = [0, -3, 0]", "spin_axis = [0, 0, 1]", "error", &["are parallel"]);
}

#[test]
fn a_wheel_turns_and_starts_within_its_speed() {
    assert_says("speed_rpm = 600", "speed_rpm = 6600", "error", &["beyond its 6000 rpm"]);
    assert_says(
        "axis = [2, 0, 0]",
        "axis = [2, 0, 0]\ntorque_limit_nm = 0.0004",
        "error",
        &["wheel 'wheel-x' never turns: its Coulomb friction of 0.0005 N·m"],
    );
}

#[test]
fn wheels_and_cmgs_that_do_not_span_name_the_missing_direction() {
    let two = wheel("a", "[1, 0, 0]") + &wheel("b", "[1, 1, 0]");
    let words = ["the wheels make torque in 2 of 3 dimensions: none about [0, 0, 1]"];
    assert_bus_says(&two, "error", &words);
    let flat = two + &wheel("c", "[1, -1, 0]") + &wheel("d", "[0, 1, 0]");
    assert_bus_says(&flat, "error", &words);
    assert_bus_says(
        &wheel("a", "[0, 1, 0]"),
        "error",
        &["in 1 of 3 dimensions: about [0, 1, 0] alone"],
    );
    let parallel: String = ["a", "b", "c"].map(|name| cmg(name, "[0, 3, 4]", "[1, 0, 0]")).concat();
    assert_bus_says(&parallel, "error", &["the CMGs make", "none about [0, 0.6, 0.8]"]);
}

#[test]
fn wheels_make_up_for_cmgs_that_do_not_span() {
    let pair = cmg("a", "[0, 0, 1]", "[1, 0, 0]") + &cmg("b", "[0, 0, 1]", "[0, 1, 0]");
    let both = format!("{}{pair}{}", bus(), wheel("w", "[0, 0, 1]"));
    assert_eq!(said(&both), "");
}

#[test]
fn cmgs_that_start_singular_are_doubted() {
    assert_bus_says(
        "[[actuators.cmg_array]]\nname = \"box\"\nmodel = \"airbus-cmg-15-45s\"\narrangement = \
         \"box\"\ngimbal_angles_deg = [0, 0, 0, 0]\n",
        "warning",
        &["at the start the CMGs are singular: about [0, 0, 1] alone"],
    );
}

#[test]
fn an_array_is_given_by_what_its_arrangement_needs() {
    assert_says(
        "skew_deg = 54.74\n",
        "",
        "error",
        &["CMG array 'cluster' has no `skew_deg`: the angle between gimbal axes and z"],
    );
    assert_says("skew_deg = 54.74", "skew_deg = 180", "error", &["between 0 and 180"]);
    assert_says("= \"pyramid\"", "= \"box\"", "error", &["`skew_deg`, which says nothing"]);
    assert_says("= \"pyramid\"", "= \"roof\"", "error", &["has no `count`"]);
    assert_says("= \"pyramid\"", "= \"roof\"\ncount = 5", "error", &["has 5 CMGs"]);
    assert_says("= \"pyramid\"", "= \"piramid\"", "error", &["did you mean \"pyramid\"?"]);
    assert_says(
        "skew_deg = 54.74",
        "skew_deg = 54.74\ngimbal_angles_deg = [1, 2, 3]",
        "error",
        &["has 4 CMGs and 3 gimbal angles"],
    );
    assert_says("count = 12", "count = 14", "error", &["has 14 thrusters", "12, 16 or 24"]);
    assert_says("edges_m = [1.8,", "edges_m = [0,", "error", &["must be positive"]);
}

#[test]
fn thrusters_that_cannot_turn_the_vehicle_name_the_way() {
    // Four on the rear face, pushing forward: no torque about x, and none pushes back.
    let rear =
        [("[-1, 1, 0]", "a"), ("[-1, -1, 0]", "b"), ("[-1, 0, 1]", "c"), ("[-1, 0, -1]", "d")];
    let four: String = rear.map(|(at, name)| thruster(name, at, "[1, 0, 0]")).concat();
    assert_bus_says(&four, "error", &["cannot make a torque about +x, -x alone"]);
    let three = four.split("[[actuators.thruster]]\nname = \"d\"").next().unwrap();
    assert_bus_says(three, "error", &["+x, -x, -y alone"]);
    // Beside wheels it is a doubt.
    let wheels = wheel("x", "[1, 0, 0]") + &wheel("y", "[0, 1, 0]") + &wheel("z", "[0, 0, 1]");
    let words = ["about +x, -x alone", "cannot be unloaded"];
    assert_bus_says(&format!("{wheels}{four}"), "warning", &words);
}

#[test]
fn the_lever_of_a_thruster_is_from_the_centre_of_mass() {
    // Through the centre of mass of the bus, until propellant moves it.
    let through = thruster("a", "[-1, 0, 0]", "[1, 0, 0]");
    let words = ["+x, -x, +y, -y, +z, -z alone", "is at [0, 0, 0] m"];
    assert_bus_says(&through, "error", &words);
    let tank = "[actuators.tank]\npropellant_kg = 500\nposition_m = [0, 0, 0.4]\n";
    let words = ["+x, -x, +y, +z, -z alone", "is at [0, 0, 0.1] m"];
    assert_bus_says(&format!("{through}{tank}"), "error", &words);
}

#[test]
fn units_fit_the_vehicle() {
    let nine: String = (0..9).map(|k| wheel(&format!("w{k}"), "[1, 2, 3]")).collect();
    assert!(said(&format!("{}{nine}", bus())).contains("9 wheels: a vehicle has at most 8"));
    assert_says("count = 12", "count = 24", "error", &["25 thrusters: a vehicle has at most 24"]);
}

/// Three wheels along the axes, each with these lines too.
fn three_wheels(each: &str) -> String {
    [("x", "[1, 0, 0]"), ("y", "[0, 1, 0]"), ("z", "[0, 0, 1]")]
        .map(|(name, axis)| wheel(name, axis) + each)
        .concat()
}

#[test]
fn units_are_lighter_than_the_base_that_they_are_part_of() {
    assert_bus_says(
        &three_wheels("mass_kg = 500\n"),
        "error",
        &["the actuators weigh 1500 kg, and the base with them 1500 kg"],
    );
    assert_bus_says(
        &three_wheels("momentum_nms = 2000\nspeed_limit_rpm = 20\n"),
        "error",
        &["turn 954.9 kg·m² about their axes, and the base with them has 640, 725, 725 kg·m²"],
    );
}

#[test]
fn two_units_have_two_names() {
    let words = ["two units are called 'wheel-x'; the other is on line 12"];
    assert_says("name = \"lone\"", "name = \"wheel-x\"", "error", &words);
    let words = ["two units are called 'cluster'; the other is on line 41"];
    assert_says("name = \"box\"", "name = \"cluster\"", "error", &words);
    // An array calls its units by numbers.
    assert_says("name = \"main\"", "name = \"box-3\"", "error", &["are called 'box-3'"]);
}

#[test]
fn attitude_takes_both_sensors() {
    let (gyro, tracker) = GOOD.split_once("star_tracker = ").unwrap();
    assert_said(gyro, "error", &["the sensors have `gyro`, but not `star_tracker`"]);
    let (before, _) = gyro.split_once("gyro = { model").unwrap();
    let alone = format!("{before}star_tracker = {tracker}");
    assert_said(&alone, "error", &["the sensors have `star_tracker`, but not `gyro`"]);
}

#[test]
fn numbers_without_source_are_in_the_one_warning() {
    let source = "source.assumed = \"numbers for a test\"\n";
    assert_says(source, "", "warning", &["body.bus, actuators.wheel.wheel-x", "and 6 more"]);
    let text = GOOD.replace(source, "").replace("[sensors]\n", &format!("[sensors]\n{source}"));
    assert_said(&text, "warning", &["and 3 more"]);
}

#[test]
fn a_key_without_its_unit_is_told_the_unit() {
    assert_says("force_n = 20", "force = 20", "error", &["write `force_n`"]);
    assert_says("axis = [2, 0, 0]", "axes = [2, 0, 0]", "error", &["did you mean `axis`?"]);
}

/// The rate sensor keeps the word `gyro`.
#[test]
fn names_that_control_moment_gyros_had_are_answered_with_those_they_have() {
    for (new, old) in [("[[actuators.cmg]]", "gyro"), ("[[actuators.cmg_array]]", "gyro_array")] {
        let help = format!("`{old}` was renamed: write `{}`", old.replace("gyro", "cmg"));
        assert_says(new, &new.replace("cmg", "gyro"), "error", &["unknown key", &help]);
    }
    let help = "\"gyro-class-125\" was renamed: write \"cmg-class-125\"";
    assert_says("\"airbus-cmg-15-45s\"", "\"gyro-class-125\"", "error", &[help]);
}

//! The table `[actuators.tank.slosh]`: what it becomes, and what a user sees where it cannot be.

use wrasse_document::render;
use wrasse_hardware::TankShape;
use wrasse_spatial::vec3;
use wrasse_vehicle::{Grade, Vehicle, read_vehicle};

const GOOD: &str = include_str!("data/servicer.toml");

/// 120 kg in a sphere that holds 268 kg.
const SPHERE: &str = "sphere = { radius_m = 0.4 }";
const SLOSH: &str = "\n[actuators.tank.slosh]\naxis = [2.0, 0, 0]\ndensity_kg_m3 = 1000\n\
                     damping_ratio = 0.02\nacceleration_m_s2 = 0.1\n\
                     source_of.damping_ratio.assumed = \"a smooth wall\"\n";

/// The servicer's file with these lines in its table for slosh.
fn text(lines: &str) -> String {
    let (above, below) = GOOD.split_once("\n[sensors]").expect("sensors come next");
    format!("{above}{SLOSH}{lines}\n\n[sensors]{below}")
}

fn vehicle(lines: &str) -> Vehicle {
    let vehicle = read_vehicle("servicer.toml", text(lines));
    vehicle.unwrap_or_else(|c| panic!("{}", render(&c, false)))
}

/// One complaint about the text, which says all these words.
#[track_caller]
fn assert_said(text: String, severity: &str, words: &[&str]) {
    let said = match read_vehicle("servicer.toml", text) {
        Ok(vehicle) => render(&vehicle.remarks, false),
        Err(complaints) => render(&complaints, false),
    };
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with(&format!("\n1 {severity}\n")), "not one {severity}:\n{said}");
}

/// The table with a sphere and `from` replaced by `to`.
#[track_caller]
fn assert_says(from: &str, to: &str, severity: &str, words: &[&str]) {
    let good = text(SPHERE);
    assert_eq!(good.matches(from).count(), 1, "`{from}` must be there once");
    assert_said(good.replace(from, to), severity, words);
}

#[test]
fn the_slosh_arrives_with_its_shape_and_its_sources() {
    let vehicle = vehicle(SPHERE);
    assert_eq!(render(&vehicle.remarks, false), "");
    let slosh = vehicle.equipment.slosh.expect("it swings");
    assert_eq!(slosh.axis_B, vec3(1.0, 0.0, 0.0));
    assert_eq!(slosh.shape, TankShape::Sphere { radius: 0.4 });
    assert_eq!((slosh.density, slosh.damping_ratio), (1000.0, 0.02));
    assert_eq!((slosh.acceleration, slosh.stiffness), (0.1, 0.0));
    let rows = vehicle.provenance.iter().chain(&vehicle.equipment.provenance);
    let row = rows.clone().find(|row| row.of == "actuators.tank.slosh.damping_ratio");
    assert_eq!(row.map(|row| row.grade), Some(Grade::Assumed));
    let upright = "cylinder = { radius_m = 0.3, height_m = 0.5 }\nstiffness_nm_rad = 0.4";
    let slosh = self::vehicle(upright).equipment.slosh.expect("it swings");
    assert_eq!(slosh.shape, TankShape::UprightCylinder { radius: 0.3, height: 0.5 });
    assert_eq!(slosh.stiffness, 0.4);
}

#[test]
fn a_tank_without_the_table_does_not_slosh() {
    let vehicle = read_vehicle("servicer.toml", GOOD).expect("no complaints");
    assert_eq!(vehicle.equipment.slosh, None);
}

#[test]
fn a_tank_has_one_shape() {
    let words =
        ["takes one shape of the tank, found none", "[actuators.tank.slosh]", "cylinder = {"];
    assert_said(text(""), "error", &words);
    let two = format!("{SPHERE}\ncylinder = {{ radius_m = 0.3, height_m = 0.5 }}");
    assert_said(text(&two), "error", &["one shape of the tank, found two"]);
}

#[test]
fn numbers_of_the_slosh_can_be() {
    let words = ["`axis` of the slosh of the tank has no direction", "found [0, 0, 0]"];
    assert_says("axis = [2.0, 0, 0]", "axis = [0, 0, 0]", "error", &words);
    let words = ["`density_kg_m3` of the slosh of the tank must be positive, found -1"];
    assert_says("density_kg_m3 = 1000", "density_kg_m3 = -1", "error", &words);
    let words = ["`radius_m` of the slosh of the tank must be positive, found 0"];
    assert_says("radius_m = 0.4", "radius_m = 0", "error", &words);
    let words = ["`damping_ratio` of the slosh of the tank must be less than 1, found 1.5"];
    let said = read_vehicle("servicer.toml", text(SPHERE).replace("ratio = 0.02", "ratio = 1.5"));
    let said = render(&said.expect_err("more than critical"), false);
    assert!(said.contains(words[0]), "{said}");
    // In g/cm³.
    let words = ["`density_kg_m3` of the slosh of the tank is 1", "is it in the unit of its key?"];
    let said = read_vehicle("servicer.toml", text(SPHERE).replace("m3 = 1000", "m3 = 1.0"));
    let said = render(&said.expect_err("it does not fit either"), false);
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn a_damping_ratio_is_that_of_a_swing_that_is_restored() {
    let words = ["is that of a swing which nothing restores", "the thrust over the mass"];
    assert_says("acceleration_m_s2 = 0.1", "acceleration_m_s2 = 0", "error", &words);
    let sprung = text(SPHERE).replace("acceleration_m_s2", "stiffness_nm_rad");
    let sprung = read_vehicle("servicer.toml", sprung).expect("a spring restores it");
    assert_eq!(sprung.equipment.slosh.map(|slosh| slosh.stiffness), Some(0.1));
}

#[test]
fn propellant_fits_into_its_tank() {
    let words = [
        "`propellant_kg` of the tank is 120 kg, and its inside holds 113.1 kg of 1000 kg/m³",
        "propellant_kg = 120",
        "a larger tank, or less propellant",
    ];
    assert_says("radius_m = 0.4", "radius_m = 0.3", "error", &words);
}

#[test]
fn propellant_that_is_too_little_or_too_much_to_swing_is_a_doubt() {
    let words = ["it fills 0.373 % of the tank, 0.02855 m deep", "a mass at rest"];
    assert_says("propellant_kg = 120", "propellant_kg = 1", "warning", &words);
    let words = ["it fills 99.86 % of the tank", "no slosh"];
    assert_says("propellant_kg = 120", "propellant_kg = 267.7", "warning", &words);
}

#[test]
fn a_key_that_is_meant_is_named() {
    let said =
        read_vehicle("servicer.toml", text(SPHERE).replace("\ndamping_ratio", "\ndamping_ration"));
    let said = render(&said.expect_err("no such key"), false);
    assert!(said.contains("did you mean `damping_ratio`?"), "{said}");
}

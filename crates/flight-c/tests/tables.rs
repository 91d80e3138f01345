//! The vehicle tables of the C example and of the firmware are those of the catalogue.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod vehicle_tables;

use std::fmt::Write;
use std::path::Path;
use std::{env, fs};
use vehicle_tables::{table, tool, vehicle};
use wrasse_dynamics::{State, kinematics, mass_matrix};
use wrasse_flight_c::{
    WrasseBody, WrasseFrame, WrasseJoint, WrasseLink, frame_from_table, robot_from_tables,
};
use wrasse_testing::largest;
use wrasse_vehicle::{JOINTS, Vehicle};

/// A vehicle as Rust: constants that are printed as the language writes them.
fn in_rust(vehicle: &Vehicle) -> String {
    let (base, links) = table(vehicle);
    let mut text = format!("//! `{}` of the catalogue as a table.\n\n", vehicle.name);
    text += "use wrasse_flight_c::{WrasseBody, WrasseFrame, WrasseJoint, WrasseLink};\n\n";
    writeln!(text, "#[rustfmt::skip]\npub(crate) const BASE: WrasseBody = {base:?};\n").unwrap();
    let frame = tool(vehicle);
    writeln!(text, "#[rustfmt::skip]\npub(crate) const TOOL: WrasseFrame = {frame:?};\n").unwrap();
    let count = links.len();
    writeln!(text, "#[rustfmt::skip]\npub(crate) const LINKS: [WrasseLink; {count}] = [").unwrap();
    for link in &links {
        writeln!(text, "    {link:?},").unwrap();
    }
    text + "];\n"
}

/// Compare with the file; with `WRASSE_WRITE=1` write it.
#[track_caller]
fn check(file: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    if env::var_os("WRASSE_WRITE").is_some() {
        fs::write(&path, text).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == text, "{file} is out of date: WRASSE_WRITE=1 cargo test -p wrasse-flight-c");
}

#[test]
fn tables_of_the_firmware_are_those_of_the_catalogue() {
    for (name, file) in
        [("atlas-class", "atlas_class.rs"), ("atlas-class-two-arms", "atlas_class_two_arms.rs")]
    {
        check(&format!("embedded/golden/src/{file}"), &in_rust(&vehicle(name)));
    }
}

/// The table says what the vehicle file says: same mass, same place of the tool, same inertia seen
/// from the base. Measured 0, and 0 of the largest element.
#[test]
fn a_robot_from_its_table_is_the_robot_of_the_catalogue() {
    let vehicle = vehicle("atlas-class-two-arms");
    let (base, links) = table(&vehicle);
    let robot = robot_from_tables::<f64, JOINTS>(&base, &links).unwrap();
    let mut state = State::default();
    for j in robot.joints() {
        state.q[j] = 0.3 * f64::from(u8::try_from(j).unwrap()) - 1.0;
    }
    let frame = frame_from_table(&tool(&vehicle));
    let (k, expected) = (kinematics(&robot, &state), kinematics(&vehicle.robot, &state));
    let apart = k.pose(&frame).translation - expected.pose(&frame).translation;
    let (M, M_expected) =
        (mass_matrix(&k).M_bb.to_matrix(), mass_matrix(&expected).M_bb.to_matrix());
    let differences =
        M.iter().flatten().zip(M_expected.iter().flatten()).map(|(a, b)| (a - b).abs());
    let apart_by_mass = largest(differences) / M_expected[0][0];
    assert_eq!(robot.joint_count(), vehicle.robot.joint_count());
    assert!(apart.norm() < 1e-14 && apart_by_mass < 1e-14, "{} m, {apart_by_mass}", apart.norm());
}

/// A vehicle as C. Rust's nested arrays are C's with braces.
fn in_c(vehicle: &Vehicle, prefix: &str) -> String {
    let (base, links) = table(vehicle);
    let numbers = |debug: String| debug.replace('[', "{").replace(']', "}");
    let body = |b: &WrasseBody| {
        let WrasseBody { mass, centre_of_mass, inertia } = b;
        numbers(format!("{{{mass:?}, {centre_of_mass:?}, {inertia:?}}}"))
    };
    let mut text = format!("/* `{}` of the catalogue as a table. */\n", vehicle.name);
    text += "#include \"wrasse_flight.h\"\n\n";
    writeln!(text, "static const WrasseBody {prefix}_BASE = {};\n", body(&base)).unwrap();
    let WrasseFrame { link, position, rotation } = tool(vehicle);
    let frame = numbers(format!("{{{link}, {position:?}, {rotation:?}}}"));
    writeln!(text, "static const WrasseFrame {prefix}_TOOL = {frame};\n").unwrap();
    writeln!(text, "#define {prefix}_LINK_COUNT {}\n", links.len()).unwrap();
    writeln!(text, "static const WrasseLink {prefix}_LINKS[{prefix}_LINK_COUNT] = {{").unwrap();
    for WrasseLink { joint, body: b } in &links {
        let WrasseJoint { parent, sliding, position, rotation, axis } = joint;
        let joint = format!("{{{parent}, {sliding}, {position:?}, {rotation:?}, {axis:?}}}");
        writeln!(text, "    {{{},\n     {}}},", numbers(joint), body(b)).unwrap();
    }
    text + "};\n"
}

#[test]
fn the_table_of_the_example_in_c_is_that_of_the_catalogue() {
    check("crates/flight-c/c/atlas_class.h", &in_c(&vehicle("atlas-class"), "ATLAS_CLASS"));
}

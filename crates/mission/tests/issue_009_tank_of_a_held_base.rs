//! A held base dropped its tank: the same recoil with 0, 30 and 600 kg of propellant, and a word of an
//! empty tank where no thruster acts.
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

use wrasse_document::render;
use wrasse_mission::{read_mission, run};
use wrasse_rehearsal::{CaseOutcome, EventKind, RunOptions};

/// A load of 200 kg is moved by 0.2 m within 5 s, with the base `held` or `controlled` by what has no
/// limits, and this much propellant (kg) beside the centre of mass.
fn flown(base: &str, propellant: f64) -> CaseOutcome {
    let text = format!(
        r#"
name = "tank"
vehicle = "atlas-class"
[initial]
posture = "sideways_300mm"
[payload.module]
mass_kg = 200.0
centre_of_mass_m = [0.5, 0.0, 0.0]
uniform_box_m = [1.0, 1.0, 1.0]
held_by = "tool"
[world]
base_attitude = "{base}"
joints = "torque"
[control]
arm_law = "attitude-held"
actuators = "unlimited"
measurement = "base"
[actuators.tank]
propellant_kg = {propellant:?}
position_m = [-0.2, 0.1, -0.3]
[[actuators.thruster_set]]
name = "jet"
model = "moog-monarc-22-6"
arrangement = "box"
count = 24
edges_m = [1.8, 1.6, 1.6]
position_m = [0, 0, 0]
[[actuators.wheel]]
name = "x"
model = "honeywell-hr16-100"
axis = [1, 0, 0]
[[actuators.wheel]]
name = "y"
model = "honeywell-hr16-100"
axis = [0, 1, 0]
[[actuators.wheel]]
name = "z"
model = "honeywell-hr16-100"
axis = [0, 0, 1]
[[phase]]
name = "reach"
move_tool = {{ by_m = [0.0, 0.2, 0.0], duration_s = 5.0 }}
"#
    );
    let mission = read_mission("tank.toml", text)
        .unwrap_or_else(|complaints| panic!("{}", render(&complaints, false)));
    let mut cases = run(&mission, RunOptions::default(), &mut |_| {}).cases;
    let case = cases.remove(0);
    assert!(case.ledger.closes, "{:?}", case.ledger);
    case
}

fn metric(case: &CaseOutcome, name: &str) -> f64 {
    let found = case.metrics.iter().find(|m| m.name == name);
    found.unwrap_or_else(|| panic!("no metric {name}; it ended with {:?}", case.end)).value
}

/// A controlled base turns a little, a held one not at all: that is the only difference between them.
#[test]
fn held_and_controlled_without_limits_recoil_alike_whatever_is_in_the_tank() {
    let mut before = f64::INFINITY;
    for propellant in [0.0, 30.0, 600.0] {
        let [held, controlled] = ["held", "controlled"].map(|base| flown(base, propellant));
        for (name, bound) in RECOIL {
            let [a, b] = [&held, &controlled].map(|case| metric(case, name));
            println!("{propellant} kg: {name} {a} {b}, {:e}", (a / b - 1.0).abs());
            assert!((a / b - 1.0).abs() < bound, "{propellant} kg: {name} {a} {b}");
        }
        let recoil = metric(&held, "base.translation.final");
        assert!(recoil < before * 0.999, "{recoil} {before}");
        before = recoil;
    }
}

/// Quantities, and how far apart they may be (relative): some ten times what was measured, 6e-7, 2.5e-4
/// and 1.4e-6. The attitude loop adds its own little to the torque of the joints' motion.
const RECOIL: [(&str, f64); 3] = [
    ("base.translation.final", 1e-5),
    ("attitude.torque.max", 2.5e-3),
    ("attitude.momentum.max", 1.5e-5),
];

#[test]
fn no_tank_is_said_to_be_empty_where_no_thruster_acts() {
    for (base, propellant) in [("held", 30.0), ("held", 0.0), ("controlled", 0.0)] {
        let case = flown(base, propellant);
        let said = case.events.iter().find(|e| e.text.contains("tank"));
        assert!(said.is_none_or(|e| e.kind != EventKind::Limit), "{base} {propellant}: {said:?}");
        assert_eq!(metric(&case, "thrusters.propellant_used.final"), 0.0);
    }
}

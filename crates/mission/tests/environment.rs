//! Propellant that swings and gravity, from a mission file to what a run says of them.

use std::path::Path;
use wrasse_mission::{Mission, read_mission};
use wrasse_rehearsal::{
    CaseOutcome, Event, Observer, RunOptions, Simulation, Source, TruePlant, run_case,
};
use wrasse_vehicle::JOINTS;

fn read(text: &str) -> Mission {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/test.toml");
    read_mission(file, text)
        .unwrap_or_else(|complaints| panic!("{}", wrasse_document::render(&complaints, false)))
}

fn fly(text: &str) -> CaseOutcome {
    run_case(&read(text).cases[0], RunOptions::default(), &mut |_, _| {})
}

#[track_caller]
fn metric(case: &CaseOutcome, name: &str) -> f64 {
    case.metrics.iter().find(|m| m.name == name).unwrap_or_else(|| panic!("no {name}")).value
}

const SLOSH: &str = include_str!("../../../missions/slosh.toml");

/// The shipped mission without the table of the slosh.
fn at_rest() -> String {
    let (above, table) = SLOSH.split_once("[actuators.tank.slosh]").expect("the table");
    let (_, below) = table.split_once("[[phase]]").expect("phases come next");
    let kept = above.lines().filter(|line| !line.contains("\"slosh.angle"));
    format!("{}\n[[phase]]{below}", kept.collect::<Vec<_>>().join("\n"))
}

/// The ledger closes and has the damper's work, without momentum; the swing dies away, and a tenth of the
/// damping fails the requirements. Measured: 6.42 deg, -0.0175 J.
#[test]
fn a_burn_sets_propellant_swinging_and_the_damper_brings_it_to_rest() {
    let flown = fly(SLOSH);
    assert!(flown.passed && flown.ledger.closes, "{:?}", flown.verdicts);
    let given = flown.ledger.sources[Source::Slosh];
    assert!(given.work < -1e-3, "{} J", given.work);
    assert_eq!((given.angular.norm(), given.linear.norm()), (0.0, 0.0));
    let swings = flown.as_flown.iter().find(|s| s.key == "actuators.tank.slosh");
    assert_eq!(swings.map(|s| s.value.as_str()), Some("112.9 of 200 kg on 0.2832 m"));
    // The pendulum is not drawn as an arm.
    assert!(!flown.snapshots.is_empty() && flown.snapshots.iter().all(|s| s.arms.len() == 1));
    let swung = metric(&flown, "slosh.angle.max").to_degrees();
    assert!((4.0..8.0).contains(&swung), "{swung} deg");
    let loose = fly(&SLOSH.replace("damping_ratio = 0.05", "damping_ratio = 0.005"));
    let failed =
        |words: &str| loose.verdicts.iter().any(|v| !v.pass && v.requirement.contains(words));
    assert!(failed("slosh.angle.final") && failed("base.rotation.final"), "{:?}", loose.verdicts);
}

/// The base of a vehicle whose propellant does not swing is still long before the end.
#[test]
fn propellant_that_does_not_swing_has_no_signal_and_leaves_the_base_still() {
    let flown = fly(&at_rest());
    assert!(flown.metrics.iter().all(|m| !m.name.starts_with("slosh.")));
    assert_eq!(flown.ledger.sources[Source::Slosh].work, 0.0);
    let (still, swinging) =
        (metric(&flown, "base.rotation.final"), metric(&fly(SLOSH), "base.rotation.final"));
    assert!(still < 1e-3 * swinging, "{still:e} rad, {swinging:e} rad");
}

/// Looks at what the flight computer knows.
struct Knowledge {
    joints: usize,
    mass: f64,
}

impl<'a> Observer<TruePlant<'a>> for Knowledge {
    fn flown(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &wrasse_flight::Command<f64, JOINTS>,
        _: &mut Vec<Event>,
    ) {
        let robot = flight.computer().robot();
        (self.joints, self.mass) = (robot.joint_count(), robot.mass());
        assert!(command.effort[7..].iter().all(|tau| *tau == 0.0));
    }
}

/// What flies has the vehicle's own seven joints, and the propellant as a mass at rest.
#[test]
fn the_flight_computer_knows_nothing_of_the_swing() {
    let mission = read(SLOSH);
    let mut flight = Simulation::new(&mission.cases[0]);
    let mut known = Knowledge { joints: 0, mass: 0.0 };
    for _ in 0..300 {
        flight.step(&mut known).expect("it flies");
    }
    let whole = mission.cases[0].vehicle.robot.mass() + 200.0;
    assert_eq!(known.joints, 7);
    assert!((known.mass - whole).abs() < 1e-9, "{} kg", known.mass);
}

const FALL: &str = r#"
name = "fall"
vehicle = "atlas-class"
[initial]
posture = "forward_300mm"
[world]
GRAVITY
[[phase]]
name = "p"
hold = { duration_s = 2.0, keep = "joints" }
"#;

/// `g t²/2`, and a mount that bears nothing: the arm falls as the base does. Measured 4e-11 m and 4e-11 N.
#[test]
fn a_vehicle_falls_in_gravity_and_its_arm_weighs_nothing() {
    let flown = fly(&FALL.replace("GRAVITY", "gravity_m_s2 = [0.0, 3.0, -4.0]"));
    let fallen = metric(&flown, "base.translation.final");
    assert!((fallen - 10.0).abs() < 1e-9, "{fallen} m");
    let borne = metric(&flown, "mount.force.max");
    assert!(borne < 1e-8, "{borne:e} N");
    let given = flown.ledger.sources[Source::Gravity];
    let mass = read(FALL.replace("GRAVITY", "").as_str()).cases[0].vehicle.robot.mass();
    assert!(flown.ledger.closes);
    assert!((given.linear.norm() / (mass * 10.0) - 1.0).abs() < 1e-12, "{:?}", given.linear);
    assert!((given.work / (mass * 50.0) - 1.0).abs() < 1e-6, "{} J", given.work);
}

#[track_caller]
fn setting(case: &CaseOutcome) -> (&str, &str) {
    let found = case.as_flown.iter().find(|s| s.key == "world.gravity_m_s2");
    found.map(|s| (s.value.as_str(), s.origin)).expect("it is a setting")
}

/// No gravity, and gravity of zero, are free space.
#[test]
fn the_world_as_flown_says_what_surrounds_it() {
    let [none, zero, some] = ["", "gravity_m_s2 = [0, 0, 0.0]", "gravity_m_s2 = [0.0, 0.0, -1.62]"]
        .map(|line| fly(&FALL.replace("GRAVITY", line)));
    assert_eq!(setting(&none), ("none: free space", "default"));
    assert_eq!(setting(&zero), ("none: free space", "mission file"));
    assert_eq!(setting(&some), ("[0.0,0.0,-1.62]", "mission file"));
    for flown in [&none, &zero] {
        assert_eq!(metric(flown, "base.translation.final"), 0.0);
        assert_eq!(flown.ledger.sources[Source::Gravity].work, 0.0);
    }
}

#[test]
fn gravity_that_no_planet_has_is_a_doubt() {
    let remarks = &read(&FALL.replace("GRAVITY", "gravity_m_s2 = [0.0, 0.0, -9810.0]")).remarks;
    let said = wrasse_document::render(remarks, false);
    assert!(said.contains("gravity of 9810 m/s² is stronger than any planet's"), "{said}");
    assert!(said.contains("gravity_m_s2 = [0.0, 0.0, -9810.0]"), "{said}");
}

//! The loop of a simulated run does not touch the heap: a longer run allocates no more than a short one.

use std::hint::black_box;
use std::path::Path;
use wrasse_mission::read_mission;
use wrasse_rehearsal::{End, fly_sample, plan_samples};
use wrasse_testing::{Counting, allocations};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Calls to the allocator in a flight of a shipped mission, with these words in place of others.
fn calls(file: &str, changes: &[(&str, &str)]) -> usize {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions").join(file);
    let mut text = std::fs::read_to_string(&path).expect("the mission file is there");
    for (was, is) in changes {
        assert!(text.contains(was), "{file} has no {was}");
        text = text.replace(was, is);
    }
    let mission = read_mission(&path, text).unwrap_or_else(|complaints| {
        panic!("{}", wrasse_document::render(&complaints, false));
    });
    let planned = plan_samples(&mission.cases[0]);
    let mut outcome = None;
    let calls = allocations(|| outcome = Some(fly_sample(black_box(&planned), 1, 1)));
    let outcome = outcome.expect("it was flown");
    assert!(matches!(outcome.end, End::Completed), "{file}: {:?}", outcome.end);
    calls
}

/// Flight computer, sensors, drives, actuators, integration, the books, what is watched.
#[track_caller]
fn assert_length_costs_nothing(file: &str, phase: &str, [short, long]: [&str; 2]) {
    let [few, many] = [short, long].map(|duration| calls(file, &[(phase, duration)]));
    assert!(few > 0, "the counter sees the set-up");
    assert_eq!(few, many, "{file}");
}

const SETTLE: &str = "hold = { duration_s = 5.0";
const LONGER: [&str; 2] = ["hold = { duration_s = 1.0", "hold = { duration_s = 3.0"];

#[test]
fn a_longer_flight_by_an_ideal_actuator_allocates_no_more() {
    assert_length_costs_nothing("atlas-reach.toml", SETTLE, LONGER);
}

#[test]
fn a_longer_flight_by_wheels_allocates_no_more() {
    assert_length_costs_nothing("base-control/wheels.toml", SETTLE, LONGER);
}

#[test]
fn a_longer_flight_by_cmgs_allocates_no_more() {
    assert_length_costs_nothing("base-control/cmgs.toml", SETTLE, LONGER);
}

/// They fire from the wrench at 5 s on, and the flight computer is told of propellant that has gone.
#[test]
fn a_longer_flight_by_thrusters_allocates_no_more() {
    let phase = "hold = { duration_s = 50.0";
    let longer = ["hold = { duration_s = 8.0", "hold = { duration_s = 12.0"];
    assert_length_costs_nothing("base-control/thrusters.toml", phase, longer);
}

#[test]
fn a_longer_flight_by_noisy_sensors_allocates_no_more() {
    assert_length_costs_nothing("base-control/noisy-tracker.toml", SETTLE, LONGER);
}

/// The burn of the shipped mission is flown, too.
#[test]
fn a_longer_flight_with_propellant_that_swings_allocates_no_more() {
    let longer = ["hold = { duration_s = 1.0", "hold = { duration_s = 3.0"];
    assert_length_costs_nothing("slosh.toml", "hold = { duration_s = 98.0", longer);
}

/// Thrusters draw on a tank that swings: the pendulum is made anew with every period in which they fire.
#[test]
fn a_longer_flight_on_propellant_that_swings_allocates_no_more() {
    let slosh = "position_m = [-0.5, 0.0, 0.0]\nslosh = { sphere = { radius_m = 0.3 }, axis = [1, 0, 0], \
                 density_kg_m3 = 1004.0, damping_ratio = 0.05, stiffness_nm_rad = 0.2 }";
    let [few, many] = ["hold = { duration_s = 8.0", "hold = { duration_s = 12.0"].map(|phase| {
        let changes =
            [("position_m = [-0.5, 0.0, 0.0]", slosh), ("hold = { duration_s = 50.0", phase)];
        calls("base-control/thrusters.toml", &changes)
    });
    assert_eq!(few, many);
}

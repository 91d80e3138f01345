//! Studies as files: what is read, what is complained of, and that threads change nothing.

use std::path::Path;
use wrasse_study::{StudyOutcome, read_study, size};

/// Half a second of a push of 20 N on the tool, with a reference and two sets.
const SMALL: &str = r#"
name = "small"
vehicle = "atlas-class"

[study]
tasks = "task"
sets = "set"
reference = "ideal"
closed_loop = ["pushed"]

[world]
base_attitude = "held"

[control]
arm_law = "attitude-held"
actuators = "unlimited"

[[phase]]
name = "hold"
hold = { duration_s = 0.5 }

[[compare]]
axis = "task"

[[compare.row]]
name = "at rest"

[[compare.row]]
name = "pushed"
set.world.applied_wrench = [{ on = "tool", force_n = [0.0, 20.0, 0.0], from_s = 0.0, duration_s = 5.0 }]

[[compare]]
axis = "set"

[[compare.row]]
name = "ideal"

[[compare.row]]
name = "cmgs"
set.world.base_attitude = "controlled"
set.control.actuators = "fitted"
set.actuators.cmg_array = [{ name = "g", model = "airbus-cmg-75-75s", arrangement = "pyramid", skew_deg = 53.13 }]

[[compare.row]]
name = "thrusters"
set.world.base_attitude = "controlled"
set.control.actuators = "fitted"
set.actuators.thruster_set = [{ name = "t", model = "moog-monarc-22-6", arrangement = "box", count = 24, edges_m = [1.8, 1.6, 1.6], position_m = [0, 0, 0] }]
"#;

fn sized(threads: usize) -> StudyOutcome {
    let study = read_study("small.toml", SMALL).unwrap_or_else(|found| panic!("{found:#?}"));
    size(&study, threads, &mut |_| {})
}

#[test]
fn the_same_bits_come_out_for_any_number_of_threads() {
    let told = |threads| {
        let outcome = sized(threads);
        let demands: Vec<_> = outcome.tasks.iter().map(|task| task.demand.clone()).collect();
        (serde_json::to_string(&outcome).unwrap(), demands)
    };
    let alone = told(1);
    assert!(alone == told(3) && alone == told(7));
}

#[test]
fn a_study_flies_each_task_with_the_reference_and_the_named_ones_with_every_set() {
    let outcome = sized(2);
    assert_eq!((outcome.flights, outcome.closes), (4, true));
    let flown = |k: usize| outcome.tasks[k].verdicts.iter().filter(|v| v.flown.is_some()).count();
    assert_eq!((flown(0), flown(1)), (0, 3));
    assert_eq!(outcome.tasks[0].peak_torque_nm, 0.0);
    assert!(!outcome.tasks[1].own_motion && outcome.tasks[1].gathered_nm.is_some());
    let thrusters = &outcome.tasks[1].verdicts[2];
    assert!(thrusters.fuel_kg.unwrap() > 0.0 && thrusters.saturates_s.best.is_none());
}

#[test]
fn a_mission_without_sets_gets_those_of_the_catalogue() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/atlas-reach.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let study = read_study(&path, &text).unwrap_or_else(|found| panic!("{found:#?}"));
    // With what it has, as fitted, beside the reference and ten sets.
    assert_eq!((study.name(), study.flights()), ("atlas-reach", 12));
}

#[test]
fn a_missing_axis_or_row_is_complained_of_with_its_place() {
    let wrong = [
        ("sets = \"set\"", "sets = \"sets\"", "sets"),
        ("tasks = \"task\"", "tasks = \"tasks\"", "tasks"),
        ("reference = \"ideal\"", "reference = \"idea\"", "ideal"),
        ("closed_loop = [\"pushed\"]", "closed_loop = [\"pulled\"]", "pulled"),
    ];
    for (right, wrong, word) in wrong {
        let complaints = read_study("small.toml", &SMALL.replace(right, wrong)).unwrap_err();
        let complaint = &complaints[0];
        assert!(complaint.span.is_some() && complaint.help.is_some(), "{complaint:?}");
        let told = format!("{} {}", complaint.message, complaint.help.clone().unwrap_or_default());
        assert!(told.contains(word), "{told}");
    }
}

#[test]
fn a_claim_of_an_unknown_kind_is_complained_of() {
    let with = |kind: &str| SMALL.replace("[study]", &format!("[study]\nclaim_is = {kind:?}"));
    let complaints = read_study("small.toml", &with("wheels-needed")).unwrap_err();
    let told = format!("{complaints:?}");
    assert!(told.contains("cmgs-needed") && complaints[0].span.is_some(), "{told}");
    let complaints = read_study("small.toml", &with("gyros-needed")).unwrap_err();
    let help = complaints[0].help.as_deref();
    assert_eq!(help, Some("\"gyros-needed\" was renamed: write \"cmgs-needed\""));
    assert!(read_study("small.toml", &with("cmgs-needed")).is_ok());
}

/// A mission's own failures, and what only its own units can do, are not asked of the sets.
#[test]
fn every_shipped_mission_can_be_sized() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions");
    let folders = [root.clone(), root.join("base-control"), root.join("miss-distance")];
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let mut paths: Vec<_> = files.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(paths.len() > 15, "{paths:?}");
    let mut refused = vec![];
    for path in &paths {
        let text = std::fs::read_to_string(path).unwrap();
        if let Err(complaints) = read_study(path, &text) {
            let told: Vec<_> = complaints.iter().map(|c| c.message.clone()).collect();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            refused.push(format!("{name}: {}", told.join("; ")));
        }
    }
    // The reference holds the base exactly, which takes a base at rest.
    assert_eq!(refused, ["coast.toml: a base that turns at the start cannot be held"]);
}

/// Requirements on wheels say nothing of a set without wheels, and so do not fail it.
#[test]
fn a_requirement_on_units_that_a_set_lacks_does_not_count_against_it() {
    let asked = "vehicle = \"atlas-class\"\nrequirements = [\"wheels.speed_use.max <= 100 %\"]";
    let text = SMALL.replace("vehicle = \"atlas-class\"", asked);
    let study = read_study("small.toml", &text).unwrap_or_else(|found| panic!("{found:#?}"));
    let outcome = size(&study, 2, &mut |_| {});
    let hold =
        outcome.tasks[1].verdicts.iter().map(|v| v.flown.as_ref().unwrap().requirements_hold);
    assert_eq!(hold.collect::<Vec<_>>(), [true; 3]);
    // One that has a value still counts.
    let text = text.replace("wheels.speed_use.max <= 100 %", "tool.position_error.max < 0 mm");
    let study = read_study("small.toml", &text).unwrap_or_else(|found| panic!("{found:#?}"));
    let outcome = size(&study, 2, &mut |_| {});
    assert!(outcome.tasks[1].verdicts.iter().all(|v| !v.flown.as_ref().unwrap().requirements_hold));
}

#[test]
fn mass_and_power_are_held_against_the_limits_of_the_study() {
    let limits = "[study]\nmass_limit_kg = 100\npower_limit_w = 1e6";
    let study = read_study("small.toml", &SMALL.replace("[study]", limits)).unwrap();
    let outcome = size(&study, 2, &mut |_| {});
    assert_eq!((outcome.mass_limit_kg, outcome.power_limit_w), (Some(100.0), Some(1e6)));
    let cmgs = &outcome.sets[1];
    // Four of them weigh more than 100 kg together.
    assert!(cmgs.mass_kg.unwrap() > 100.0, "{cmgs:?}");
    assert_eq!((cmgs.within_mass_limit, cmgs.within_power_limit), (Some(false), Some(true)));
    assert_eq!(outcome.sets[0].within_mass_limit, None);
    assert_eq!(sized(2).sets[1].within_mass_limit, None);
}

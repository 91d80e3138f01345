//! A sample has the same bits alone, in whatever lane it flies, beside whichever others, and on every level
//! of the processor.

use std::path::{Path, PathBuf};
use wrasse_lanes::Level;
use wrasse_mission::{
    End, Mission, RunOptions, SampleOutcome, fly_chunk, fly_chunk_on, fly_sample, plan_samples,
    read_mission, run_case,
};

fn missions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions")
}

#[track_caller]
fn read(text: &str) -> Mission {
    read_mission(missions().join("test.toml"), text).unwrap_or_else(|complaints| {
        panic!("{}", wrasse_document::render(&complaints, false));
    })
}

/// A short flight through every kind of phase that lanes fly; masses, the start and what it holds differ.
const SHORT: &str = r#"
name = "short"
vehicle = "atlas-class"
seed = 3
requirements = ["tool.position_error.max <= 1 m"]

[initial]
posture = "sideways_300mm"

[payload.module]
mass_kg = 200.0
centre_of_mass_m = [0.5, 0.0, 0.0]
uniform_box_m = [1.0, 1.0, 1.0]
held_by = "tool"

[world]
base_attitude = "ATTITUDE"
joints = "DRIVES"

[control]
arm_law = "LAW"

[[phase]]
name = "reach"
move_tool = { by_m = [0.0, 0.01, 0.0], duration_s = 0.4 }

[[phase]]
name = "stay"
hold = { duration_s = 0.1, keep = "tool" }

[[phase]]
name = "stand"
hold = { duration_s = 0.1, keep = "joints" }

[[disperse]]
quantity = "payload.module.mass_kg"
sigma = 10.0
within = 30.0

[[disperse]]
quantity = "body.bus.mass_kg"
between = [-15.0, 15.0]

[[disperse]]
quantity = "initial.joints_deg"
sigma = 1.0
within = 3.0
"#;

fn short(attitude: &str, drives: &str, law: &str) -> String {
    SHORT.replace("ATTITUDE", attitude).replace("DRIVES", drives).replace("LAW", law)
}

/// The mission with every metric that it has required.
fn requiring_everything(text: &str) -> Mission {
    let outcome = run_case(&read(text), 0, RunOptions::default(), &mut |_, _| {});
    let all = outcome
        .metrics
        .iter()
        .map(|m| format!("{} >= -1e300 {}", m.name, if m.unit == "–" { "-" } else { &m.unit }));
    let start = text.find("requirements = [").expect("it has requirements");
    let end = start + text[start..].find("]\n").expect("they end") + 1;
    let all: Vec<_> = all.collect();
    read(&format!("{}requirements = {all:?}{}", &text[..start], &text[end..]))
}

#[track_caller]
fn assert_same_bits(a: &SampleOutcome, b: &SampleOutcome, what: &str) {
    assert_eq!((a.sample, &a.end, a.closes, a.passed), (b.sample, &b.end, b.closes, b.passed));
    assert_eq!(a.verdicts.len(), b.verdicts.len());
    for (a, b) in a.verdicts.iter().zip(&b.verdicts) {
        let bits = |value: Option<f64>| value.map(f64::to_bits);
        assert_eq!(bits(a.value), bits(b.value), "{what}: {} and {:?}", a.requirement, b.value);
    }
}

#[test]
fn a_sample_has_the_same_bits_alone_and_in_every_lane_beside_any_others() {
    for (attitude, drives, law) in [
        ("controlled", "torque", "attitude-held"),
        ("free", "torque", "free-floating"),
        ("held", "prescribed", "attitude-held"),
        ("free", "prescribed", "terrestrial"),
    ] {
        let mission = requiring_everything(&short(attitude, drives, law));
        let planned = plan_samples(&mission, 0);
        assert!(planned.flies_side_by_side());
        let alone: Vec<_> = (0..12).map(|sample| fly_sample(&planned, 9, sample)).collect();
        assert!(alone.iter().all(|a| a.end == End::Completed && a.verdicts.len() > 30));
        // A whole formation and half of one; the same samples in other lanes; a formation not full.
        for range in [0..12, 3..11, 5..9] {
            let first = usize::try_from(range.start).unwrap();
            for (outcome, alone) in fly_chunk(&planned, 9, range).iter().zip(&alone[first..]) {
                assert_same_bits(outcome, alone, attitude);
            }
        }
    }
}

#[test]
fn every_level_of_the_processor_flies_the_same_bits() {
    let mission = requiring_everything(&short("controlled", "torque", "attitude-held"));
    let planned = plan_samples(&mission, 0);
    let alone: Vec<_> = (0..8).map(|sample| fly_sample(&planned, 9, sample)).collect();
    for level in Level::ALL {
        let flown = fly_chunk_on(level, &planned, 9, 0..8);
        assert_eq!(flown.len(), 8);
        for (a, b) in flown.iter().zip(&alone) {
            assert_same_bits(a, b, &format!("{level:?}"));
        }
    }
}

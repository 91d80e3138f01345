//! A mission flown from Rust: the verdicts without files or a terminal.
//!
//! `cargo run -p wrasse-mission --example fly_a_mission`
#![allow(clippy::print_stdout, reason = "an example prints")]

use wrasse_mission::{read_mission, run};
use wrasse_rehearsal::RunOptions;

const MISSION: &str = r#"
name = "nudge"
vehicle = "atlas-class"
requirements = ["tool.position_error.max <= 0.3 mm", "base.rotation.max <= 1 deg"]

[initial]
posture = "sideways_300mm"

[[phase]]
name = "nudge"
move_tool = { by_m = [0.0, 0.05, 0.0], duration_s = 5.0 }
"#;

fn main() {
    let mission = match read_mission("nudge.toml", MISSION) {
        Ok(mission) => mission,
        Err(complaints) => panic!("{}", wrasse_document::render(&complaints, false)),
    };
    let outcome = run(&mission, RunOptions::default(), &mut |_| {});
    for verdict in &outcome.cases[0].verdicts {
        println!("{}: {:?} {}", verdict.requirement, verdict.value, verdict.unit);
    }
    assert!(outcome.cases[0].passed, "the requirements hold and the ledger closes");
}

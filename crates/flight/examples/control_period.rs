//! Flies single control periods, for counting what each takes:
//! `control_period one|two held|floating median|all`.
//!
//! Under `valgrind --tool=callgrind --toggle-collect='*one_period*'` what is counted is the period from
//! the sensed state to the torques: kinematics, law, computed torque, feedforward, attitude law. Not
//! counted are planning, trajectory, estimators and actuator steering. With `--dump-after='*one_state*'`
//! and `all` there is a count for each of the 1,000 states; `median` flies an ordinary one.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

#[path = "../tests/spanning_states/mod.rs"]
#[allow(dead_code, reason = "the tests ask more of the same states")]
mod spanning_states;

use spanning_states::{Period, servicer, setup, states};
use std::process::ExitCode;
use wrasse_dynamics::{Robot, State, kinematics, momentum};
use wrasse_flight::{ArmLaw, ControlOutput, Setup};

/// The state that stands for an ordinary one.
const ORDINARY: usize = 9;

/// What is counted.
#[inline(never)]
fn one_period<const J: usize>(
    period: &mut Period<J>,
    robot: &Robot<f64, J>,
    setup: &Setup<f64, J>,
) -> ControlOutput<f64, J> {
    period.fly(robot, setup)
}

/// One state: the period, and what must be true after it.
#[inline(never)]
fn one_state<const J: usize>(
    k: usize,
    state: State<f64, J>,
    robot: &Robot<f64, J>,
    setup: &Setup<f64, J>,
) {
    let mut period = Period::new(robot, setup, state, k);
    let told = one_period(&mut period, robot, setup);
    assert!(told.effort.iter().all(|tau| tau.abs() <= 500.0), "state {k}: {:?}", told.effort);
    // The law ends the period with the momentum that it read, in the posture predicted for the end: in
    // these states, which no motion led to, it is off by up to 7e-3 of some 16 N·s.
    let after = momentum(&kinematics(robot, &period.believed_state()));
    let before = &period.believed_momentum();
    let gained = (after.linear - before.force).norm();
    assert!(gained < 2e-2, "state {k}: momentum from nothing, {gained:e} N·s");
}

fn fly<const J: usize>(law: ArmLaw, all: bool) {
    let (robot, tool) = servicer::<J>();
    let setup = setup(law, tool);
    for (k, state) in states::<J>().into_iter().enumerate() {
        if all || k == ORDINARY {
            one_state(k, state, &robot, &setup);
        }
    }
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
    if words.is_empty() {
        words = vec!["one", "held", "median"];
    }
    let [arms @ ("one" | "two"), law @ ("held" | "floating"), which @ ("median" | "all")] =
        words[..]
    else {
        return ExitCode::from(2);
    };
    let law = if law == "held" { ArmLaw::AttitudeHeld } else { ArmLaw::FreeFloating };
    match arms {
        "one" => fly::<7>(law, which == "all"),
        _ => fly::<14>(law, which == "all"),
    }
    ExitCode::SUCCESS
}

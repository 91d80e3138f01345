//! `wrasse eval`: every quantity of the dynamics at given states, as JSON.

use crate::YES;
use crate::eval_answer::answer;
use crate::eval_question::questions;
use crate::input::{Failure, say_json, text_up_to};
use clap::Args;
use serde_json::Value;
use std::path::PathBuf;
use std::process::ExitCode;
use wrasse_vehicle::{NoVehicle, find_vehicle};

/// Evaluate the dynamics of a vehicle at given states, for any other program.
///
/// The states are JSON: {"frame": NAME, "states": [STATE, …]}. The answer goes to standard output.
/// The book's page "Evaluating from other programs" has the whole contract.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  wrasse eval ssrms --states states.json")]
pub(crate) struct Eval {
    /// A vehicle of the catalogue, or a vehicle file.
    vehicle: String,
    /// The states, as a JSON file; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    states: PathBuf,
}

/// Largest file of states (bytes): some 100,000 states.
const MOST_STATES: u64 = 64 << 20;

impl Eval {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let vehicle = find_vehicle(&self.vehicle, None).map_err(not_found)?;
        let text = text_up_to(&self.states, MOST_STATES)?;
        let (frame, questions) = questions(&self.states, text, &vehicle)?;
        say_answer(&answer(&vehicle, &frame, &questions))
    }
}

fn not_found(why: NoVehicle) -> Failure {
    match why {
        NoVehicle::Faulty(complaints) => Failure::Complaints(complaints),
        NoVehicle::NotFound { message, help, .. } => {
            Failure::Sentence(format!("{message}\nhelp: {help}"))
        }
        why => Failure::Sentence(format!("{why:?}")),
    }
}

/// Print an answer; refuse it where a number is not finite, for JSON has no such numbers.
fn say_answer(answer: &Value) -> Result<ExitCode, Failure> {
    let results = answer["results"].as_array().into_iter().flatten().enumerate();
    let members =
        results.flat_map(|(i, r)| r.as_object().into_iter().flatten().map(move |m| (i, m)));
    let broken: Vec<String> = members
        .filter(|(_, (_, value))| holds_null(value))
        .map(|(i, (name, _))| format!("state {i}: {name} is not finite"))
        .collect();
    if broken.is_empty() {
        say_json(answer);
        return Ok(YES);
    }
    let help = "help: the numbers of the state are too large to be worked with";
    Err(Failure::Sentence(format!("{}\n{help}", broken.join("\nerror: "))))
}

fn holds_null(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Array(items) => items.iter().any(holds_null),
        Value::Object(members) => members.values().any(holds_null),
        _ => false,
    }
}

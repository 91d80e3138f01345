//! The project's own chores: `cargo xtask test`, `cargo xtask tidy`, `cargo xtask ci`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "chores talk to their caller")]

mod chores;
mod tidy;

use std::env;
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask CHORE

  test [ARGS]   all tests: unit, integration and documentation tests of the whole workspace;
                ARGS go to `cargo test`
  tidy          rules of the repository that no compiler knows
  ci            formatting, lints, documentation, then all tests: what a change must pass";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (chore, rest) = match arguments.split_first() {
        Some((chore, rest)) => (chore.as_str(), rest),
        None => ("", [].as_slice()),
    };
    let outcome = match chore {
        "test" => chores::test(rest),
        "tidy" => tidy::report(),
        "ci" => chores::ci(),
        _ => Err(USAGE.to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

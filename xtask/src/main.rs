//! The project's own chores: `cargo xtask test`, `cargo xtask tidy`, `cargo xtask ci` and others.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "chores talk to their caller")]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod bench;
mod chores;
mod counts;
mod deny;
mod embedded;
mod fuzz;
mod golden;
mod tidy;

use std::env;
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask CHORE

  test [ARGS]   all tests: unit, integration and documentation tests of the whole workspace;
                ARGS go to `cargo test`
  bench         times of the kernels beside Pinocchio and MuJoCo, as a page of the book;
                with --page only the page, from what was measured last
  tidy          rules of the repository that no compiler knows
  counts [--require | --accept | --release]
                instructions of the main kernels, counted by callgrind and held against
                validation/instruction_counts.toml; --accept writes them there, --release also
                makes them what the next release is compared with
  embedded [--require]
                the control period on a flight processor's instruction set, in an emulator:
                no panic, same bits as the host, instructions, stack; without the tools it is
                skipped, with --require it fails
  golden [FOLDER]
                numbers from outside held against what the product computes, in every file of
                a folder (validation/golden): deviation, tolerance, verdict of each case; exit
                code 1 for a missed tolerance, 2 for a file that cannot be used
  fuzz [--require] [--seconds N] [TARGET]
                arbitrary bytes into every reader, or into one, for N seconds each (15);
                without cargo-fuzz it is skipped, with --require it fails
  deny [--require]
                licences and sources of what comes in from outside, and which crates may see
                the truth (deny.toml); without cargo-deny it is skipped, with --require it fails
  ci            formatting, lints, documentation, licences, golden files, then all tests: what
                a change must pass";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (chore, rest) = match arguments.split_first() {
        Some((chore, rest)) => (chore.as_str(), rest),
        None => ("", [].as_slice()),
    };
    let outcome = match chore {
        "golden" => return golden::golden(rest),
        "test" => chores::test(rest),
        "bench" => bench::bench(rest),
        "tidy" => tidy::report(),
        "counts" => counts::counts(rest),
        "embedded" => embedded::embedded(rest),
        "deny" => deny::deny(rest),
        "fuzz" => fuzz::fuzz(rest),
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

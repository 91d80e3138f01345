//! The binary `wrasse`: rehearses servicing missions of free-flying robots.
//!
//! Exit codes: 0 all requirements hold; 1 the answer is no; 2 bad input or breakdown; 130 Ctrl-C.

#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod check;
mod eval;
mod eval_answer;
mod eval_question;
mod hardware;
mod input;
mod interrupt;
mod progress;
mod results;
mod run;
mod schema;
mod size;
mod sweep;
mod vehicle_page;
mod vehicles;

use clap::{Parser, Subcommand};
use std::num::NonZeroUsize;
use std::process::ExitCode;

/// Rehearse on-orbit servicing: free-flying spacecraft with arms.
///
/// Start with `wrasse run missions/atlas-reach.toml`, then open out/atlas-reach/report.html.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
struct Wrasse {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Run),
    Sweep(sweep::Sweep),
    Size(size::Size),
    Check(check::Check),
    Vehicles(vehicles::Vehicles),
    Hardware(hardware::Hardware),
    Eval(eval::Eval),
    Schema(schema::Schema),
}

/// Stack of the thread that does the work (bytes): planning keeps the matrices of many joints by value,
/// and a shell may grant less to the first thread.
const STACK: usize = 64 << 20;

fn main() -> ExitCode {
    let command = match Wrasse::try_parse() {
        Ok(Wrasse { command }) => command,
        Err(answer) if answer.use_stderr() => {
            input::tell(&answer.to_string());
            return bad();
        }
        // Help, and the version.
        Err(answer) => answer.exit(),
    };
    let command = std::sync::Arc::new(command);
    let work = std::sync::Arc::clone(&command);
    let thread = std::thread::Builder::new().name("wrasse".into()).stack_size(STACK);
    match thread.spawn(move || go(&work)) {
        Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        // A system that grants no thread has the first one do it.
        Err(_) => go(&command),
    }
}

fn go(command: &Command) -> ExitCode {
    let done = match command {
        Command::Run(run) => run.go(),
        Command::Sweep(sweep) => sweep.go(),
        Command::Size(size) => size.go(),
        Command::Check(check) => Ok(check.go()),
        Command::Vehicles(vehicles) => vehicles.go(),
        Command::Hardware(hardware) => hardware.go(),
        Command::Eval(eval) => eval.go(),
        Command::Schema(schema) => Ok(schema.go()),
    };
    done.unwrap_or_else(|failure| failure.tell())
}

/// All requirements hold.
pub(crate) const YES: ExitCode = ExitCode::SUCCESS;

/// The answer is no: a requirement failed, a path is infeasible.
pub(crate) fn no() -> ExitCode {
    ExitCode::from(1)
}

/// Bad input, or a breakdown.
pub(crate) fn bad() -> ExitCode {
    ExitCode::from(2)
}

/// Flights at a time: as many as were asked for, or as the machine has processors.
pub(crate) fn threads(asked: Option<NonZeroUsize>) -> usize {
    let processors = || std::thread::available_parallelism().ok();
    asked.or_else(processors).map_or(1, NonZeroUsize::get)
}

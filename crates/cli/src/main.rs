//! The binary `wrasse`: rehearses servicing missions of free-flying robots.
//!
//! Exit codes: 0 all requirements hold; 1 the answer is no; 2 bad input or breakdown; 130 Ctrl-C.

#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod check;
mod check_json;
mod completions;
mod convert;
mod deep_report;
mod eval;
mod eval_answer;
mod eval_question;
mod hardware;
mod input;
mod interrupt;
mod keys;
mod new;
mod new_file;
mod progress;
mod results;
mod run;
mod schema;
mod settings;
mod size;
mod sweep;
mod vehicle_page;
mod vehicles;

use clap::{Parser, Subcommand};
use std::num::NonZeroUsize;
use std::process::ExitCode;

const EXAMPLES: &str = "Start with:
  wrasse new mission > reach.toml    a mission, with comments
  wrasse run reach.toml              then open out/my-mission/report.html
`wrasse help COMMAND` has an example of each.";

/// Rehearse on-orbit servicing: free-flying spacecraft with arms.
///
/// A mission is a file: a vehicle, what it does, and what is required. Exit code 0: all requirements hold;
/// 1: one does not; 2: bad input, or a breakdown.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_help = EXAMPLES)]
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
    #[command(after_help = "Example:\n  wrasse convert arm.urdf > arm.toml")]
    Convert(convert::Convert),
    #[command(after_help = "Example:\n  wrasse vehicles ssrms > my-arm.toml")]
    Vehicles(vehicles::Vehicles),
    Hardware(hardware::Hardware),
    Eval(eval::Eval),
    Schema(schema::Schema),
    New(new::New),
    Completions(completions::Completions),
    Man(completions::Man),
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
        Command::Convert(convert) => convert.go(),
        Command::Vehicles(vehicles) => vehicles.go(),
        Command::Hardware(hardware) => hardware.go(),
        Command::Eval(eval) => eval.go(),
        Command::Schema(schema) => Ok(schema.go()),
        Command::New(new) => new.go(),
        Command::Completions(completions) => Ok(completions.go()),
        Command::Man(man) => man.go(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The command and all below it, but for what clap adds.
    fn all(command: &clap::Command) -> Vec<clap::Command> {
        let below = command.get_subcommands().filter(|below| below.get_name() != "help");
        std::iter::once(command.clone()).chain(below.flat_map(all)).collect()
    }

    #[test]
    fn the_declarations_of_the_command_line_hold_together() {
        Wrasse::command().debug_assert();
    }

    #[test]
    fn every_help_has_an_example_that_can_be_typed_and_fits_80_columns() {
        for command in all(&Wrasse::command().term_width(80)) {
            let mut command = command.term_width(80);
            let help = command.render_long_help().to_string();
            let long = help.lines().find(|line| line.chars().count() > 80);
            assert_eq!(long, None, "{}", command.get_name());
            let examples = help.rsplit("\n\n").next().unwrap_or_default();
            let lines = examples.lines().filter(|line| line.starts_with("  wrasse "));
            let typed = lines.map(|line| {
                let part = line.split(['|', '>', '&']).next().unwrap_or_default();
                // Behind wide spaces stands what it does.
                let part = part.trim().split("   ").next().unwrap_or_default();
                Wrasse::try_parse_from(part.split(' ')).map(|_| ())
            });
            let typed: Vec<_> = typed.collect();
            assert!(!typed.is_empty(), "{} has no example", command.get_name());
            assert!(typed.iter().all(Result::is_ok), "{typed:?}");
        }
    }
}

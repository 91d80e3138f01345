//! `cargo xtask fuzz`: arbitrary bytes into every reader, for some seconds each.

use crate::tidy::repository_root;
use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

/// A target and the folders with files of its kind, from the root of the repository.
const TARGETS: [(&str, &[&str]); 7] = [
    ("vehicle_toml", &["vehicles", "crates/vehicle/tests/data"]),
    ("vehicle_urdf", &["validation/golden", "crates/vehicle/tests/data"]),
    ("vehicle_mjcf", &["crates/vehicle/tests/data/mjcf"]),
    ("mission_toml", &["missions", "fuzz/seeds/mission_toml"]),
    ("eval_json", &["fuzz/seeds/eval_json"]),
    ("sweep_folder", &["fuzz/seeds/sweep_folder"]),
    ("c_period", &["fuzz/seeds/c_period"]),
];

const USAGE: &str = "usage: cargo xtask fuzz [--require] [--seconds N] [TARGET]";

/// What is asked of the chore.
struct Arguments {
    required: bool,
    seconds: u32,
    target: Option<String>,
}

fn asked(arguments: &[String]) -> Result<Arguments, String> {
    let mut asked = Arguments { required: false, seconds: 15, target: None };
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--require" => asked.required = true,
            "--seconds" => {
                let seconds = rest.next().and_then(|n| n.parse().ok());
                asked.seconds = seconds.ok_or_else(|| USAGE.to_owned())?;
            }
            name if TARGETS.iter().any(|(target, _)| *target == name) => {
                asked.target = Some(name.to_owned());
            }
            _ => {
                let names = TARGETS.map(|(name, _)| name).join(", ");
                return Err(format!("{USAGE}\nTARGET is one of {names}"));
            }
        }
    }
    Ok(asked)
}

/// Build the targets and run one or all of them; what breaks one is kept in `fuzz/artifacts`.
pub(crate) fn fuzz(arguments: &[String]) -> Result<(), String> {
    let asked = asked(arguments)?;
    let Some(program) = cargo_fuzz() else {
        let missing = "cargo-fuzz is not installed: fuzz/install_tools.sh";
        if asked.required {
            return Err(missing.to_owned());
        }
        eprintln!("SKIPPED: {missing}");
        return Ok(());
    };
    run(&program, &["fuzz", "build", "-s", "none"])?;
    for (target, seeds) in TARGETS {
        if asked.target.as_deref().is_none_or(|only| only == target) {
            fuzz_one(&program, target, seeds, asked.seconds)?;
        }
    }
    Ok(())
}

fn fuzz_one(program: &PathBuf, target: &str, seeds: &[&str], seconds: u32) -> Result<(), String> {
    let corpus = format!("fuzz/corpus/{target}");
    let folder = repository_root().join(&corpus);
    fs::create_dir_all(&folder).map_err(|why| format!("{corpus}: {why}"))?;
    let time = format!("-max_total_time={seconds}");
    let mut arguments = vec!["fuzz", "run", "-s", "none", target, corpus.as_str()];
    arguments.extend(seeds);
    // A case that takes a minute or two gigabytes is a finding.
    arguments.extend(["--", &time, "-timeout=60", "-rss_limit_mb=2048", "-max_len=20000"]);
    arguments.push("-print_final_stats=1");
    run(program, &arguments)
}

/// The program on the path, or where the script installs it.
fn cargo_fuzz() -> Option<PathBuf> {
    let target = env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let installed = repository_root().join(target).join("fuzz-tools/bin/cargo-fuzz");
    [installed, PathBuf::from("cargo-fuzz")].into_iter().find(|program| {
        Command::new(program).args(["fuzz", "--version"]).output().is_ok_and(|o| o.status.success())
    })
}

/// The stable compiler instruments code when it takes itself for its own successor.
fn run(program: &PathBuf, arguments: &[&str]) -> Result<(), String> {
    let line = format!("cargo {}", arguments.join(" "));
    eprintln!("== {line}");
    let mut command = Command::new(program);
    command.args(arguments).current_dir(repository_root()).env("RUSTC_BOOTSTRAP", "1");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{line}` failed: {status}; what broke it is in fuzz/artifacts")),
        Err(why) => Err(format!("`{line}` could not be started: {why}")),
    }
}

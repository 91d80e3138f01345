//! `cargo xtask deny`: licences and sources of what comes in from outside, and which crates may see
//! the truth, by cargo-deny and `deny.toml`.

use crate::tidy::repository_root;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The workspaces, and what is asked of each: only the first has crates that must not meet.
const WORKSPACES: [(&str, &[&str]); 3] = [
    ("Cargo.toml", &["bans", "licenses", "sources"]),
    ("embedded/Cargo.toml", &["licenses", "sources"]),
    ("fuzz/Cargo.toml", &["licenses", "sources"]),
];

/// Check all workspaces; without cargo-deny it is skipped, or fails where it is required.
pub(crate) fn deny(arguments: &[String]) -> Result<(), String> {
    let required = match arguments {
        [] => false,
        [only] if only == "--require" => true,
        _ => return Err("usage: cargo xtask deny [--require]".to_owned()),
    };
    let Some(program) = cargo_deny() else {
        let missing = "cargo-deny is not installed: xtask/install_tools.sh";
        if required {
            return Err(missing.to_owned());
        }
        eprintln!("SKIPPED: {missing}");
        return Ok(());
    };
    WORKSPACES.iter().try_for_each(|(manifest, asked)| check(&program, manifest, asked))
}

fn check(program: &Path, manifest: &str, asked: &[&str]) -> Result<(), String> {
    let line = format!("cargo deny --manifest-path {manifest} check {}", asked.join(" "));
    eprintln!("== {line}");
    let mut command = Command::new(program);
    command
        .args(["--config", "deny.toml", "--manifest-path", manifest, "--locked", "check"])
        .args(asked)
        .current_dir(repository_root());
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{line}` failed: {status}")),
        Err(why) => Err(format!("`{line}` could not be started: {why}")),
    }
}

/// The program where the script installs it, or on the path.
fn cargo_deny() -> Option<PathBuf> {
    let target = env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let installed = repository_root().join(target).join("deny-tools/bin/cargo-deny");
    let runs = |program: &PathBuf| {
        Command::new(program).arg("--version").output().is_ok_and(|o| o.status.success())
    };
    [installed, PathBuf::from("cargo-deny")].into_iter().find(runs)
}

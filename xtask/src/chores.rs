//! Chores that hand their work to cargo.

use crate::tidy::repository_root;
use crate::{deny, golden};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// All examples, then all tests of the workspace, doctests included; cargo's own lines close the output.
pub(crate) fn test(arguments: &[String]) -> Result<(), String> {
    if arguments.is_empty() {
        examples()?;
    }
    let mut all = vec!["test", "--workspace", "--no-fail-fast", "--quiet"];
    all.extend(arguments.iter().map(String::as_str));
    cargo(&all, None)
}

/// Run every example: each ends by asserting a physical fact.
fn examples() -> Result<(), String> {
    let mut found = 0;
    for folder in root_entries("crates")? {
        let files = sorted_entries(&folder.join("examples")).unwrap_or_default();
        for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "rs")) {
            let manifest = folder.join("Cargo.toml").display().to_string();
            let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            cargo(&["run", "--quiet", "--manifest-path", &manifest, "--example", &stem], None)?;
            found += 1;
        }
    }
    if found == 0 { Err("no example was found under crates/*/examples".into()) } else { Ok(()) }
}

fn root_entries(folder: &str) -> Result<Vec<PathBuf>, String> {
    sorted_entries(&repository_root().join(folder)).map_err(|why| format!("{folder}: {why}"))
}

fn sorted_entries(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let entries: std::io::Result<Vec<_>> = fs::read_dir(folder)?.map(|e| Ok(e?.path())).collect();
    let mut entries = entries?;
    entries.sort();
    Ok(entries)
}

/// What a change must pass. Quick checks come first.
pub(crate) fn ci() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], None)?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], None)?;
    let warnings = Some(("RUSTDOCFLAGS", "-D warnings"));
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"], warnings)?;
    deny::deny(&[])?;
    golden::in_repository()?;
    test(&[])
}

/// Run cargo in the root of the repository and wait for it.
pub(crate) fn cargo(arguments: &[&str], variable: Option<(&str, &str)>) -> Result<(), String> {
    let line = format!("cargo {}", arguments.join(" "));
    eprintln!("== {line}");
    // The cargo that runs this chore, so that one toolchain does it all.
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.args(arguments).current_dir(repository_root()).envs(variable);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{line}` failed: {status}")),
        Err(why) => Err(format!("`{line}` could not be started: {why}")),
    }
}

//! Chores that hand their work to cargo.

use crate::tidy::repository_root;
use std::env;
use std::process::Command;

/// All tests of the workspace, doctests included; cargo's own lines close the output.
pub(crate) fn test(arguments: &[String]) -> Result<(), String> {
    let mut all = vec!["test", "--workspace", "--no-fail-fast", "--quiet"];
    all.extend(arguments.iter().map(String::as_str));
    cargo(&all, None)
}

/// What a change must pass. Quick checks come first.
pub(crate) fn ci() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], None)?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], None)?;
    let deny = Some(("RUSTDOCFLAGS", "-D warnings"));
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"], deny)?;
    test(&[])
}

/// Run cargo in the root of the repository and wait for it.
fn cargo(arguments: &[&str], variable: Option<(&str, &str)>) -> Result<(), String> {
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

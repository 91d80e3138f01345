//! Programs in C, compiled by a C compiler and linked with the library.
#![allow(clippy::print_stderr, reason = "what is skipped is said loudly")]

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Run a command; what it says of itself when it fails.
#[track_caller]
fn run(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    assert!(status.success(), "{command:?}: {status}\n{}", String::from_utf8_lossy(&stderr));
    String::from_utf8(stdout).unwrap()
}

/// The C compiler, if there is one; in CI there must be one.
fn c_compiler() -> Option<&'static str> {
    let found = Command::new("cc").arg("--version").output().is_ok_and(|o| o.status.success());
    if !found {
        assert!(env::var_os("WRASSE_REQUIRE_TOOLS").is_none(), "no C compiler `cc`");
        eprintln!("SKIPPED: the programs in C were not run, there is no C compiler `cc`");
    }
    found.then_some("cc")
}

/// Build the static library as flight software would; where it lies.
fn library(target: &Path) -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
    run(Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["rustc", "--quiet", "--profile", "flight", "--crate-type", "staticlib"])
        .args(["--features", "panic-handler", "--manifest-path"])
        .arg(manifest)
        .env("CARGO_TARGET_DIR", target));
    target.join("flight").join("libwrasse_flight_c.a")
}

/// What a program in `c/` prints, linked with the library as flight software would; nothing without a C
/// compiler.
pub(crate) fn run_in_c(name: &str, arguments: &[&str]) -> Option<String> {
    let cc = c_compiler()?;
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let program = target.join(name);
    run(Command::new(cc)
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2", "-I"])
        .arg(crate_folder.join("../../include"))
        .arg(crate_folder.join("c").join(format!("{name}.c")))
        .arg(library(target))
        .args(["-lm", "-o"])
        .arg(&program));
    Some(run(Command::new(&program).args(arguments)))
}

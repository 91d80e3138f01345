//! What the embedded proof needs: a compiler with the sources of its core library, a linker, an
//! emulator.

use crate::tidy::repository_root;
use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The instruction set: Armv7E-M with floating-point registers.
pub(super) const TARGET: &str = "thumbv7em-none-eabihf";

const HOW_TO_INSTALL: &str = "\
  On Debian: embedded/install_tools.sh, or
  apt-get install rustc-web rust-web-src qemu-system-arm
  (rustc-web is Debian's newest compiler; it goes to /usr/bin/rustc and leaves rustup's alone.)";

/// The tools, all found.
pub(super) struct Toolchain {
    /// Debian's compiler, which has the sources of `core` beside it.
    compiler: PathBuf,
    linker: PathBuf,
    emulator: PathBuf,
    pub(super) compiler_version: String,
    pub(super) emulator_version: String,
}

impl Toolchain {
    /// Find all of them, or say which are missing and how to get them.
    pub(super) fn find() -> Result<Self, String> {
        let compiler = PathBuf::from("/usr/bin/rustc");
        let sysroot = version(&compiler, &["--print", "sysroot"]);
        let sources = sysroot.map(|root| Path::new(&root).join("lib/rustlib/src/rust/library"));
        let host = version(Path::new("rustc"), &["--print", "sysroot"]).unwrap_or_default();
        let linker = Path::new(&host).join("lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
        let emulators = [
            target_folder().join("tools/usr/bin/qemu-system-arm"),
            PathBuf::from("qemu-system-arm"),
        ];
        let emulator = emulators.into_iter().find_map(|e| Some((version(&e, &["--version"])?, e)));
        let compiler_version = version(&compiler, &["--version"]);
        let mut missing = Vec::new();
        if compiler_version.is_none() {
            missing.push("  no compiler /usr/bin/rustc (package rustc-web)".to_owned());
        } else if !sources.is_some_and(|folder| folder.is_dir()) {
            missing.push("  no sources of its core library (package rust-web-src)".to_owned());
        }
        if !linker.is_file() {
            missing.push(format!(
                "  no linker {} (it comes with rustup's toolchains)",
                linker.display()
            ));
        }
        match (compiler_version, emulator) {
            (Some(compiler_version), Some((emulator_version, emulator))) if missing.is_empty() => {
                let found = Self { compiler, linker, emulator, compiler_version, emulator_version };
                return Ok(found);
            }
            (_, None) => missing.push("  no emulator qemu-system-arm in the path".to_owned()),
            _ => {}
        }
        Err(format!("{}\n{HOW_TO_INSTALL}", missing.join("\n")))
    }

    /// A release build for the target, its core library built along. The compiler is a release, which
    /// takes unstable flags only when told that it builds itself.
    pub(super) fn build(&self, rust_flags: &str) -> Command {
        let script = repository_root().join("embedded/firmware/memory.x");
        let (linker, script) = (self.linker.display(), script.display());
        let flags =
            format!("-C linker={linker} -C link-arg=-T{script} -Zemit-stack-sizes{rust_flags}");
        let mut command = Command::new(cargo());
        command
            .args([
                "build",
                "--profile",
                "firmware",
                "--quiet",
                "-Zbuild-std=core",
                "--target",
                TARGET,
            ])
            .env("RUSTC", &self.compiler)
            .env("RUSTC_BOOTSTRAP", "1")
            .env("RUSTFLAGS", flags)
            .env("CARGO_TARGET_DIR", target_folder());
        command
    }

    /// Run a program on an emulated board, one instruction per nanosecond; what it printed.
    pub(super) fn emulate(&self, board: &str, program: &Path) -> Result<String, String> {
        let mut command = Command::new(&self.emulator);
        command
            .args(["-M", board, "-icount", "shift=0"])
            .args(["-display", "none", "-monitor", "none", "-serial", "none"])
            .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
            .arg(program);
        output_of(&mut command)
    }
}

/// The cargo that runs this chore.
pub(crate) fn cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Where the embedded workspace is built.
pub(crate) fn target_folder() -> PathBuf {
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    repository_root().join(target).join("embedded")
}

/// First line that a program says of itself; nothing if it cannot be run.
fn version(program: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    output.status.success().then(|| text.lines().next().unwrap_or_default().trim().to_owned())
}

/// What a command prints; what it complains of if it fails.
pub(crate) fn output_of(command: &mut Command) -> Result<String, String> {
    let line = format!("{command:?}");
    let Output { status, stdout, stderr } =
        command.output().map_err(|why| format!("{line}: could not be started: {why}"))?;
    if status.success() {
        return Ok(String::from_utf8_lossy(&stdout).into_owned());
    }
    Err(format!("{line}: {status}\n{}", String::from_utf8_lossy(&stderr)))
}

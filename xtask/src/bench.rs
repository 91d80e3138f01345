//! `cargo xtask bench`: the kernels beside the peers, in one run, as a page of the book.

mod figure;
mod page;
mod timings;

use crate::chores::cargo;
use crate::tidy::repository_root;
use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use timings::Timing;

/// What was measured, by vehicle and quantity.
pub(crate) struct Measured {
    /// `base`, `avx2`, `avx512`, `batch_of_8`; the peers by their names.
    pub(super) timings: BTreeMap<(String, String), BTreeMap<String, Timing>>,
    /// Operations that each kernel takes.
    pub(super) operations: BTreeMap<(String, String), f64>,
    /// What a core does at most in lanes, products and sums not fused (operations a nanosecond).
    pub(super) peak: f64,
    /// Processor, compiler, commit.
    pub(super) circumstances: [String; 3],
    /// Why the peers are missing, if they are.
    pub(super) without_peers: Option<String>,
}

/// Measure and write the page; with `--page`, write it from what was measured last; with `--quick`,
/// measure what is asked for most, shortly, and print how many times faster than the peers it is.
pub(crate) fn bench(arguments: &[String]) -> Result<(), String> {
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => cargo(&["bench", "-p", "wrasse-bench", "--bench", "kernels"], None)?,
        ["--page"] => {}
        ["--quick"] => return quick(),
        _ => return Err("usage: cargo xtask bench [--page | --quick]".to_owned()),
    }
    let target = target();
    let mut timings = timings::of_criterion(&target.join("criterion"))?;
    let peak = timings
        .remove(&("peak".to_owned(), "lanes_19200_operations".to_owned()))
        .and_then(|ways| ways.values().next().map(|t| 19_200.0 / t.minimum))
        .ok_or("the peak was not measured")?;
    let without_peers = peers(&target, &mut timings).err();
    let measured = Measured {
        timings,
        operations: operations()?,
        peak,
        circumstances: circumstances(),
        without_peers,
    };
    let book = repository_root().join("book/src");
    let write = |name: &str, text: String| {
        fs::write(book.join(name), text).map_err(|why| format!("{name}: {why}"))
    };
    write("performance.svg", figure::figure(&measured))?;
    write("performance.md", page::page(&measured))?;
    println!("{}", page::table(&measured));
    println!("book/src/performance.md was written");
    Ok(())
}

/// Ratios to the peers of a short run, one line each.
fn quick() -> Result<(), String> {
    let target = target();
    let results = target.join("criterion");
    if results.exists() {
        fs::remove_dir_all(&results).map_err(|why| format!("{}: {why}", results.display()))?;
    }
    let quantities = format!("({})\\.(avx2|base)$", page::QUICK.join("|"));
    let bench = ["bench", "-p", "wrasse-bench", "--bench", "kernels", "--", &quantities];
    let short = ["--warm-up-time", "0.1", "--measurement-time", "0.3", "--noplot"];
    cargo(&[&bench[..], &short].concat(), None)?;
    let mut timings = timings::of_criterion(&results)?;
    let without_peers = peers(&target, &mut timings).err();
    let (operations, circumstances) = (BTreeMap::new(), circumstances());
    let peak = f64::NAN;
    let measured = Measured { timings, operations, peak, circumstances, without_peers };
    if let Some(why) = &measured.without_peers {
        return Err(why.clone());
    }
    print!("{}", page::ratios(&measured));
    Ok(())
}

/// Where cargo builds.
fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| repository_root().join("target"), PathBuf::from)
}

/// Time the peers; why they could not be, if so.
fn peers(
    target: &std::path::Path,
    timings: &mut BTreeMap<(String, String), BTreeMap<String, Timing>>,
) -> Result<(), String> {
    println!("== validation/peers/run");
    let run = repository_root().join("validation/peers/run");
    let output = Command::new(run).arg(target.join("peers")).output();
    let output = output.map_err(|why| format!("the peers could not be started: {why}"))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        let why = why.lines().last().unwrap_or("no reason given").to_owned();
        return Err(format!("the peers could not be timed: {why}"));
    }
    timings::of_peers(&String::from_utf8_lossy(&output.stdout), timings)
}

/// Operations of each kernel, as the example counts them.
fn operations() -> Result<BTreeMap<(String, String), f64>, String> {
    let text =
        said_by(&["run", "--release", "-q", "-p", "wrasse-bench", "--example", "operations"])?;
    let row = |line: &str| {
        let mut words = line.split_whitespace().map(str::to_owned);
        let (vehicle, quantity) = (words.next()?, words.next()?);
        Some(((vehicle, quantity), words.next()?.parse().ok()?))
    };
    let rows: Option<BTreeMap<_, _>> = text.lines().map(row).collect();
    rows.ok_or_else(|| format!("not a table of operations:\n{text}"))
}

fn said_by(arguments: &[&str]) -> Result<String, String> {
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(program).args(arguments).current_dir(repository_root()).output();
    let output = output.map_err(|why| format!("cargo: {why}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

/// Processor, compiler and commit.
fn circumstances() -> [String; 3] {
    let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = processor.lines().find(|line| line.starts_with(name));
        line.and_then(|line| line.split(": ").nth(1)).unwrap_or("unknown").to_owned()
    };
    let say = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(repository_root()).output();
        output.map_or_else(
            |_| "unknown".to_owned(),
            |o| String::from_utf8_lossy(&o.stdout).trim().to_owned(),
        )
    };
    let cpu = format!(
        "{} (family {}, model {})",
        field("model name"),
        field("cpu family"),
        field("model\t")
    );
    [cpu, say("rustc", &["--version"]), say("git", &["describe", "--always", "--dirty"])]
}

//! Counting: each kernel called once under callgrind, which is the same on every run.

use crate::embedded::toolchain::{cargo, output_of, target_folder};
use crate::tidy::repository_root;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The function that the counter is switched on in.
const COUNTED: &str = "counted::counted";

/// Without these the C library copies memory by what the processor at hand does best, and the counts
/// would depend on it.
const PLAIN_COPIES: &str = "glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX2,-AVX,-ERMS,-FSRM,-SSSE3";

/// Most instructions that one control period of one seven-joint arm should take, `f64`, on the host:
/// a target, whose miss is told and does not fail.
/// The law that the paper uses, and the one that leaves the base free.
const BUDGETED: [(&str, u64); 2] =
    [("control_period_held/7", 24_700), ("control_period_floating/7", 28_000)];

/// Most that the worst state may take beyond the median (–).
const SPREAD: f64 = 0.10;

/// Counts of one kernel over its states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    pub(super) smallest: u64,
    pub(super) median: u64,
    pub(super) largest: u64,
}

/// Instructions by kernel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Counted {
    pub(super) compiler: String,
    pub(super) kernels: BTreeMap<String, Spread>,
}

/// The counter's version; nothing if it is not there.
pub(super) fn version() -> Option<String> {
    let mut command = Command::new("valgrind");
    output_of(command.arg("--version")).ok().map(|text| text.trim().to_owned())
}

/// Build the program of kernels as anybody builds it, and count.
pub(super) fn count() -> Result<Counted, String> {
    let mut build = Command::new(cargo());
    build
        .args(["build", "--release", "--quiet", "-p", "wrasse-golden-periods", "--bin", "counted"])
        .current_dir(repository_root().join("embedded"))
        .env("CARGO_TARGET_DIR", target_folder())
        .env("RUSTFLAGS", "");
    output_of(&mut build)?;
    let folder = target_folder().join("counts");
    let failed = |why: std::io::Error| format!("{}: {why}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    let mut run = Command::new("valgrind");
    run.args(["--tool=callgrind", "--callgrind-out-file=dump"])
        .args([format!("--toggle-collect={COUNTED}"), format!("--dump-after={COUNTED}")])
        .arg(target_folder().join("release").join("counted"))
        .current_dir(&folder)
        .env("GLIBC_TUNABLES", PLAIN_COPIES);
    let names = output_of(&mut run)?;
    let totals = totals(&folder, names.lines().count());
    fs::remove_dir_all(&folder).map_err(failed)?;
    let compiler = output_of(Command::new("rustc").arg("--version"))?.trim().to_owned();
    Ok(Counted { compiler, kernels: by_kernel(&names, &totals?) })
}

/// The total of each of so many dumps.
fn totals(folder: &Path, count: usize) -> Result<Vec<u64>, String> {
    let total = |number: usize| {
        let path = folder.join(format!("dump.{number}"));
        let text = fs::read_to_string(&path).map_err(|why| format!("{}: {why}", path.display()))?;
        let total = text.lines().find_map(|line| line.strip_prefix("totals: ")?.parse().ok());
        total.ok_or_else(|| format!("{}: no line `totals: NUMBER`", path.display()))
    };
    (1..=count).map(total).collect()
}

/// Totals in the order of the names that the program printed.
fn by_kernel(names: &str, totals: &[u64]) -> BTreeMap<String, Spread> {
    let mut all: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for (name, total) in names.lines().zip(totals) {
        all.entry(name.to_owned()).or_default().push(*total);
    }
    let spread = |(name, mut counts): (String, Vec<u64>)| {
        counts.sort_unstable();
        let (smallest, largest) = (counts[0], counts[counts.len() - 1]);
        (name, Spread { smallest, median: counts[counts.len() / 2], largest })
    };
    all.into_iter().map(spread).collect()
}

impl Counted {
    /// All counts, one kernel a line.
    pub(super) fn table(&self) -> String {
        let mut text =
            format!("{:27} {:>9} {:>9} {:>9}\n", "kernel/joints", "smallest", "median", "largest");
        for (name, Spread { smallest, median, largest }) in &self.kernels {
            let _ = writeln!(text, "{name:27} {smallest:9} {median:9} {largest:9}");
        }
        text
    }

    /// How the worst state of the control period stands to its budget, one law a line.
    pub(super) fn against_budget(&self) -> String {
        let mut text = String::new();
        for (name, budget) in BUDGETED {
            let Some(Spread { largest, .. }) = self.kernels.get(name) else { continue };
            let verdict = if *largest > budget { "MISSED" } else { "met" };
            let share = *largest as f64 / budget as f64;
            let _ = writeln!(
                text,
                "target of {budget} instructions {verdict}: {name} takes {largest} ({share:.2} of it)"
            );
        }
        text
    }

    /// Where the control period is not counted, or takes much more in some states than in others.
    pub(super) fn uneven(&self) -> Vec<String> {
        let mut findings = Vec::new();
        for (name, _) in BUDGETED {
            let Some(found) = self.kernels.get(name) else {
                findings.push(format!("{name}: not counted"));
                continue;
            };
            let Spread { median, largest, .. } = *found;
            if largest as f64 > median as f64 * (1.0 + SPREAD) {
                findings.push(format!(
                    "{name}: {largest} instructions in the worst state, {median} in the median: at most \
                     {:.0} % more are allowed, so that the time is known beforehand",
                    SPREAD * 100.0
                ));
            }
        }
        findings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn periods(median: u64, largest: u64) -> Counted {
        let spread = Spread { smallest: median, median, largest };
        let kernels = BUDGETED.map(|(name, _)| (name.to_owned(), spread));
        Counted { compiler: String::new(), kernels: kernels.into() }
    }

    #[test]
    fn dumps_belong_to_the_names_in_their_order() {
        let found = by_kernel("a/7\nb/7\na/7\na/7\n", &[30, 5, 10, 20]);
        assert_eq!(found["a/7"], Spread { smallest: 10, median: 20, largest: 30 });
        assert_eq!(found["b/7"], Spread { smallest: 5, median: 5, largest: 5 });
    }

    #[test]
    fn a_period_over_its_budget_is_told_and_does_not_fail() {
        assert!(periods(24_000, 24_500).against_budget().contains("met: control_period_held/7"));
        let missed = periods(30_000, 30_000);
        assert_eq!(missed.against_budget().matches("MISSED").count(), 2);
        assert!(missed.uneven().is_empty());
    }

    #[test]
    fn a_period_that_is_uneven_or_not_counted_fails() {
        assert!(periods(20_000, 22_000).uneven().is_empty());
        assert_eq!(periods(20_000, 22_100).uneven().len(), 2);
        let nothing = Counted { compiler: String::new(), kernels: BTreeMap::new() };
        assert_eq!(nothing.uneven().len(), 2);
    }
}

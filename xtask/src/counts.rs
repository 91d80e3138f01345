//! `cargo xtask counts`: instructions of the main kernels, held against the accepted ones.

mod accepted;
mod callgrind;

use crate::tidy::repository_root;
use accepted::Accepted;
use std::fs;

/// Where the accepted counts lie.
const FILE: &str = "validation/instruction_counts.toml";

/// What may be asked of the chore.
#[derive(Clone, Copy, PartialEq)]
enum Wish {
    /// Compare; skipped where the counter is missing.
    Compare,
    /// Compare; the counter must be there.
    Require,
    /// Write what was counted as what is accepted.
    Accept,
    /// The same, and as what the next release is compared with.
    Release,
}

/// Count, and compare or accept.
pub(crate) fn counts(arguments: &[String]) -> Result<(), String> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let wish = match words[..] {
        [] => Wish::Compare,
        ["--require"] => Wish::Require,
        ["--accept"] => Wish::Accept,
        ["--release"] => Wish::Release,
        _ => return Err("usage: cargo xtask counts [--require | --accept | --release]".to_owned()),
    };
    let Some(version) = callgrind::version() else {
        let how = "valgrind is not installed: apt-get install valgrind";
        if wish != Wish::Compare {
            return Err(how.to_owned());
        }
        println!("SKIPPED: instructions were not counted. {how}");
        return Ok(());
    };
    let counted = callgrind::count()?;
    println!("{version}; {}\n{}", counted.compiler, counted.table());
    println!("{}", counted.against_budget());
    let path = repository_root().join(FILE);
    let accepted = Accepted::read(&fs::read_to_string(&path).unwrap_or_default())?;
    if matches!(wish, Wish::Accept | Wish::Release) {
        let text = accepted.replaced_by(&counted, wish == Wish::Release).text();
        return fs::write(&path, text).map_err(|why| format!("{FILE}: {why}"));
    }
    let changelog = fs::read_to_string(repository_root().join("CHANGELOG.md")).unwrap_or_default();
    let mut findings = accepted.against(&counted);
    findings.extend(accepted.unstated(&changelog));
    findings.extend(counted.uneven());
    if findings.is_empty() { Ok(()) } else { Err(findings.join("\n")) }
}

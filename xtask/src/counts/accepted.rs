//! The accepted counts: what the code is held to, and what the last release took.

use super::FILE;
use super::callgrind::Counted;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Change that must be accepted and stated (–).
const TOLERANCE: f64 = 0.03;

const HEAD: &str = "\
# Instructions of one call of each main kernel, joint trigonometry included: callgrind on a plain
# release build for x86-64 with AVX2, vehicle atlas-class (7 joints, room for 8) and atlas-class-two-arms (14 of 16), median where
# a kernel is counted in many states. Written by `cargo xtask counts --accept`.
";

/// The file of accepted counts.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Accepted {
    /// Compiler that they were counted with.
    compiler: String,
    /// What the code is held to.
    counts: BTreeMap<String, u64>,
    /// What the last release took; before the first, what counting began with.
    released: BTreeMap<String, u64>,
}

impl Accepted {
    /// From the text of the file; an empty one accepts nothing yet.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let file: toml::Table = text.parse().map_err(|why| format!("{FILE}: {why}"))?;
        let table = |name: &str| {
            let entries = file.get(name).and_then(toml::Value::as_table).into_iter().flatten();
            let entry = |(kernel, value): (&String, &toml::Value)| {
                let count = value.as_integer().and_then(|n| u64::try_from(n).ok());
                let count = count.filter(|n| *n > 0).ok_or_else(|| {
                    format!("{FILE}: {name}.\"{kernel}\" is {value}, not a number of instructions")
                })?;
                Ok((kernel.clone(), count))
            };
            entries.map(entry).collect::<Result<BTreeMap<_, _>, String>>()
        };
        let compiler = file.get("compiler").and_then(toml::Value::as_str).unwrap_or_default();
        let (counts, released) = (table("counts")?, table("released")?);
        Ok(Self { compiler: compiler.to_owned(), counts, released })
    }

    /// The file's text.
    pub(super) fn text(&self) -> String {
        let mut text = format!("{HEAD}compiler = \"{}\"\n", self.compiler);
        let tables = [
            ("counts", "What the code is held to: a change of more than 3 % fails.", &self.counts),
            (
                "released",
                "At the last release; before the first, where counting began. What is more than 3 % \
                 away from it stands\n# in the changelog.",
                &self.released,
            ),
        ];
        for (name, what, counts) in tables {
            let _ = writeln!(text, "\n# {what}\n[{name}]");
            for (kernel, count) in counts {
                let _ = writeln!(text, "\"{kernel}\" = {count}");
            }
        }
        text
    }

    /// With what was counted; at a release also as what the next one is compared with. A kernel that
    /// is new begins there.
    pub(super) fn replaced_by(&self, counted: &Counted, release: bool) -> Self {
        let counts: BTreeMap<_, _> =
            counted.kernels.iter().map(|(name, spread)| (name.clone(), spread.median)).collect();
        let released = |name: &String, count: u64| match self.released.get(name) {
            Some(before) if !release => *before,
            _ => count,
        };
        let released = counts.iter().map(|(n, c)| (n.clone(), released(n, *c))).collect();
        Self { compiler: counted.compiler.clone(), counts, released }
    }

    /// Kernels that take more or fewer instructions than accepted.
    pub(super) fn against(&self, counted: &Counted) -> Vec<String> {
        let mut findings = Vec::new();
        for (name, spread) in &counted.kernels {
            match self.counts.get(name) {
                None => findings.push(format!("{name}: new, not in {FILE}")),
                Some(before) if changed(*before, spread.median) => findings.push(format!(
                    "{name}: {} instructions, {before} accepted ({:+.1} %)",
                    spread.median,
                    (spread.median as f64 / *before as f64 - 1.0) * 100.0
                )),
                Some(_) => {}
            }
        }
        let gone = self.counts.keys().filter(|name| !counted.kernels.contains_key(*name));
        findings.extend(gone.map(|name| format!("{name}: in {FILE}, but not counted")));
        if findings.is_empty() {
            return findings;
        }
        if self.compiler != counted.compiler {
            findings.push(format!(
                "the compiler is another one: `{}`, accepted were the counts of `{}`",
                counted.compiler, self.compiler
            ));
        }
        findings.push(
            "if that is meant, say it in CHANGELOG.md under `Results that change` with the kernel in \
             backticks, then run `cargo xtask counts --accept`"
                .to_owned(),
        );
        findings
    }

    /// Kernels that changed since the last release without a word in the changelog's unreleased part.
    pub(super) fn unstated(&self, changelog: &str) -> Vec<String> {
        let unreleased = changelog.split_once("## Unreleased").map_or("", |(_, rest)| rest);
        let unreleased = unreleased.split("\n## ").next().unwrap_or_default();
        let silent = self.counts.iter().filter_map(|(name, count)| {
            let before = self.released.get(name).copied().unwrap_or(*count);
            let kernel = name.split('/').next().unwrap_or(name);
            let stated = [name, kernel].iter().any(|word| unreleased.contains(&format!("`{word}`")));
            (changed(before, *count) && !stated).then(|| {
                format!(
                    "{name}: {before} instructions at the last release, now {count}: CHANGELOG.md does \
                     not say `{kernel}` under Unreleased"
                )
            })
        });
        silent.collect()
    }
}

fn changed(before: u64, now: u64) -> bool {
    (now as f64 - before as f64).abs() > before as f64 * TOLERANCE
}

#[cfg(test)]
mod tests {
    use super::super::callgrind::Spread;
    use super::*;

    fn counted(kernels: &[(&str, u64)]) -> Counted {
        let spread = |n: u64| Spread { smallest: n, median: n, largest: n };
        let kernels = kernels.iter().map(|(name, n)| ((*name).to_owned(), spread(*n))).collect();
        Counted { compiler: "rustc 1".to_owned(), kernels }
    }

    #[test]
    fn the_file_reads_as_it_was_written() {
        let accepted =
            Accepted::default().replaced_by(&counted(&[("a/7", 1000), ("b/7", 20)]), false);
        assert_eq!(Accepted::read(&accepted.text()), Ok(accepted));
        assert!(Accepted::read("[counts]\n\"a/7\" = \"many\"\n").is_err());
    }

    #[test]
    fn more_than_three_per_cent_either_way_is_told_and_less_is_not() {
        let accepted = Accepted::default().replaced_by(&counted(&[("a/7", 1000)]), false);
        for (now, told) in [(1030, 0), (970, 0), (1031, 2), (969, 2)] {
            assert_eq!(accepted.against(&counted(&[("a/7", now)])).len(), told, "{now}");
        }
        assert_eq!(accepted.against(&counted(&[("b/7", 1)])).len(), 3, "one new, one gone");
    }

    #[test]
    fn what_changed_since_the_release_must_stand_in_the_unreleased_part() {
        let released = Accepted::default().replaced_by(&counted(&[("a/7", 1000)]), true);
        let now = released.replaced_by(&counted(&[("a/7", 500)]), false);
        assert_eq!(now.unstated("## Unreleased\n\n## 0.1.0\n- `a` is faster.\n").len(), 1);
        assert!(now.unstated("## Unreleased\n\n- `a` takes half.\n\n## 0.1.0\n").is_empty());
        assert!(now.replaced_by(&counted(&[("a/7", 500)]), true).unstated("").is_empty());
    }
}

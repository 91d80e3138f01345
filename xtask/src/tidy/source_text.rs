//! What no source file may hold.

use super::dependencies::CORE;
use super::{files_below, text_of};
use std::path::Path;

/// Longest source file that is not a test.
const LONGEST_FILE: usize = 500;

/// Names that say nothing about what they hold.
const EMPTY_NAMES: [&str; 9] =
    ["utils", "util", "helpers", "helper", "common", "manager", "misc", "data2", "tmp1"];

/// What breaks the promise of the same bits every time, and marks of unfinished work.
const FORBIDDEN: [(&str, &str); 9] = [
    ("Instant::now", "a clock below the binary"),
    ("SystemTime", "a clock below the binary"),
    ("rand::rng", "global randomness"),
    ("thread_rng", "global randomness"),
    ("HashMap", "an order that changes from run to run (BTreeMap keeps one)"),
    ("HashSet", "an order that changes from run to run (BTreeSet keeps one)"),
    ("mul_add", "slow where the target has no fused instruction"),
    ("TODO", "unfinished work"),
    ("FIXME", "unfinished work"),
];

/// Methods of `f64` that take their bits from the host's library.
const HOST_FUNCTIONS: [&str; 19] = [
    ".sin()",
    ".cos()",
    ".tan()",
    ".asin()",
    ".atan()",
    ".sinh()",
    ".cosh()",
    ".tanh()",
    ".exp()",
    ".exp2()",
    ".exp_m1()",
    ".ln()",
    ".ln_1p()",
    ".log10()",
    ".log2()",
    ".powf(",
    ".powi(",
    ".cbrt()",
    ".hypot(",
];

/// Sources of the product and of the chores.
fn sources(root: &Path) -> Vec<String> {
    let mut all = files_below(root, "crates", ".rs");
    all.extend(files_below(root, "xtask", ".rs"));
    all
}

/// Files stay short, and names say what they hold.
pub(super) fn files(root: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    for path in sources(root) {
        let text = text_of(root, &path);
        let lines = text.lines().count();
        if lines > LONGEST_FILE && !path.contains("/tests/") {
            findings.push(format!("{path}: {lines} lines, at most {LONGEST_FILE}"));
        }
        let stem = path.trim_end_matches(".rs").trim_end_matches("/mod");
        let names = stem.rsplit('/').take(1).chain(text.lines().filter_map(declared_name));
        let empty = names.filter(|name| says_nothing(name));
        findings.extend(empty.map(|name| format!("{path}: `{name}` does not say what it holds")));
    }
    findings
}

/// Name that a line declares.
fn declared_name(line: &str) -> Option<&str> {
    if line.trim_start().starts_with("//") {
        return None;
    }
    let words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let mut words = words.filter(|word| !word.is_empty());
    let first = words.find(|word| !matches!(*word, "pub" | "crate" | "super" | "const"))?;
    let declares = matches!(first, "mod" | "struct" | "enum" | "trait" | "fn" | "type");
    if declares { words.next() } else { None }
}

/// Whether one of the words of a name is an empty one.
fn says_nothing(name: &str) -> bool {
    let mut spaced = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() {
            spaced.push('_');
        }
        spaced.extend(letter.to_lowercase());
    }
    spaced.split('_').any(|word| EMPTY_NAMES.contains(&word))
}

/// No clocks (but in the binary), no global randomness, no marks of unfinished work.
pub(super) fn words(root: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    for path in files_below(root, "crates", ".rs") {
        let in_binary = path.starts_with("crates/cli/");
        for (number, line) in (1..).zip(text_of(root, &path).lines()) {
            for (word, why) in FORBIDDEN {
                let allowed = in_binary && why.starts_with("a clock");
                if line.contains(word) && !allowed {
                    findings.push(format!("{path}:{number}: `{word}`: {why}"));
                }
            }
        }
    }
    findings
}

/// The core takes no elementary function from the host.
pub(super) fn core_floats(root: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    for path in CORE.iter().flat_map(|c| files_below(root, &format!("crates/{c}/src"), ".rs")) {
        // Tests may compare with the host's library.
        let text = text_of(root, &path);
        let product = text.lines().take_while(|line| line.trim() != "#[cfg(test)]");
        for (number, line) in (1..).zip(product) {
            let code = line.split("//").next().unwrap_or_default();
            let found = HOST_FUNCTIONS.iter().filter(|name| code.contains(**name));
            findings.extend(found.map(|name| {
                format!("{path}:{number}: `{name}`: use the functions of `Real` and `Scalar`")
            }));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_names_are_seen_inside_longer_ones() {
        assert!(says_nothing("file_utils") && says_nothing("StateManager"));
        assert!(!says_nothing("utilization") && !says_nothing("commonality"));
    }

    #[test]
    fn a_declaration_gives_its_name_and_a_comment_none() {
        assert_eq!(declared_name("pub(crate) fn helpers() {"), Some("helpers"));
        assert_eq!(declared_name("mod  common;"), Some("common"));
        assert_eq!(declared_name("// fn helpers"), None);
        assert_eq!(declared_name("assert!(x, \"fn helpers\");"), None);
    }
}

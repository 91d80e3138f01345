//! The book: a page for every algorithm, tests that exist, links that lead somewhere.

use super::{files_below, in_backticks, text_of};
use std::collections::BTreeSet;
use std::path::Path;

const SOURCE: &str = "book/src";
const SUMMARY: &str = "book/src/SUMMARY.md";

/// Heads of a theory page, in order.
const HEADS: [&str; 7] = [
    "## Problem",
    "## Assumptions and limits",
    "## Notation used",
    "## Derivation",
    "## Algorithm",
    "## Checks",
    "## Sources",
];

/// Every file of the dynamics has a theory page of its name; theory pages have their heads.
pub(super) fn theory_pages(root: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    for path in files_below(root, "crates/dynamics/src", ".rs") {
        let stem = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".rs");
        let page = format!("{SOURCE}/theory/{stem}.md");
        if stem != "lib" && !root.join(&page).exists() {
            findings.push(format!("{path}: no page {page}"));
        }
    }
    for page in files_below(root, &format!("{SOURCE}/theory"), ".md") {
        let text = text_of(root, &page);
        let heads: Vec<&str> = text.lines().filter(|line| line.starts_with("## ")).collect();
        if heads != HEADS {
            findings.push(format!("{page}: heads are {heads:?}, expected {HEADS:?}"));
        }
        let checks = text.split("\n## ").find_map(|part| part.strip_prefix("Checks\n"));
        if checks.is_none_or(|part| test_names(part).next().is_none()) {
            findings.push(format!("{page}: no test under Checks"));
        }
    }
    findings
}

/// A list item under "Checks" starts with the name of a test, which exists.
pub(super) fn named_tests(root: &Path) -> Vec<String> {
    let functions: BTreeSet<String> = ["crates", "xtask"]
        .iter()
        .flat_map(|folder| files_below(root, folder, ".rs"))
        .flat_map(|path| functions_of(&text_of(root, &path)))
        .collect();
    let mut findings = Vec::new();
    for page in files_below(root, SOURCE, ".md") {
        let text = text_of(root, &page);
        let names = test_names(&text);
        let missing = names.filter(|name| !functions.contains(*name));
        findings.extend(missing.map(|name| format!("{page}: no test `{name}`")));
    }
    findings
}

/// Names of the functions that a source file declares.
fn functions_of(text: &str) -> Vec<String> {
    let after_fn = text.lines().filter_map(|line| line.split_once("fn ").map(|(_, rest)| rest));
    let in_name = |c: char| c.is_alphanumeric() || c == '_';
    after_fn.map(|rest| rest.chars().take_while(|c| in_name(*c)).collect()).collect()
}

/// Last parts of the keys of files: they say the unit.
const UNITS: [&str; 12] =
    ["s", "s2", "h", "m", "n", "nm", "nms", "kg", "deg", "rad", "rpm", "arcsec"];

/// Words in backticks that read like the sentence of a test: long, four words or more, and not the key
/// of a file.
fn test_names(text: &str) -> impl Iterator<Item = &str> {
    in_backticks(text).filter(|word| {
        let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let words = word.split('_').filter(|part| !part.is_empty()).count();
        let is_key = word.rsplit('_').next().is_some_and(|last| UNITS.contains(&last));
        plain && !is_key && words >= 4 && word.len() >= 20
    })
}

/// Every page is in the summary, and relative links lead to files and heads that exist.
pub(super) fn links(root: &Path) -> Vec<String> {
    let pages = files_below(root, SOURCE, ".md");
    let summary = text_of(root, SUMMARY);
    let listed: BTreeSet<String> =
        targets(&summary).map(|target| format!("{SOURCE}/{target}")).collect();
    let mut findings: Vec<String> = pages
        .iter()
        .filter(|page| *page != SUMMARY && !listed.contains(*page))
        .map(|page| format!("{page}: not listed in {SUMMARY}"))
        .collect();
    for page in &pages {
        let text = text_of(root, page);
        let dead = targets(&text).filter(|target| !leads_somewhere(root, page, target));
        findings.extend(dead.map(|target| format!("{page}: `{target}` leads nowhere")));
    }
    findings
}

/// Paths of the repository that the book and the project's own pages name exist.
pub(super) fn paths(root: &Path) -> Vec<String> {
    let mut pages = files_below(root, SOURCE, ".md");
    pages.extend(["README.md", "CONTRIBUTING.md", "validation/README.md"].map(str::to_owned));
    let mut findings = Vec::new();
    for page in pages {
        let text = text_of(root, &page);
        let named = in_backticks(&text).filter(|word| is_path(word));
        let missing = named.filter(|path| !root.join(path).exists());
        findings.extend(missing.map(|path| format!("{page}: `{path}` does not exist")));
    }
    findings
}

/// Whether a word starts with one of the repository's folders, and stands for one path.
fn is_path(word: &str) -> bool {
    let first = word.split('/').next().unwrap_or_default();
    let ours = ["book", "crates", "missions", "validation", "vehicles", "xtask"].contains(&first);
    ours && word.contains('/') && !word.contains(['*', ' ', '<'])
}

/// Targets of the Markdown links of a page, fences and outside addresses left out.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    let outside_fences = text.split("```").step_by(2);
    let links = outside_fences.flat_map(|part| part.split("](").skip(1));
    let target = links.filter_map(|rest| rest.split(')').next());
    target.filter(|target| !target.contains("://"))
}

/// Whether a link on a page leads to a file, and to a head where it names one.
fn leads_somewhere(root: &Path, page: &str, target: &str) -> bool {
    let (path, head) = target.split_once('#').unwrap_or((target, ""));
    let folder = root.join(page).parent().expect("a page lies in a folder").to_owned();
    let file = if path.is_empty() { root.join(page) } else { folder.join(path) };
    let Ok(text) = std::fs::read_to_string(&file) else { return file.is_dir() };
    head.is_empty() || text.lines().any(|line| line.starts_with('#') && anchor(line) == head)
}

/// Anchor that mdBook gives a head.
fn anchor(line: &str) -> String {
    let words = line.trim_start_matches('#').trim().to_lowercase();
    let kept = words.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_names_of_tests_and_monograms_are_not() {
        let text = "`power_balances_on_trees`, `mass_matrix`, `cargo run_a_b_c_d_e`, `J_V_NE_N`";
        assert_eq!(test_names(text).collect::<Vec<_>>(), ["power_balances_on_trees"]);
    }

    #[test]
    fn a_path_starts_with_a_folder_of_the_repository() {
        assert!(is_path("vehicles/x.toml") && is_path("crates/"));
        assert!(!is_path("crates/*/tests") && !is_path("out/x") && !is_path("vehicles"));
    }

    #[test]
    fn links_out_of_the_book_are_left_alone() {
        let text = "[a](b.md) [c](https://d.e) ```\n[f](g.md)\n``` [h](../i.md#j-k)";
        assert_eq!(targets(text).collect::<Vec<_>>(), ["b.md", "../i.md#j-k"]);
        assert_eq!(anchor("## J K: (l)"), "j-k-l");
    }
}

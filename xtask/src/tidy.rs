//! Rules of the repository that no compiler knows. Each rule gives its findings as lines; none is
//! good news.

mod architecture;
mod book;
mod dependencies;
mod names;
mod printed_reactions;
mod quotations;
mod source_text;

use std::fs;
use std::path::{Path, PathBuf};

/// A rule: its name, and what it finds in the repository at a path.
type Rule = (&'static str, fn(&Path) -> Vec<String>);

const RULES: [Rule; 15] = [
    ("the map is at most two pages and its paths exist", architecture::map),
    ("every crate has its paragraph in the map", architecture::crates_described),
    ("every external dependency has its reason in the map", architecture::dependency_reasons),
    ("the arrows between crates are those of the map", dependencies::arrows),
    ("the core rests on itself, libm and cpufeatures, without std", dependencies::core_alone),
    ("files are short and named for what they hold", source_text::files),
    ("no clocks, global randomness or marks of unfinished work", source_text::words),
    ("names are the terms of the field", names::retired),
    ("elementary functions of the core come from one source", source_text::core_floats),
    ("every algorithm has its theory page, with all its heads", book::theory_pages),
    ("the tests that the book names exist", book::named_tests),
    ("the summary lists every page, and links between pages lead somewhere", book::links),
    ("paths that the book names exist", book::paths),
    ("what the book quotes stands in the file", quotations::stand_in_their_files),
    ("the table of printed reactions is that of the data", printed_reactions::table),
];

/// Print the findings of all rules.
pub(crate) fn report() -> Result<(), String> {
    let mut findings = 0;
    for (name, rule) in RULES {
        let found = rule(&repository_root());
        println!("{} {name}", if found.is_empty() { "ok  " } else { "FAIL" });
        for line in &found {
            println!("       {line}");
        }
        findings += found.len();
    }
    if findings == 0 { Ok(()) } else { Err(format!("{findings} findings")) }
}

/// The root of the repository.
pub(crate) fn repository_root() -> PathBuf {
    let xtask = Path::new(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().expect("xtask lies in the repository").to_owned()
}

/// The text of a file below the root; a file that is missing is an empty one.
fn text_of(root: &Path, path: &str) -> String {
    fs::read_to_string(root.join(path)).unwrap_or_default()
}

/// Paths below `folder` whose name ends in `ending`, relative to the root, in order.
pub(crate) fn files_below(root: &Path, folder: &str, ending: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.to_string_lossy().ends_with(ending) {
                let below = path.strip_prefix(root).expect("it was found below the root");
                found.push(below.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    found.sort();
    found
}

/// Words in backticks, fenced blocks left out.
fn in_backticks(text: &str) -> impl Iterator<Item = &str> {
    let outside_fences = text.split("```").step_by(2);
    outside_fences.flat_map(|part| part.split('`').skip(1).step_by(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repository_keeps_all_its_rules() {
        let findings: Vec<String> = RULES
            .iter()
            .flat_map(|(name, rule)| {
                rule(&repository_root()).into_iter().map(move |line| format!("{name}: {line}"))
            })
            .collect();
        assert!(findings.is_empty(), "\n{}", findings.join("\n"));
    }

    #[test]
    fn files_below_a_folder_are_found_in_order_and_by_ending() {
        let found = files_below(&repository_root(), "xtask", ".rs");
        assert!(found.contains(&"xtask/src/tidy/book.rs".to_owned()), "{found:?}");
        assert!(found.is_sorted() && !found.contains(&"xtask/Cargo.toml".to_owned()), "{found:?}");
    }

    #[test]
    fn words_in_fences_are_not_words_in_backticks() {
        let words: Vec<_> = in_backticks("a `b/c` d\n```text\n`no`\n```\n`e`").collect();
        assert_eq!(words, ["b/c", "e"]);
    }
}

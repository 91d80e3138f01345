//! `ARCHITECTURE.md`: a map that lies is worse than no map.

use super::{dependencies, in_backticks, text_of};
use std::path::Path;

/// Lines of two printed pages.
const TWO_PAGES: usize = 110;

/// Every path that the map names exists, and the map stays short.
pub(super) fn map(root: &Path) -> Vec<String> {
    let text = text_of(root, "ARCHITECTURE.md");
    let lines = text.lines().count();
    let mut findings = Vec::new();
    if lines == 0 || lines > TWO_PAGES {
        findings.push(format!("ARCHITECTURE.md: {lines} lines, expected 1 to {TWO_PAGES}"));
    }
    let paths = in_backticks(&text).filter(|word| word.contains('/') && !word.contains(' '));
    let missing = paths.filter(|path| !root.join(path).exists());
    findings.extend(missing.map(|path| format!("ARCHITECTURE.md: `{path}` does not exist")));
    findings
}

/// Every crate of the workspace is described by its folder's name.
pub(super) fn crates_described(root: &Path) -> Vec<String> {
    let text = text_of(root, "ARCHITECTURE.md");
    let folders = match dependencies::workspace(root) {
        Ok(crates) => crates.into_iter().map(|c| c.folder),
        Err(why) => return vec![why],
    };
    let undescribed = folders.filter(|f| !text.contains(&format!("**`{f}/`**")));
    undescribed.map(|f| format!("ARCHITECTURE.md: no paragraph starts with **`{f}/`**")).collect()
}

/// Every dependency from outside stands in the table with a reason.
pub(super) fn dependency_reasons(root: &Path) -> Vec<String> {
    let crates = match dependencies::workspace(root) {
        Ok(crates) => crates,
        Err(why) => return vec![why],
    };
    let mut external: Vec<String> = declared_in_workspace(&text_of(root, "Cargo.toml"));
    external.extend(crates.into_iter().flat_map(|c| c.external));
    external.sort();
    external.dedup();
    let text = text_of(root, "ARCHITECTURE.md");
    let unexplained = external.into_iter().filter(|name| !has_reason(&text, name));
    unexplained
        .map(|name| format!("ARCHITECTURE.md: no row `| {name} | reason |` for this dependency"))
        .collect()
}

/// A table row whose first cell names the dependency and whose second is not empty.
fn has_reason(text: &str, name: &str) -> bool {
    text.lines().any(|line| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        let named = cells.next().is_some_and(|cell| cell.split(", ").any(|word| word == name));
        named && cells.next().is_some_and(|reason| !reason.is_empty())
    })
}

/// Names under `[workspace.dependencies]` that are not the project's own crates.
fn declared_in_workspace(manifest: &str) -> Vec<String> {
    manifest
        .lines()
        .skip_while(|line| *line != "[workspace.dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter_map(|line| line.split_once(" = ").map(|(name, _)| name.trim()))
        .filter(|name| !name.starts_with('#') && !name.starts_with("wrasse"))
        .map(str::to_owned)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_without_a_reason_is_no_reason() {
        let table = "| toml, serde | files in |\n| clap | |\n";
        assert!(has_reason(table, "serde") && has_reason(table, "toml"));
        assert!(!has_reason(table, "clap") && !has_reason(table, "tom"));
    }

    #[test]
    fn the_manifest_gives_outside_names_only() {
        let manifest = "[workspace.dependencies]\nwrasse-a = { path = \"a\" }\n# why = so\n\
                        toml = \"1\"\n\n[profile.dev]\nx = 1\n";
        assert_eq!(declared_in_workspace(manifest), ["toml"]);
    }
}

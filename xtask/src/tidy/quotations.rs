//! What the book quotes from files of the repository stands there.

use super::{files_below, text_of};
use std::path::Path;

/// A fence of the book whose first line is `# from PATH` shows passages of that file: between blank
/// lines, each stands in the file as it stands in the book. A fence of TOML has such a line.
pub(super) fn stand_in_their_files(root: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    let mut pages = files_below(root, "book/src", ".md");
    pages.push("README.md".to_owned());
    for page in pages {
        for fence in text_of(root, &page).split("```").skip(1).step_by(2) {
            findings.extend(in_fence(root, fence).map(|what| format!("{page}: {what}")));
        }
    }
    findings
}

fn in_fence(root: &Path, fence: &str) -> Option<String> {
    let (kind, body) = fence.split_once('\n')?;
    let first = body.lines().next().unwrap_or_default();
    let Some(path) = first.strip_prefix("# from ") else {
        return (kind == "toml").then(|| format!("a quotation of TOML without `# from`: {first}"));
    };
    let source = text_of(root, path);
    let quoted = body.split_once('\n').map_or("", |(_, rest)| rest);
    let missing = quoted.split("\n\n").find(|passage| !source.contains(passage.trim_matches('\n')));
    missing.map(|passage| format!("`{path}` does not say: {}", passage.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_passage_that_the_file_does_not_hold_is_found() {
        let root = super::super::repository_root();
        assert_eq!(in_fence(&root, "toml\n# from rustfmt.toml\nmax_width = 100\n"), None);
        let wrong = in_fence(&root, "toml\n# from rustfmt.toml\nmax_width = 100\n\nmin = 3\n");
        assert_eq!(wrong.as_deref(), Some("`rustfmt.toml` does not say: min = 3"));
        assert!(in_fence(&root, "toml\nx = 1\n").is_some());
        assert_eq!(in_fence(&root, "text\nx = 1\n"), None);
    }
}

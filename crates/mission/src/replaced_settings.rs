//! Values that a command line lays over a mission, and that a compared row replaces again.

use wrasse_document::{Complaint, Document, Step, at};

/// A warning for each value that not every case is flown with.
pub(crate) fn replaced_settings(document: &Document) -> Vec<Complaint> {
    let outside = |path: &Vec<Step<'_>>| path.first() != Some(&Step::Key("compare"));
    let warning = |path: Vec<Step<'_>>| {
        let rows = rows_that_replace(document, &path);
        let (first, more) = (rows.first()?, rows.len() - 1);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let message = format!("{first}{more} of [[compare]] replaces this value");
        let help = "set the value of the row, or leave out what is compared: compare=[]";
        Some(document.warning(&path, message, "this value").with_help(help))
    };
    document.set_paths().into_iter().filter(outside).filter_map(warning).collect()
}

/// The compared rows that say something else at a path, or above it.
fn rows_that_replace(document: &Document, path: &[Step<'_>]) -> Vec<String> {
    let mut found = vec![];
    for axis in 0..document.len(at!["compare"]) {
        for row in 0..document.len(at!["compare", axis, "row"]) {
            let row_at: &[Step<'_>] = at!["compare", axis, "row", row];
            if document.replaces(&[row_at, at!["set"]].concat(), path) {
                let name = document.value(&[row_at, at!["name"]].concat());
                let name = name.as_ref().and_then(|name| name.as_str()).unwrap_or("?");
                found.push(format!("row {name:?}"));
            }
        }
    }
    found
}

//! The folder of results, and how a command hands them over.

use crate::input::{Failure, say, say_json};
use serde_json::Value;
use std::path::{Path, PathBuf};
use wrasse_mission::Mission;
use wrasse_record::{Provenance, RecordError, prepare_place};

/// The folder for results, ready to be written to: `out` if it is given, else out/`name`.
pub(crate) fn results_folder(out: Option<&Path>, name: &str) -> Result<PathBuf, Failure> {
    let folder = out.map_or_else(|| Path::new("out").join(name), Path::to_path_buf);
    prepare_place(&folder).map_err(|error| not_written(&error))?;
    Ok(folder)
}

/// Whence the results of a mission come.
pub(crate) fn provenance(mission: &Mission) -> Provenance {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    Provenance::of(mission, env!("WRASSE_COMMIT"), what_decides(words))
}

/// A command line without where the program is, where the results go, how they are shown and on how many
/// threads they are found: none of these changes them.
fn what_decides(words: impl Iterator<Item = String>) -> Vec<String> {
    let mut kept = vec!["wrasse".to_owned()];
    let mut words = words;
    while let Some(word) = words.next() {
        let (name, has_value) =
            word.split_once('=').map_or((&*word, false), |(name, _)| (name, true));
        match name {
            "--out" | "--threads" if !has_value => drop(words.next()),
            "--out" | "--threads" | "--json" | "--csv" => {}
            _ => kept.push(word),
        }
    }
    kept
}

/// Print what was asked for of results that are written: the summary as JSON, or the tables and where
/// the report is.
pub(crate) fn hand_over(
    report: Result<PathBuf, RecordError>,
    json: bool,
    summary: impl FnOnce() -> Value,
    tables: impl FnOnce() -> String,
) -> Result<(), Failure> {
    let report = report.map_err(|error| not_written(&error))?;
    if json {
        say_json(&summary());
    } else {
        say(&tables());
        say(&format!("report: {}", report.display()));
    }
    Ok(())
}

fn not_written(error: &RecordError) -> Failure {
    Failure::Sentence(format!("the results cannot be written: {error}"))
}

#[cfg(test)]
mod tests {
    use super::what_decides;

    #[test]
    fn what_changes_no_result_is_left_out_of_the_command_line() {
        let told =
            "run m.toml --out a --threads 4 --sample 3 --json --out=b --error-estimate --csv";
        let kept = what_decides(told.split(' ').map(String::from)).join(" ");
        assert_eq!(kept, "wrasse run m.toml --sample 3 --error-estimate");
    }
}

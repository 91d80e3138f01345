//! `cargo xtask golden`: numbers from outside against what the product computes, file by file.

mod capture;
mod comparison;
mod contract;
mod derivatives;
mod file;
mod friction;
mod kind;
mod normal_contact;
mod paper_equations;
mod peg;
mod product;
mod state;
mod table;
mod touching_bodies;
mod two_bodies;

use crate::tidy::repository_root;
use comparison::Comparison;
use file::{Complaint, GoldenFile};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask golden [FOLDER]";

/// Exit code when a file cannot be used.
const BAD_FILE: u8 = 2;

/// What came of all files.
#[derive(Debug, Default)]
struct Tally {
    agree: usize,
    missed: usize,
    not_built: usize,
    kinds_not_built: BTreeSet<String>,
    bad_files: usize,
}

impl Tally {
    fn exit_code(&self) -> u8 {
        match (self.bad_files, self.missed) {
            (0, 0) => 0,
            (0, _) => 1,
            _ => BAD_FILE,
        }
    }
    fn sentence(&self) -> String {
        let mut sentence = format!("{} cases agree, {} missed", self.agree, self.missed);
        if self.not_built > 0 {
            let kinds = self.kinds_not_built.len();
            let _ = write!(sentence, "; {} cases of {kinds} kinds are not built", self.not_built);
        }
        if self.bad_files > 0 {
            let _ = write!(sentence, "; {} files cannot be used", self.bad_files);
        }
        sentence
    }
}

/// Compare the folder that is named, or the repository's: exit code 1 for a missed tolerance, 2 for a
/// file that cannot be used.
pub(crate) fn golden(arguments: &[String]) -> ExitCode {
    let folder = match arguments {
        [] => repository_root().join("validation/golden"),
        [folder] if !folder.starts_with('-') => PathBuf::from(folder),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(BAD_FILE);
        }
    };
    ExitCode::from(compare(&folder, &mut |line| println!("{line}")).exit_code())
}

/// The repository's golden files, for the checks of a change.
pub(crate) fn in_repository() -> Result<(), String> {
    let folder = repository_root().join("validation/golden");
    let tally = compare(&folder, &mut |line| println!("{line}"));
    if tally.exit_code() == 0 { Ok(()) } else { Err(format!("golden: {}", tally.sentence())) }
}

/// Compare all golden files of a folder; each line is said as soon as it is known, complaints last.
fn compare(folder: &Path, say: &mut dyn FnMut(&str)) -> Tally {
    let (mut tally, mut complaints) = (Tally::default(), Vec::new());
    let files = json_files(folder);
    if files.is_empty() {
        complaints.push(format!("error: {}: no golden file (*.json) is there", folder.display()));
        tally.bad_files += 1;
    }
    say(&table::head());
    for path in files {
        let name = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
        let lines = match GoldenFile::read(&path) {
            Ok(Some(file)) => {
                let (lines, wrong) = compare_file(&name, &file, &mut tally);
                tally.bad_files += usize::from(!wrong.is_empty());
                complaints.extend(wrong.iter().map(Complaint::to_string));
                lines
            }
            Ok(None) => vec![table::row(&name, "", "skipped")],
            Err(complaint) => {
                tally.bad_files += 1;
                complaints.push(complaint.to_string());
                vec![table::row(&name, "", "unusable")]
            }
        };
        for line in &lines {
            say(line);
        }
    }
    say(&tally.sentence());
    for line in &complaints {
        say(line);
    }
    tally
}

/// The lines of one file, and what is wrong with it.
fn compare_file(name: &str, file: &GoldenFile, tally: &mut Tally) -> (Vec<String>, Vec<Complaint>) {
    let (mut lines, mut complaints) = (Vec::new(), Vec::new());
    let mut not_built: BTreeMap<&str, usize> = BTreeMap::new();
    let mut left_out: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut sentences = BTreeSet::new();
    for case in &file.cases {
        let Some(kind) = kind::named(&case.kind) else {
            tally.not_built += 1;
            tally.kinds_not_built.insert(case.kind.clone());
            *not_built.entry(&case.kind).or_default() += 1;
            continue;
        };
        sentences.insert(kind.tolerances().sentence);
        match kind.found(case) {
            Ok(found) => {
                let outcome = Comparison::of(&case.expect, &found, kind.tolerances());
                let count = if outcome.is_met() { &mut tally.agree } else { &mut tally.missed };
                *count += 1;
                lines.extend(table::case_lines(name, &case.label, &outcome));
                for (place, why) in outcome.left_out {
                    let (place, places) = (table::without_numbers(&place), left_out.entry(why));
                    let places = places.or_default();
                    if !places.contains(&place) {
                        places.push(place);
                    }
                }
            }
            Err(complaint) => {
                complaints.push(complaint);
                lines.push(table::row(name, &case.label, "unusable"));
            }
        }
    }
    lines.extend(not_built.iter().map(|(kind, count)| table::not_built(name, kind, *count)));
    lines.extend(left_out.iter().flat_map(|(why, places)| table::left_out(why, places)));
    if let Some(stated) = &file.tolerance
        && sentences.iter().any(|sentence| sentence != stated)
    {
        lines.extend(table::other_sentence(stated));
    }
    (lines, complaints)
}

/// Files below a folder that end in `.json`, in order; a file is itself.
fn json_files(folder: &Path) -> Vec<PathBuf> {
    let (mut found, mut waiting) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).into_iter().flatten().flatten().map(|e| e.path());
            let hidden = |path: &PathBuf| {
                path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
            };
            waiting.extend(entries.filter(|path| !hidden(path)));
        } else if path.extension().is_some_and(|ending| ending == "json") {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};
    use tempfile::TempDir;

    /// A golden file of the repository, as the reader has it.
    fn of_repository(name: &str) -> Value {
        let path = repository_root().join("validation/golden").join(name);
        serde_json::from_str(&fs::read_to_string(path).expect("the file")).expect("JSON")
    }

    fn folder(files: &[(&str, &str)]) -> TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("it is made");
            fs::write(path, text).expect("it is written");
        }
        folder
    }

    /// Exit code and all that is said.
    fn outcome(files: &[(&str, &str)]) -> (u8, String) {
        let (folder, mut said) = (folder(files), String::new());
        let tally = compare(folder.path(), &mut |line| said = format!("{said}{line}\n"));
        let too_long =
            said.lines().find(|line| line.chars().count() > 100 && !line.starts_with("error: "));
        assert_eq!(too_long, None, "lines have at most 100 characters");
        (tally.exit_code(), said)
    }

    const NAME: &str = "derivatives_one_arm.json";

    #[test]
    fn a_number_that_is_spoilt_exits_1_and_is_named() {
        let sound = of_repository(NAME);
        assert_eq!(outcome(&[(NAME, &sound.to_string())]).0, 0);
        let mut spoilt = sound;
        let number = &mut spoilt["inverse_dynamics"]["by_velocity"][3][2];
        *number = json!(number.as_f64().expect("a number") + 1e-6);
        let (code, said) = outcome(&[(NAME, &spoilt.to_string())]);
        assert_eq!(code, 1);
        assert!(said.contains("inverse_dynamics.by_velocity: off by 1.0e-6"), "{said}");
        assert!(said.contains("0 cases agree, 1 missed"), "{said}");
    }

    #[test]
    fn kinds_that_are_not_built_are_counted_and_no_failure() {
        let text = r#"{ "cases": [{ "kind": "a", "input": {}, "expect": { "x": 1 } },
            { "kind": "b", "expect": { "x": 1 } }, { "kind": "a", "expect": { "x": 2 } }] }"#;
        let (code, said) = outcome(&[("below/unheard_of_shared.json", text)]);
        assert_eq!(code, 0);
        assert!(said.contains("2 cases a ") && said.contains("1 case b "), "{said}");
        assert!(said.contains("3 cases of 2 kinds are not built"), "{said}");
    }

    #[test]
    fn a_number_that_nobody_compares_is_printed() {
        let mut file = of_repository(NAME);
        file["inverse_dynamics"]["by_temperature"] = json!([[1.0, 2.0]]);
        let (code, said) = outcome(&[(NAME, &file.to_string())]);
        assert_eq!(code, 0);
        let told =
            "not compared, for the kind gives no such number: inverse_dynamics.by_temperature";
        assert!(said.contains(told), "{said}");
    }

    #[test]
    fn files_that_cannot_be_used_exit_2_with_file_place_and_reason() {
        let without = |path: &str, member: &str| {
            let mut file = of_repository(NAME);
            file.pointer_mut(path).and_then(Value::as_object_mut).expect("it").remove(member);
            file.to_string()
        };
        let with = |path: &str, member: &str, value: Value| {
            let mut file = of_repository(NAME);
            file.pointer_mut(path).expect("it")[member] = value;
            file.to_string()
        };
        let joint = "/input/joints/a0_j3";
        let (q, at_q) = (json!({ "w": 2, "x": 0, "y": 0, "z": 0 }), "at input.base.attitude: ");
        let bad = [
            (NAME, "{ \"made_by\": ".to_owned(), "at line 1, column "),
            (NAME, "3".to_owned(), "expected an object or a list of cases, found 3"),
            (NAME, without("", "vehicle"), "at vehicle: is missing"),
            (NAME, without("", "input"), "at input: is missing"),
            (NAME, with("", "vehicle", json!("none.urdf")), "the vehicle none.urdf is neither"),
            (NAME, with(joint, "position", json!("x")), "at input: invalid type: string"),
            (
                NAME,
                with("/input/joints", "a9", json!({})),
                "at input.joints.a9: the joints are a0_j1",
            ),
            (NAME, with("/input/base", "attitude", q), at_q),
            (
                NAME,
                with("", "joint_names", json!(["a0_j1"])),
                "at joint_names: the joints are a0_j1",
            ),
            ("one_arm.json", "{}".to_owned(), "neither `cases` nor `expect` is there"),
            ("peg_shared.json", r#"{ "cases": {} }"#.to_owned(), "at cases: expected a list"),
            ("peg_shared.json", r#"{ "cases": [] }"#.to_owned(), "at cases: there is no case"),
            ("peg_shared.json", r#"{ "cases": [1] }"#.to_owned(), "at cases[0]: expected a case"),
            (
                "peg_shared.json",
                r#"{ "cases": [{}] }"#.to_owned(),
                "at cases[0].expect: is missing",
            ),
        ];
        for (name, text, complaint) in bad {
            let (code, said) = outcome(&[(name, &text)]);
            assert_eq!(code, 2, "{said}");
            let line = said.lines().find(|line| line.starts_with("error: ")).expect("a complaint");
            assert!(line.contains(name) && line.contains(complaint), "{line}");
        }
        let (code, said) = outcome(&[("readme.md", "")]);
        assert!(code == 2 && said.contains("no golden file"), "{said}");
    }

    #[test]
    fn vehicles_are_looked_for_beside_the_file_then_one_folder_up_then_in_the_repository() {
        let vehicle = repository_root().join("validation/golden/one_arm.urdf");
        let vehicle = fs::read_to_string(vehicle).expect("the vehicle");
        // Another mass of the first link: who reads this one finds other numbers.
        let other = vehicle.replacen("<mass value=\"", "<mass value=\"1", 1);
        assert_ne!(vehicle, other);
        let file = of_repository(NAME).to_string();
        let (up, beside) = ("one_arm.urdf", "below/one_arm.urdf");
        let golden = ("below/derivatives_one_arm.json", file.as_str());
        let codes = [
            outcome(&[golden]).0,
            outcome(&[golden, (up, &other)]).0,
            outcome(&[golden, (up, &other), (beside, &vehicle)]).0,
        ];
        assert_eq!(codes, [0, 1, 0]);
    }
}

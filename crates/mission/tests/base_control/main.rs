//! The missions of base control, flown once for all tests.
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod second_routes;
mod the_book;
mod what_comes_of_them;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use wrasse_mission::{Mission, Outcome, read_mission, run};
use wrasse_rehearsal::{CaseOutcome, RunOptions};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions/base-control")
}

fn read(text: &str) -> Mission {
    read_mission(folder().join("flown.toml"), text)
        .unwrap_or_else(|complaints| panic!("{}", wrasse_document::render(&complaints, false)))
}

fn fly(text: &str) -> Outcome {
    run(&read(text), RunOptions::default(), &mut |_| {})
}

fn text_of(name: &str) -> String {
    std::fs::read_to_string(folder().join(name).with_extension("toml")).expect("it is shipped")
}

/// All missions of the folder, flown once.
static FLOWN: LazyLock<BTreeMap<String, Outcome>> = LazyLock::new(|| {
    let entries = std::fs::read_dir(folder()).expect("the folder is there");
    let paths = entries.map(|e| e.expect("an entry").path());
    let names = paths.map(|p| p.file_stem().expect("it has a name").to_string_lossy().into_owned());
    names.map(|name| (name.clone(), fly(&text_of(&name)))).collect()
});

/// The case of a mission in this row; the only one if the row is empty.
#[track_caller]
fn case(mission: &str, row: &str) -> &'static CaseOutcome {
    let cases = &FLOWN[mission].cases;
    let found =
        cases.iter().find(|c| c.labels.iter().map(|l| l.1.as_str()).collect::<String>() == row);
    found.unwrap_or_else(|| panic!("{mission} has no case {row:?}"))
}

#[track_caller]
fn metric(case: &CaseOutcome, name: &str) -> f64 {
    let found = case.metrics.iter().find(|m| m.name == name);
    found.unwrap_or_else(|| panic!("no metric {name}; it ended with {:?}", case.end)).value
}

fn degrees(case: &CaseOutcome, name: &str) -> f64 {
    metric(case, name).to_degrees()
}

#[track_caller]
fn channel<'a>(case: &'a CaseOutcome, name: &str) -> &'a [f64] {
    let found = case.telemetry.channels.iter().find(|c| c.name == name);
    &found.unwrap_or_else(|| panic!("no channel {name}")).values
}

/// What was said that starts with these words, with its time (s).
#[track_caller]
fn said<'a>(case: &'a CaseOutcome, words: &str) -> (f64, &'a str) {
    let found = case.events.iter().find(|e| e.text.starts_with(words));
    let found = found.unwrap_or_else(|| panic!("no `{words}` in {:?}", case.events));
    (found.time_s, &found.text)
}

/// A number within a share of what was measured.
#[track_caller]
fn about(found: f64, measured: f64, share: f64) {
    println!("{found:.5e}, measured before {measured:e}");
    assert!(
        (found / measured - 1.0).abs() < share,
        "found {found}, not within {share} of {measured}"
    );
}

//! Changed texts of XML models, for whatever format: nothing makes a reader panic, and a refusal says why.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use wrasse_document::{Severity, render};
use wrasse_vehicle::read_vehicle;

/// What models of a format are made of.
pub(crate) struct Format {
    /// A file name with its ending.
    pub(crate) file: &'static str,
    /// Models to begin with.
    pub(crate) seeds: &'static [&'static str],
    /// Words that come in between.
    pub(crate) words: &'static [&'static str],
    /// What stands before and behind the content of a model.
    pub(crate) around: (&'static str, &'static str),
    /// Tags that may stand within one another.
    pub(crate) tags: &'static [&'static str],
}

fn survives(file: &str, text: &str) -> Result<(), TestCaseError> {
    let remarks = match read_vehicle(file, text) {
        Ok(vehicle) => {
            prop_assert!(vehicle.robot.mass() > 0.0);
            vehicle.remarks
        }
        Err(complaints) => {
            prop_assert!(complaints.iter().any(|c| c.severity == Severity::Error));
            complaints
        }
    };
    for span in remarks.iter().filter_map(|c| c.span.clone()) {
        prop_assert!(text.get(span.clone()).is_some(), "{span:?} is no place in the text");
    }
    prop_assert!(remarks.is_empty() || !render(&remarks, false).is_empty());
    Ok(())
}

/// Parts of a text are counted in ten-thousandths.
const WHOLE: usize = 10_000;

/// The character boundary at or before a part of the text.
fn place(text: &str, part: usize) -> usize {
    let at = part * text.len() / WHOLE;
    (0..=at).rev().find(|&k| text.is_char_boundary(k)).unwrap_or(0)
}

/// One change: delete, double or replace a slice, or exchange two slices.
fn changed(
    text: &str,
    words: &[&str],
    (what, a, b, c, word): (u8, usize, usize, usize, usize),
) -> String {
    let mut places = [place(text, a), place(text, (a + b / 50).min(WHOLE)), place(text, c)];
    let slice = &text[places[0]..places[1]];
    match what {
        0 => [&text[..places[0]], &text[places[1]..]].concat(),
        1 => [&text[..places[1]], slice, &text[places[1]..]].concat(),
        2 => [&text[..places[0]], words[word], &text[places[1]..]].concat(),
        3 => [&text[..places[0]], words[word], &text[places[0]..]].concat(),
        _ => {
            places.sort_unstable();
            let [i, j, k] = places;
            [&text[..i], &text[j..k], &text[i..j], &text[k..]].concat()
        }
    }
}

/// The values of two attributes, exchanged.
fn exchanged(text: &str, first: usize, second: usize) -> String {
    let mut quoted: Vec<_> = text.split('"').collect();
    let values = quoted.len() / 2;
    quoted.swap(1 + 2 * (first % values), 1 + 2 * (second % values));
    quoted.join("\"")
}

/// A thousand cases, always the same.
fn run<S: Strategy>(cases: &S, test: impl Fn(S::Value) -> Result<(), TestCaseError>) {
    let config = Config {
        cases: 1000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(42),
        ..Config::default()
    };
    TestRunner::new(config).run(cases, test).unwrap_or_else(|why| panic!("{why}"));
}

impl Format {
    fn seed(&self) -> impl Strategy<Value = &'static str> + use<> {
        prop::sample::select(self.seeds)
    }
    pub(crate) fn survives_arbitrary_text(&self) {
        let (before, behind) = self.around;
        run(&"\\PC{0,200}", |text: String| {
            survives(self.file, &text)?;
            survives(self.file, &format!("{before}{text}{behind}"))
        });
    }
    pub(crate) fn survives_changes(&self) {
        let change = (0..5u8, 0..WHOLE, 0..WHOLE, 0..WHOLE, 0..self.words.len());
        run(&(self.seed(), prop::collection::vec(change, 1..6)), |(seed, changes)| {
            let change = |text: String, c| changed(&text, self.words, c);
            survives(self.file, &changes.into_iter().fold(seed.to_owned(), change))
        });
    }
    pub(crate) fn survives_exchanged_attributes(&self) {
        let pairs = prop::collection::vec((0..500usize, 0..500usize), 1..4);
        run(&(self.seed(), pairs), |(seed, pairs)| {
            let swap = |text: String, (a, b)| exchanged(&text, a, b);
            survives(self.file, &pairs.into_iter().fold(seed.to_owned(), swap))
        });
    }
    pub(crate) fn survives_attributes_of_arbitrary_text(&self) {
        run(&("[-+0-9.eE&;,$ {}naif]{0,12}", 0..500usize), |(value, at)| {
            let mut quoted: Vec<&str> = self.seeds[0].split('"').collect();
            let values = quoted.len() / 2;
            quoted[1 + 2 * (at % values)] = &value;
            survives(self.file, &quoted.join("\""))
        });
    }
    pub(crate) fn survives_deep_nesting(&self) {
        let (before, behind) = self.around;
        for tag in self.tags {
            let text = format!("{before}{}", format!("<{tag}>").repeat(20_000));
            survives(self.file, &text).expect("an answer");
            let closed = format!("{text}{}{behind}", format!("</{tag}>").repeat(20_000));
            survives(self.file, &closed).expect("an answer");
        }
    }
}

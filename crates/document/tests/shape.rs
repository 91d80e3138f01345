//! What a user sees when a file has not the shape of its format.

use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_document::{Complaint, Document, at, render};

/// A format with everything that a format may have.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Craft {
    /// What it is called.
    #[schemars(length(min = 1))]
    name: String,
    #[serde(default)]
    body: Vec<Body>,
    law: Option<Law>,
    #[serde(default)]
    turn: Option<Turn>,
    #[serde(default)]
    angle_deg: BTreeMap<String, f64>,
    solver: Option<Solver>,
    seed: Option<u32>,
    size: Option<Size>,
    #[serde(default)]
    quiet: bool,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Body {
    name: String,
    /// Mass (kg).
    #[schemars(extend("x-formerly" = ["heft"]))]
    mass_kg: f64,
    centre_m: Option<[f64; 3]>,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Law {
    /// On the ground.
    Terrestrial,
    /// In orbit.
    #[schemars(extend("x-formerly" = ["unbound"]))]
    FreeFloating,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Turn {
    RpyDeg([f64; 3]),
    Quaternion(Quaternion),
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Quaternion {
    w: f64,
    x: f64,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
enum Solver {
    FixedStep { step_s: f64 },
    Adaptive { tolerance: f64 },
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged)]
enum Size {
    Round(f64),
    Edges([f64; 3]),
}

fn read(text: &str) -> Result<Craft, Vec<Complaint>> {
    Document::parse("craft.toml", text)?.read()
}

fn complaints(text: &str) -> String {
    render(&read(text).expect_err("a complaint"), false)
}

/// `text` has one mistake, and its complaint says all these words.
#[track_caller]
fn assert_complains(text: &str, words: &[&str]) {
    let complaints = complaints(text);
    for word in words {
        assert!(complaints.contains(word), "no `{word}` in\n{complaints}");
    }
    assert!(complaints.ends_with("\n1 error\n"), "not one complaint:\n{complaints}");
}

#[test]
fn a_file_without_mistakes_is_read() {
    let craft = read(
        "name = 'a'\nlaw = 'free-floating'\nturn = { rpy_deg = [1, 2.5, 3] }\nseed = 3\n\
         angle_deg = { knee = 3 }\nsolver = { kind = 'fixed-step', step_s = 1 }\nsize = [1, 2, 3]\n\
         [[body]]\nname = 'bus'\nmass_kg = 3\n",
    )
    .unwrap();
    let body = Body { name: "bus".into(), mass_kg: 3.0, centre_m: None };
    let expected = Craft {
        name: "a".into(),
        body: vec![body],
        law: Some(Law::FreeFloating),
        turn: Some(Turn::RpyDeg([1.0, 2.5, 3.0])),
        angle_deg: BTreeMap::from([("knee".into(), 3.0)]),
        solver: Some(Solver::FixedStep { step_s: 1.0 }),
        seed: Some(3),
        size: Some(Size::Edges([1.0, 2.0, 3.0])),
        quiet: false,
    };
    assert_eq!(craft, expected);
}

#[test]
fn all_mistakes_of_a_file_are_reported_at_once() {
    let text = "\
naem = 'a'
law = 'terestrial'
seed = 1.5
quiet = 'yes'
turn = { rpy_deg = [1, 2] }

[[body]]
name = 'bus'
mass = 1500.0

[[body]]
name = 'arm'
mass_kg = nan
centre_m = [0, 'up', 0]
color = 'red'
";
    assert_eq!(complaints(text), include_str!("all_mistakes.txt"));
}

#[test]
fn a_missing_key_says_what_it_is_for() {
    assert_complains("name = ''", &["`name` must not be empty"]);
    assert_complains("", &["the file has no `name`", "help: `name`: What it is called"]);
    assert_complains(
        "name = 'a'\n[[body]]\nname = 'bus'\n",
        &["craft.toml:2:1", "`body` \"bus\" has no `mass_kg`", "help: `mass_kg`: Mass (kg)"],
    );
}

#[test]
fn a_choice_of_shapes_names_them() {
    assert_complains(
        "name = 'a'\nturn = { quaternoin = { w = 1, x = 0 } }\n",
        &["unknown key `quaternoin`", "`rpy_deg` or `quaternion`", "did you mean `quaternion`?"],
    );
    assert_complains(
        "name = 'a'\nturn = { quaternion = { w = 1, x = 0 }, rpy_deg = [0, 0, 0] }\n",
        &["`turn` must have one key"],
    );
    assert_complains(
        "name = 'a'\nturn = 3\n",
        &["must be { rpy_deg = … } or { quaternion = … }, found an integer"],
    );
    assert_complains("name = 'a'\nlaw = 3\n", &["\"terrestrial\" or \"free-floating\", found"]);
    assert_complains(
        "name = 'a'\nsolver = { step_s = 3 }\n",
        &["`solver` has no `kind`", "\"fixed-step\" or \"adaptive\""],
    );
    assert_complains(
        "name = 'a'\nsolver = { kind = 'adaptive', tolerance = 1, step_s = 1 }\n",
        &["unknown key `step_s`"],
    );
    assert_complains("name = 'a'\nsolver = { kind = 'fixed' }\n", &["found \"fixed\""]);
    assert_complains("name = 'a'\nsize = 'big'\n", &["must be a number or a list"]);
    assert_complains("name = 'a'\nsize = [1, 2]\n", &["`size` must have 3 values, found 2"]);
}

#[test]
fn a_number_out_of_the_range_of_its_type_is_a_complaint() {
    assert_complains("name = 'a'\nseed = -1\n", &["`seed` must be at least 0, found -1"]);
    assert_complains("name = 'a'\nangle_deg = { knee = inf }\n", &["not a finite number"]);
    assert_complains("name = 'a'\nseed = 99999999999999999999\n", &["beyond the range of 64 bits"]);
}

#[test]
fn text_that_is_not_toml_is_shown_where_it_breaks() {
    let complaints = complaints("name = 'a'\nmass_kg = 3 kg\n");
    assert!(complaints.contains("craft.toml:2:11"), "{complaints}");
    assert!(complaints.contains("write the number alone"), "{complaints}");
}

#[test]
fn a_path_finds_its_place_or_the_nearest_above() {
    let text = "name = 'a'\n[[body]]\nname = 'bus'\nmass_kg = 3\n";
    let document = Document::parse("craft.toml", text).unwrap();
    let at = |path: &[wrasse_document::Step<'_>]| document.span(path).map(|s| &text[s]);
    assert_eq!(at(at!["body", 0, "mass_kg"]), Some("3"));
    assert_eq!(at(at!["body", 0, "centre_m"]), Some("[[body]]"));
    assert_eq!(at(at!["body", 7]), Some("[[body]]"));
    assert_eq!(at(at!["elsewhere"]), None);
    let key = document.key_span(at!["body", 0, "mass_kg"]).map(|s| &text[s]);
    assert_eq!(key, Some("mass_kg"));
    assert_eq!(document.keys(at!["body", 0]), ["mass_kg", "name"]);
    assert_eq!(document.keys(at![]), ["body", "name"]);
    assert!(document.keys(at!["name"]).is_empty());
}

#[test]
fn an_overlay_replaces_values_and_keeps_their_places() {
    let text = "name = 'a'\nsolver = { kind = 'fixed-step', step_s = 1 }\n\
                [[variant]]\nset.solver.step_s = 2\n[[variant]]\nset.solver.step_s = 'x'\n";
    let document = Document::parse("craft.toml", text).unwrap();
    let variant = |i: usize| document.overlaid(at!["variant", i, "set"], &["variant"]);
    let craft: Craft = variant(0).read().unwrap();
    assert_eq!(craft.solver, Some(Solver::FixedStep { step_s: 2.0 }));
    let complaints = variant(1).read::<Craft>().unwrap_err();
    assert_eq!(complaints.len(), 1);
    assert_eq!(complaints[0].span.clone().map(|s| &text[s]), Some("'x'"));
}

#[test]
fn complaints_come_errors_first_and_are_counted() {
    let document = Document::parse("craft.toml", "a = 1\nb = 2\nc = 3\n").unwrap();
    let late = document.error(at!["c"], "third", "here");
    let early = document.error(at!["a"], "first", "here");
    let warning = document.warning(at!["b"], "second", "here").with_help("mend it");
    let text = render(&[warning, late, early], false);
    let order: Vec<_> = ["first", "third", "second", "mend it"].map(|w| text.find(w)).into();
    assert!(order.is_sorted() && order[0].is_some(), "{text}");
    assert!(text.ends_with("\n2 errors, 1 warning\n"), "{text}");
    assert!(render(&[], false).is_empty());
}

mod never_panics {
    use super::*;
    use proptest::prelude::*;

    const VALID: &str = "name = 'ä'\nlaw = 'free-floating'\nturn = { rpy_deg = [1, 2.5, 3] }\n\
        seed = 3\nangle_deg = { knee = 3 }\nsolver = { kind = 'fixed-step', step_s = 1 }\n\
        size = [1, 2, 3]\n[[body]]\nname = \"büs\"\nmass_kg = 3\ncentre_m = [0, 0, 0]\n";

    /// Reads and shows the complaints, as the program would.
    fn survives(text: &str) {
        let complaints = match Document::parse("craft.toml", text) {
            Ok(document) => document.read::<Craft>().err().unwrap_or_default(),
            Err(complaints) => complaints,
        };
        assert_eq!(render(&complaints, true).is_empty(), complaints.is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            rng_seed: proptest::test_runner::RngSeed::Fixed(2),
            failure_persistence: None,
            ..ProptestConfig::default()
        })]
        #[test]
        fn arbitrary_text(text in "\\PC*") {
            survives(&text);
        }
        #[test]
        fn arbitrary_toml_like_text(text in "([a-z_.]{1,4} ?= ?|[\\[\\]{}'\",=\n\r\t#é漢]|-?[0-9]{1,3}\\.?){0,40}") {
            survives(&text);
        }
        #[test]
        fn a_mutated_file(cut in any::<[prop::sample::Index; 3]>(), other in "\\PC{0,6}|[\\[\\]{}\n\"'=,.-]{1,3}") {
            let chars: Vec<char> = VALID.chars().collect();
            let [a, b, c] = cut.map(|i| i.index(chars.len()));
            let (a, b) = (a.min(b), a.max(b));
            let put = |parts: [&[char]; 3], middle: &str| -> String {
                let text = |part: &[char]| part.iter().collect::<String>();
                text(parts[0]) + middle + &text(parts[1]) + &text(parts[2])
            };
            // Deleted, replaced, doubled.
            survives(&put([&chars[..a], &[], &chars[b..]], ""));
            survives(&put([&chars[..c], &[], &chars[c..]], &other));
            survives(&put([&chars[..b], &chars[a..b], &chars[b..]], ""));
        }
        #[test]
        fn any_span_of_any_text(text in "\\PC{0,40}|[\n\r\té漢a]{0,20}", start in 0_usize..60, end in 0_usize..60) {
            let source = wrasse_document::Source::new("f", text);
            let complaint = Complaint::error(&source, "wrong").at(start..end, "here");
            prop_assert!(!render(&[complaint], false).is_empty());
        }
    }
}

#[test]
fn a_key_or_word_that_was_renamed_is_answered_with_its_new_name() {
    let body = "name = 'a'\n[[body]]\nname = 'bus'\n";
    assert_complains(
        &format!("{body}heft = 3\n"),
        &["unknown key `heft`", "`heft` was renamed: write `mass_kg`"],
    );
    assert_complains(
        &format!("law = 'unbound'\n{body}mass_kg = 3\n"),
        &["found \"unbound\"", "\"unbound\" was renamed: write \"free-floating\""],
    );
}

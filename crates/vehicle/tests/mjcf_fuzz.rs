//! No text makes the MJCF reader panic, and a refusal always says why.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_document::{Severity, render};
use wrasse_vehicle::read_vehicle;

const SEEDS: [&str; 3] = [
    include_str!("data/mjcf/servicer.xml"),
    include_str!("data/mjcf/conventions.xml"),
    r#"<mujoco><compiler settotalmass="9" boundmass="1"/><default><default class="ä"><joint ref="3"/>
</default></default><worldbody><body name="bus"><freejoint/><geom size="1"/><frame euler="1 2 3">
<body childclass="ä"><joint type="slide" range="0 1"/><geom type="box" size="1 1 1" density="3"/>
</body></frame></body><body mocap="true"/></worldbody><keyframe><key qpos="1"/></keyframe></mujoco>"#,
];

/// Words that turn one valid file into another, or into a mistake that is nearly one.
const WORDS: [&str; 24] = [
    "\"",
    "<",
    "/>",
    "</body>",
    "<body name=\"bus\">",
    "<joint type=\"ball\"/>",
    "<frame>",
    "<include file=\"x\"/>",
    "<inertial/>",
    "mass=\"-1\"",
    "fromto",
    "nan",
    "-inf",
    "1e308",
    "-1e-320",
    "0",
    "&#48;",
    "ä\u{301}",
    "<!--",
    "]]>",
    "class=\"arm\"",
    "<default>",
    "eulerseq=\"xyz\"",
    "<equality><weld/></equality>",
];

fn survives(text: &str) -> Result<(), TestCaseError> {
    let remarks = match read_vehicle("fuzz.xml", text) {
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
fn changed(text: &str, (what, a, b, c, word): (u8, usize, usize, usize, usize)) -> String {
    let mut places = [place(text, a), place(text, (a + b / 50).min(WHOLE)), place(text, c)];
    let slice = &text[places[0]..places[1]];
    match what {
        0 => [&text[..places[0]], &text[places[1]..]].concat(),
        1 => [&text[..places[1]], slice, &text[places[1]..]].concat(),
        2 => [&text[..places[0]], WORDS[word], &text[places[1]..]].concat(),
        3 => [&text[..places[0]], WORDS[word], &text[places[0]..]].concat(),
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

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(42),
        ..Default::default()
    })]

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,200}") {
        survives(&text)?;
        survives(&format!("<mujoco><worldbody>{text}</worldbody></mujoco>"))?;
    }

    #[test]
    fn changed_files_never_panic(
        seed in 0..SEEDS.len(),
        changes in prop::collection::vec(
            (0..5u8, 0..WHOLE, 0..WHOLE, 0..WHOLE, 0..WORDS.len()), 1..6),
    ) {
        let text = changes.into_iter().fold(SEEDS[seed].to_owned(), |t, c| changed(&t, c));
        survives(&text)?;
    }

    #[test]
    fn exchanged_attributes_never_panic(
        seed in 0..SEEDS.len(),
        pairs in prop::collection::vec((0..500usize, 0..500usize), 1..4),
    ) {
        let swap = |text: String, (a, b)| exchanged(&text, a, b);
        survives(&pairs.into_iter().fold(SEEDS[seed].to_owned(), swap))?;
    }

    #[test]
    fn attributes_of_arbitrary_text_never_panic(value in "[-+0-9.eE&;,$ {}naif]{0,12}", at in 0..500usize) {
        let mut quoted: Vec<_> = SEEDS[0].split('"').collect();
        let values = quoted.len() / 2;
        quoted[1 + 2 * (at % values)] = &value;
        survives(&quoted.join("\""))?;
    }
}

#[test]
fn deep_nesting_never_panics() {
    for tag in ["body", "frame", "default", "a"] {
        let text = format!("<mujoco><worldbody>{}", format!("<{tag}>").repeat(20_000));
        survives(&text).expect("an answer");
        let closed = format!("{text}{}</worldbody></mujoco>", format!("</{tag}>").repeat(20_000));
        survives(&closed).expect("an answer");
    }
}

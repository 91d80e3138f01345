//! No text makes the reader of missions panic, and no mission that is read makes a run panic.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_document::{Severity, render};
use wrasse_mission::{Mission, read_mission, run};
use wrasse_rehearsal::{End, RunOptions};

const SHIPPED: [&str; 23] = [
    include_str!("../../../missions/atlas-reach.toml"),
    include_str!("../../../missions/coast.toml"),
    include_str!("../../../missions/ets-vii-reach.toml"),
    include_str!("../../../missions/grasp-and-release.toml"),
    include_str!("../../../missions/shuttle-rms-berth.toml"),
    include_str!("../../../missions/two-arms.toml"),
    include_str!("../../../missions/two-arms-at-once.toml"),
    include_str!("../../../missions/grasp-again.toml"),
    include_str!("../../../missions/slosh.toml"),
    include_str!("../../../missions/miss-distance/feedforward.toml"),
    include_str!("../../../missions/miss-distance/laws.toml"),
    include_str!("../../../missions/miss-distance/overshoot.toml"),
    include_str!("../../../missions/base-control/gimbal-stuck.toml"),
    include_str!("../../../missions/base-control/cmgs.toml"),
    include_str!("../../../missions/base-control/hybrid.toml"),
    include_str!("../../../missions/base-control/noisy-tracker.toml"),
    include_str!("../../../missions/base-control/posture-relief.toml"),
    include_str!("../../../missions/base-control/singular-cmgs.toml"),
    include_str!("../../../missions/base-control/tank-empty.toml"),
    include_str!("../../../missions/base-control/thrusters.toml"),
    include_str!("../../../missions/base-control/wheel-fails.toml"),
    include_str!("../../../missions/base-control/wheels-saturate.toml"),
    include_str!("../../../missions/base-control/wheels.toml"),
];

/// What can stand in place of a number: TOML knows nan and inf.
const NUMBERS: [&str; 14] = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e300",
    "-1e300",
    "1e-300",
    "9223372036854775807",
    "1e999",
    "-0.0",
    "1",
    "1e9",
    "\"1\"",
];

/// Words that turn one valid mission into another, or into a mistake that is nearly one.
const WORDS: [&str; 47] = [
    "\"",
    "[",
    "]]",
    "{",
    "}",
    "=",
    "\n",
    "#",
    "[[phase]]\nname = \"x\"\n",
    "hold = { duration_s = 0.03, keep = \"tool\" }\n",
    "release = { payload = \"module\" }\n",
    "[[compare]]\naxis = \"x\"\n",
    "base_attitude = \"held\"\n",
    "joints = \"prescribed\"\n",
    "measurement = \"none\"\n",
    "task = \"position\"\n",
    "axes = \"base\", ",
    "set.vehicle = \"planar-two-link\"",
    "during",
    "ä\u{301}",
    "1979-05-27",
    "'''",
    "unload_by_posture = { duration_s = 0.03, keep = \"nothing\", gain_per_s = 0.1 }\n",
    "actuators = \"ideal\"\n",
    "actuators = \"unlimited\"\n",
    "actuators = \"fitted\"\n",
    "sensing = \"fitted\"\n",
    "measure_tool_wrench = true\n",
    "wheels = \"minimum-peak\"\n",
    "cmgs = \"singularity-robust\"\n",
    "position_hold = { bandwidth_rad_s = 0.5 }\n",
    "unloading = { begins_at_nms = 0.01, ends_at_nms = 0.001, gain_per_s = 0.5 }\n",
    "gimbal_angles_deg = [90, 90, 90, 90], ",
    "[[failure]]\nunit = \"g-1\"\nkind = \"stuck\"\nat_s = 0.01\n",
    "[[failure]]\nunit = \"t-1\"\nkind = \"open\"\nat_s = 0.01\nreported_after_s = 0.01\n",
    "[[failure]]\nunit = \"w1\"\nkind = \"dead\"\nat_s = 0.01\n",
    "until = { elapsed_s = 0.02 }\n",
    "until = { reached = { distance_mm = 1e3, angle_deg = 90 } }\ntimeout_s = 0.03\n",
    "until = { signal = \"tool.position_error < 1 m\" }\n",
    "timeout_s = 0.02\n",
    "then = \"x\"\n",
    "on_fault = \"end\"\n",
    "attempts = 2\n",
    "[[phase.arm]]\ntool = \"a_tool\"\nhold = { duration_s = 0.03, keep = \"tool\" }\n",
    "[[phase.arm]]\ntool = \"b_tool\"\nmove_tool = { by_m = [0, 0, 0.001], duration_s = 0.03 }\n",
    "arm_law = \"terrestrial\"\n",
    "[[world.applied_wrench]]\non = \"tool\"\ntorque_nm = [1e3, 0, 0]\nfrom_s = 0\nduration_s = 0.03\n",
];

/// Every complaint has a place in its own text, and words.
fn read(text: &str) -> Result<Option<Mission>, TestCaseError> {
    let complaints = match read_mission("fuzz.toml", text) {
        Ok(mission) => {
            prop_assert!(!mission.cases.is_empty());
            return Ok(Some(mission));
        }
        Err(complaints) => complaints,
    };
    prop_assert!(complaints.iter().any(|c| c.severity == Severity::Error));
    for complaint in &complaints {
        let there = complaint.span.clone().is_none_or(|s| complaint.source.text.get(s).is_some());
        prop_assert!(there, "{:?} is no place in the text", complaint.span);
        prop_assert!(!complaint.message.is_empty());
    }
    prop_assert!(!render(&complaints, false).is_empty());
    Ok(None)
}

/// Longest mission that is flown here (s).
const LONGEST: f64 = 2.0;

/// Seconds of flight that a text asks for at most; none if only the planning could say.
fn seconds(text: &str) -> Option<f64> {
    if text.contains("limits") {
        return None;
    }
    let durations = text.split("duration_s").skip(1);
    let number = |rest: &str| {
        let rest = rest.trim_start().strip_prefix('=')?.trim_start();
        let end = rest.find([',', ' ', '}', '\n']).unwrap_or(rest.len());
        rest[..end].parse::<f64>().ok()
    };
    durations.map(number).sum()
}

/// A mission that is short enough is flown; its outcome does not contradict itself.
fn fly(text: &str) -> Result<bool, TestCaseError> {
    let Some(mission) = read(text)? else { return Ok(false) };
    let cases = mission.cases.len();
    if seconds(text).is_none_or(|s| s * cases as f64 > 5.0 * LONGEST || s > LONGEST) {
        return Ok(false);
    }
    let mut last = -1.0;
    let options = RunOptions { error_estimate: text.len().is_multiple_of(2) };
    let outcome = run(&mission, options, &mut |progress| last = progress.share);
    prop_assert!((0.0..=1.0).contains(&last), "{last} is no share");
    prop_assert_eq!(outcome.cases.len(), cases);
    for case in &outcome.cases {
        let completed = matches!(case.end, End::Completed);
        prop_assert!(!case.passed || (completed && case.ledger.closes));
        prop_assert!(case.verdicts.iter().all(|v| v.value.is_some() || !v.pass));
        prop_assert!(case.verdicts.iter().all(|v| v.value.is_none_or(|x| !x.is_nan())));
        let samples = case.telemetry.time.len();
        prop_assert!(case.telemetry.channels.iter().all(|c| c.values.len() == samples));
        if let End::Infeasible { reason, .. }
        | End::Stopped { reason, .. }
        | End::Breakdown { reason, .. } = &case.end
        {
            prop_assert!(reason.len() > 10, "{reason}");
        }
    }
    Ok(true)
}

/// A shipped mission, its phases a few control periods long.
fn hurried(text: &str) -> String {
    let mut short = String::new();
    for line in text.lines() {
        let mut line = line.to_owned();
        if let Some(at) = line.find("limits = {") {
            line.replace_range(at.., "duration_s = 0.03 }");
        }
        // What happens on the way happens within these periods, too.
        for (key, time) in [
            ("duration_s = ", "0.03"),
            ("from_s = ", "0.005"),
            ("ramp_s = ", "0.01"),
            ("at_s = ", "0.01"),
            ("reported_after_s = ", "0.01"),
        ] {
            let mut from = 0;
            while let Some(at) = line[from..].find(key).map(|at| from + at + key.len()) {
                let end = line[at..].find([',', ' ', '}']).map_or(line.len(), |end| at + end);
                line.replace_range(at..end, time);
                from = at;
            }
        }
        short = short + &line + "\n";
    }
    short
}

/// Parts of a text are counted in ten-thousandths.
const WHOLE: usize = 10_000;

/// The character boundary at or before a part of the text.
fn place(text: &str, part: usize) -> usize {
    let at = part * text.len() / WHOLE;
    (0..=at).rev().find(|&k| text.is_char_boundary(k)).unwrap_or(0)
}

/// One change: delete, double or replace a slice, put a word in, or exchange two lines.
fn changed(text: &str, (what, a, b, c, word): (u8, usize, usize, usize, usize)) -> String {
    let (from, to) = (place(text, a), place(text, (a + b / 50).min(WHOLE)));
    let word = WORDS[word];
    match what {
        0 => [&text[..from], &text[to..]].concat(),
        1 => [&text[..to], &text[from..]].concat(),
        2 => [&text[..from], word, &text[to..]].concat(),
        3 => [&text[..from], word, &text[from..]].concat(),
        _ => {
            let mut lines: Vec<_> = text.lines().collect();
            let count = lines.len().max(1);
            if !lines.is_empty() {
                lines.swap(a % count, c % count);
            }
            lines.join("\n")
        }
    }
}

/// The text with one of its numbers replaced.
fn renumbered(text: &str, (which, number): (usize, usize)) -> String {
    let starts: Vec<usize> = text
        .match_indices(|c: char| c.is_ascii_digit())
        .map(|(at, _)| at)
        .filter(|&at| text[..at].ends_with([' ', '[', '-']))
        .collect();
    let Some(&at) = starts.get(which % starts.len().max(1)) else { return text.to_owned() };
    let end = text[at..].find([',', ' ', ']', '}', '\n', '"']).map_or(text.len(), |end| at + end);
    [&text[..at], NUMBERS[number], &text[end..]].concat()
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(17),
        ..Default::default()
    }
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,200}") {
        read(&text)?;
        read(&[SHIPPED[0], &text].concat())?;
    }

    #[test]
    fn arbitrary_requirements_never_panic(text in "[a-z._<>=0-9 %/·ä]{0,40}") {
        let quoted = format!("\"{text}\"");
        read(&SHIPPED[0].replace("\"tool.speed.max <= 0.1 m/s\"", &quoted))?;
    }

    #[test]
    fn changed_missions_never_panic(
        seed in 0..SHIPPED.len(),
        changes in prop::collection::vec(
            (0..5u8, 0..WHOLE, 0..WHOLE, 0..WHOLE, 0..WORDS.len()), 1..6),
    ) {
        read(&changes.into_iter().fold(SHIPPED[seed].to_owned(), |t, c| changed(&t, c)))?;
    }
}

proptest! {
    #![proptest_config(config(250))]

    #[test]
    fn missions_with_any_numbers_never_panic_when_flown(
        seed in 0..SHIPPED.len(),
        numbers in prop::collection::vec((0..1000usize, 0..NUMBERS.len()), 1..4),
    ) {
        let text = hurried(SHIPPED[seed]);
        fly(&numbers.into_iter().fold(text, |t, n| renumbered(&t, n)))?;
    }

    #[test]
    fn changed_missions_that_are_read_never_panic_when_flown(
        seed in 0..SHIPPED.len(),
        change in (2..5u8, 0..WHOLE, 0..20usize, 0..WHOLE, 0..WORDS.len()),
    ) {
        fly(&changed(&hurried(SHIPPED[seed]), change))?;
    }
}

#[test]
fn the_hurried_missions_are_flown_and_a_good_part_of_those_with_other_numbers() {
    let mut flown = 0;
    for text in SHIPPED.map(hurried) {
        assert!(fly(&text).expect("nothing contradicts itself"), "not flown:\n{text}");
        for which in 0..15 {
            flown += usize::from(fly(&renumbered(&text, (which, 11))).expect("nor here"));
        }
    }
    assert!(flown > 90, "the fuzz above flies next to nothing: {flown}");
}

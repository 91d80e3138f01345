//! The study of section 4: demands against the hand, verdicts against the envelopes.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use wrasse_study::{Answer, SetKind, SetVerdict, StudyOutcome, TaskOutcome, read_study, size};

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../studies/section-4.toml")
}

fn text() -> String {
    std::fs::read_to_string(path()).expect("the study lies in studies/")
}

/// The study without what takes long: the tasks that are flown with every set, but for one row.
fn shortened(keep: Option<&str>) -> String {
    let text = text();
    let (before, rest) = text.split_once("closed_loop = [").expect("a list of flown tasks");
    let (_, after) = rest.split_once(']').expect("its end");
    let named = keep.map_or(String::new(), |name| format!("{name:?}"));
    let closed = format!("{before}closed_loop = [{named}]{after}");
    without_rows(&closed, |name| name.starts_with("flown") && Some(name) != keep)
}

/// A file without some rows of its axes. What follows a row on the next axis stays.
fn without_rows(text: &str, drop: impl Fn(&str) -> bool) -> String {
    let mut blocks = text.split("[[compare.row]]\n");
    let mut kept = blocks.next().expect("a beginning").to_owned();
    for block in blocks {
        let name = block.split('"').nth(1).expect("a row has a name");
        if !drop(name) {
            kept += "[[compare.row]]\n";
            kept += block;
        } else if let Some((_, next)) = block.split_once("[[compare]]") {
            kept += "[[compare]]";
            kept += next;
        }
    }
    kept
}

fn sized(text: &str, threads: usize) -> StudyOutcome {
    let study = read_study(path(), text).unwrap_or_else(|complaints| panic!("{complaints:#?}"));
    size(&study, threads, &mut |_| {})
}

/// What the envelopes say, flown once for all tests.
fn judged() -> &'static StudyOutcome {
    static OUTCOME: OnceLock<StudyOutcome> = OnceLock::new();
    OUTCOME.get_or_init(|| sized(&shortened(None), 2))
}

fn task<'a>(outcome: &'a StudyOutcome, name: &str) -> &'a TaskOutcome {
    let found = outcome.tasks.iter().find(|task| task.name == name);
    found.unwrap_or_else(|| panic!("no task {name}"))
}

fn verdict<'a>(task: &'a TaskOutcome, set: &str) -> &'a SetVerdict {
    let found = task.verdicts.iter().find(|verdict| verdict.set.starts_with(set));
    found.unwrap_or_else(|| panic!("no set {set}"))
}

/// Momentum is reduced mass times lever times speed, torque that over the ramp, and force times lever.
/// The hand takes the load for a point, the arm for a rod and the lever for that of the start.
#[test]
fn each_demand_agrees_with_its_hand_check() {
    let outcome = judged();
    assert!(outcome.closes);
    assert_eq!(outcome.tasks.len(), 30);
    for task in &outcome.tasks {
        let hand = task.by_hand.as_ref().unwrap_or_else(|| panic!("{} by hand", task.name));
        let off = |found: f64, hand: f64| (found / hand - 1.0).abs();
        let (torque, momentum) =
            (off(task.peak_torque_nm, hand.torque), off(task.peak_momentum_nms, hand.momentum));
        let bound = if task.name.contains(", 0 kg") {
            // Nothing but the arm, whose elbow goes its own way. Measured 0.39.
            0.5
        } else if task.own_motion {
            // Measured 0.03.
            0.05
        } else {
            // Force and lever are exact. Measured 1.2e-13.
            1e-9
        };
        assert!(
            torque < bound && momentum < bound,
            "{}: torque {torque:.2e}, momentum {momentum:.2e}; {}",
            task.name,
            hand.how
        );
    }
}

/// The figures of the paper's argument, by the envelopes alone.
#[test]
fn torque_momentum_and_duration_each_decide() {
    let outcome = judged();
    // 500 kg with a quick ramp: every set of wheels lacks the torque, gyros from 40 N·m·s on suffice.
    let moving = task(outcome, "offset, 500 kg, ramp 1.25 s");
    for wheels in ["4 wheels 0.1", "4 wheels 0.2", "4 wheels 1 "] {
        assert_eq!(verdict(moving, wheels).torque, Answer::No);
        assert!(verdict(moving, wheels).slower.plain.unwrap() > 5.0);
    }
    assert_eq!(verdict(moving, "4 gyros 15").momentum, Answer::No);
    assert_eq!(verdict(moving, "4 gyros 75").suffices, Answer::Yes);
    // The arm alone, slowly: wheels do, so the claim does not hold everywhere.
    assert_eq!(
        verdict(task(outcome, "offset, 0 kg, ramp 5 s"), "4 wheels 1 ").suffices,
        Answer::Yes
    );
    // 200 N square to a lever of 1.75 m: beyond 4 x 75 N·m·s, and 4 x 250 N·m·s last seconds.
    let pushed = task(outcome, "offset, 200 N lateral");
    assert_eq!(verdict(pushed, "4 gyros 75").torque, Answer::No);
    let strong = verdict(pushed, "4 gyros 250");
    // The torque is there until the gimbals near the surface.
    assert_eq!((strong.torque, strong.momentum), (Answer::WithSteering, Answer::No));
    let full = strong.saturates_s.best.unwrap();
    let by_hand = strong.momentum_nms.best.unwrap() / pushed.gathered_nm.unwrap() + 0.25;
    // Momentum over torque, and half of the rise. Measured 4e-14 s of 2.6.
    assert!((full - by_hand).abs() < 1e-9, "{full} {by_hand}");
    // Along the arm of the centred mount the same force has hardly a lever: wheels do.
    let axial = task(outcome, "centred, 200 N axial");
    assert_eq!(verdict(axial, "4 wheels 0.2").suffices, Answer::Yes);
    // No pace helps against a force, and thrusters alone keep the base in its place.
    assert!(pushed.verdicts.iter().all(|v| v.slower.plain.is_none()));
    let thrusters = verdict(pushed, "24 thrusters 200");
    assert!(thrusters.fuel_in_place_kg.unwrap() > thrusters.fuel_kg.unwrap());
    let holds = outcome.findings.iter().find(|f| f.about == "gyros are needed").unwrap();
    assert!(holds.tasks.contains(&moving.name) && !holds.tasks.contains(&axial.name));
}

/// One flight with every set: what the envelopes promise, the tool confirms.
#[test]
fn sets_that_suffice_keep_the_tool_and_sets_that_do_not_lose_it() {
    let text = shortened(Some("flown: 200 N for 1 s"));
    let text = without_rows(&text, |name| name.contains(" kg, ramp") || name == "centred");
    let outcome = sized(&text, 2);
    let flown = task(&outcome, "offset, flown: 200 N for 1 s");
    let error = |set: &str| verdict(flown, set).flown.as_ref().unwrap().tool_error_mm;
    // Measured 0.68, 9.8, 48, 744 mm.
    assert!(error("ideal") < 1.0 && error("4 gyros 250") < 20.0);
    assert!(error("4 gyros 75") > 20.0 && error("4 wheels 0.2") > 500.0);
    assert_eq!(verdict(flown, "4 gyros 250").suffices, Answer::Yes);
    assert_eq!(verdict(flown, "4 wheels 0.2").suffices, Answer::No);
    assert!(outcome.closes);
    let kinds: Vec<_> = outcome.sets.iter().map(|set| set.kind).collect();
    assert_eq!(kinds[0], SetKind::Ideal);
    assert_eq!(kinds.iter().filter(|k| **k == SetKind::Gyros).count(), 5);
}

/// The row of a task in the book: demand, then a word for each set.
fn row(task: &TaskOutcome) -> String {
    let word = |verdict: &SetVerdict| match (verdict.suffices, verdict.torque, verdict.momentum) {
        (Answer::Yes, ..) => "yes",
        (Answer::WithSteering, ..) => "steer",
        (Answer::No, Answer::No, Answer::No) => "no TH",
        (Answer::No, Answer::No, _) => "no T",
        (Answer::No, ..) => "no H",
    };
    let (torque, momentum) = (task.peak_torque_nm, task.peak_momentum_nms);
    let words: Vec<_> = task.verdicts[1..].iter().map(word).collect();
    format!("| {} | {torque:.1} | {momentum:.1} | {} |", task.name, words.join(" | "))
}

#[test]
fn the_book_tells_what_the_study_finds() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/validation/section_4.md");
    let book = std::fs::read_to_string(page).expect("the page lies in the book");
    let outcome = judged();
    let missing: Vec<_> = outcome.tasks.iter().map(row).filter(|r| !book.contains(r)).collect();
    assert!(missing.is_empty(), "the book does not say:\n{}", missing.join("\n"));
}

//! A study as plain text, for the terminal.

use wrasse_study::{Answer, SetVerdict, StudyOutcome, TaskOutcome};

use crate::numbers::significant;
use crate::tables::{Side, aligned, printable};

/// Tasks up to which each set gets its own line; more are shown as a matrix.
const CLOSELY: usize = 2;

/// The demands, the verdicts, the flights in closed loop and the findings.
pub fn study_table(outcome: &StudyOutcome) -> String {
    let mut text = demands(outcome);
    text += "\n";
    if outcome.tasks.len() <= CLOSELY {
        for task in &outcome.tasks {
            text += &closely(outcome, task);
        }
    } else {
        text += &matrix(outcome);
    }
    text += &flights(outcome);
    if !outcome.claim.is_empty() {
        text += &format!("\nclaim: {}\n", printable(&outcome.claim));
    }
    for finding in &outcome.findings {
        text += &format!("{}: {}\n", finding.about, printable(&finding.text));
    }
    let ledgers = if outcome.closes { "close" } else { "DO NOT ALL CLOSE" };
    text + &format!("\n{} flights; their ledgers {ledgers}\n", outcome.flights)
}

/// What each task asks, and the same by hand.
fn demands(outcome: &StudyOutcome) -> String {
    let mut rows = [
        ["", "", "peak", "by", "peak", "by", "gathered", "tool"],
        ["", "lasts", "torque", "hand", "momentum", "hand", "at the end", "error"],
        ["task", "s", "N·m", "N·m", "N·m·s", "N·m·s", "N·m·s/s", "mm"],
    ]
    .map(|row| row.map(String::from).to_vec())
    .to_vec();
    let number = |value: Option<f64>| value.map_or("-".to_owned(), rounded);
    let flown = |task: &&TaskOutcome| task.unflown.is_none();
    for task in outcome.tasks.iter().filter(flown) {
        let mut row = vec![task.name.clone()];
        let hand = task.by_hand.as_ref();
        row.extend([
            rounded(task.duration_s),
            rounded(task.peak_torque_nm),
            number(hand.map(|h| h.torque)),
            rounded(task.peak_momentum_nms),
            number(hand.map(|h| h.momentum)),
            number(task.gathered_nm),
            rounded(task.tool_error_mm),
        ]);
        rows.push(row);
    }
    let mut sides = vec![Side::Right; 8];
    sides[0] = Side::Left;
    let mut text = aligned(&rows, &sides);
    for task in &outcome.tasks {
        if let Some(why) = &task.unflown {
            text += &format!("{}: not flown: {}\n", printable(&task.name), printable(why));
        }
    }
    text
}

/// Three significant digits.
fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return significant(value);
    }
    format!("{value:.2e}").parse().map_or_else(|_| significant(value), significant)
}

/// Tasks down, sets across.
fn matrix(outcome: &StudyOutcome) -> String {
    let names: Vec<Vec<&str>> =
        outcome.sets.iter().map(|set| set.name.split_whitespace().collect()).collect();
    let depth = names.iter().map(Vec::len).max().unwrap_or(0);
    let mut rows: Vec<Vec<String>> = (0..depth)
        .map(|line| {
            let part = |words: &Vec<&str>| {
                let at = (line + words.len()).checked_sub(depth);
                at.map_or("", |k| words[k]).to_owned()
            };
            let first = if line + 1 == depth { "task" } else { "" };
            [vec![first.to_owned()], names.iter().map(part).collect()].concat()
        })
        .collect();
    for task in outcome.tasks.iter().filter(|task| task.unflown.is_none()) {
        rows.push([vec![task.name.clone()], task.verdicts.iter().map(cell).collect()].concat());
    }
    let sides = vec![Side::Left; outcome.sets.len() + 1];
    aligned(&rows, &sides)
        + "steer: only with steering that avoids or escapes singularities; no T: not the torque, no H: not \
           the momentum;\nx4.1: 4.1 times slower it can (with plain steering)\n"
}

fn cell(verdict: &SetVerdict) -> String {
    let lacks = match (verdict.torque, verdict.momentum) {
        (Answer::No, Answer::No) => "no TH",
        (Answer::No, _) => "no T",
        (_, Answer::No) => "no H",
        _ => "",
    };
    let word = match verdict.suffices {
        Answer::Yes => "yes",
        Answer::WithSteering => "steer",
        Answer::No => lacks,
    };
    match verdict.slower.plain {
        Some(factor) if verdict.suffices != Answer::Yes => format!("{word} x{}", pace(factor)),
        _ => word.to_owned(),
    }
}

/// A factor, rounded so that it still suffices.
fn pace(factor: f64) -> String {
    let tenths = libm::ceil(10.0 * factor - 1e-6) / 10.0;
    if tenths < 10.0 { format!("{tenths:.1}") } else { format!("{:.0}", libm::ceil(factor)) }
}

/// One task, a line for each set.
fn closely(outcome: &StudyOutcome, task: &TaskOutcome) -> String {
    if task.unflown.is_some() {
        return String::new();
    }
    let mut rows = [
        ["", "torque", "", "momentum", "", "full", "times", "fuel", "mass", "power"],
        [task.name.as_str(), "N·m", "", "N·m·s", "", "after s", "slower", "g", "kg", "W"],
    ]
    .map(|row| row.map(String::from).to_vec())
    .to_vec();
    let number = |value: Option<f64>| value.map_or("-".to_owned(), rounded);
    for (set, verdict) in outcome.sets.iter().zip(&task.verdicts) {
        rows.push(vec![
            set.name.clone(),
            verdict.torque_nm.plain.map_or("any".to_owned(), rounded),
            word(verdict.torque).to_owned(),
            verdict.momentum_nms.plain.map_or("any".to_owned(), rounded),
            word(verdict.momentum).to_owned(),
            verdict.saturates_s.plain.map_or("never".to_owned(), rounded),
            verdict.slower.plain.map_or("-".to_owned(), pace),
            number(verdict.fuel_kg.map(|kg| 1e3 * kg)),
            number(set.mass_kg),
            number(set.power_w),
        ]);
    }
    let mut sides = vec![Side::Right; 10];
    (sides[0], sides[2], sides[4]) = (Side::Left, Side::Left, Side::Left);
    aligned(&rows, &sides) + "\n"
}

/// An answer in a word.
fn word(answer: Answer) -> &'static str {
    match answer {
        Answer::Yes => "yes",
        Answer::WithSteering => "steer",
        Answer::No => "no",
    }
}

/// What was flown in closed loop.
fn flights(outcome: &StudyOutcome) -> String {
    let mut rows = [
        ["flown in closed loop", "", "tool error", "at the end", "attitude", "requirements", ""],
        ["task", "set", "mm", "mm", "deg", "", "first limit"],
    ]
    .map(|row| row.map(String::from).to_vec())
    .to_vec();
    for task in &outcome.tasks {
        for verdict in &task.verdicts {
            let Some(flown) = &verdict.flown else { continue };
            let limit = flown.ended.as_ref().or(flown.limit.as_ref());
            rows.push(vec![
                task.name.clone(),
                verdict.set.clone(),
                rounded(flown.tool_error_mm),
                rounded(flown.tool_error_at_end_mm),
                rounded(flown.attitude_error_deg),
                if flown.requirements_hold { "hold" } else { "FAIL" }.to_owned(),
                limit.map_or(String::new(), |text| shortened(text)),
            ]);
        }
    }
    if rows.len() == 2 {
        return String::new();
    }
    let mut sides = vec![Side::Left; 7];
    sides[2..5].fill(Side::Right);
    format!("\n{}", aligned(&rows, &sides))
}

/// The beginning of a text, so that the table stays narrow.
fn shortened(text: &str) -> String {
    const MOST: usize = 56;
    if text.chars().count() <= MOST {
        return text.to_owned();
    }
    text.chars().take(MOST - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_is_rounded_to_the_slower_side() {
        assert_eq!([1.0, 1.01, 4.1, 9.96, 21.2].map(pace), ["1.0", "1.1", "4.1", "10", "22"]);
    }

    #[test]
    fn figures_of_the_terminal_have_three_digits() {
        assert_eq!(
            [92.4567, 0.0, 12345.0, 0.000_123_45].map(rounded),
            ["92.5", "0", "12300", "1.23e-4"]
        );
    }
}

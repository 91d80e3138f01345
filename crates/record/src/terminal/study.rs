//! A study as plain text, for the terminal.

use wrasse_study::{Answer, SetCard, SetVerdict, StudyOutcome, TaskOutcome};

use super::{Side, aligned, printable};
use crate::wording::ledger::OPEN;
use crate::wording::numbers::{FINEST, beside_largest, counted, error, pace, rounded};

/// Tasks up to which each set gets its own line; more are shown as a matrix.
const CLOSELY: usize = 2;

/// The demands, the verdicts, the flights in closed loop and the findings.
pub fn study_table(outcome: &StudyOutcome) -> String {
    let mut text = demands(outcome);
    text += &format!("\n{}\n", sets(&outcome.sets));
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
    text + &ledgers(outcome)
}

/// Whether the ledgers close; if not, which stay open, and what may help.
fn ledgers(outcome: &StudyOutcome) -> String {
    let flights = counted(outcome.flights, "flight");
    if outcome.closes {
        return format!("\n{flights}; their ledgers close\n");
    }
    let open = open_flights(outcome);
    if open.is_empty() {
        // The outcome holds ledgers of flights in closed loop only.
        let whose = "of a task that is not flown in closed loop, or its numbers broke down";
        return format!("\n{flights}; LEDGER OPEN: {whose}\n{OPEN}");
    }
    let mut text = format!("\n{flights}; LEDGER OPEN:\n");
    for (task, set) in open {
        text += &format!("  {} with {}\n", printable(task), printable(set));
    }
    text + OPEN
}

/// (task, set) of the flights in closed loop whose ledger stays open.
fn open_flights(outcome: &StudyOutcome) -> Vec<(&str, &str)> {
    let flown = outcome.tasks.iter().flat_map(|task| {
        let open = |v: &&SetVerdict| v.flown.as_ref().is_some_and(|flown| !flown.closes);
        task.verdicts.iter().filter(open).map(|v| (task.name.as_str(), v.set.as_str()))
    });
    flown.collect()
}

/// What each task asks, and the same by hand.
fn demands(outcome: &StudyOutcome) -> String {
    let mut rows = [
        ["", "", "peak", "by", "peak", "by", "gathered", "tool"],
        ["", "lasts", "torque", "hand", "momentum", "hand", "at the end", "error"],
        ["task", "s", "N·m", "N·m", "N·m·s", "N·m·s", "N·m", "mm"],
    ]
    .map(|row| row.map(String::from).to_vec())
    .to_vec();
    let flown = |task: &&TaskOutcome| task.unflown.is_none();
    for task in outcome.tasks.iter().filter(flown) {
        let mut row = vec![task.name.clone()];
        let hand = task.by_hand.as_ref();
        let figures = [
            Some(task.duration_s),
            Some(task.peak_torque_nm),
            hand.map(|h| h.torque),
            Some(task.peak_momentum_nms),
            hand.map(|h| h.momentum),
            task.gathered_nm,
        ];
        let largest = figures.iter().flatten().copied().fold(0.0, f64::max);
        row.extend(figures.map(|x| number(x.map(|x| beside_largest(x, largest)))));
        row.push(error(beside_largest(task.tool_error_mm, largest), FINEST));
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

/// Three significant digits; a dash for what is not known.
fn number(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), rounded)
}

/// A figure with a yes or no, where the study sets a limit.
fn judged(figure: String, within: Option<bool>) -> String {
    match within {
        None => figure,
        Some(true) => format!("{figure} yes"),
        Some(false) => format!("{figure} NO"),
    }
}

/// What each set can give and hold, what it weighs and takes; against the limits of the study.
fn sets(sets: &[SetCard]) -> String {
    let heads = [
        ["", "torque", "", "", "momentum", "", "", "anywhere", "", "", ""],
        ["", "x", "y", "z", "x", "y", "z", "at best", "mass", "power", "propellant"],
        ["set", "N·m", "N·m", "N·m", "N·m·s", "N·m·s", "N·m·s", "N·m·s", "kg", "W", "kg"],
    ];
    let mut rows = heads.map(|row| row.map(String::from).to_vec()).to_vec();
    let any = |value: Option<f64>| value.map_or("any".to_owned(), rounded);
    for set in sets {
        let mut row = vec![set.name.clone()];
        let reaches = set.torque_nm.iter().chain(&set.momentum_nms);
        row.extend(reaches.map(|reach| any(reach.map(|both| both.plain))));
        row.push(any(set.momentum_everywhere_nms));
        let mass = judged(number(set.mass_kg), set.within_mass_limit);
        let power = judged(number(set.power_w), set.within_power_limit);
        row.extend([mass, power, number(set.propellant_kg)]);
        rows.push(row);
    }
    let mut sides = vec![Side::Right; 11];
    sides[0] = Side::Left;
    aligned(&rows, &sides)
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
        + "steer: not ruled out, but only with steering that avoids or escapes singularities; no T: not the \
           torque, no H: not the momentum, no P: not the propellant;\nx4.1: 4.1 times slower it can (with plain steering; rounded up)\n"
}

fn cell(verdict: &SetVerdict) -> String {
    let asked = [(verdict.torque, 'T'), (verdict.momentum, 'H'), (verdict.propellant, 'P')];
    let lacks = asked.iter().filter(|(answer, _)| *answer == Answer::No).map(|(_, letter)| letter);
    let word = match verdict.suffices {
        Answer::Yes => "yes".to_owned(),
        Answer::WithSteering => "steer".to_owned(),
        Answer::No => format!("no {}", lacks.collect::<String>()),
    };
    match verdict.slower.plain {
        Some(factor) if verdict.suffices != Answer::Yes => format!("{word} x{}", pace(factor)),
        _ => word,
    }
}

/// One task, a line for each set.
fn closely(outcome: &StudyOutcome, task: &TaskOutcome) -> String {
    if task.unflown.is_some() {
        return String::new();
    }
    let mut rows = [
        ["", "torque", "", "momentum", "", "full", "times", "fuel"],
        [task.name.as_str(), "N·m", "", "N·m·s", "", "after s", "slower", "g"],
    ]
    .map(|row| row.map(String::from).to_vec())
    .to_vec();
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
        ]);
    }
    let mut sides = vec![Side::Right; 8];
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
                error(flown.tool_error_mm, FINEST),
                error(flown.tool_error_at_end_mm, FINEST),
                error(flown.attitude_error_deg, FINEST),
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

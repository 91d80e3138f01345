//! The table of `cargo xtask golden`: lines of at most 100 characters.

use super::comparison::{Comparison, Quantity};

const WIDTH: usize = 100;
const FILE: usize = 35;
const CASE: usize = 33;
/// Before what is said of a file or a case.
const INDENT: &str = "    ";

/// The names of the columns. Deviation and tolerance are those of the quantity that uses up most of
/// its tolerance, in its own unit.
pub(super) fn head() -> String {
    line("file", "case", "deviation", "tolerance", "verdict")
}

fn line(file: &str, case: &str, deviation: &str, tolerance: &str, verdict: &str) -> String {
    let (file, case) = (tail(file, FILE), start(case, CASE));
    let line = format!("{file:<FILE$} {case:<CASE$} {deviation:>9} {tolerance:>9}  {verdict}");
    line.trim_end().to_owned()
}

/// A line without numbers.
pub(super) fn row(file: &str, case: &str, verdict: &str) -> String {
    line(file, case, "", "", verdict)
}

/// The lines of a case that was compared.
pub(super) fn case_lines(file: &str, case: &str, outcome: &Comparison) -> Vec<String> {
    let verdict = if outcome.is_met() { "ok" } else { "MISSED" };
    let Some(worst) = outcome.worst() else {
        let mut lines = vec![row(file, case, verdict)];
        lines.extend(wrapped("nothing was compared"));
        lines.extend(outcome.differences.iter().flat_map(|line| wrapped(line)));
        return lines;
    };
    let (deviation, tolerance) = (small(worst.deviation), small(worst.allowed));
    let mut lines = vec![line(file, case, &deviation, &tolerance, verdict)];
    for Quantity { path, deviation, allowed } in
        outcome.quantities.iter().filter(|quantity| !quantity.is_met())
    {
        let off = format!("{path}: off by {}, allowed {}", small(*deviation), small(*allowed));
        lines.extend(wrapped(&off));
    }
    lines.extend(outcome.differences.iter().flat_map(|line| wrapped(line)));
    lines
}

/// The line of cases of a kind that is not built.
pub(super) fn not_built(file: &str, kind: &str, count: usize) -> String {
    let own = kind.split_once('/').map_or("", |(_, own)| own);
    row(file, format!("{} {own}", cases(count)).trim_end(), "not built")
}

/// What nobody compared for one reason.
pub(super) fn left_out(why: &str, places: &[String]) -> Vec<String> {
    wrapped(&format!("not compared, for {why}: {}", places.join(", ")))
}

/// The file states another tolerance than the table in the code has.
pub(super) fn other_sentence(stated: &str) -> Vec<String> {
    wrapped(&format!("the file states a tolerance that the table in the code does not: {stated}"))
}

fn cases(count: usize) -> String {
    format!("{count} case{}", if count == 1 { "" } else { "s" })
}

fn small(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

/// The end of a path that is too long.
fn tail(text: &str, width: usize) -> String {
    let length = text.chars().count();
    if length <= width {
        return text.to_owned();
    }
    "…".to_owned() + &text.chars().skip(length + 1 - width).collect::<String>()
}

/// The start of words that are too long.
fn start(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width - 1).collect::<String>() + "…"
}

/// A sentence in lines, indented.
fn wrapped(sentence: &str) -> Vec<String> {
    let mut lines = vec![INDENT.to_owned()];
    for word in sentence.split_whitespace() {
        let word = start(word, WIDTH - 2 * INDENT.len());
        let last = lines.last_mut().expect("there is a first line");
        let is_new = last.trim().is_empty();
        if !is_new && last.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(format!("{INDENT}{INDENT}{word}"));
        } else {
            *last += if is_new { "" } else { " " };
            *last += &word;
        }
    }
    lines
}

/// A place with the numbers of lists left away: `results[].printed`.
pub(super) fn without_numbers(place: &str) -> String {
    let mut inside = false;
    let keep = |c: &char| {
        inside = (inside && *c != ']') || *c == '[';
        !(inside && c.is_ascii_digit())
    };
    place.chars().filter(keep).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_longer_than_a_hundred_characters() {
        let long = "a/very/long/path/".repeat(9);
        let row = line(&long, &long, "-1.0e-300", "-1.0e-300", "not built");
        assert!(row.chars().count() <= WIDTH, "{row}");
        for line in wrapped(&format!("{long} and {}", "some words and more ".repeat(20))) {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
    }

    #[test]
    fn places_of_lists_are_said_without_their_numbers() {
        assert_eq!(without_numbers("rows[12].a1[3]"), "rows[].a1[]");
    }
}

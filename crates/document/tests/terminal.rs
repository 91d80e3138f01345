//! What complaints do to the terminal that shows them, and to the time of the reader.

use std::time::{Duration, Instant};
use wrasse_document::{Complaint, Document, Source, render};

#[test]
fn no_text_of_a_file_reaches_the_terminal_as_a_command() {
    let evil = "\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}\u{200b}";
    let source = Source::new(format!("{evil}.toml"), format!("name = '{evil}' # ä\nnext = 1\n"));
    let all = [
        Complaint::error(&source, evil).at(8..8 + evil.len(), evil).with_help(evil),
        Complaint::warning(&source, "no place"),
    ];
    let text = render(&all, false);
    let obeyed = |c: char| c != '\n' && (c.is_control() || "\u{202e}\u{200b}".contains(c));
    assert!(!text.contains(obeyed), "{text:?}");
    let shown = r"\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}\u{200b}";
    assert!(text.contains(&format!("1 | name = '{shown}' # ä")), "{text}");
    let carets = "^".repeat(shown.len());
    assert!(text.contains(&format!("  |         {carets} {shown}\n")), "{text}");
}

#[test]
fn the_caret_stands_below_its_place_and_the_column_is_that_of_the_file() {
    let text = "a = 'x\u{9b}\u{202e}', b = 1\n";
    let source = Source::new("a.toml", text);
    let place = text.find("b =").unwrap();
    let drawn = render(&[Complaint::error(&source, "b").at(place..place + 1, "here")], false);
    let column = text[..place].chars().count() + 1;
    assert!(drawn.contains(&format!("a.toml:1:{column}\n")), "{drawn}");
    let line = |mark: &str| drawn.lines().find(|line| line.contains(mark)).unwrap();
    assert_eq!(line("^ here").find('^'), line("1 | ").find("b ="), "{drawn}");
}

#[test]
fn of_many_complaints_the_first_hundred_are_shown_and_all_are_counted() {
    let text = "key = 1\n".repeat(2500);
    let source = Source::new("many.toml", text);
    let at = |i: usize| i * 8..i * 8 + 3;
    let mut all: Vec<_> = (0..2500)
        .map(|i| Complaint::error(&source, format!("number {i} is wrong")).at(at(i), "here"))
        .collect();
    let drawn = render(&all, false);
    assert!(drawn.contains("number 99 is wrong") && !drawn.contains("number 100 is wrong"));
    assert!(drawn.ends_with("the first 100 are shown, 2400 more are not\n2500 errors\n"));
    all.truncate(100);
    assert!(render(&all, false).ends_with("\n\n100 errors\n"));
}

/// Reading and complaining, for one mistake in each of `count` lines.
fn time_of(count: usize) -> Duration {
    #[derive(serde::Deserialize, schemars::JsonSchema)]
    #[serde(deny_unknown_fields)]
    struct Craft {
        #[allow(dead_code, reason = "read only")]
        mass_kg: f64,
    }
    let text: String = (0..count).map(|i| format!("k{i} = 1\n")).collect();
    let began = Instant::now();
    let document = Document::parse("many.toml", text).unwrap();
    let part = document.read_in_part::<Craft>();
    assert_eq!(part.complaints.len(), count + 1);
    let meaning = (0..count).map(|i| document.error(&[], format!("{i}"), "")).collect();
    let all = document.beside(part.complaints, meaning);
    assert!(render(&all, false).len() < 100_000);
    began.elapsed()
}

/// Ten times the mistakes take ten times the time; a hundred times would be the square. Measured 9 to
/// 13; the bound leaves room for a machine with other work.
#[test]
fn the_time_of_complaints_grows_with_their_number_and_not_with_its_square() {
    let best = |count| (0..3).map(|_| time_of(count)).min().unwrap();
    let (few, many) = (best(2000), best(20_000));
    let ratio = many.as_secs_f64() / few.as_secs_f64();
    assert!(ratio < 40.0, "{few:?} for 2000, {many:?} for 20000: {ratio:.1} times");
}

//! What complaints do to the terminal that shows them.

use wrasse_document::{Complaint, Source, render};

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

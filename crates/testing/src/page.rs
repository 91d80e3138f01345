//! Figures of the book, held: each number that a page prints is compared with one that was just found.

use std::ops::Range;
use std::path::{Path, PathBuf};

/// With this variable set the figures are written into the page instead of compared with it.
const WRITE: &str = "WRASSE_WRITE_FIGURES";

/// A page, and what was compared in it.
#[derive(Debug)]
pub struct Page {
    path: PathBuf,
    text: String,
    compared: Vec<Range<usize>>,
    meant: Vec<(Range<usize>, String)>,
    wrong: Vec<String>,
}

impl Page {
    /// A page by its path in the repository.
    pub fn open(path: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
        let read = std::fs::read_to_string(&path);
        let text = read.unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self { path, text, compared: vec![], meant: vec![], wrong: vec![] }
    }

    /// The page has these words, with a number in the place of each `{}`: the ones found, in order, to
    /// the digits printed. What the words hold themselves counts as compared.
    pub fn says(&mut self, words: &str, found: &[f64]) {
        let pieces: Vec<_> = words.split("{}").collect();
        assert_eq!(pieces.len(), found.len() + 1, "a number for each place in {words:?}");
        let places = self.text.match_indices(pieces[0]).map(|(at, _)| at);
        let Some(numbers) = places.into_iter().find_map(|at| numbers(&self.text, at, &pieces))
        else {
            self.wrong.push(format!("the page does not say: {words}"));
            return;
        };
        let printed = |at: &Range<usize>| self.text[at.clone()].to_owned();
        let differ: Vec<_> = numbers.iter().zip(found).map(|(at, &x)| (printed(at), x)).collect();
        for (printed, x) in &differ {
            if !agrees(printed, *x) {
                let meant = written_like(printed, *x);
                self.wrong.push(format!("{words}: printed {printed}, found {x:e} ({meant})"));
            }
        }
        let end = numbers.last().map_or(0, |last| last.end) + pieces[pieces.len() - 1].len();
        let begin = numbers.first().map_or(0, |first| first.start) - pieces[0].len();
        self.compared.push(begin..end);
        let meant = differ.into_iter().map(|(printed, x)| written_like(&printed, x));
        self.meant.extend(numbers.into_iter().zip(meant));
    }

    /// Words without a number of their own: inputs and definitions of the files that were flown.
    pub fn gives(&mut self, words: &str) {
        match self.text.find(words) {
            Some(at) => self.compared.push(at..at + words.len()),
            None => self.wrong.push(format!("the page does not give: {words}")),
        }
    }

    /// No number from the line that begins with `from` to that which begins with `to` (or the end of the
    /// page) is left uncompared.
    pub fn leaves_nothing_open(&mut self, from: &str, to: &str) {
        let mut at = 0;
        let mut inside = false;
        for line in self.text.split_inclusive('\n') {
            inside = (inside || line.starts_with(from)) && (to.is_empty() || !line.starts_with(to));
            let open = |i: usize| !self.compared.iter().any(|range| range.contains(&(at + i)));
            let digits = line.char_indices().filter(|(_, c)| inside && c.is_ascii_digit());
            if let Some((i, _)) = digits.into_iter().find(|&(i, _)| open(i)) {
                self.wrong.push(format!("no test holds: {}", &line[i..].trim_end()));
            }
            at += line.len();
        }
    }

    /// All of it was right; or it is now, if the figures are to be written.
    #[track_caller]
    pub fn holds(mut self) {
        if std::env::var_os(WRITE).is_some() {
            self.meant.sort_by_key(|(at, _)| at.start);
            for (at, meant) in self.meant.into_iter().rev() {
                self.text.replace_range(at, &meant);
            }
            std::fs::write(&self.path, self.text).expect("the page can be written");
            self.wrong.retain(|w| !w.contains(": printed "));
        }
        assert!(self.wrong.is_empty(), "{}:\n{}", self.path.display(), self.wrong.join("\n"));
    }
}

/// Where the numbers lie if the words, cut at their numbers, stand at this place.
fn numbers(text: &str, at: usize, pieces: &[&str]) -> Option<Vec<Range<usize>>> {
    let mut at = at + pieces[0].len();
    let mut found = vec![];
    for piece in &pieces[1..] {
        let rest = &text[at..];
        let number = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
        let sign = if rest.starts_with("< ") { 2 } else { 0 };
        let length = rest[sign..].find(|c| !number(c)).unwrap_or(rest.len() - sign);
        // The point that ends a sentence is no part of a number.
        let length = sign + rest[sign..sign + length].trim_end_matches(['.', '-', 'e', '+']).len();
        if length == sign || !rest[length..].starts_with(piece) {
            return None;
        }
        found.push(at..at + length);
        at += length + piece.len();
    }
    Some(found)
}

/// A printed number is the one found, rounded to its own digits; `< x` is a bound.
fn agrees(printed: &str, found: f64) -> bool {
    let number = printed.trim_start_matches("< ");
    let value: f64 = number.parse().unwrap_or_else(|_| panic!("{printed} is no number"));
    if printed.starts_with('<') {
        return found.abs() < value;
    }
    let (mantissa, power) = number.split_once('e').unwrap_or((number, "0"));
    let power: i32 = power.parse().expect("it was read as a number");
    // Half of the last digit is its rounding.
    (value - found).abs() <= 0.501 * 10f64.powi(power - decimals(mantissa))
}

fn decimals(number: &str) -> i32 {
    number.split_once('.').map_or(0, |(_, digits)| i32::try_from(digits.len()).expect("a few"))
}

/// The number found, with as many digits as the one printed.
fn written_like(printed: &str, found: f64) -> String {
    if agrees(printed, found) {
        return printed.to_owned();
    }
    let number = printed.trim_start_matches("< ");
    let mantissa = number.split('e').next().unwrap_or(number);
    let digits = mantissa.trim_start_matches(['-', '0', '.']).replace('.', "").len().max(1);
    let rounded = format!("{:.*e}", digits - 1, found);
    let power: i32 = rounded.split('e').nth(1).and_then(|p| p.parse().ok()).unwrap_or(0);
    if number.contains('e') || power < -4 {
        return rounded;
    }
    let places = i32::try_from(digits).expect("a few") - 1 - power;
    format!("{found:.*}", usize::try_from(places).unwrap_or(0))
}

#[test]
fn a_figure_is_compared_to_its_printed_digits_and_none_is_left_out() {
    let page = |text: &str| Page {
        path: PathBuf::new(),
        text: text.into(),
        compared: vec![],
        meant: vec![],
        wrong: vec![],
    };
    let text = "# A\nbase within 3.2e-7 deg of 0.2, tool within 12.3 mm. \n# B\n7\n";
    for (found, wrong) in [([3.24e-7, 12.26], 0), ([3.26e-7, 12.26], 1), ([-3.2e-7, 12.4], 2)] {
        let mut page = page(text);
        page.says("base within {} deg of 0.2, tool within {} mm", &found);
        assert_eq!(page.wrong.len(), wrong, "{:?}", page.wrong);
        page.leaves_nothing_open("# A", "# B");
        assert_eq!(page.wrong.len(), wrong, "{:?}", page.wrong);
        page.leaves_nothing_open("# A", "");
        assert_eq!(page.wrong.len(), wrong + 1, "{:?}", page.wrong);
    }
    let written = ["0.71", "< 0.01", "745", "0.0011", "3e-9"].map(|p| written_like(p, 0.02347));
    assert_eq!(written, ["0.023", "0.02", "0.0235", "0.023", "2e-2"]);
    assert!(agrees("< 0.01", 0.0099) && !agrees("< 0.01", 0.011) && agrees("745", 745.4));
}

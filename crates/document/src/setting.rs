//! A value that a command line gives beside a file: `phase[reach].duration_s=20`.

use crate::positioned::{Positioned, value_of};
use crate::{Complaint, Source};
use std::ops::Range;
use std::sync::Arc;

/// Where complaints about such a value point.
const PLACE: &str = "--set";

/// A value and the path that it goes to. Positions are those in its own text.
#[derive(Debug, Clone)]
pub struct Setting {
    pub(crate) source: Arc<Source>,
    pub(crate) path: Vec<PathPart>,
    pub(crate) value: Positioned,
}

/// One step of the path, and where it is written.
#[derive(Debug, Clone)]
pub(crate) struct PathPart {
    pub(crate) step: PathStep,
    pub(crate) span: Range<usize>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum PathStep {
    /// Into a table.
    Key(String),
    /// Into a list, from zero.
    Index(usize),
    /// To the table of a list that has this name.
    Name(String),
}

impl Setting {
    /// The setting that a text like `world.step_s=0.01` describes: keys with points between them, in
    /// brackets behind the key of a list the number from zero or the name of one of its values; behind the
    /// first equals sign the value as TOML. A word that is no TOML is a string without its quotes.
    ///
    /// # Errors
    /// A complaint that points into the text.
    pub fn parse(text: &str) -> Result<Self, Box<Complaint>> {
        let source = Source::new(PLACE, text);
        let mut reader = Reader { source: &source, at: 0 };
        let path = reader.path()?;
        let value = reader.value()?;
        Ok(Self { source, path, value })
    }

    /// The text, as it was given.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// A complaint about a part of the path.
    pub(crate) fn complaint(&self, part: &PathPart, message: String, help: &str) -> Complaint {
        Complaint::error(&self.source, message).at(part.span.clone(), "here").with_help(help)
    }
}

struct Reader<'s> {
    source: &'s Arc<Source>,
    at: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.source.text[self.at..]
    }
    fn refuse<T>(&self, span: Range<usize>, message: &str) -> Result<T, Box<Complaint>> {
        let complaint = Complaint::error(self.source, message).at(span, "here");
        Err(Box::new(complaint.with_help("write KEY=VALUE, such as phase[reach].duration_s=20")))
    }
    fn takes(&mut self, c: char) -> bool {
        let is_there = self.rest().starts_with(c);
        self.at += if is_there { c.len_utf8() } else { 0 };
        is_there
    }
    fn skip_spaces(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    /// The path, and the equals sign behind it.
    fn path(&mut self) -> Result<Vec<PathPart>, Box<Complaint>> {
        self.skip_spaces();
        let mut path = vec![self.key()?];
        loop {
            let begin = self.at;
            if self.takes('.') {
                path.push(self.key()?);
            } else if self.takes('[') {
                let (word, quoted) = self.word()?;
                if !self.takes(']') {
                    return self.refuse(begin..self.at, "the bracket is not closed");
                }
                let step = match word.parse() {
                    Ok(index) if !quoted => PathStep::Index(index),
                    _ => PathStep::Name(word),
                };
                path.push(PathPart { step, span: begin..self.at });
            } else {
                self.skip_spaces();
                let end = self.source.text.len();
                return match self.rest().chars().next() {
                    Some('=') => {
                        self.at += 1;
                        Ok(path)
                    }
                    Some(odd) => {
                        let message = format!("a key has letters, digits, - and _, found {odd:?}");
                        self.refuse(self.at..self.at + odd.len_utf8(), &message)
                    }
                    None => self.refuse(0..end, "there is no value: an equals sign is missing"),
                };
            }
        }
    }

    fn key(&mut self) -> Result<PathPart, Box<Complaint>> {
        let begin = self.at;
        let (word, _) = self.word()?;
        Ok(PathPart { step: PathStep::Key(word), span: begin..self.at })
    }

    /// A word as it stands, or in quotes; and whether it is in quotes.
    fn word(&mut self) -> Result<(String, bool), Box<Complaint>> {
        let begin = self.at;
        if self.takes('"') {
            let Some(length) = self.rest().find('"') else {
                return self.refuse(begin..self.source.text.len(), "the quotes are not closed");
            };
            let word = self.rest()[..length].to_owned();
            self.at += length + 1;
            return Ok((word, true));
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        let rest = self.rest();
        let word = rest[..rest.find(|c| !plain(c)).unwrap_or(rest.len())].to_owned();
        if word.is_empty() {
            let odd = self.rest().chars().next().map_or(0, char::len_utf8);
            return self.refuse(begin..begin + odd, "a key is missing");
        }
        self.at += word.len();
        Ok((word, false))
    }

    /// The value behind the equals sign.
    fn value(&mut self) -> Result<Positioned, Box<Complaint>> {
        self.skip_spaces();
        let text = self.rest().trim_end();
        let span = self.at..self.at + text.len();
        if text.is_empty() {
            return self
                .refuse(0..self.source.text.len(), "there is no value")
                .map_err(|complaint| Box::new(complaint.with_help("\"\" is an empty string")));
        }
        match value_of(self.source, span.clone()) {
            Ok(value) => Ok(value),
            Err(complaint) if begins_like_toml(text) => Err(Box::new(complaint)),
            Err(_) => Ok(Positioned::string(text, span)),
        }
    }
}

/// Whether a text is meant as a number, a string, a list or a table.
fn begins_like_toml(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || "+-\"'[{".contains(c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::positioned::Value;

    fn parse(text: &str) -> Setting {
        Setting::parse(text).unwrap_or_else(|found| panic!("{text}: {found:?}"))
    }

    #[test]
    fn a_path_has_keys_numbers_and_names() {
        let found = parse("a.b-c[2][reach].\"d.e\"[\"3\"] = 4");
        let steps: Vec<_> = found.path.iter().map(|part| part.step.clone()).collect();
        let key = |word: &str| PathStep::Key(word.into());
        let name = |word: &str| PathStep::Name(word.into());
        let wanted =
            [key("a"), key("b-c"), PathStep::Index(2), name("reach"), key("d.e"), name("3")];
        assert_eq!(steps, wanted);
        let places: Vec<_> =
            found.path.iter().map(|part| &found.text()[part.span.clone()]).collect();
        assert_eq!(places, ["a", "b-c", "[2]", "[reach]", "\"d.e\"", "[\"3\"]"]);
        assert_eq!(found.value.span, 29..30);
    }

    #[test]
    fn a_value_is_toml_or_a_bare_word() {
        let value = |text: &str| parse(&format!("k={text}")).value.value;
        assert!(matches!(value("20"), Value::Integer(20)));
        assert!(matches!(value(" 1e-3 "), Value::Float(x) if x == 1e-3));
        assert!(matches!(value("true"), Value::Boolean(true)));
        assert!(matches!(value("[1, [2]]"), Value::Array(items) if items.len() == 2));
        assert!(matches!(value("{ a = 1 }"), Value::Table(table) if table.len() == 1));
        for (text, word) in [
            ("free-floating", "free-floating"),
            ("../v.toml", "../v.toml"),
            ("\"3\"", "3"),
            ("two words", "two words"),
            ("tool.speed.max <= 1 m/s", "tool.speed.max <= 1 m/s"),
        ] {
            assert!(matches!(value(text), Value::String(found) if found == word), "{text}");
        }
    }

    #[test]
    fn what_is_no_setting_is_complained_of_at_its_place() {
        for (text, place, words) in [
            ("", "", "a key is missing"),
            ("=3", "=", "a key is missing"),
            ("a", "a", "equals sign"),
            ("a.=3", "=", "a key is missing"),
            ("a[1=3", "[1", "not closed"),
            ("a[]=3", "]", "a key is missing"),
            ("\"a=3", "\"a=3", "quotes"),
            ("a b=3", "b", "found 'b'"),
            ("ä=3", "ä", "a key is missing"),
            ("a=", "a=", "no value"),
            ("a=3 kg", "kg", "not TOML"),
            ("a=[1", "", "not TOML"),
        ] {
            let found = *Setting::parse(text).expect_err(text);
            assert_eq!(found.source.path.to_str(), Some("--set"));
            assert!(found.message.contains(words), "{text}: {}", found.message);
            let span = found.span.clone().expect("a place");
            assert!(text[span.clone()].contains(place), "{text}: {span:?}");
        }
    }
}

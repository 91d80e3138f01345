//! Numbers in the attributes of an XML file, each with its place.

use super::element::{Element, Reading, Text};
use std::ops::Range;
use wrasse_spatial::Vec3;

impl Reading<'_> {
    /// A number that must be there; nothing after a complaint.
    pub(crate) fn required_number(&mut self, element: &Element<'_, '_>, name: &str) -> Option<f64> {
        element.required(name, self)?;
        self.number(element, name)
    }

    /// A number, if it is there; nothing after a complaint.
    pub(crate) fn number(&mut self, element: &Element<'_, '_>, name: &str) -> Option<f64> {
        match self.numbers(element, name, 1)?[..] {
            [x] => Some(x),
            _ => None,
        }
    }

    /// Three numbers, if they are there; nothing after a complaint.
    pub(crate) fn vector(&mut self, element: &Element<'_, '_>, name: &str) -> Option<Vec3<f64>> {
        match self.numbers(element, name, 3)?[..] {
            [x, y, z] => Some(Vec3 { x, y, z }),
            _ => None,
        }
    }

    /// As many numbers as expected, if they are there; nothing after a complaint.
    pub(crate) fn numbers(
        &mut self,
        element: &Element<'_, '_>,
        name: &str,
        expected: usize,
    ) -> Option<Vec<f64>> {
        let value = element.attribute(name)?;
        let count = words(value, self.text).len();
        if count != expected {
            let wanted = counted(expected);
            let what = format!("`{name}` of <{}>", element.tag);
            let message = format!("{what} must be {wanted}, found {count}");
            let help = "separate numbers by spaces; the decimal sign is a point";
            self.found.error(&value.at, message, &wanted, help);
            return None;
        }
        self.list(element, name)
    }

    /// As many numbers as are given, up to a number, if they are there; nothing after a complaint.
    pub(crate) fn numbers_up_to(
        &mut self,
        element: &Element<'_, '_>,
        name: &str,
        most: usize,
    ) -> Option<Vec<f64>> {
        let given = words(element.attribute(name)?, self.text).len();
        self.numbers(element, name, given.clamp(1, most))
    }

    /// Any number of numbers, if they are there; nothing after a complaint.
    pub(crate) fn list(&mut self, element: &Element<'_, '_>, name: &str) -> Option<Vec<f64>> {
        let value = element.attribute(name)?;
        let numbers: Vec<_> = words(value, self.text)
            .into_iter()
            .map(|(word, at)| {
                let number = finite(word);
                if let Err((problem, help)) = number {
                    let word = shortened(word);
                    let message = format!("`{name}` of <{}>: '{word}' is {problem}", element.tag);
                    self.found.error(&at, message, problem, help);
                }
                number.ok()
            })
            .collect();
        numbers.into_iter().collect()
    }
}

/// How many numbers are wanted.
fn counted(expected: usize) -> String {
    match expected {
        1 => "one number".into(),
        3 => "three numbers".into(),
        _ => format!("{expected} numbers"),
    }
}

/// The words of a value and their places. A value written with entities has one place for all.
fn words<'a>(value: &Text<'a>, text: &'a str) -> Vec<(&'a str, Range<usize>)> {
    match text.get(value.at.clone()) {
        Some(written) if !written.contains('&') => {
            let mut from = 0;
            let place = |word: &'a str| {
                let start = from + written[from..].find(word).unwrap_or(0);
                from = start + word.len();
                (word, value.at.start + start..value.at.start + from)
            };
            written.split_whitespace().map(place).collect()
        }
        _ => value.text.split_whitespace().map(|word| (word, value.at.clone())).collect(),
    }
}

/// Letters of a word that are told.
const TOLD: usize = 40;

/// A word as it is told in a complaint.
fn shortened(word: &str) -> std::borrow::Cow<'_, str> {
    match word.char_indices().nth(TOLD) {
        Some((at, _)) => format!("{}…", &word[..at]).into(),
        None => word.into(),
    }
}

/// A finite number, or what is wrong with it and how to mend it.
fn finite(word: &str) -> Result<f64, (&'static str, &'static str)> {
    match word.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(_) => Err(("not finite", "write a finite number")),
        Err(_) if word.starts_with('$') || word.contains("${") => {
            Err(("a xacro expression", crate::urdf::EXPAND_XACRO))
        }
        Err(_) if word.contains(',') => {
            Err(("not a number", "the decimal sign is a point; separate numbers by spaces"))
        }
        Err(_) => Err(("not a number", "write a number such as 0.25 or 1e-3")),
    }
}

//! What must hold of a flight, and whether it does.

use crate::outcome::Verdict;
use crate::signals::quantity::{Statistic, Statistics};

/// How a value compares with its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// `<=`
    AtMost,
    /// `<`
    Below,
    /// `>=`
    AtLeast,
    /// `>`
    Above,
}

impl Comparison {
    /// All of them by their symbols.
    pub const ALL: [(&'static str, Self); 4] =
        [("<=", Self::AtMost), (">=", Self::AtLeast), ("<", Self::Below), (">", Self::Above)];

    fn symbol(self) -> &'static str {
        Self::ALL.iter().find(|(_, c)| *c == self).map_or("", |(symbol, _)| symbol)
    }
    fn holds(self, value: f64, limit: f64) -> bool {
        match self {
            Self::AtMost => value <= limit,
            Self::Below => value < limit,
            Self::AtLeast => value >= limit,
            Self::Above => value > limit,
        }
    }
}

/// A requirement, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// As it is written.
    pub text: String,
    /// Number of the quantity that it is about.
    pub quantity: usize,
    /// What is made of its values.
    pub statistic: Statistic,
    /// How it compares with the limit.
    pub comparison: Comparison,
    /// The limit, in its unit.
    pub limit: f64,
    /// Unit of the limit.
    pub unit: String,
    /// What the unit is in SI.
    pub scale: f64,
    /// The one phase that counts; all without one.
    pub phase: Option<usize>,
}

impl Requirement {
    /// Whether it holds.
    pub fn verdict(&self, seen: &Statistics) -> Verdict {
        let value = seen.value(self.quantity, self.statistic, self.phase);
        let value = value.map(|x| x / self.scale);
        Verdict {
            requirement: self.text.clone(),
            comparison: self.comparison.symbol().into(),
            limit: self.limit,
            value,
            unit: self.unit.clone(),
            pass: value.is_some_and(|x| self.comparison.holds(x, self.limit)),
        }
    }

    /// The verdict of a run that never came to a value.
    pub fn unanswered(&self) -> Verdict {
        Verdict {
            requirement: self.text.clone(),
            comparison: self.comparison.symbol().into(),
            limit: self.limit,
            value: None,
            unit: self.unit.clone(),
            pass: false,
        }
    }
}

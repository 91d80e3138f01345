//! Requirements: `METRIC <= NUMBER UNIT [during PHASE]`.

use crate::outcome::Verdict;
use crate::quantity::{Quantity, Statistic, Watch, is_unit};
use std::ops::Range;
use wrasse_document::closest;

/// How a value compares with its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Comparison {
    AtMost,
    Below,
    AtLeast,
    Above,
}

impl Comparison {
    const ALL: [(&'static str, Self); 4] =
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
pub(crate) struct Requirement {
    text: String,
    quantity: usize,
    statistic: Statistic,
    comparison: Comparison,
    limit: f64,
    unit: String,
    /// What the unit is in SI.
    scale: f64,
    phase: Option<usize>,
}

/// What is wrong with a requirement, and where in its text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BadRequirement {
    pub(crate) message: String,
    pub(crate) at: Range<usize>,
    pub(crate) help: String,
}

const FORM: &str = "write it as \"tool.position_error.max <= 0.3 mm\", with \"during PHASE\" behind it \
                    for one phase only";

impl Requirement {
    /// From its text.
    pub(crate) fn parse(
        text: &str,
        quantities: &[Quantity],
        phases: &[String],
    ) -> Result<Self, BadRequirement> {
        let bad = |message: String, word: &str, help: String| {
            let start = text.find(word).unwrap_or(0);
            BadRequirement { message, at: start..start + word.len(), help }
        };
        let mut words = text.split_whitespace();
        let mut next = |what: &str| {
            words.next().ok_or_else(|| bad(format!("the {what} is missing"), text, FORM.into()))
        };
        let (metric, symbol) = (next("metric")?, next("comparison")?);
        let (number, unit) = (next("limit")?, next("unit")?);
        let (quantity, statistic) = find_metric(metric, quantities, &bad)?;
        let comparison = Comparison::ALL.iter().find(|(s, _)| *s == symbol).map(|(_, c)| *c);
        let comparison = comparison.ok_or_else(|| {
            bad(format!("{symbol} is not a comparison"), symbol, "one of <=, <, >=, >".into())
        })?;
        let limit = number
            .parse::<f64>()
            .ok()
            .filter(|x| x.is_finite())
            .ok_or_else(|| bad(format!("{number} is not a number"), number, FORM.into()))?;
        let kind = quantities[quantity].kind;
        let scale = kind.scale_of(unit).ok_or_else(|| {
            let wrong = if is_unit(unit) { "does not measure" } else { "is no unit of" };
            let message = format!("{unit} {wrong} {}", quantities[quantity].name);
            bad(message, unit, format!("one of {}", kind.units().join(", ")))
        })?;
        let phase = match words.next() {
            None => None,
            Some("during") => {
                let name = words.next().unwrap_or_default();
                let found = phases.iter().position(|p| p == name);
                Some(found.ok_or_else(|| {
                    let message = format!("there is no phase called {name:?}");
                    bad(message, name, format!("one of {}", phases.join(", ")))
                })?)
            }
            Some(word) => {
                return Err(bad(format!("{word} is not understood here"), word, FORM.into()));
            }
        };
        Ok(Self {
            text: text.into(),
            quantity,
            statistic,
            comparison,
            limit,
            unit: unit.into(),
            scale,
            phase,
        })
    }

    /// Whether it holds.
    pub(crate) fn verdict(&self, watch: &Watch) -> Verdict {
        let value = watch.value(self.quantity, self.statistic, self.phase);
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
    pub(crate) fn unanswered(&self) -> Verdict {
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

/// The quantity and statistic that a metric names.
fn find_metric(
    metric: &str,
    quantities: &[Quantity],
    bad: &dyn Fn(String, &str, String) -> BadRequirement,
) -> Result<(usize, Statistic), BadRequirement> {
    for (i, quantity) in quantities.iter().enumerate() {
        let rest = metric.strip_prefix(quantity.name.as_str()).and_then(|r| r.strip_prefix('.'));
        let found = quantity.statistics.iter().find(|s| rest == Some(s.name()));
        if let Some(&statistic) = found {
            return Ok((i, statistic));
        }
    }
    let names: Vec<String> = quantities
        .iter()
        .flat_map(|q| q.statistics.iter().map(move |s| format!("{}.{}", q.name, s.name())))
        .collect();
    let help = match closest(metric, names.iter().map(String::as_str)) {
        Some(name) => format!("did you mean {name}?"),
        None => format!("the metrics are {}", names.join(", ")),
    };
    Err(bad(format!("there is no metric called {metric}"), metric, help))
}

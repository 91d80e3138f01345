//! Requirements: `METRIC <= NUMBER UNIT [during PHASE]`.

use crate::outcome::Verdict;
use crate::quantity::{Quantity, Statistic, Watch, is_unit};
use std::ops::Range;
use wrasse_document::{UNKNOWN, closest};

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
            // Words are parts of the text: where they begin is where they stand.
            let start = (word.as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
            BadRequirement { message, at: start..start + word.len(), help }
        };
        let mut words = text.split_whitespace();
        let missing = |what: &str| bad(format!("the {what} is missing"), text, FORM.into());
        let metric = words.next().ok_or_else(|| missing("metric"))?;
        let (quantity, statistic) = find_metric(metric, quantities, &bad)?;
        let symbol = words.next().ok_or_else(|| missing("comparison"))?;
        let comparison = Comparison::ALL.iter().find(|(s, _)| *s == symbol).map(|(_, c)| *c);
        let comparison = comparison.ok_or_else(|| {
            bad(format!("{symbol} is not a comparison"), symbol, "one of <=, <, >=, >".into())
        })?;
        let number = words.next().ok_or_else(|| missing("limit"))?;
        let limit = number
            .parse::<f64>()
            .ok()
            .filter(|x| x.is_finite())
            .ok_or_else(|| bad(format!("{number} is not a number"), number, FORM.into()))?;
        let kind = quantities[quantity].kind;
        let units = format!("one of {}", kind.units().join(", "));
        let unit = words.next().ok_or_else(|| {
            bad(format!("the unit of {number} is missing"), number, units.clone())
        })?;
        let scale = kind.scale_of(unit).ok_or_else(|| {
            let wrong = if is_unit(unit) { "does not measure" } else { "is no unit of" };
            let message = format!("{unit} {wrong} {}", quantities[quantity].name);
            bad(message, unit, units)
        })?;
        let phase = match words.next() {
            None => None,
            Some(during @ "during") => {
                Some(find_phase(behind(text, during), during, phases, &bad)?)
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

    /// Number of the quantity that it is about.
    pub(crate) fn quantity(&self) -> usize {
        self.quantity
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

/// What stands behind a word of a text.
fn behind<'t>(text: &'t str, word: &'t str) -> &'t str {
    let end = (word.as_ptr() as usize + word.len()).saturating_sub(text.as_ptr() as usize);
    text.get(end..).unwrap_or_default().trim()
}

/// The phase of a name, which may have spaces.
fn find_phase(
    name: &str,
    during: &str,
    phases: &[String],
    bad: &dyn Fn(String, &str, String) -> BadRequirement,
) -> Result<usize, BadRequirement> {
    let names = || format!("one of {}", phases.join(", "));
    if name.is_empty() {
        return Err(bad("the phase is missing behind during".into(), during, names()));
    }
    // A phase whose name is left out may be any.
    let made_up = || phases.iter().position(|p| p == UNKNOWN);
    phases.iter().position(|p| p == name).or_else(made_up).ok_or_else(|| {
        let help = match closest(name, phases.iter().map(String::as_str)) {
            Some(close) => format!("did you mean {close}?"),
            None => names(),
        };
        bad(format!("there is no phase called {name:?}"), name, help)
    })
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
    if let Some(quantity) = quantities.iter().find(|q| q.name == metric) {
        let message = format!("which value of {metric} is missing");
        return Err(bad(message, metric, format!("write {}", with_statistics(quantity))));
    }
    let names: Vec<String> = quantities
        .iter()
        .flat_map(|q| q.statistics.iter().map(move |s| format!("{}.{}", q.name, s.name())))
        .collect();
    let renamed = metric.replacen("gyros.", "cmgs.", 1);
    let help = match closest(metric, names.iter().map(String::as_str)) {
        _ if metric != renamed && names.contains(&renamed) => {
            format!("{metric} was renamed: write {renamed}")
        }
        Some(name) => format!("did you mean {name}?"),
        None => format!("the metrics are {}", all_metrics(quantities).join("; ")),
    };
    Err(bad(format!("there is no metric called {metric}"), metric, help))
}

/// `tool.speed.max or .final`
fn with_statistics(quantity: &Quantity) -> String {
    let statistics: Vec<&str> = quantity.statistics.iter().map(|s| s.name()).collect();
    format!("{}.{}", quantity.name, statistics.join(" or ."))
}

/// All metrics, those of joints once for all joints.
fn all_metrics(quantities: &[Quantity]) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    for quantity in quantities {
        let joint = quantity.name.strip_prefix("joint.").and_then(|rest| rest.rsplit_once('.'));
        let written = with_statistics(quantity);
        let written = joint.map_or(written.clone(), |(name, _)| written.replacen(name, "NAME", 1));
        if !all.contains(&written) {
            all.push(written);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::quantities;

    fn parse(text: &str) -> Result<Requirement, BadRequirement> {
        let phases = ["reach".to_owned(), "hold on".to_owned()];
        Requirement::parse(text, &quantities(&[("elbow".into(), true)]), &phases)
    }

    /// The verdict on a requirement when its quantity was seen to have these values in each phase.
    #[track_caller]
    fn verdict(text: &str, phases: [&[f64]; 2]) -> Verdict {
        let quantities = quantities(&[("elbow".into(), true)]);
        let requirement = parse(text).expect("a sound requirement");
        let mut watch = Watch::new(quantities.clone(), 2);
        for (phase, values) in phases.iter().enumerate() {
            for value in *values {
                let mut all = vec![f64::NAN; quantities.len()];
                all[requirement.quantity] = *value;
                watch.add(phase, &all);
            }
        }
        requirement.verdict(&watch)
    }

    #[test]
    fn a_value_at_its_limit_holds_where_equality_is_allowed() {
        for (comparison, below, at, above) in [
            ("<=", true, true, false),
            ("<", true, false, false),
            (">=", false, true, true),
            (">", false, false, true),
        ] {
            let text = format!("energy.final {comparison} 2 J");
            let holds = |value: f64| verdict(&text, [&[value], &[]]).pass;
            assert_eq!([holds(1.0), holds(2.0), holds(3.0)], [below, at, above], "{comparison}");
        }
    }

    #[test]
    fn limit_and_value_are_in_the_unit_of_the_requirement() {
        let found = verdict("tool.position_error.max <= 0.3 mm", [&[1e-4, -4e-4], &[2e-4]]);
        assert_eq!((found.limit, found.unit.as_str(), found.pass), (0.3, "mm", false));
        let value = found.value.expect("it was seen");
        assert!((value - 0.4).abs() < 1e-15, "the largest, without its sign: {value}");
        let found = verdict("joint.elbow.travel.final <= 90 deg", [&[1.0], &[0.5]]);
        let value = found.value.expect("it was seen");
        assert!((value - 0.5_f64.to_degrees()).abs() < 1e-13, "the last: {value}");
        let found = verdict("joints.effort_use.max <= 100 %", [&[0.25], &[]]);
        assert!((found.value.expect("it was seen") - 25.0).abs() < 1e-13);
    }

    #[test]
    fn a_requirement_of_a_phase_sees_that_phase_only() {
        let seen: [&[f64]; 2] = [&[3.0], &[1.0, 2.0]];
        let value = |text: &str| verdict(text, seen).value;
        assert_eq!(value("energy.max <= 1 J"), Some(3.0));
        assert_eq!(value("energy.max <= 1 J during hold on"), Some(2.0));
        assert_eq!(value("energy.final <= 1 J during reach"), Some(3.0));
    }

    #[test]
    fn a_quantity_without_a_value_fails_its_requirement() {
        for text in ["energy.max >= 0 J", "energy.max <= 1 J during hold on"] {
            let found = verdict(text, [&[f64::NAN], &[]]);
            assert_eq!((found.value, found.pass), (None, false), "{text}");
        }
        let unanswered = parse("energy.max <= 1 J").expect("sound").unanswered();
        assert_eq!((unanswered.value, unanswered.pass), (None, false));
    }

    #[test]
    fn every_unit_belongs_to_a_metric_and_every_metric_has_a_unit() {
        for quantity in quantities(&[("a".into(), true), ("b".into(), false)]) {
            let units = quantity.kind.units();
            assert!(!units.is_empty(), "{}", quantity.name);
            assert!(units.iter().any(|unit| quantity.kind.scale_of(unit) == Some(1.0)), "no SI");
            for unit in units {
                assert!(is_unit(unit));
                let statistic = quantity.statistics[0].name();
                let text = format!("{}.{statistic} <= 1 {unit}", quantity.name);
                let one = [quantity.clone()];
                assert!(Requirement::parse(&text, &one, &[]).is_ok(), "{text}");
            }
        }
    }
}

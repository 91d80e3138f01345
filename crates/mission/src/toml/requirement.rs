//! `requirements`: what must hold, `METRIC <= NUMBER UNIT [during PHASE]`.

use crate::reading::Reading;
use crate::toml::MissionFile;
use std::ops::Range;
use wrasse_document::{Complaint, Document, UNKNOWN, at, closest};
use wrasse_dynamics::JointKind;
use wrasse_rehearsal::{
    Comparison, Quantity, Requirement, Statistic, measured_in, quantities, watched_tools,
};

/// The quantities that are watched, and what is required of them.
pub(crate) fn requirements(
    r: &mut Reading<'_>,
    file: &MissionFile,
) -> (Vec<Quantity>, Vec<Requirement>) {
    let vehicle = r.vehicle;
    let phases: Vec<String> = file.phase.iter().map(|p| p.name.clone()).collect();
    let joints: Vec<(String, bool)> = vehicle
        .joint_names
        .iter()
        .enumerate()
        .map(|(j, name)| (name.clone(), vehicle.robot.joint(j).kind == JointKind::Revolute))
        .collect();
    let quantities = quantities(watched_tools(vehicle), &joints);
    let mut requirements = vec![];
    for (i, text) in file.requirements.iter().enumerate() {
        match parse(text, &quantities, &phases) {
            Ok(requirement) => requirements.push(requirement),
            Err(bad) => r.complaints.push(complaint_within(r.document, i, text, bad)),
        }
    }
    (quantities, requirements)
}

/// What is wrong with a requirement, and where in its text.
#[derive(Debug, Clone, PartialEq)]
struct BadRequirement {
    message: String,
    at: Range<usize>,
    help: String,
}

const FORM: &str = "write it as \"tool.position_error.max <= 0.3 mm\", with \"during PHASE\" behind it \
                    for one phase only";

/// From its text.
fn parse(
    text: &str,
    quantities: &[Quantity],
    phases: &[String],
) -> Result<Requirement, BadRequirement> {
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
    let unit = words
        .next()
        .ok_or_else(|| bad(format!("the unit of {number} is missing"), number, units.clone()))?;
    let scale = kind.scale_of(unit).ok_or_else(|| {
        let wrong = if measured_in(unit).is_some() { "does not measure" } else { "is no unit of" };
        let message = format!("{unit} {wrong} {}", quantities[quantity].name);
        bad(message, unit, units)
    })?;
    let phase = match words.next() {
        None => None,
        Some(during @ "during") => Some(find_phase(behind(text, during), during, phases, &bad)?),
        Some(word) => {
            return Err(bad(format!("{word} is not understood here"), word, FORM.into()));
        }
    };
    Ok(Requirement {
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

/// A complaint about a part of a requirement's text.
fn complaint_within(
    document: &Document,
    i: usize,
    requirement: &str,
    bad: BadRequirement,
) -> Complaint {
    let whole = document.error(at!["requirements", i], bad.message, "here").with_help(bad.help);
    // Inside the quotes, if the text stands there as it is.
    let Some(span) = whole.span.clone() else { return whole };
    let text = &whole.source.text;
    let first = span.start + 1;
    let as_it_is = text.get(first..first + requirement.len()) == Some(requirement);
    let inside = first + bad.at.start..first + bad.at.end;
    if as_it_is && !bad.at.is_empty() { whole.at(inside, "here") } else { whole }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_rehearsal::{Statistics, Verdict};

    fn parse(text: &str) -> Result<Requirement, BadRequirement> {
        let phases = ["reach".to_owned(), "hold on".to_owned()];
        super::parse(text, &quantities(&[], &[("elbow".into(), true)]), &phases)
    }

    /// The verdict on a requirement when its quantity was seen to have these values in each phase.
    #[track_caller]
    fn verdict(text: &str, phases: [&[f64]; 2]) -> Verdict {
        let quantities = quantities(&[], &[("elbow".into(), true)]);
        let requirement = parse(text).expect("a sound requirement");
        let mut watch = Statistics::new(quantities.clone(), 2);
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
        for quantity in quantities(&["t".into()], &[("a".into(), true), ("b".into(), false)]) {
            let units = quantity.kind.units();
            assert!(!units.is_empty(), "{}", quantity.name);
            assert!(units.iter().any(|unit| quantity.kind.scale_of(unit) == Some(1.0)), "no SI");
            for unit in units {
                assert!(measured_in(unit).is_some());
                let statistic = quantity.statistics[0].name();
                let text = format!("{}.{statistic} <= 1 {unit}", quantity.name);
                let one = [quantity.clone()];
                assert!(super::parse(&text, &one, &[]).is_ok(), "{text}");
            }
        }
    }
}

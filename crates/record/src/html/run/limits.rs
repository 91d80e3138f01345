//! Limits of requirements as lines in the plots of their quantities.

use serde::Serialize;
use wrasse_rehearsal::{CaseOutcome, Channel, EventKind, Verdict};

use crate::wording::cases::quantity;

/// A limit in a plot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Limit {
    /// What it says: `max <= 0.3 mm`.
    text: String,
    /// The limit, in the unit of the channel.
    value: f64,
    unit: String,
    /// Between which times it binds (s); one instant for what is judged at the end.
    from: f64,
    to: f64,
}

/// The limits on channels of one plot, in the order of the requirements.
pub(super) fn limits(case: &CaseOutcome, channels: &[&Channel]) -> Vec<Limit> {
    let each = case.verdicts.iter().filter_map(|verdict| of(verdict, case, channels));
    each.flatten().collect()
}

fn of(verdict: &Verdict, case: &CaseOutcome, channels: &[&Channel]) -> Option<Vec<Limit>> {
    let metric = quantity(&verdict.requirement, &verdict.comparison);
    let (name, statistic) = metric.rsplit_once('.')?;
    let on: Vec<_> = channels.iter().filter(|channel| is_of(channel, name)).collect();
    let unit = &on.first()?.unit;
    let value = verdict.limit * si(&verdict.unit)?.1 / si(unit)?.1;
    if si(&verdict.unit)?.0 != si(unit)?.0 {
        return None;
    }
    let [from, to] = span(verdict, case)?;
    let from = if statistic == "final" { to } else { from };
    let text = verdict.requirement.trim_start_matches(name).trim_start_matches('.').to_owned();
    let above = Limit { text, value, unit: unit.clone(), from, to };
    // The largest value counts without its sign.
    let is_signed = on.iter().any(|channel| channel.values.iter().any(|x| *x < 0.0));
    let below = Limit { value: -value, text: String::new(), ..above.clone() };
    let both = is_signed && verdict.comparison.starts_with('<');
    Some(if both { vec![above, below] } else { vec![above] })
}

/// Whether a channel is the quantity, or a component of it.
fn is_of(channel: &Channel, quantity: &str) -> bool {
    let rest = channel.name.strip_prefix(quantity);
    rest.is_some_and(|rest| matches!(rest, "" | ".x" | ".y" | ".z"))
}

/// Start and end of what is judged: the run, or the phase that the requirement names.
fn span(verdict: &Verdict, case: &CaseOutcome) -> Option<[f64; 2]> {
    let (first, last) = (*case.telemetry.time.first()?, *case.telemetry.time.last()?);
    let Some((_, phase)) = verdict.requirement.split_once(" during ") else {
        return Some([first, last]);
    };
    let begins = format!("phase {}", phase.trim());
    let mut phases = case.events.iter().filter(|event| event.kind == EventKind::Phase);
    let from = phases.find(|event| event.text == begins)?.time_s;
    Some([from, phases.next().map_or(last, |next| next.time_s)])
}

/// What a unit of requirements and channels measures, as its unit in SI, and what it is in that.
fn si(unit: &str) -> Option<(&'static str, f64)> {
    const DEGREE: f64 = std::f64::consts::PI / 180.0;
    Some(match unit {
        "m" => ("m", 1.0),
        "cm" => ("m", 1e-2),
        "mm" => ("m", 1e-3),
        "um" => ("m", 1e-6),
        "rad" => ("rad", 1.0),
        "mrad" => ("rad", 1e-3),
        "deg" => ("rad", DEGREE),
        "arcmin" => ("rad", DEGREE / 60.0),
        "arcsec" => ("rad", DEGREE / 3600.0),
        "m/s" => ("m/s", 1.0),
        "mm/s" => ("m/s", 1e-3),
        "rad/s" => ("rad/s", 1.0),
        "deg/s" => ("rad/s", DEGREE),
        "N" => ("N", 1.0),
        "kN" => ("N", 1e3),
        "N·m" | "N.m" | "Nm" => ("N·m", 1.0),
        "mNm" => ("N·m", 1e-3),
        "N·m·s" | "N.m.s" | "Nms" => ("N·m·s", 1.0),
        "J" => ("J", 1.0),
        "mJ" => ("J", 1e-3),
        "kg" => ("kg", 1.0),
        "g" => ("kg", 1e-3),
        "–" | "-" => ("–", 1.0),
        "%" => ("–", 1e-2),
        _ => return None,
    })
}

//! Limits of requirements as lines in the plots of their quantities.

use serde::Serialize;
use wrasse_rehearsal::{CaseOutcome, Channel, EventKind, Verdict, measured_in};

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
    let (asked, drawn) = (measured_in(&verdict.unit)?, measured_in(unit)?);
    if asked.0 != drawn.0 {
        return None;
    }
    let value = verdict.limit * asked.1 / drawn.1;
    let text = verdict.requirement.trim_start_matches(name).trim_start_matches('.');
    // The largest value counts without its sign.
    let is_signed = on.iter().any(|channel| channel.values.iter().any(|x| *x < 0.0));
    let both = is_signed && verdict.comparison.starts_with('<');
    let mut limits = vec![];
    for [from, to] in spans(verdict, case) {
        let from = if statistic == "final" { to } else { from };
        // Said once, however often a phase comes.
        let text = if limits.is_empty() { text.to_owned() } else { String::new() };
        limits.push(Limit { text, value, unit: unit.clone(), from, to });
        if both {
            limits.push(Limit { value: -value, text: String::new(), unit: unit.clone(), from, to });
        }
    }
    Some(limits)
}

/// Whether a channel is the quantity, or a component of it.
fn is_of(channel: &Channel, quantity: &str) -> bool {
    let rest = channel.name.strip_prefix(quantity);
    rest.is_some_and(|rest| matches!(rest, "" | ".x" | ".y" | ".z"))
}

/// Starts and ends of what is judged: the run, or each time that the phase comes that the requirement names.
fn spans(verdict: &Verdict, case: &CaseOutcome) -> Vec<[f64; 2]> {
    let time = &case.telemetry.time;
    let (Some(&first), Some(&last)) = (time.first(), time.last()) else { return vec![] };
    let Some((_, phase)) = verdict.requirement.split_once(" during ") else {
        return vec![[first, last]];
    };
    let begins = format!("phase {}", phase.trim());
    let phases: Vec<_> =
        case.events.iter().filter(|event| event.kind == EventKind::Phase).collect();
    let end = |k: usize| phases.get(k + 1).map_or(last, |next| next.time_s);
    let named = phases.iter().enumerate().filter(|(_, event)| event.text == begins);
    named.map(|(k, event)| [event.time_s, end(k)]).collect()
}

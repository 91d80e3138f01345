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

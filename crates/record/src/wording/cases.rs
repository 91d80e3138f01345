//! Cases and requirements in words: their names, how they ended and why.

use wrasse_rehearsal::{CaseOutcome, End};

use super::numbers::significant;

/// The quantity of a requirement: what stands before its comparison.
pub(crate) fn quantity<'a>(requirement: &'a str, comparison: &str) -> &'a str {
    match requirement.split_once(comparison) {
        Some((quantity, _)) if !comparison.is_empty() => quantity.trim(),
        _ => requirement.trim(),
    }
}

/// What a requirement judges, without its limit: its quantity, and the phase if it names one.
pub(crate) fn judged(requirement: &str, comparison: &str) -> String {
    let quantity = quantity(requirement, comparison);
    match requirement.split_once(" during ") {
        Some((_, phase)) if !quantity.contains(" during ") => format!("{quantity} during {phase}"),
        _ => quantity.to_owned(),
    }
}

/// The case in words, from its labels: `law=terrestrial, payload=200 kg`; `run` for the only one.
pub(crate) fn case_name(case: &CaseOutcome) -> String {
    name_of(&case.labels)
}

/// The name that axes and rows give a case.
pub(crate) fn name_of(labels: &[(String, String)]) -> String {
    if labels.is_empty() {
        return "run".to_owned();
    }
    let labels: Vec<_> = labels.iter().map(|(axis, row)| format!("{axis}={row}")).collect();
    labels.join(", ")
}

/// How a case ended, in two or three words.
pub(crate) fn ending(end: &End) -> String {
    match end {
        End::Completed => "completed".to_owned(),
        End::Infeasible { time_s, .. } => format!("infeasible at {} s", significant(*time_s)),
        End::Stopped { time_s, .. } => format!("stopped at {} s", significant(*time_s)),
        End::Breakdown { time_s, .. } => format!("breakdown at {} s", significant(*time_s)),
    }
}

/// Why a case ended early, with where and when; nothing for one that was flown to its end.
pub(crate) fn reason(end: &End) -> Option<String> {
    let (what, phase, time_s, reason) = match end {
        End::Completed => return None,
        End::Infeasible { phase, time_s, reason } => ("infeasible", Some(phase), time_s, reason),
        End::Stopped { phase, time_s, reason } => ("stopped", Some(phase), time_s, reason),
        End::Breakdown { time_s, reason } => ("breakdown", None, time_s, reason),
    };
    let phase = phase.map_or(String::new(), |phase| format!(" in phase {phase}"));
    Some(format!("{what}{phase} at {} s: {reason}", significant(*time_s)))
}

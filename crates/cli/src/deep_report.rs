//! What `wrasse check --deep` prints of a vehicle.

use crate::vehicle_page::wrapped;
use wrasse_document::visible;
use wrasse_rehearsal::{COAST_SEED, coast};
use wrasse_vehicle::{DeepCheck, Finding, FindingKind, Vehicle};

/// Columns of a terminal.
const WIDTH: usize = 80;
/// Findings of one kind that are shown.
const SHOWN: usize = 8;

/// All checks of a vehicle: those of its numbers, and a coast.
pub(crate) fn deep_check(vehicle: &Vehicle) -> DeepCheck {
    let mut check = vehicle.deep_check();
    let (found, fine) = coast(vehicle, COAST_SEED).finding(vehicle);
    check.take(found, fine);
    check
}

/// The report: findings by kind, each kind with why it matters, then what is fine.
pub(crate) fn deep_report(check: &DeepCheck) -> String {
    let mut lines = vec![match check.findings.len() {
        0 => "deep check: nothing found".to_owned(),
        1 => "deep check: 1 finding".to_owned(),
        count => format!("deep check: {count} findings"),
    }];
    for kind in FindingKind::ALL {
        let found: Vec<_> = check.findings.iter().filter(|found| found.kind == kind).collect();
        if found.is_empty() {
            continue;
        }
        lines.extend([String::new(), kind.title().to_owned(), wrapped(kind.why(), 2, WIDTH)]);
        lines.extend(found.iter().take(SHOWN).map(|found| of_finding(found)));
        if found.len() > SHOWN {
            lines.push(format!("  and {} more: --json lists all", found.len() - SHOWN));
        }
    }
    if !check.fine.is_empty() {
        lines.extend([String::new(), "fine".to_owned()]);
        let fine = check.fine.iter();
        lines.extend(fine.map(|fine| {
            wrapped(&visible(&format!("{}: {}", fine.kind.title(), fine.message)), 2, WIDTH)
        }));
    }
    lines.join("\n")
}

fn of_finding(found: &Finding) -> String {
    let place = found.place.as_ref().map_or(String::new(), |place| format!(" ({place})"));
    let head = format!("  {}: {}{place}", found.severity.word(), found.subject);
    format!("{}\n{}", visible(&head), wrapped(&visible(&found.message), 4, WIDTH))
}

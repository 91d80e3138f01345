//! The ledger in words: what it leaves unexplained, how much that is of what was in play, why there
//! is none, what to try if it stays open.

use wrasse_rehearsal::{Booking, CaseOutcome, End, Ledger, Source};

/// What to try when the ledger does not close.
pub(crate) const OPEN: &str = "          an open ledger fails the run; a smaller world.step_s closes it if the \
                    integration is the reason\n";

/// Why there is no ledger, where nothing moved or numbers were lost.
pub(crate) fn no_ledger(case: &CaseOutcome) -> Option<&'static str> {
    match case.end {
        End::Infeasible { .. } => Some("nothing moved: there is no ledger"),
        End::Breakdown { .. } => Some("numbers broke down: there is no ledger"),
        End::Completed | End::Stopped { .. } => None,
    }
}

/// What one line of the ledger leaves unexplained.
pub(crate) struct Rest {
    /// Its unit.
    pub(crate) unit: &'static str,
    /// Unexplained, largest over the run.
    pub(crate) rest: f64,
    /// What was in play.
    pub(crate) scale: f64,
    /// Rest over scale; zero where there is no rest.
    pub(crate) relative: f64,
    /// The bound on `relative`.
    pub(crate) bound: f64,
}

/// The unexplained rests: angular and linear momentum, energy.
pub(crate) fn ledger_rests(ledger: &Ledger) -> [Rest; 3] {
    let rest = |unit, rest: f64, scale: f64, bound| Rest {
        unit,
        rest,
        scale,
        relative: if rest == 0.0 { 0.0 } else { rest / scale },
        bound,
    };
    let [angular, linear, energy] = ledger.bounds;
    [
        rest("N·m·s", ledger.residual[0], ledger.scale[0], angular),
        rest("N·s", ledger.residual[1], ledger.scale[1], linear),
        rest("J", ledger.residual[2], ledger.scale[2], energy),
    ]
}

/// The sources that have given anything.
pub(crate) fn sources(ledger: &Ledger) -> impl Iterator<Item = (Source, Booking)> + '_ {
    let all = Source::ALL.into_iter().map(|source| (source, ledger.sources[source]));
    all.filter(|(_, given)| *given != Booking::default())
}

impl Rest {
    /// Whether the rest is within its bound.
    pub(crate) fn within(&self) -> bool {
        self.relative <= self.bound
    }
}

//! The ledger in words: what it leaves unexplained, how much that is of what was in play, why there
//! is none, what to try if it stays open.

use wrasse_mission::{CaseOutcome, End, Ledger};

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
        rest("N·m·s", ledger.angular_rest, ledger.angular_scale, angular),
        rest("N·s", ledger.linear_rest, ledger.linear_scale, linear),
        rest("J", ledger.energy_rest, ledger.energy_scale, energy),
    ]
}

impl Rest {
    /// Whether the rest is within its bound.
    pub(crate) fn within(&self) -> bool {
        self.relative <= self.bound
    }
}

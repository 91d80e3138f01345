//! What follows from the verdicts: where CMGs are needed, as the claim of a study has it, where they
//! are not, and what decides. Every sentence counts verdicts; none is written beforehand.

mod beyond_sets;
mod deciding_quantity;
mod lightest;
mod sufficient_sets;
#[cfg(test)]
mod tests;
mod verdicts;
mod wording;

use crate::outcome::{Finding, SetCard, TaskOutcome};
use lightest::lightest;
use verdicts::Verdicts;
use wrasse_mission::ClaimIs;

/// The findings, in a fixed order; what does not occur is left out, and so is everything where nothing
/// was flown.
pub(crate) fn findings(
    claim: Option<ClaimIs>,
    sets: &[SetCard],
    tasks: &[TaskOutcome],
) -> Vec<Finding> {
    let all = Verdicts { claim, sets, tasks };
    let parts = [
        lightest(sets, &all.that(|_| true)),
        all.only_cmgs(),
        all.wheels_suffice(),
        all.neither(),
        all.torque_decides(),
        all.steering_decides(),
        all.duration_decides(),
        all.thrusters(),
        all.push_moves(),
        all.tool_error_decides(),
        all.nothing_asked(),
    ];
    parts.into_iter().flatten().filter(|finding| !finding.tasks.is_empty()).collect()
}

//! Readings that the attitude estimator refused, and how often it started again.

use crate::notices::limits_passed::Passed;
use wrasse_flight::AttitudeEstimate;

/// What the attitude estimator refused, and how often it started again.
#[derive(Debug, Default)]
pub(crate) struct Refusals {
    refused: Count,
    restarts: Count,
}

/// How often something happened, and when first (s).
#[derive(Debug, Default)]
struct Count {
    all: u32,
    first: f64,
}

impl Count {
    /// Whether there are more than before.
    fn rises(&mut self, all: u32, time: f64) -> bool {
        if self.all == 0 {
            self.first = time;
        }
        let more = all > self.all;
        self.all = all;
        more
    }
}

impl Refusals {
    /// Note what the estimator says at a time (s); what is new, in words.
    pub(crate) fn note(
        &mut self,
        estimate: &AttitudeEstimate<f64>,
        time: f64,
    ) -> Vec<(Passed, String)> {
        let AttitudeEstimate { refused, restarts, .. } = *estimate;
        let mut new = vec![];
        if self.refused.rises(refused, time) {
            let text = format!(
                "the attitude estimator refuses a reading of the star tracker ({refused} since the start): \
                 it does not fit what was estimated, or is no number"
            );
            new.push((Passed::ReadingRefused, text));
        }
        if self.restarts.rises(restarts, time) {
            let text = format!(
                "the attitude estimator starts again from the star tracker ({restarts} since the \
                 start): reading after reading did not fit what it estimated"
            );
            new.push((Passed::EstimatorRestarted, text));
        }
        new
    }

    /// One sentence for each that happened.
    pub(crate) fn summary(&self) -> Vec<String> {
        let each = [
            (&self.refused, "readings of the star tracker that the attitude estimator refused"),
            (&self.restarts, "new starts of the attitude estimator from the star tracker"),
        ];
        let happened = each.into_iter().filter(|(count, _)| count.all > 0);
        happened
            .map(|(count, what)| {
                format!("{} in all, the first at {:.2} s: {what}", count.all, count.first)
            })
            .collect()
    }
}

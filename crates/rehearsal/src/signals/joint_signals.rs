//! Signals of each joint.

use crate::signals::observe::there;
use crate::signals::quantity::Statistic::{Final, Max};
use crate::signals::quantity::{Kind, Statistic};
use crate::signals::{Needs, Seen};

/// A signal that every joint has.
pub(super) struct JointSignal {
    pub(super) name: &'static str,
    pub(super) meaning: &'static str,
    /// Where the joint turns, and where it slides.
    pub(super) kinds: [Kind; 2],
    pub(super) statistics: &'static [Statistic],
    pub(super) needs: Needs,
    pub(super) value: fn(&Seen<'_>, usize) -> f64,
}

/// The signals of each joint.
pub(super) const JOINT_SIGNALS: [JointSignal; 4] = [
    JointSignal {
        name: "travel",
        meaning: "how far the joint is from where it was at the start",
        kinds: [Kind::Angle, Kind::Length],
        statistics: &[Max, Final],
        needs: Needs::NONE,
        value: |s, j| there(s.truth.state.q[j] - s.case.start.q[j]),
    },
    JointSignal {
        name: "commanded_travel",
        meaning: "how far the joint was sent from where it was at the start",
        kinds: [Kind::Angle, Kind::Length],
        statistics: &[Max, Final],
        needs: Needs::NONE,
        value: |s, j| there(s.command.set_points[j].position - s.case.start.q[j]),
    },
    JointSignal {
        name: "rate",
        meaning: "the rate that the way asks of the joint before its rate limit slows the tool, or the one that it has where that is more",
        kinds: [Kind::AngularSpeed, Kind::Speed],
        statistics: &[Max],
        needs: Needs::NONE,
        value: |s, j| there(s.asked.rates[j]),
    },
    JointSignal {
        name: "effort",
        meaning: "what the law asks of the drive before it is cut; of a prescribed joint what it takes to move it",
        kinds: [Kind::Torque, Kind::Force],
        statistics: &[Max],
        needs: Needs::DYNAMICS,
        value: |s, j| there(s.asked.efforts[j]),
    },
];

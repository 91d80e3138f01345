//! Moves that the tests of the computer fly.

use crate::laws::flights::{aside, at_rest};
use wrasse_dynamics::State;
use wrasse_flight::{Axes, Command, Held, JointTarget, JointTiming, Phase};
use wrasse_hardware::SetPoint;

pub(super) fn joints_to(q: [f64; 7], duration: f64) -> Phase<f64, 7> {
    let to = JointTarget::Positions(q.map(Some));
    Phase::MoveJoints { to, timing: JointTiming::Duration(duration) }
}

/// A tool move, a hold of the tool, a joint move that brings the joints on, and a hold of the joints.
pub(super) fn tour(axes: Axes) -> [Phase<f64, 7>; 4] {
    let q = at_rest().q.map(|q| q + 0.2);
    [
        aside(axes, 4.0),
        Phase::Hold { what: Held::Tool, duration: 0.5 },
        joints_to(q, 3.0),
        Phase::Hold { what: Held::Joints, duration: 0.5 },
    ]
}

/// Set-points at the ends of all periods, the start included, on the same joint.
pub(super) fn of_joint(
    start: &State<f64, 7>,
    commands: &[Command<f64, 7>],
    j: usize,
) -> Vec<SetPoint<f64>> {
    let first = SetPoint { position: start.q[j], rate: start.v[j], acceleration: 0.0 };
    core::iter::once(first).chain(commands.iter().map(|c| c.set_points[j])).collect()
}

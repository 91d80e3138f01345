//! Tools on joints that follow others: no path is planned for them, because the guidance moves each joint
//! of an arm for itself.

use crate::reading::Reading;
use wrasse_document::at;
use wrasse_dynamics::Frame;
use wrasse_flight::{Assignment, Held, JointTarget, Phase};
use wrasse_rehearsal::StepCase;
use wrasse_vehicle::JOINTS;

/// Complains of phases that guide a tool on a joint that follows another one, or is followed.
pub(crate) fn refuse_paths_over_gears(
    r: &mut Reading<'_>,
    steps: &[StepCase],
    usual: &Assignment<f64>,
) {
    for (i, step) in steps.iter().enumerate() {
        for task in step.step.tasks() {
            let tool = task.assignment.unwrap_or(*usual).tool;
            if let Some((follower, leader)) = geared(r, &tool).filter(|_| guides_tool(&task.motion))
            {
                let message = format!(
                    "the tool hangs on joint '{follower}' or '{leader}', of which the first follows the \
                     second: no path is planned for it"
                );
                let help =
                    "move the joints, guide a tool before them, or fix them in an [[include]]";
                r.error(at!["phase", i], message, help);
            }
        }
    }
}

/// Whether a motion says where the tool is to be.
fn guides_tool(motion: &Phase<f64, JOINTS>) -> bool {
    match motion {
        Phase::MoveTool { .. } | Phase::UnloadByPosture { .. } => true,
        Phase::MoveJoints { to, .. } => matches!(to, JointTarget::Tool(..)),
        Phase::Hold { what: kept, .. } | Phase::Grip { keep: kept, .. } => *kept == Held::Tool,
    }
}

/// Names of a follower and its leader, one of which carries a frame.
fn geared(r: &Reading<'_>, frame: &Frame<f64>) -> Option<(String, String)> {
    let vehicle = r.vehicle;
    let carries = |j: usize| vehicle.robot.path_to_base(frame.body).any(|on_way| on_way == j);
    let mut geared = vehicle.followers.iter().filter(|f| carries(f.joint) || carries(f.leader));
    let found = geared.next()?;
    let name = |j: usize| vehicle.joint_names.get(j).cloned().unwrap_or_default();
    Some((name(found.joint), name(found.leader)))
}

//! What one arm does in a phase: exactly one motion, and its tool, law and task.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::control::{ArmLawFile, TaskFile, guided_tool, law, task};
use crate::toml::phase::duration;
use crate::toml::phase::grip::{GraspFile, ReleaseFile, bounds};
use crate::toml::phase::hold::{HoldFile, UnloadByPostureFile, held, unload_by_posture};
use crate::toml::phase::move_joints::{MoveJointsFile, move_joints};
use crate::toml::phase::move_tool::{MoveToolFile, move_tool};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_flight::{ArmTask, Assignment, Axes, Grip, Phase};
use wrasse_vehicle::JOINTS;
use wrasse_world::GripOffset;

/// What one arm does beside others: exactly one motion.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ArmFile {
    /// Its tool.
    pub(crate) tool: String,
    /// Which part of the tool's motion counts; that of `[control]` if it is left out.
    pub(crate) task: Option<TaskFile>,
    /// The tool goes on a straight line, turning on the shortest way.
    pub(crate) move_tool: Option<MoveToolFile>,
    /// The arm's joints go to a posture or by so much, starting and ending together.
    pub(crate) move_joints: Option<MoveJointsFile>,
    /// Nothing new is asked for a while.
    pub(crate) hold: Option<HoldFile>,
    /// The tool grasps a free payload.
    pub(crate) grasp: Option<GraspFile>,
    /// The tool lets go of a payload.
    pub(crate) release: Option<ReleaseFile>,
}

/// What an arm is to do, as its table has it.
#[derive(Clone, Copy, Default)]
pub(super) struct TaskTable<'f> {
    pub(super) tool: Option<&'f str>,
    pub(super) task: Option<TaskFile>,
    pub(super) arm_law: Option<ArmLawFile>,
    pub(super) move_tool: Option<&'f MoveToolFile>,
    pub(super) move_joints: Option<&'f MoveJointsFile>,
    pub(super) hold: Option<&'f HoldFile>,
    pub(super) unload_by_posture: Option<&'f UnloadByPostureFile>,
    pub(super) grasp: Option<&'f GraspFile>,
    pub(super) release: Option<&'f ReleaseFile>,
}

impl<'f> TaskTable<'f> {
    /// The task of an arm beside others, by the law of their phase.
    pub(super) fn of_arm(file: &'f ArmFile, arm_law: Option<ArmLawFile>) -> Self {
        Self {
            tool: Some(&file.tool),
            task: file.task,
            arm_law,
            move_tool: file.move_tool.as_ref(),
            move_joints: file.move_joints.as_ref(),
            hold: file.hold.as_ref(),
            unload_by_posture: None,
            grasp: file.grasp.as_ref(),
            release: file.release.as_ref(),
        }
    }

    /// Names of the motions that it has.
    pub(super) fn said(&self) -> Vec<&'static str> {
        let things = [
            (self.move_tool.is_some(), "move_tool"),
            (self.move_joints.is_some(), "move_joints"),
            (self.hold.is_some(), "hold"),
            (self.unload_by_posture.is_some(), "unload_by_posture"),
            (self.grasp.is_some(), "grasp"),
            (self.release.is_some(), "release"),
        ];
        things.iter().filter(|t| t.0).map(|t| t.1).collect()
    }
}

/// What a task reader knows of its phase.
#[derive(Clone, Copy)]
pub(super) struct TaskContext<'a> {
    /// Where the table of the task stands.
    pub(super) above: &'a [Step<'a>],
    /// How to speak of it.
    pub(super) name: &'a str,
    pub(super) payloads: &'a [String],
    pub(super) mission: &'a MissionFile,
    /// Whether something else than the motion ends the phase.
    pub(super) has_until: bool,
}

/// The task of an arm, and what its grasp allows; errors if it does not say exactly one thing.
pub(super) fn arm_task(
    r: &mut Reading<'_>,
    table: &TaskTable<'_>,
    context: &TaskContext<'_>,
) -> Option<(ArmTask<f64, JOINTS>, Option<GripOffset>)> {
    let said = table.said();
    if said.len() != 1 {
        let found = if said.is_empty() { "none".into() } else { said.join(" and ") };
        let name = context.name;
        let message = format!("{name} must say exactly one thing to do, found {found}");
        let help = "one of move_tool, move_joints, hold, unload_by_posture, grasp, release; write a \
                    phase for each";
        r.error(context.above, message, help);
        return None;
    }
    let (motion, grasp_bounds) = motion(r, table, context)?;
    Some((ArmTask { motion, assignment: assignment(r, table, context) }, grasp_bounds))
}

fn motion(
    r: &mut Reading<'_>,
    table: &TaskTable<'_>,
    context: &TaskContext<'_>,
) -> Option<(Phase<f64, JOINTS>, Option<GripOffset>)> {
    let TaskContext { above, mission, .. } = *context;
    let path = |key: &'static str, inner: &'static str| [above, at![key, inner]].concat();
    if let Some(m) = table.move_tool {
        return Some((move_tool(r, above, m, mission)?, None));
    }
    if let Some(m) = table.move_joints {
        let law = table.arm_law.unwrap_or(mission.control.arm_law);
        return Some((move_joints(r, above, m, mission, law)?, None));
    }
    if let Some(hold) = table.hold {
        let time = match hold.duration_s {
            Some(time) => duration(r, &path("hold", "duration_s"), time, mission),
            None if context.has_until => 0.0,
            None => {
                let help = "give duration_s, or end the phase by until";
                r.error(&[above, at!["hold"]].concat(), "a hold without an end".into(), help);
                1.0
            }
        };
        return Some((Phase::Hold { what: held(hold.keep), duration: time }, None));
    }
    if let Some(given) = table.unload_by_posture {
        return Some((unload_by_posture(r, above, given, mission), None));
    }
    if let Some(grasp) = table.grasp {
        let tool = table.tool.or(mission.control.tool.as_deref());
        let bounds = bounds(r, above, grasp, tool);
        let place = path("grasp", "payload");
        let action = Grip::Grasp(r.find(&place, "payload", &grasp.payload, context.payloads)?);
        return Some((Phase::Grip { action, keep: held(grasp.keep) }, Some(bounds)));
    }
    let release = table.release?;
    let place = path("release", "payload");
    let action = Grip::Release(r.find(&place, "payload", &release.payload, context.payloads)?);
    Some((Phase::Grip { action, keep: held(release.keep) }, None))
}

/// Tool, law and task where they are not those of `[control]`.
fn assignment(
    r: &mut Reading<'_>,
    table: &TaskTable<'_>,
    context: &TaskContext<'_>,
) -> Option<Assignment<f64>> {
    if table.tool.is_none() && table.task.is_none() && table.arm_law.is_none() {
        return None;
    }
    let c = &context.mission.control;
    let path = [context.above, at!["tool"]].concat();
    let tool = if let Some(name) = table.tool {
        guided_tool(r, &path, Some(name))
    } else {
        // What is wrong with that of `[control]` is said where it stands.
        let before = r.complaints.len();
        let tool = guided_tool(r, at!["control", "tool"], c.tool.as_deref());
        r.complaints.truncate(before);
        tool
    };
    Some(Assignment {
        tool,
        axes: Axes::Inertial,
        task: task(table.task.unwrap_or(c.task)),
        law: law(table.arm_law.unwrap_or(c.arm_law)),
        damped_below: c.damped_below,
    })
}

//! `[[phase]]`: what happens, until when, and what comes next.

mod geared_tool;
mod grip;
mod hold;
mod move_joints;
mod move_tool;
mod task;
mod until;

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::control::{ArmLawFile, RATES, TaskFile};
use crate::toml::pose::leader;
pub(crate) use geared_tool::refuse_paths_over_gears;
use grip::{GraspFile, ReleaseFile};
use hold::{HoldFile, UnloadByPostureFile};
use move_joints::MoveJointsFile;
use move_tool::MoveToolFile;
use schemars::JsonSchema;
use serde::Deserialize;
use task::{ArmFile, TaskContext, TaskTable, arm_task};
use until::{UntilFile, check_cycles, next, until};
use wrasse_document::{Step as Key, at};
use wrasse_dynamics::BodyId;
use wrasse_flight::{ARMS, ArmTask, JointTarget, LONGEST, Next, Phase, STEPS, Step};
use wrasse_rehearsal::{PayloadCase, StepCase};
use wrasse_vehicle::JOINTS;
use wrasse_world::GripOffset;

/// One phase: a name, and exactly one thing to do for each arm at work.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PhaseFile {
    /// Its name.
    pub(crate) name: String,
    /// The tool goes on a straight line, turning on the shortest way.
    pub(crate) move_tool: Option<MoveToolFile>,
    /// All joints go to a posture or by so much, starting and ending together.
    pub(crate) move_joints: Option<MoveJointsFile>,
    /// Nothing new is asked for a while.
    pub(crate) hold: Option<HoldFile>,
    /// The arm moves so that what pushes at the tool asks the base to store less momentum, without
    /// turning it.
    #[schemars(extend("x-formerly" = ["relieve"]))]
    pub(crate) unload_by_posture: Option<UnloadByPostureFile>,
    /// The tool grasps a free payload.
    pub(crate) grasp: Option<GraspFile>,
    /// The tool lets go of a payload.
    pub(crate) release: Option<ReleaseFile>,
    /// Several arms at once, each with its tool and its motion, in place of one motion.
    #[serde(default)]
    pub(crate) arm: Vec<ArmFile>,
    /// The tool that is guided; that of `[control]` if it is left out.
    pub(crate) tool: Option<String>,
    /// Which part of the tool's motion counts; that of `[control]` if it is left out.
    pub(crate) task: Option<TaskFile>,
    /// What the arm law takes the base for; that of `[control]` if it is left out.
    pub(crate) arm_law: Option<ArmLawFile>,
    /// What ends the phase; the end of its motions if it is left out.
    pub(crate) until: Option<UntilFile>,
    /// The longest that it may take; then it is a fault.
    pub(crate) timeout_s: Option<f64>,
    /// The phase that comes next, or `end`; the next of the file if it is left out.
    pub(crate) then: Option<String>,
    /// The phase that comes after a fault (a timeout, a refused grasp, a motion that cannot begin), or
    /// `end`. Without it a timeout leads to the same as the end, and the others end the mission.
    pub(crate) on_fault: Option<String>,
    /// How often the phase may begin.
    pub(crate) attempts: Option<u32>,
    /// The phase that comes in place of it once its attempts are used up, or `end`; the mission stops
    /// there if it is left out.
    pub(crate) on_exhausted: Option<String>,
}

/// What happens, until when, and what comes next.
pub(crate) fn phases(
    r: &mut Reading<'_>,
    file: &MissionFile,
    payloads: &[PayloadCase],
) -> Vec<StepCase> {
    check_phase_list(r, &file.phase);
    let payloads: Vec<String> = payloads.iter().map(|p| p.name.clone()).collect();
    let names: Vec<String> = file.phase.iter().map(|p| p.name.clone()).collect();
    let phases = file.phase.iter().enumerate();
    let read: Vec<StepCase> =
        phases.filter_map(|(i, p)| phase(r, i, p, (&payloads, &names), file)).collect();
    if read.len() == names.len() {
        check_cycles(r, &read);
    }
    read
}

fn check_phase_list(r: &mut Reading<'_>, phases: &[PhaseFile]) {
    if phases.is_empty() {
        r.error(at!["phase"], "a mission without phases".into(), "add a [[phase]]");
    }
    if phases.len() > STEPS {
        let message = format!("{} phases, at most {STEPS} fit", phases.len());
        r.error(at!["phase", STEPS], message, "split the mission in two");
    }
    for (i, phase) in phases.iter().enumerate() {
        if phases[..i].iter().any(|p| p.name == phase.name) {
            let message = format!("a second phase called {:?}", phase.name);
            r.error(at!["phase", i, "name"], message, "phases are told apart by their names");
        }
    }
}

/// The phase of this number; errors if it does not say exactly one thing for each arm.
fn phase(
    r: &mut Reading<'_>,
    i: usize,
    file: &PhaseFile,
    (payloads, names): (&[String], &[String]),
    mission: &MissionFile,
) -> Option<StepCase> {
    let (tasks, grasp_bounds) = tasks(r, i, file, payloads, mission)?;
    let mut next =
        |key: &str, name: &Option<String>| next(r, at!["phase", i, key], name.as_ref(), names);
    let then = next("then", &file.then).unwrap_or(Next::InOrder);
    let on_fault = next("on_fault", &file.on_fault);
    let on_exhausted = next("on_exhausted", &file.on_exhausted);
    let timeout =
        file.timeout_s.map(|time| duration(r, at!["phase", i, "timeout_s"], time, mission));
    if file.attempts == Some(0) {
        let message = "attempts must be above zero, found 0".into();
        r.error(at!["phase", i, "attempts"], message, "a phase that never begins can be left out");
    }
    if file.on_exhausted.is_some() && file.attempts.is_none() {
        let message = "attempts are never used up: there is no limit to them".into();
        r.error(at!["phase", i, "on_exhausted"], message, "add attempts");
    }
    let until = until(r, i, file, mission);
    let (attempts, name) = (file.attempts, file.name.clone());
    let step = Step { tasks, until, timeout, then, on_fault, attempts, on_exhausted };
    Some(StepCase { name, step, grasp_bounds })
}

/// Tasks of the arms at work.
type Tasks = [Option<ArmTask<f64, JOINTS>>; ARMS];

/// What each arm does, and what a grasp allows.
fn tasks(
    r: &mut Reading<'_>,
    i: usize,
    file: &PhaseFile,
    payloads: &[String],
    mission: &MissionFile,
) -> Option<(Tasks, Option<GripOffset>)> {
    let (name, has_until) = (format!("phase {:?}", file.name), file.until.is_some());
    let above = [Key::Key("phase"), i.into()];
    let context = TaskContext { above: &above, name: &name, payloads, mission, has_until };
    let of_phase = of_phase(file);
    if file.arm.is_empty() {
        let (task, bounds) = arm_task(r, &of_phase, &context)?;
        return Some(([Some(task), None, None], bounds));
    }
    check_arms(r, i, file, &of_phase);
    let (mut tasks, mut grasp_bounds, mut are_whole) = ([None; ARMS], None, true);
    for ((k, arm), place) in file.arm.iter().enumerate().zip(&mut tasks) {
        let above = [Key::Key("phase"), i.into(), Key::Key("arm"), k.into()];
        let table = TaskTable::of_arm(arm, file.arm_law);
        let read = arm_task(r, &table, &TaskContext { above: &above, ..context });
        are_whole &= read.is_some();
        *place = read.map(|(task, _)| task);
        grasp_bounds = grasp_bounds.or(read.and_then(|(_, bounds)| bounds));
    }
    if !are_whole {
        return None;
    }
    check_joints(r, i, &tasks);
    Some((tasks, grasp_bounds))
}

/// The motion that a phase has itself.
fn of_phase(file: &PhaseFile) -> TaskTable<'_> {
    TaskTable {
        tool: file.tool.as_deref(),
        task: file.task,
        arm_law: file.arm_law,
        move_tool: file.move_tool.as_ref(),
        move_joints: file.move_joints.as_ref(),
        hold: file.hold.as_ref(),
        unload_by_posture: file.unload_by_posture.as_ref(),
        grasp: file.grasp.as_ref(),
        release: file.release.as_ref(),
    }
}

/// What is wrong with a list of arms.
fn check_arms(r: &mut Reading<'_>, i: usize, file: &PhaseFile, own: &TaskTable<'_>) {
    if !own.said().is_empty() || file.tool.is_some() || file.task.is_some() {
        let message = format!("phase {:?} has a motion or a tool beside its arms", file.name);
        r.error(at!["phase", i], message, "write it in one of [[phase.arm]]");
    }
    if file.arm.len() > ARMS {
        let message = format!("{} arms at once, at most {ARMS} can work", file.arm.len());
        r.error(at!["phase", i, "arm", ARMS], message, "let one of them wait for another phase");
    }
    let mut grips = 0;
    for (k, arm) in file.arm.iter().enumerate() {
        if file.arm[..k].iter().any(|other| other.tool == arm.tool) {
            let message = format!("{} has two tasks at once", arm.tool);
            r.error(at!["phase", i, "arm", k, "tool"], message, "one task for each tool");
        }
        grips += usize::from(arm.grasp.is_some() || arm.release.is_some());
        if grips > 1 {
            let message = "a second grip in one phase".into();
            r.error(at!["phase", i, "arm", k], message, "one at a time: write a phase for each");
            return;
        }
        let keeps = [
            arm.hold.as_ref().map(|hold| hold.keep),
            arm.grasp.as_ref().map(|grasp| grasp.keep),
            arm.release.as_ref().map(|release| release.keep),
        ];
        if keeps.contains(&Some(hold::KeepFile::Nothing)) {
            let message = "one arm cannot coast while others are driven".into();
            r.error(at!["phase", i, "arm", k], message, "keep its joints or its tool");
        }
    }
}

/// Joints that an arm beside others is sent to, and that do not carry its tool.
fn check_joints(r: &mut Reading<'_>, i: usize, tasks: &Tasks) {
    for (k, task) in tasks.iter().enumerate() {
        let Some(ArmTask { motion: Phase::MoveJoints { to, .. }, assignment: Some(own) }) = task
        else {
            continue;
        };
        let (JointTarget::Positions(to) | JointTarget::By(to)) = to else { continue };
        let carries = carriers(r, own.tool.body);
        // A joint that follows another goes along with it, wherever it is.
        let is_named = |j: usize| to[j].is_some() && leader(r.vehicle, j).is_none();
        let others = r.vehicle.robot.joints().filter(|&j| is_named(j) && !carries[j]);
        for j in others.collect::<Vec<_>>() {
            let name = r.vehicle.joint_names[j].clone();
            let message = format!("joint {name} does not carry the tool of this arm");
            let path = at!["phase", i, "arm", k, "move_joints"];
            let help =
                "name this arm's joints alone, by to_deg or to_m, joints_by_deg or joints_by_m";
            r.error(path, message, help);
        }
    }
}

/// Joints between the base and a body.
fn carriers(r: &Reading<'_>, body: BodyId) -> [bool; JOINTS] {
    let (mut carries, mut at) = ([false; JOINTS], body);
    while let BodyId::Link(j) = at {
        carries[j] = true;
        at = r.vehicle.robot.joint(j).parent;
    }
    carries
}

/// A duration (s) that can be planned.
fn duration(r: &mut Reading<'_>, path: &[Key<'_>], given: f64, mission: &MissionFile) -> f64 {
    // A rate that cannot be is complained of where it stands.
    let (given, rate) = (r.positive(path, given), mission.control.rate_hz.min(RATES.1));
    if given * rate > f64::from(LONGEST) {
        let message =
            format!("{given} s at {rate} control periods per second: no phase is so long");
        let longest = f64::from(LONGEST) / rate;
        r.error(path, message, &format!("at most {longest} s at this control.rate_hz"));
        return 1.0;
    }
    given
}

fn no_timing(
    r: &mut Reading<'_>,
    path: &[Key<'_>],
    duration: Option<f64>,
) -> Option<Phase<f64, JOINTS>> {
    let found = if duration.is_some() { "both" } else { "neither" };
    let message = format!("a move takes either a duration or limits, found {found}");
    r.error(path, message, "give duration_s, or limits = { … }");
    None
}

//! `[[phase]]`: what happens, one after the other.

mod grip;
mod hold;
mod move_joints;
mod move_tool;

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::control::RATES;
use grip::{GraspFile, ReleaseFile, bounds};
use hold::{HoldFile, UnloadByPostureFile, held, unload_by_posture};
use move_joints::{MoveJointsFile, move_joints};
use move_tool::{MoveToolFile, move_tool};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_flight::{Grip, LONGEST, PHASES, Phase};
use wrasse_rehearsal::{PayloadCase, PhaseCase};
use wrasse_vehicle::JOINTS;

/// One phase: a name and exactly one thing to do.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PhaseFile {
    /// Its name.
    pub(crate) name: String,
    /// The tool goes on a straight line, turning on the shortest way.
    pub(crate) move_tool: Option<MoveToolFile>,
    /// All joints go to a posture, starting and ending together.
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
}

/// What happens, one after the other.
pub(crate) fn phases(
    r: &mut Reading<'_>,
    file: &MissionFile,
    payloads: &[PayloadCase],
) -> Vec<PhaseCase> {
    check_phase_list(r, &file.phase);
    let names: Vec<String> = payloads.iter().map(|p| p.name.clone()).collect();
    let phases = file.phase.iter().enumerate();
    phases.filter_map(|(i, p)| phase(r, i, p, &names, file)).collect()
}

fn check_phase_list(r: &mut Reading<'_>, phases: &[PhaseFile]) {
    if phases.is_empty() {
        r.error(at!["phase"], "a mission without phases".into(), "add a [[phase]]");
    }
    if phases.len() > PHASES {
        let message = format!("{} phases, at most {PHASES} fit", phases.len());
        r.error(at!["phase", PHASES], message, "split the mission in two");
    }
    for (i, phase) in phases.iter().enumerate() {
        if phases[..i].iter().any(|p| p.name == phase.name) {
            let message = format!("a second phase called {:?}", phase.name);
            r.error(at!["phase", i, "name"], message, "phases are told apart by their names");
        }
    }
}

/// The phase of this number; errors if it does not say exactly one thing.
pub(crate) fn phase(
    r: &mut Reading<'_>,
    i: usize,
    file: &PhaseFile,
    payloads: &[String],
    mission: &MissionFile,
) -> Option<PhaseCase> {
    let mut grasp_bounds = None;
    let things = [
        (file.move_tool.is_some(), "move_tool"),
        (file.move_joints.is_some(), "move_joints"),
        (file.hold.is_some(), "hold"),
        (file.unload_by_posture.is_some(), "unload_by_posture"),
        (file.grasp.is_some(), "grasp"),
        (file.release.is_some(), "release"),
    ];
    let said: Vec<&str> = things.iter().filter(|t| t.0).map(|t| t.1).collect();
    if said.len() != 1 {
        let found = if said.is_empty() { "none".into() } else { said.join(" and ") };
        let message =
            format!("phase {:?} must say exactly one thing to do, found {found}", file.name);
        let help = "one of move_tool, move_joints, hold, unload_by_posture, grasp, release; write a \
                    phase for each";
        r.error(at!["phase", i], message, help);
        return None;
    }
    let phase = if let Some(m) = &file.move_tool {
        move_tool(r, i, m, mission)?
    } else if let Some(m) = &file.move_joints {
        move_joints(r, i, m, mission)?
    } else if let Some(hold) = &file.hold {
        let path = at!["phase", i, "hold", "duration_s"];
        let duration = duration(r, path, hold.duration_s, mission);
        Phase::Hold { what: held(hold.keep), duration }
    } else if let Some(given) = &file.unload_by_posture {
        unload_by_posture(r, i, given, mission)
    } else if let Some(grasp) = &file.grasp {
        grasp_bounds = Some(bounds(r, i, grasp, mission));
        let path = at!["phase", i, "grasp", "payload"];
        let told = Grip::Grasp(r.find(path, "payload", &grasp.payload, payloads)?);
        Phase::Grip { action: told, keep: held(grasp.keep) }
    } else {
        let release = file.release.as_ref()?;
        let path = at!["phase", i, "release", "payload"];
        let told = Grip::Release(r.find(path, "payload", &release.payload, payloads)?);
        Phase::Grip { action: told, keep: held(release.keep) }
    };
    Some(PhaseCase { name: file.name.clone(), phase, grasp_bounds })
}

/// A duration (s) that can be planned.
fn duration(r: &mut Reading<'_>, path: &[Step<'_>], given: f64, mission: &MissionFile) -> f64 {
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
    path: &[Step<'_>],
    duration: Option<f64>,
) -> Option<Phase<f64, JOINTS>> {
    let found = if duration.is_some() { "both" } else { "neither" };
    let message = format!("a move takes either a duration or limits, found {found}");
    r.error(path, message, "give duration_s, or limits = { … }");
    None
}

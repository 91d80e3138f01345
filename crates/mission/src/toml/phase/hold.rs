//! `hold` and `unload_by_posture`: what stays for a while.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::phase::duration;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::{Step, at};
use wrasse_flight::allocation::ToolTask;
use wrasse_flight::{Held, Phase};
use wrasse_vehicle::JOINTS;

/// What a hold or a grip keeps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum KeepFile {
    /// The joints stand still; joints that move come to rest within a second.
    #[default]
    Joints,
    /// The tool stays on its reference.
    Tool,
    /// Nothing: no actuator acts, the joints move on as they do.
    Nothing,
}

/// A hold.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HoldFile {
    /// For how long; it may be left out where `until` ends the phase.
    pub(crate) duration_s: Option<f64>,
    /// What stays.
    #[serde(default)]
    pub(crate) keep: KeepFile,
}

/// What of the tool must stay while the posture unloads the base.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ToolTaskFile {
    /// Nothing: the force goes along with the tool.
    Nothing,
    /// How it is turned.
    #[default]
    Orientation,
    /// Where it is.
    Position,
    /// Both.
    Pose,
}

/// A posture that unloads the base.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnloadByPostureFile {
    /// For how long.
    pub(crate) duration_s: f64,
    /// What of the tool must stay.
    #[serde(default)]
    pub(crate) keep: ToolTaskFile,
    /// How fast what can be lowered fades.
    #[serde(default = "tenth")]
    pub(crate) gain_per_s: f64,
}

fn tenth() -> f64 {
    0.1
}

pub(super) fn unload_by_posture(
    r: &mut Reading<'_>,
    above: &[Step<'_>],
    file: &UnloadByPostureFile,
    mission: &MissionFile,
) -> Phase<f64, JOINTS> {
    let here = [above, at!["unload_by_posture"]].concat();
    let path = |key| [&here[..], at![key]].concat();
    if !mission.control.measure_tool_wrench {
        let message = "nothing is known of what pushes at the tool".into();
        let help = "set control.measure_tool_wrench = true: a force-torque sensor at the tool";
        r.error(&here, message, help);
    }
    Phase::UnloadByPosture {
        task: match file.keep {
            ToolTaskFile::Nothing => ToolTask::Free,
            ToolTaskFile::Orientation => ToolTask::Orientation,
            ToolTaskFile::Position => ToolTask::Position,
            ToolTaskFile::Pose => ToolTask::Pose,
        },
        gain: r.positive(&path("gain_per_s"), file.gain_per_s),
        duration: duration(r, &path("duration_s"), file.duration_s, mission),
    }
}

pub(super) fn held(file: KeepFile) -> Held {
    match file {
        KeepFile::Joints => Held::Joints,
        KeepFile::Tool => Held::Tool,
        KeepFile::Nothing => Held::Nothing,
    }
}

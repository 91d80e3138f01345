//! `until`, `timeout_s`, `then`, `on_fault`, `attempts`: when a phase ends, and what comes next.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::phase::{PhaseFile, duration};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at, closest};
use wrasse_flight::{Condition, Next, SensedSignal};
use wrasse_rehearsal::{Kind, StepCase, cycle_without_attempts};

/// What ends a phase before or behind its motion: exactly one of these; without any the end of its motion.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UntilFile {
    /// So much time has passed since it began.
    pub(crate) elapsed_s: Option<f64>,
    /// The tools are where their motions end, as the sensors have it.
    pub(crate) reached: Option<ReachedFile>,
    /// A quantity that the flight computer knows is beyond a bound: `"tool.force > 10 N"`.
    pub(crate) signal: Option<String>,
}

/// How near the tools have to be.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReachedFile {
    /// Within this distance.
    pub(crate) distance_mm: f64,
    /// And within this angle.
    pub(crate) angle_deg: f64,
}

/// The quantities that a flight computer knows, what they are measured in, and their names.
const SIGNALS: [(&str, Kind, SensedSignal); 9] = [
    ("tool.position_error", Kind::Length, SensedSignal::ToolPositionError),
    ("tool.attitude_error", Kind::Angle, SensedSignal::ToolAttitudeError),
    ("tool.force", Kind::Force, SensedSignal::ToolForce),
    ("tool.torque", Kind::Torque, SensedSignal::ToolTorque),
    ("base.attitude_error", Kind::Angle, SensedSignal::BaseAttitudeError),
    ("base.turn_speed", Kind::AngularSpeed, SensedSignal::BaseTurnSpeed),
    ("joints.turn_speed", Kind::AngularSpeed, SensedSignal::JointTurnSpeed),
    ("attitude.momentum", Kind::AngularMomentum, SensedSignal::StoredMomentum),
    ("propellant", Kind::Mass, SensedSignal::Propellant),
];

/// What ends the phase of this number.
pub(super) fn until(
    r: &mut Reading<'_>,
    i: usize,
    file: &PhaseFile,
    mission: &MissionFile,
) -> Condition<f64> {
    let Some(until) = &file.until else { return Condition::Done };
    let path = |key| [at!["phase", i, "until"] as &[Step<'_>], at![key]].concat();
    let condition = match (until.elapsed_s, &until.reached, &until.signal) {
        (Some(time), None, None) => {
            Condition::Elapsed(duration(r, &path("elapsed_s"), time, mission))
        }
        (None, Some(near), None) => {
            let path = |key| [&path("reached")[..], at![key]].concat();
            Condition::Reached {
                distance: r.positive(&path("distance_mm"), near.distance_mm) * 1e-3,
                angle: r.positive(&path("angle_deg"), near.angle_deg).to_radians(),
            }
        }
        (None, None, Some(text)) => signal(r, &path("signal"), text, mission),
        _ => {
            let message = "until says exactly one thing".into();
            let help =
                "one of elapsed_s, reached, signal; without until a phase ends with its motion";
            r.error(at!["phase", i, "until"], message, help);
            Condition::Done
        }
    };
    let ends = matches!(condition, Condition::Done | Condition::Elapsed(_));
    if !ends && file.timeout_s.is_none() {
        let message =
            format!("phase {:?} may never end: nothing says that its until comes true", file.name);
        r.error(at!["phase", i, "until"], message, "add timeout_s, the longest that it may take");
    }
    condition
}

/// `QUANTITY > NUMBER UNIT`, or with `<`.
fn signal(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    text: &str,
    mission: &MissionFile,
) -> Condition<f64> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let form = "write it as \"tool.force > 10 N\": a quantity, > or <, a number and its unit";
    let [name, comparison @ (">" | "<"), number, unit] = words[..] else {
        r.error(path, format!("{text:?} is no condition"), form);
        return Condition::Done;
    };
    let Some((_, kind, signal)) = SIGNALS.iter().find(|s| s.0 == name) else {
        let names = SIGNALS.map(|s| s.0);
        let help = match closest(name, names) {
            Some(close) => format!("did you mean {close}?"),
            None => format!("one of {}", names.join(", ")),
        };
        r.error(path, format!("the flight computer knows no quantity called {name}"), &help);
        return Condition::Done;
    };
    let bound = number.parse::<f64>().ok().filter(|x| x.is_finite());
    let Some(bound) = bound else {
        r.error(path, format!("{number} is not a number"), form);
        return Condition::Done;
    };
    let Some(scale) = kind.scale_of(unit) else {
        let message = format!("{unit} does not measure {name}");
        r.error(path, message, &format!("one of {}", kind.units().join(", ")));
        return Condition::Done;
    };
    check_sensor(r, path, name, *signal, mission);
    Condition::Beyond { signal: *signal, above: comparison == ">", bound: bound * scale }
}

/// Whether anything measures a quantity.
fn check_sensor(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    name: &str,
    signal: SensedSignal,
    mission: &MissionFile,
) {
    let at_tool = matches!(signal, SensedSignal::ToolForce | SensedSignal::ToolTorque);
    if at_tool && !mission.control.measure_tool_wrench {
        let message = format!("nothing measures {name}: the condition would never hold");
        let help = "set control.measure_tool_wrench = true: a force-torque sensor at the tool";
        r.error(path, message, help);
    }
}

/// What comes after the phase of this number, by its name.
pub(super) fn next(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    name: Option<&String>,
    names: &[String],
) -> Option<Next> {
    let name = name?;
    if let Some(i) = names.iter().position(|n| n == name) {
        return Some(Next::Step(i));
    }
    if name == "end" {
        return Some(Next::End);
    }
    r.find(path, "phase", name, names).map(Next::Step)
}

/// Phases that could go round for ever.
pub(super) fn check_cycles(r: &mut Reading<'_>, phases: &[StepCase]) {
    let steps: Vec<_> = phases.iter().map(|p| p.step).collect();
    let Some(cycle) = cycle_without_attempts(&steps) else { return };
    let names: Vec<&str> = cycle.iter().map(|&i| phases[i].name.as_str()).collect();
    let message = format!("the phases {} can go round for ever", names.join(", "));
    let help = "give one of them attempts, and on_exhausted if the mission is to go on then; what comes \
                then must lead out of the cycle";
    r.error(at!["phase", cycle[0]], message, help);
}

//! Laws and world as they are flown: each setting with its value, and whence it is.

use crate::toml::MissionFile;
use serde_json::Value;
use wrasse_document::{Document, Step};
use wrasse_flight::{ArmLaw, Task};
use wrasse_rehearsal::AttitudeActuation;
use wrasse_rehearsal::figures::rounded;
use wrasse_rehearsal::{Case, Setting};
use wrasse_world::{BaseAttitude, Environment, SloshPendulum, Stepper};

/// What was flown, in the order of the format; settings that nothing reads are left out.
pub(crate) fn as_flown(document: &Document, file: &MissionFile, case: &Case) -> Vec<Setting> {
    let mut settings = vec![];
    for (table, value) in [
        ("world", serde_json::to_value(&file.world)),
        ("control", serde_json::to_value(&file.control)),
    ] {
        // The structs hold numbers, words and tables with words for keys.
        add(&mut settings, document, table.into(), &value.unwrap_or_default());
    }
    settings.retain(|setting| is_read(case, &setting.key));
    for setting in &mut settings {
        if let Some(value) = decided(case, &setting.key) {
            setting.value = value;
        }
        let is_first = setting.key == "control.tool" && !case.vehicle.tools.is_empty();
        if is_first && setting.origin == "default" {
            setting.origin = "default: the vehicle's first tool";
        }
    }
    settings.extend(slosh_setting(case));
    settings.extend(arm_settings(case));
    settings.extend(grasp_settings(case));
    settings
}

/// A value and all below it.
fn add(settings: &mut Vec<Setting>, document: &Document, key: String, value: &Value) {
    if let Value::Object(table) = value {
        for (name, value) in table {
            add(settings, document, format!("{key}.{name}"), value);
        }
        return;
    }
    let value = match value {
        Value::Null => "none".into(),
        Value::String(word) => word.clone(),
        Value::Array(items) if items.is_empty() => "none".into(),
        Value::Array(items) if items.iter().any(Value::is_object) => items.len().to_string(),
        other => other.to_string(),
    };
    let origin = origin(document, &key);
    settings.push(Setting { key, value, origin });
}

fn origin(document: &Document, key: &str) -> &'static str {
    let path: Vec<Step<'_>> = key.split('.').map(Step::Key).collect();
    match path.split_last() {
        Some((Step::Key(last), above)) if document.keys(above).contains(last) => {
            if document.is_set(&path) { "--set" } else { "mission file" }
        }
        _ => "default",
    }
}

/// Whether a flight of this case reads a setting.
fn is_read(case: &Case, key: &str) -> bool {
    let is_controlled = case.base == BaseAttitude::Controlled;
    let is_fitted = is_controlled && case.actuation == AttitudeActuation::Fitted;
    let has = |group: &str| {
        let actuators = &case.equipment.actuators;
        is_fitted
            && match group {
                "wheels" | "wheel_null_gain_per_s" => !actuators.wheels.is_empty(),
                "cmgs" | "cmg_null_gain_rad_s" | "preferred_for" => !actuators.cmgs.is_empty(),
                "modulation" => !actuators.thrusters.is_empty(),
                _ => true,
            }
    };
    let drives = case.torque.iter().any(|torque| *torque);
    match key.split('.').collect::<Vec<_>>()[..] {
        ["control", "steering", group, ..] => has(group),
        ["control", "estimation", "joint_bandwidth_rad_s"] => {
            case.sensors.is_some_and(|s| s.encoder_step > 0.0)
        }
        ["control", "estimation", _] => case.sensors.is_some_and(|s| s.attitude.is_some()),
        ["control", "feedforward" | "attitude_bandwidth_rad_s" | "attitude_damping_ratio"]
        | ["control", "position_hold", ..] => is_controlled,
        ["control", "joint_bandwidth_rad_s" | "joint_damping_ratio"] => drives,
        ["world", "step_s"] => matches!(case.stepper, Stepper::Fixed { .. }),
        ["world", "adaptive_tolerance"] => matches!(case.stepper, Stepper::Adaptive { .. }),
        _ => true,
    }
}

/// What a setting came to that depends on others.
fn decided(case: &Case, key: &str) -> Option<String> {
    let vehicle = &case.vehicle;
    Some(match key {
        "world.step_s" => match case.stepper {
            Stepper::Fixed { step } => rounded(step.min(case.period())).to_string(),
            Stepper::Adaptive { .. } => return None,
        },
        "world.gravity_m_s2" if case.environment == Environment::FreeSpace => {
            "none: free space".into()
        }
        "control.actuators" => match (case.base, case.actuation) {
            (BaseAttitude::Free, _) => "none: the base floats".into(),
            (BaseAttitude::Held, _) => "none: the base is held from outside".into(),
            (BaseAttitude::Controlled, AttitudeActuation::Fitted) => "fitted".into(),
            (BaseAttitude::Controlled, AttitudeActuation::Ideal(None)) => "unlimited".into(),
            (BaseAttitude::Controlled, AttitudeActuation::Ideal(Some(limits))) => {
                format!("ideal, {} N·m, {} N·m·s", limits.torque_limit, limits.momentum_limit)
            }
        },
        "control.sensing" => if case.sensors.is_some() { "fitted" } else { "perfect" }.into(),
        "control.tool" => {
            let has_tool = !vehicle.tools.is_empty() || vehicle.robot.joint_count() > 0;
            let tool = case.frame_name(&case.setup.assignment.tool);
            if has_tool { tool.to_owned() } else { return None }
        }
        "control.redundancy" if case.setup.joints.gain == 0.0 => {
            "none: joint rates of least norm".into()
        }
        _ => return None,
    })
}

/// Tools, tasks and laws of phases that have their own.
fn arm_settings(case: &Case) -> Vec<Setting> {
    let mut settings = vec![];
    for phase in &case.phases {
        for assignment in phase.step.tasks().filter_map(|task| task.assignment) {
            let task = match assignment.task {
                Task::Pose => "pose",
                Task::Position => "position",
            };
            let law = match assignment.law {
                ArmLaw::Terrestrial => "terrestrial",
                ArmLaw::AttitudeHeld => "attitude-held",
                ArmLaw::FreeFloating => "free-floating",
            };
            let tool = case.frame_name(&assignment.tool);
            let key = format!("phase {}: tool, task and law", phase.name);
            settings.push(Setting {
                key,
                value: format!("{tool}, {task}, {law}"),
                origin: "tool and phase",
            });
        }
    }
    settings
}

/// The pendulum by which the propellant swings at the start.
fn slosh_setting(case: &Case) -> Option<Setting> {
    let (slosh, tank) = (case.equipment.slosh?, case.equipment.actuators.tank?);
    let value = match SloshPendulum::of(&slosh, tank.propellant) {
        Some(pendulum) => format!(
            "{} of {} kg on {} m",
            rounded(pendulum.mass),
            rounded(tank.propellant),
            rounded(pendulum.length)
        ),
        None => "none: it does not swing".into(),
    };
    Some(Setting { key: "actuators.tank.slosh".into(), value, origin: "tank and fill level" })
}

/// The bounds of each grasp.
fn grasp_settings(case: &Case) -> Vec<Setting> {
    let mut settings = vec![];
    for (phase, bounds) in case.phases.iter().filter_map(|p| Some((p, p.grasp_bounds?))) {
        let value = format!(
            "{} mm, {} deg, {} mm/s, {} deg/s",
            rounded(bounds.distance * 1e3),
            rounded(bounds.angle.to_degrees()),
            rounded(bounds.linear_speed * 1e3),
            rounded(bounds.angular_speed.to_degrees())
        );
        let key = format!("phase {}: grasp bounds", phase.name);
        settings.push(Setting { key, value, origin: "tool and phase" });
    }
    settings
}

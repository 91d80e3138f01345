//! Reaction wheels of a file.

use crate::equipment_format::{WheelFile, WheelNumbers};
use crate::figures::figures;
use crate::hardware_catalogue::ModelsUsed;
use crate::mounted_unit::{Mounted, direction};
use crate::toml_reading::{Reading, under};
use crate::unit_numbers::check_there;
use wrasse_document::Step;
use wrasse_hardware::ReactionWheel;

/// One turn in a minute (rad/s).
const RPM: f64 = core::f64::consts::TAU / 60.0;
/// How far numbers of a unit that follow from each other may differ (–): they are rounded.
pub(crate) const ROUNDED: f64 = 0.02;

/// A wheel; `None` after a complaint if it is not one.
pub(crate) fn wheel(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &WheelFile,
) -> Option<Mounted<ReactionWheel<f64>>> {
    let of = format!("wheel '{}'", file.name);
    let axis = direction(reading, path, &of, "axis", file.axis);
    let numbers = models.numbers(reading, path, &of, file.model.as_deref(), file.numbers)?;
    let (inertia, speed_limit) = rotor(reading, path, &of, &numbers);
    let due = [
        ("torque_limit_nm", numbers.torque_limit_nm),
        ("speed_limit_rpm", speed_limit),
        ("inertia_kgm2", inertia),
    ];
    check_there(reading, path, &of, &due);
    let unit = ReactionWheel {
        axis_B: axis?,
        inertia: inertia?,
        torque_limit: numbers.torque_limit_nm?,
        speed_limit: speed_limit?,
        coulomb: numbers.coulomb_friction_nm.unwrap_or(0.0),
        viscous: numbers.viscous_friction_nms.unwrap_or(0.0),
        torque_step: numbers.torque_step_nm.unwrap_or(0.0),
    };
    check_motion(reading, path, &of, &unit, file);
    Some(Mounted {
        name: file.name.clone(),
        at: reading.below(path, "name"),
        label: file.model.clone().unwrap_or("wheel".into()),
        unit,
        start: file.speed_rpm.unwrap_or(0.0) * RPM,
        mass: numbers.mass_kg,
        power: numbers.power_w,
    })
}

/// Inertia (kg·m²) and largest speed (rad/s): each follows from the other and the momentum.
fn rotor(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &WheelNumbers,
) -> (Option<f64>, Option<f64>) {
    let speed = numbers.speed_limit_rpm.map(|rpm| rpm * RPM);
    match (numbers.inertia_kgm2, numbers.momentum_nms, speed) {
        (Some(inertia), Some(momentum), Some(speed)) => {
            if (inertia * speed - momentum).abs() > ROUNDED * momentum {
                let message = format!(
                    "{of}: {} kg·m² at {} rpm are {} N·m·s, and `momentum_nms` says {momentum}",
                    figures(inertia),
                    figures(speed / RPM),
                    figures(inertia * speed)
                );
                let help = "leave out one of `inertia_kgm2`, `momentum_nms`, `speed_limit_rpm`: it \
                            follows from the others";
                reading.error(&under(path, "momentum_nms"), message, "this momentum", help);
            }
            (Some(inertia), Some(speed))
        }
        (Some(inertia), Some(momentum), None) => (Some(inertia), Some(momentum / inertia)),
        (None, Some(momentum), Some(speed)) => (Some(momentum / speed), Some(speed)),
        (inertia, _, speed) => (inertia, speed),
    }
}

/// Complains of a wheel that friction holds, or that starts faster than it can turn.
fn check_motion(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    wheel: &ReactionWheel<f64>,
    file: &WheelFile,
) {
    if wheel.coulomb >= wheel.torque_limit {
        let message = format!(
            "{of} never turns: its Coulomb friction of {} N·m holds against its motor's {} N·m",
            figures(wheel.coulomb),
            figures(wheel.torque_limit)
        );
        let help = "friction of a bearing is a few thousandths of the motor's torque";
        reading.error(&under(path, "coulomb_friction_nm"), message, "this friction", help);
    }
    if wheel.torque_step > wheel.torque_limit {
        let message = format!(
            "{of} cannot be told anything: its torque comes in steps of {} N·m, its motor gives {}",
            figures(wheel.torque_step),
            figures(wheel.torque_limit)
        );
        reading.error(&under(path, "torque_step_nm"), message, "this step", "");
    }
    if let Some(rpm) = file.speed_rpm.filter(|rpm| rpm.abs() * RPM > wheel.speed_limit) {
        let message = format!(
            "{of} starts at {rpm} rpm, beyond its {} rpm",
            figures(wheel.speed_limit / RPM)
        );
        reading.error(&under(path, "speed_rpm"), message, "too fast", "");
    }
}

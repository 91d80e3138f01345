//! The tables `[[actuators.wheel]]`: reaction wheels.

use super::catalogue::ModelsUsed;
use super::numbers::{ROUNDED, WheelNumbers, check_there};
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile, direction};
use crate::figures::figures;
use crate::table::{ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::ReactionWheel;
use wrasse_spatial::Vec3;

/// A reaction wheel: of a model of the catalogue, or by its own numbers, or a model with some numbers
/// replaced.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A reaction wheel of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Direction of the spin axis, base axes (–); any length.
    pub(crate) axis: [f64; 3],
    /// Speed at the start (rpm); zero if not given.
    pub(crate) speed_rpm: Option<f64>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: WheelNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// One turn in a minute (rad/s).
pub(crate) const RPM: f64 = core::f64::consts::TAU / 60.0;

impl UnitFile for WheelFile {
    const KEY: &'static str = "wheel";
    type Unit = ReactionWheel<f64>;
    fn head(&self) -> Head<'_> {
        let model = self.model.as_deref();
        Head { name: &self.name, model, provenance: &self.provenance }
    }
    fn read(
        &self,
        reading: &mut Reading<'_>,
        models: &mut ModelsUsed,
        path: &[Step<'_>],
    ) -> Option<Vec<MountedUnit<Self::Unit>>> {
        let of = format!("wheel '{}'", self.name);
        let axis = direction(reading, path, &of, "axis", self.axis);
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let unit = ReactionWheel { axis_B: axis?, ..wheel(reading, path, &of, &numbers)? };
        let speed = self.speed_rpm.unwrap_or(0.0);
        check_speed(reading, path, &of, &unit, speed);
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "wheel", mass_power);
        Some(vec![MountedUnit { unit, start: speed * RPM, entry }])
    }
}

/// What a wheel can do, its axis left open; complains of what is missing or cannot be.
pub(crate) fn wheel(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &WheelNumbers,
) -> Option<ReactionWheel<f64>> {
    let (inertia, speed_limit) = rotor(reading, path, of, numbers);
    let due = [
        ("torque_limit_nm", numbers.torque_limit_nm),
        ("speed_limit_rpm", speed_limit),
        ("inertia_kgm2", inertia),
    ];
    check_there(reading, path, of, &due);
    let wheel = ReactionWheel {
        axis_B: Vec3::zero(),
        inertia: inertia?,
        torque_limit: numbers.torque_limit_nm?,
        speed_limit: speed_limit?,
        coulomb: numbers.coulomb_friction_nm.unwrap_or(0.0),
        viscous: numbers.viscous_friction_nms.unwrap_or(0.0),
        torque_step: numbers.torque_step_nm.unwrap_or(0.0),
    };
    check_motor(reading, path, of, &wheel);
    Some(wheel)
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

/// Complains of a wheel that friction holds, or whose motor cannot be told anything.
fn check_motor(reading: &mut Reading<'_>, path: &[Step<'_>], of: &str, wheel: &ReactionWheel<f64>) {
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
}

/// Complains of a wheel that starts faster than it can turn.
pub(crate) fn check_speed(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    wheel: &ReactionWheel<f64>,
    rpm: f64,
) {
    if rpm.abs() * RPM > wheel.speed_limit {
        let most = figures(wheel.speed_limit / RPM);
        let message = format!("{of} starts at {rpm} rpm, beyond its {most} rpm");
        reading.error(&under(path, "speed_rpm"), message, "too fast", "");
    }
}

//! The numbers of a unit, kind by kind: their keys, what each may be, and what is believed of it.

use crate::figures::figures;
use crate::table::{Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;

/// How far numbers of a unit that follow from each other may differ (–): they are rounded.
pub(crate) const ROUNDED: f64 = 0.02;

/// One number of a unit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Figure {
    /// Its key.
    pub(crate) key: &'static str,
    /// Its value, if it is given, in the unit of the key.
    pub(crate) value: Option<f64>,
    believed: Believed,
}

/// From where to where a number is believed, and whether it may be zero.
#[derive(Debug, Clone, Copy)]
struct Believed {
    least: f64,
    most: f64,
    zero: bool,
}

const fn positive(least: f64, most: f64) -> Believed {
    Believed { least, most, zero: false }
}

const fn not_negative(most: f64) -> Believed {
    Believed { least: 0.0, most, zero: true }
}

impl Figure {
    /// A number that must be positive, and is believed from one to another.
    pub(crate) const fn positive(key: &'static str, value: f64, (least, most): (f64, f64)) -> Self {
        Self { key, value: Some(value), believed: positive(least, most) }
    }
    /// A number that must be zero or more, and is believed up to another.
    pub(crate) const fn not_negative(key: &'static str, value: f64, most: f64) -> Self {
        Self { key, value: Some(value), believed: not_negative(most) }
    }
}

/// The numbers of one kind of unit.
pub(crate) trait Numbers: Copy {
    /// What a unit of this kind is called.
    const KIND: &'static str;
    /// These, and where one is not given, that of the model.
    fn or(self, model: Self) -> Self;
    /// Each with what is believed of it.
    fn figures(&self) -> Vec<Figure>;
}

/// A kind of unit: a key, its description for editors, and the range for each of its numbers. The
/// ranges hold every unit known to have flown, with room to spare.
macro_rules! unit_numbers {
    ($(#[$doc:meta])* $name:ident, $kind:literal:
     $($(#[$of_key:meta])* $key:ident: $believed:expr,)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
        pub(crate) struct $name {
            $($(#[$of_key])* pub(crate) $key: Option<f64>,)*
        }
        impl Numbers for $name {
            const KIND: &'static str = $kind;
            fn or(self, model: Self) -> Self {
                Self { $($key: self.$key.or(model.$key),)* }
            }
            fn figures(&self) -> Vec<Figure> {
                vec![$(Figure { key: stringify!($key), value: self.$key, believed: $believed },)*]
            }
        }
    };
}

unit_numbers! {
    /// What a reaction wheel can do.
    WheelNumbers, "reaction wheel":
    /// Largest torque of the motor (N·m).
    torque_limit_nm: positive(1e-5, 10.0),
    /// Largest speed (rpm).
    speed_limit_rpm: positive(10.0, 20_000.0),
    /// Inertia about the spin axis (kg·m²); follows from momentum and speed.
    inertia_kgm2: positive(1e-8, 10.0),
    /// Momentum at the largest speed (N·m·s); follows from inertia and speed.
    momentum_nms: positive(1e-4, 2000.0),
    /// Coulomb friction of the bearing (N·m); none if not given.
    coulomb_friction_nm: not_negative(0.1),
    /// Viscous friction of the bearing (N·m for each rad/s); none if not given.
    viscous_friction_nms: not_negative(0.01),
    /// Torque commands are rounded to multiples of this (N·m); not rounded if not given.
    torque_step_nm: not_negative(0.1),
    /// Mass (kg), part of the base's; for tables.
    mass_kg: positive(0.01, 500.0),
    /// Electric power (W); for tables.
    power_w: not_negative(5000.0),
}

unit_numbers! {
    /// What a control moment gyro can do.
    CmgNumbers, "control moment gyro":
    /// Momentum of the rotor (N·m·s).
    momentum_nms: positive(1e-3, 20_000.0),
    /// Largest gimbal rate (deg/s); follows from torque and momentum.
    gimbal_rate_limit_deg_s: positive(0.1, 1000.0),
    /// Largest torque on the base (N·m): momentum times largest gimbal rate.
    torque_limit_nm: positive(1e-4, 10_000.0),
    /// Largest gimbal acceleration (deg/s²).
    gimbal_acceleration_limit_deg_s2: positive(0.1, 1e5),
    /// Inertia of gimbal and rotor about the gimbal axis (kg·m²).
    gimbal_inertia_kgm2: positive(1e-7, 100.0),
    /// Largest torque of the gimbal motor (N·m).
    motor_torque_limit_nm: positive(1e-5, 1000.0),
    /// Bandwidth of the servo that holds the gimbal's rate (rad/s).
    servo_bandwidth_rad_s: positive(0.1, 1e4),
    /// Mass (kg), part of the base's; for tables.
    mass_kg: positive(0.01, 1000.0),
    /// Electric power (W); for tables.
    power_w: not_negative(5000.0),
}

unit_numbers! {
    /// What a thruster can do.
    ThrusterNumbers, "thruster":
    /// Force when fully open (N).
    force_n: positive(1e-6, 5000.0),
    /// Specific impulse (s).
    specific_impulse_s: positive(20.0, 10_000.0),
    /// Shortest time that it can be open (s); zero if not given.
    minimum_on_time_s: not_negative(1.0),
    /// Time from shut to full force (s); zero if not given.
    rise_time_s: not_negative(1.0),
    /// Time from full force to none (s); zero if not given.
    fall_time_s: not_negative(1.0),
    /// Standard deviation of the impulse of a pulse (% of it); zero if not given.
    impulse_noise_percent: not_negative(30.0),
    /// Mass (kg), part of the base's; for tables.
    mass_kg: positive(0.001, 200.0),
    /// Electric power while it is open (W); for tables.
    power_w: not_negative(1e5),
}

unit_numbers! {
    /// How well a rate gyro feels.
    RateGyroNumbers, "rate gyro":
    /// Random walk of the angle (deg/√h).
    angle_random_walk_deg_sqrt_h: not_negative(10.0),
    /// Random walk of the bias (deg/h for each √h).
    bias_random_walk_deg_h_sqrt_h: not_negative(100.0),
    /// Rates are rounded to multiples of this (deg/s); not rounded if not given.
    rate_step_deg_s: not_negative(1.0),
}

unit_numbers! {
    /// How well a star tracker sees.
    StarTrackerNumbers, "star tracker":
    /// Standard deviation about each axis across the boresight (arcsec).
    noise_across_arcsec: not_negative(3600.0),
    /// Standard deviation about the boresight (arcsec).
    noise_about_arcsec: not_negative(3600.0),
    /// Readings in a second (Hz).
    rate_hz: positive(0.01, 1000.0),
    /// Age of a reading when it arrives (s); zero if not given.
    latency_s: not_negative(10.0),
    /// Rate of the base above which it sees nothing (deg/s).
    rate_limit_deg_s: positive(0.01, 360.0),
}

/// Complains of numbers of the unit `of` that cannot be, and doubts those that hardly any unit has;
/// whether all can be.
pub(crate) fn check_figures(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &[Figure],
) -> bool {
    let mut possible = true;
    for figure in numbers {
        let Believed { least, most, zero } = figure.believed;
        let Some(found) = figure.value else { continue };
        let key = figure.key;
        let place = under(path, key);
        if found < 0.0 || (found == 0.0 && !zero) {
            let wanted = if zero { "zero or more" } else { "positive" };
            let message = format!("`{key}` of {of} must be {wanted}, found {found}");
            reading.error(&place, message, "this number", "");
            possible = false;
        } else if found < least || found > most {
            let message = format!(
                "`{key}` of {of} is {found}: units that are known have {} to {}",
                figures(least),
                figures(most)
            );
            reading.warning(&place, message, "this number", "is it in the unit of its key?");
        }
    }
    possible
}

/// Complains, once, of the numbers of the unit `of` that are due and missing.
pub(crate) fn check_there(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    due: &[(&str, Option<f64>)],
) {
    let missing: Vec<_> =
        due.iter().filter(|(_, v)| v.is_none()).map(|(key, _)| format!("`{key}`")).collect();
    if missing.is_empty() {
        return;
    }
    let message = format!("{of} has no {}", missing.join(", no "));
    let help = "write each beside the unit, or name a `model` of the hardware catalogue: `wrasse \
                hardware` lists them";
    // At its name, or for a sensor, which has none, at its table.
    reading.error(&under(path, "name"), message, "numbers are missing", help);
}

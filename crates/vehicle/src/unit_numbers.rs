//! Numbers of a unit: what each may be, what is believed of it, and how a file's own replace those of
//! the model that it names.

use crate::equipment_format::{CmgNumbers, ThrusterNumbers, WheelNumbers};
use crate::figures::figures;
use crate::sensor_format::{RateGyroNumbers, StarTrackerNumbers};
use crate::toml_reading::{Reading, under};
use wrasse_document::Step;

/// One number of a unit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Figure {
    /// Its key.
    pub(crate) key: &'static str,
    /// Its value, if it is given, in the unit of the key.
    pub(crate) value: Option<f64>,
    /// Whether it may be zero.
    zero: bool,
    /// From where to where it is believed.
    believed: (f64, f64),
}

fn positive(key: &'static str, value: Option<f64>, least: f64, most: f64) -> Figure {
    Figure { key, value, zero: false, believed: (least, most) }
}

fn not_negative(key: &'static str, value: Option<f64>, most: f64) -> Figure {
    Figure { key, value, zero: true, believed: (0.0, most) }
}

/// The numbers of one kind of unit.
pub(crate) trait Numbers: Copy {
    /// What a unit of this kind is called.
    const KIND: &'static str;
    /// These, and where one is not given, that of the model.
    fn over(self, model: Self) -> Self;
    /// Each with what it may be. The ranges hold every unit known to have flown, with room to spare.
    fn figures(&self) -> Vec<Figure>;
}

impl Numbers for WheelNumbers {
    const KIND: &'static str = "reaction wheel";
    fn over(self, model: Self) -> Self {
        // One follows from the other: the model's must not contradict the file's own.
        let own = self.inertia_kgm2.is_some() || self.momentum_nms.is_some();
        let model_inertia = model.inertia_kgm2.filter(|_| !own);
        let model_momentum = model.momentum_nms.filter(|_| !own);
        // Inertia and momentum that are both the file's own say the speed.
        let both = self.inertia_kgm2.is_some() && self.momentum_nms.is_some();
        Self {
            torque_limit_nm: self.torque_limit_nm.or(model.torque_limit_nm),
            speed_limit_rpm: self.speed_limit_rpm.or(model.speed_limit_rpm.filter(|_| !both)),
            inertia_kgm2: self.inertia_kgm2.or(model_inertia),
            momentum_nms: self.momentum_nms.or(model_momentum),
            coulomb_friction_nm: self.coulomb_friction_nm.or(model.coulomb_friction_nm),
            viscous_friction_nms: self.viscous_friction_nms.or(model.viscous_friction_nms),
            torque_step_nm: self.torque_step_nm.or(model.torque_step_nm),
            mass_kg: self.mass_kg.or(model.mass_kg),
            power_w: self.power_w.or(model.power_w),
        }
    }
    fn figures(&self) -> Vec<Figure> {
        vec![
            positive("torque_limit_nm", self.torque_limit_nm, 1e-5, 10.0),
            positive("speed_limit_rpm", self.speed_limit_rpm, 10.0, 20_000.0),
            positive("inertia_kgm2", self.inertia_kgm2, 1e-8, 10.0),
            positive("momentum_nms", self.momentum_nms, 1e-4, 2000.0),
            not_negative("coulomb_friction_nm", self.coulomb_friction_nm, 0.1),
            not_negative("viscous_friction_nms", self.viscous_friction_nms, 0.01),
            not_negative("torque_step_nm", self.torque_step_nm, 0.1),
            positive("mass_kg", self.mass_kg, 0.01, 500.0),
            not_negative("power_w", self.power_w, 5000.0),
        ]
    }
}

impl Numbers for CmgNumbers {
    const KIND: &'static str = "control moment gyro";
    fn over(self, model: Self) -> Self {
        let own = self.gimbal_rate_limit_deg_s.is_some() || self.torque_limit_nm.is_some();
        let model_rate = model.gimbal_rate_limit_deg_s.filter(|_| !own);
        let model_torque = model.torque_limit_nm.filter(|_| !own);
        let model_acceleration = model.gimbal_acceleration_limit_deg_s2;
        Self {
            momentum_nms: self.momentum_nms.or(model.momentum_nms),
            gimbal_rate_limit_deg_s: self.gimbal_rate_limit_deg_s.or(model_rate),
            torque_limit_nm: self.torque_limit_nm.or(model_torque),
            gimbal_acceleration_limit_deg_s2: self
                .gimbal_acceleration_limit_deg_s2
                .or(model_acceleration),
            gimbal_inertia_kgm2: self.gimbal_inertia_kgm2.or(model.gimbal_inertia_kgm2),
            motor_torque_limit_nm: self.motor_torque_limit_nm.or(model.motor_torque_limit_nm),
            servo_bandwidth_rad_s: self.servo_bandwidth_rad_s.or(model.servo_bandwidth_rad_s),
            mass_kg: self.mass_kg.or(model.mass_kg),
            power_w: self.power_w.or(model.power_w),
        }
    }
    fn figures(&self) -> Vec<Figure> {
        let acceleration = self.gimbal_acceleration_limit_deg_s2;
        vec![
            positive("momentum_nms", self.momentum_nms, 1e-3, 20_000.0),
            positive("gimbal_rate_limit_deg_s", self.gimbal_rate_limit_deg_s, 0.1, 1000.0),
            positive("torque_limit_nm", self.torque_limit_nm, 1e-4, 10_000.0),
            positive("gimbal_acceleration_limit_deg_s2", acceleration, 0.1, 1e5),
            positive("gimbal_inertia_kgm2", self.gimbal_inertia_kgm2, 1e-7, 100.0),
            positive("motor_torque_limit_nm", self.motor_torque_limit_nm, 1e-5, 1000.0),
            positive("servo_bandwidth_rad_s", self.servo_bandwidth_rad_s, 0.1, 1e4),
            positive("mass_kg", self.mass_kg, 0.01, 1000.0),
            not_negative("power_w", self.power_w, 5000.0),
        ]
    }
}

impl Numbers for ThrusterNumbers {
    const KIND: &'static str = "thruster";
    fn over(self, model: Self) -> Self {
        Self {
            force_n: self.force_n.or(model.force_n),
            specific_impulse_s: self.specific_impulse_s.or(model.specific_impulse_s),
            minimum_on_time_s: self.minimum_on_time_s.or(model.minimum_on_time_s),
            rise_time_s: self.rise_time_s.or(model.rise_time_s),
            fall_time_s: self.fall_time_s.or(model.fall_time_s),
            impulse_noise_percent: self.impulse_noise_percent.or(model.impulse_noise_percent),
            mass_kg: self.mass_kg.or(model.mass_kg),
            power_w: self.power_w.or(model.power_w),
        }
    }
    fn figures(&self) -> Vec<Figure> {
        vec![
            positive("force_n", self.force_n, 1e-6, 5000.0),
            positive("specific_impulse_s", self.specific_impulse_s, 20.0, 10_000.0),
            not_negative("minimum_on_time_s", self.minimum_on_time_s, 1.0),
            not_negative("rise_time_s", self.rise_time_s, 1.0),
            not_negative("fall_time_s", self.fall_time_s, 1.0),
            not_negative("impulse_noise_percent", self.impulse_noise_percent, 30.0),
            positive("mass_kg", self.mass_kg, 0.001, 200.0),
            not_negative("power_w", self.power_w, 1e5),
        ]
    }
}

impl Numbers for RateGyroNumbers {
    const KIND: &'static str = "rate gyro";
    fn over(self, model: Self) -> Self {
        let model_walk = model.bias_random_walk_deg_h_sqrt_h;
        Self {
            angle_random_walk_deg_sqrt_h: self
                .angle_random_walk_deg_sqrt_h
                .or(model.angle_random_walk_deg_sqrt_h),
            bias_random_walk_deg_h_sqrt_h: self.bias_random_walk_deg_h_sqrt_h.or(model_walk),
            rate_step_deg_s: self.rate_step_deg_s.or(model.rate_step_deg_s),
        }
    }
    fn figures(&self) -> Vec<Figure> {
        let walk = self.angle_random_walk_deg_sqrt_h;
        vec![
            not_negative("angle_random_walk_deg_sqrt_h", walk, 10.0),
            not_negative(
                "bias_random_walk_deg_h_sqrt_h",
                self.bias_random_walk_deg_h_sqrt_h,
                100.0,
            ),
            not_negative("rate_step_deg_s", self.rate_step_deg_s, 1.0),
        ]
    }
}

impl Numbers for StarTrackerNumbers {
    const KIND: &'static str = "star tracker";
    fn over(self, model: Self) -> Self {
        Self {
            noise_across_arcsec: self.noise_across_arcsec.or(model.noise_across_arcsec),
            noise_about_arcsec: self.noise_about_arcsec.or(model.noise_about_arcsec),
            rate_hz: self.rate_hz.or(model.rate_hz),
            latency_s: self.latency_s.or(model.latency_s),
            rate_limit_deg_s: self.rate_limit_deg_s.or(model.rate_limit_deg_s),
        }
    }
    fn figures(&self) -> Vec<Figure> {
        vec![
            not_negative("noise_across_arcsec", self.noise_across_arcsec, 3600.0),
            not_negative("noise_about_arcsec", self.noise_about_arcsec, 3600.0),
            positive("rate_hz", self.rate_hz, 0.01, 1000.0),
            not_negative("latency_s", self.latency_s, 10.0),
            positive("rate_limit_deg_s", self.rate_limit_deg_s, 0.01, 360.0),
        ]
    }
}

/// Complains of numbers of the unit `of` that cannot be, and doubts those that hardly any unit has.
pub(crate) fn check_figures(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &[Figure],
) {
    for figure in numbers {
        let (key, (least, most)) = (figure.key, figure.believed);
        let Some(found) = figure.value else { continue };
        let place = under(path, key);
        if found < 0.0 || (found == 0.0 && !figure.zero) {
            let wanted = if figure.zero { "zero or more" } else { "positive" };
            let message = format!("`{key}` of {of} must be {wanted}, found {found}");
            reading.error(&place, message, "this number", "");
        } else if found < least || found > most {
            let message = format!(
                "`{key}` of {of} is {found}: units that are known have {} to {}",
                figures(least),
                figures(most)
            );
            reading.warning(&place, message, "this number", "is it in the unit of its key?");
        }
    }
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

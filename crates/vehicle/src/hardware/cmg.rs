//! The tables `[[actuators.cmg]]`: single-gimbal control moment gyros.

use super::catalogue::ModelsUsed;
use super::numbers::{CmgNumbers, ROUNDED, check_there};
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile, direction};
use crate::figures::figures;
use crate::table::{ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::ControlMomentGyro;
use wrasse_spatial::{Scalar, Vec3};

/// A single-gimbal control moment gyro: of a model of the catalogue, or by its own numbers.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CmgFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A control moment gyro of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// Direction of the gimbal axis, base axes (–); any length.
    pub(crate) gimbal_axis: [f64; 3],
    /// Direction of the spin axis at zero gimbal angle, base axes (–); across the gimbal axis.
    pub(crate) spin_axis: [f64; 3],
    /// Gimbal angle at the start (deg); zero if not given.
    pub(crate) gimbal_angle_deg: Option<f64>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) numbers: CmgNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The mounting of one CMG: gimbal axis, and spin axis at zero gimbal angle (–).
pub(crate) type Mounting = (Vec3<f64>, Vec3<f64>);

/// How far spin and gimbal axis may be from a right angle (–, cosine): six decimals are enough.
const ACROSS: f64 = 1e-5;

impl UnitFile for CmgFile {
    const KEY: &'static str = "cmg";
    type Unit = ControlMomentGyro<f64>;
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
        let of = format!("CMG '{}'", self.name);
        let gimbal_axis = direction(reading, path, &of, "gimbal_axis", self.gimbal_axis);
        let spin_axis = direction(reading, path, &of, "spin_axis", self.spin_axis);
        let mounting = gimbal_axis.zip(spin_axis).and_then(|axes| across(reading, path, &of, axes));
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let rotor = rotor(reading, path, &of, &numbers);
        let unit = mounted(rotor?, mounting?);
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "cmg", mass_power);
        let start = self.gimbal_angle_deg.unwrap_or(0.0).to_radians();
        Some(vec![MountedUnit { unit, start, entry }])
    }
}

/// A CMG without mounting, on its mounting.
pub(crate) fn mounted(
    rotor: ControlMomentGyro<f64>,
    (gimbal, spin): Mounting,
) -> ControlMomentGyro<f64> {
    ControlMomentGyro { gimbal_axis_B: gimbal, spin_axis_B: spin, ..rotor }
}

/// Axes at a right angle; what is left of the spin axis along the gimbal axis is rounding.
fn across(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    (gimbal, spin): Mounting,
) -> Option<Mounting> {
    let along = gimbal.dot(spin);
    let mended = spin - gimbal * along;
    if along.abs() <= ACROSS {
        return Some((gimbal, mended * (1.0 / mended.norm())));
    }
    let angle = Scalar::acos(along).to_degrees();
    let message = format!(
        "the spin axis of {of} must be across its gimbal axis, found {} deg between them",
        figures(angle)
    );
    let help = match mended.norm() {
        length if length > 1e-3 => {
            let [x, y, z] = (mended * (1.0 / length)).to_array().map(figures);
            format!("the nearest direction across it is [{x}, {y}, {z}]")
        }
        _ => "they are parallel: choose a spin axis across the gimbal axis".into(),
    };
    reading.error(&under(path, "spin_axis"), message, "not across", &help);
    None
}

/// What a CMG can do, its mounting left open; complains of what is missing.
pub(crate) fn rotor(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &CmgNumbers,
) -> Option<ControlMomentGyro<f64>> {
    let by_torque = numbers.torque_limit_nm.zip(numbers.momentum_nms).map(|(t, h)| t / h);
    let by_rate = numbers.gimbal_rate_limit_deg_s.map(f64::to_radians);
    if let (Some(by_torque), Some(by_rate)) = (by_torque, by_rate)
        && (by_torque - by_rate).abs() > ROUNDED * by_rate
    {
        let message = format!(
            "{of}: its momentum at {} deg/s makes {} N·m, and `torque_limit_nm` says {}",
            figures(by_rate.to_degrees()),
            figures(by_rate * numbers.momentum_nms.unwrap_or(0.0)),
            figures(numbers.torque_limit_nm.unwrap_or(0.0))
        );
        let help = "leave out one of `gimbal_rate_limit_deg_s` and `torque_limit_nm`: it follows from \
                    the other";
        reading.error(&under(path, "torque_limit_nm"), message, "this torque", help);
    }
    let rate = by_rate.or(by_torque);
    // Without momentum no rate follows from the torque: one complaint is enough.
    let rate_due = rate.or(numbers.torque_limit_nm);
    let due = [
        ("momentum_nms", numbers.momentum_nms),
        ("gimbal_rate_limit_deg_s", rate_due),
        ("gimbal_acceleration_limit_deg_s2", numbers.gimbal_acceleration_limit_deg_s2),
        ("gimbal_inertia_kgm2", numbers.gimbal_inertia_kgm2),
        ("motor_torque_limit_nm", numbers.motor_torque_limit_nm),
        ("servo_bandwidth_rad_s", numbers.servo_bandwidth_rad_s),
    ];
    check_there(reading, path, of, &due);
    Some(ControlMomentGyro {
        gimbal_axis_B: Vec3::zero(),
        spin_axis_B: Vec3::zero(),
        momentum: numbers.momentum_nms?,
        gimbal_inertia: numbers.gimbal_inertia_kgm2?,
        rate_limit: rate?,
        acceleration_limit: numbers.gimbal_acceleration_limit_deg_s2?.to_radians(),
        motor_limit: numbers.motor_torque_limit_nm?,
        servo_bandwidth: numbers.servo_bandwidth_rad_s?,
    })
}

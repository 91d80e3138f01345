//! Control moment gyros of a file, one by one and in arrays.

use crate::cmg_array::{BOX_ANGLES_DEG, Mounting, four_sides, pyramid, roof, roof_angles_deg};
use crate::equipment_format::{CmgArrangementFile, CmgArrayFile, CmgFile, CmgNumbers};
use crate::figures::figures;
use crate::hardware_catalogue::ModelsUsed;
use crate::mounted_unit::{Mounted, direction};
use crate::toml_reading::{Reading, under};
use crate::toml_wheel::ROUNDED;
use crate::unit_numbers::check_there;
use wrasse_document::Step;
use wrasse_hardware::ControlMomentGyro;
use wrasse_spatial::{Scalar, Vec3};

/// How far spin and gimbal axis may be from a right angle (–, cosine): six decimals are enough.
const ACROSS: f64 = 1e-5;

/// A CMG; `None` after a complaint if it is not one.
pub(crate) fn cmg(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &CmgFile,
) -> Option<Mounted<ControlMomentGyro<f64>>> {
    let of = format!("CMG '{}'", file.name);
    let gimbal_axis = direction(reading, path, &of, "gimbal_axis", file.gimbal_axis);
    let spin_axis = direction(reading, path, &of, "spin_axis", file.spin_axis);
    let mounting = gimbal_axis.zip(spin_axis).and_then(|axes| across(reading, path, &of, axes));
    let numbers = models.numbers(reading, path, &of, file.model.as_deref(), file.numbers)?;
    let rotor = rotor(reading, path, &of, &numbers);
    Some(Mounted {
        name: file.name.clone(),
        at: reading.below(path, "name"),
        label: file.model.clone().unwrap_or("CMG".into()),
        unit: mounted(rotor?, mounting?),
        start: file.gimbal_angle_deg.unwrap_or(0.0).to_radians(),
        mass: numbers.mass_kg,
        power: numbers.power_w,
    })
}

/// The CMGs of an array; none after a complaint if it is not one.
pub(crate) fn cmg_array(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &CmgArrayFile,
) -> Option<Vec<Mounted<ControlMomentGyro<f64>>>> {
    let of = format!("CMG array '{}'", file.name);
    let R_BA = reading.pose(path, [0.0; 3], file.orientation.as_ref()).rotation;
    let mountings = mountings(reading, path, &of, file);
    let angles = mountings.as_ref().map(|m| start_angles(reading, path, &of, file, m.len()));
    let numbers = models.numbers(reading, path, &of, file.model.as_deref(), file.numbers)?;
    let rotor = rotor(reading, path, &of, &numbers)?;
    let at = reading.below(path, "name");
    let each = mountings?.into_iter().zip(angles?).enumerate();
    let unit = |(k, ((gimbal, spin), angle)): (usize, (Mounting, f64))| Mounted {
        name: format!("{}-{}", file.name, k + 1),
        at: at.clone(),
        label: file.model.clone().unwrap_or("CMG".into()),
        unit: mounted(rotor, (R_BA * gimbal, R_BA * spin)),
        start: angle.to_radians(),
        mass: numbers.mass_kg,
        power: numbers.power_w,
    };
    Some(each.map(unit).collect())
}

/// A CMG without mounting, on its mounting.
fn mounted(rotor: ControlMomentGyro<f64>, (gimbal, spin): Mounting) -> ControlMomentGyro<f64> {
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
fn rotor(
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

/// The mountings of an array in its frame; complains of keys that do not belong to the arrangement.
fn mountings(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &CmgArrayFile,
) -> Option<Vec<Mounting>> {
    let arrangement = file.arrangement;
    let (has_skew, has_count) = match arrangement {
        CmgArrangementFile::Pyramid => (true, false),
        CmgArrangementFile::Roof => (true, true),
        CmgArrangementFile::Box => (false, false),
    };
    let keys = [
        ("skew_deg", file.skew_deg.is_some(), has_skew, "the angle between gimbal axes and z"),
        ("count", file.count.is_some(), has_count, "the number of CMGs, in two equal rows"),
    ];
    let mut sound = true;
    for (key, there, due, what) in keys {
        if there && !due {
            let message = format!("{of} has `{key}`, which says nothing of this arrangement");
            reading.wrong_key(&under(path, key), message, "not for this one", "leave it out");
        } else if due && !there {
            let message = format!("{of} has no `{key}`: {what}");
            reading.error(&under(path, "arrangement"), message, "how?", "");
            sound = false;
        }
    }
    let skew = file.skew_deg.filter(|_| has_skew);
    if let Some(found) = skew.filter(|deg| !(*deg > 0.0 && *deg < 180.0)) {
        let message =
            format!("`skew_deg` of {of} must be between 0 and 180, both left out, found {found}");
        let help = "with gimbal axes along z no torque about z can be made; 54.74 deg gives nearly \
                    the same momentum every way";
        reading.error(&under(path, "skew_deg"), message, "this skew", help);
        return None;
    }
    if let Some(found) = file.count.filter(|count| has_count && count % 2 != 0) {
        let message = format!("{of} has {found} CMGs, which are not two equal rows");
        reading.error(&under(path, "count"), message, "an odd number", "4, 6 or 8");
        return None;
    }
    match arrangement {
        _ if !sound => None,
        CmgArrangementFile::Pyramid => Some(pyramid(skew?)),
        CmgArrangementFile::Roof => Some(roof(skew?, file.count?)),
        CmgArrangementFile::Box => Some(four_sides()),
    }
}

/// Gimbal angles at the start (deg), one for each CMG.
fn start_angles(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &CmgArrayFile,
    count: usize,
) -> Vec<f64> {
    let usual = match file.arrangement {
        CmgArrangementFile::Pyramid => vec![0.0; count],
        CmgArrangementFile::Roof => roof_angles_deg(count),
        CmgArrangementFile::Box => BOX_ANGLES_DEG.to_vec(),
    };
    match &file.gimbal_angles_deg {
        Some(given) if given.len() == count => given.clone(),
        Some(given) => {
            let message = format!("{of} has {count} CMGs and {} gimbal angles", given.len());
            let help = "one angle for each CMG, in order";
            reading.error(&under(path, "gimbal_angles_deg"), message, "these angles", help);
            usual
        }
        None => usual,
    }
}

//! Thrusters of a file, one by one and in sets, and their tank.

use crate::equipment_format::{
    TankFile, ThrusterArrangementFile, ThrusterFile, ThrusterNumbers, ThrusterSetFile,
};
use crate::figures::figures;
use crate::hardware_catalogue::ModelsUsed;
use crate::mounted_unit::{Mounted, direction};
use crate::thruster_box::{Push, sixteen, twelve, twenty_four};
use crate::toml_reading::{Reading, under};
use crate::unit_numbers::check_there;
use wrasse_document::Step;
use wrasse_hardware::{Tank, Thruster};
use wrasse_spatial::Vec3;

/// A thruster; `None` after a complaint if it is not one.
pub(crate) fn thruster(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &ThrusterFile,
) -> Option<Mounted<Thruster<f64>>> {
    let of = format!("thruster '{}'", file.name);
    let direction = direction(reading, path, &of, "direction", file.direction);
    let numbers = models.numbers(reading, path, &of, file.model.as_deref(), file.numbers)?;
    let nozzle = nozzle(reading, path, &of, &numbers);
    Some(Mounted {
        name: file.name.clone(),
        at: reading.below(path, "name"),
        label: file.model.clone().unwrap_or("thruster".into()),
        unit: mounted(nozzle?, (Vec3::from_array(file.position_m), direction?)),
        start: 0.0,
        mass: numbers.mass_kg,
        power: numbers.power_w,
    })
}

/// The thrusters of a set; none after a complaint if it is not one.
pub(crate) fn thruster_set(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &ThrusterSetFile,
) -> Option<Vec<Mounted<Thruster<f64>>>> {
    let of = format!("thruster set '{}'", file.name);
    let X_BA = reading.pose(path, file.position_m, file.orientation.as_ref());
    let pushes = pushes(reading, path, &of, file);
    let numbers = models.numbers(reading, path, &of, file.model.as_deref(), file.numbers)?;
    let nozzle = nozzle(reading, path, &of, &numbers)?;
    let at = reading.below(path, "name");
    let unit = |(k, (position, direction)): (usize, Push)| Mounted {
        name: format!("{}-{}", file.name, k + 1),
        at: at.clone(),
        label: file.model.clone().unwrap_or("thruster".into()),
        unit: mounted(
            nozzle,
            (X_BA.rotation * position + X_BA.translation, X_BA.rotation * direction),
        ),
        start: 0.0,
        mass: numbers.mass_kg,
        power: numbers.power_w,
    };
    Some(pushes?.into_iter().enumerate().map(unit).collect())
}

/// A thruster without mounting, on its mounting.
fn mounted(nozzle: Thruster<f64>, (position_B, direction_B): Push) -> Thruster<f64> {
    Thruster { position_B, direction_B, ..nozzle }
}

/// What a thruster can do, its mounting left open; complains of what is missing.
fn nozzle(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    numbers: &ThrusterNumbers,
) -> Option<Thruster<f64>> {
    let due = [("force_n", numbers.force_n), ("specific_impulse_s", numbers.specific_impulse_s)];
    check_there(reading, path, of, &due);
    Some(Thruster {
        position_B: Vec3::zero(),
        direction_B: Vec3::zero(),
        force: numbers.force_n?,
        specific_impulse: numbers.specific_impulse_s?,
        minimum_on_time: numbers.minimum_on_time_s.unwrap_or(0.0),
        rise_time: numbers.rise_time_s.unwrap_or(0.0),
        fall_time: numbers.fall_time_s.unwrap_or(0.0),
        impulse_noise: numbers.impulse_noise_percent.unwrap_or(0.0) / 100.0,
    })
}

/// Where the thrusters of a set push, in its frame.
fn pushes(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &ThrusterSetFile,
) -> Option<Vec<Push>> {
    let ThrusterArrangementFile::Box = file.arrangement;
    let flat = file.edges_m.iter().any(|edge| *edge <= 0.0);
    if flat {
        let [x, y, z] = file.edges_m.map(figures);
        let message = format!("edges of the box of {of} must be positive, found [{x}, {y}, {z}]");
        reading.error(&under(path, "edges_m"), message, "these edges", "edges are in metres");
    }
    let half = Vec3::from_array(file.edges_m) * 0.5;
    match file.count {
        12 => Some(twelve(half)),
        16 => Some(sixteen(half)),
        24 => Some(twenty_four(half)),
        found => {
            let message = format!("{of} has {found} thrusters: on a box there are 12, 16 or 24");
            let help = "other thrusters are given one by one in [[actuators.thruster]]";
            reading.error(&under(path, "count"), message, "this number", help);
            None
        }
    }
    .filter(|_| !flat)
}

/// The tank.
pub(crate) fn tank(reading: &mut Reading<'_>, path: &[Step<'_>], file: &TankFile) -> Tank<f64> {
    let found = file.propellant_kg;
    if found < 0.0 {
        let message = format!("`propellant_kg` of the tank must be zero or more, found {found}");
        let help = "without a tank the thrusters never run dry: leave out [actuators.tank]";
        reading.error(&under(path, "propellant_kg"), message, "this mass", help);
    }
    Tank { position_B: Vec3::from_array(file.position_m), propellant: found }
}

//! The table `[sensors]` to what a vehicle is felt with.

use crate::hardware_catalogue::ModelsUsed;
use crate::mounted_unit::direction;
use crate::provenance::Sources;
use crate::sensor_format::{
    RateGyroFile, RateGyroNumbers, SensorsFile, StarTrackerFile, StarTrackerNumbers,
};
use crate::toml_reading::{Reading, under};
use crate::unit_numbers::check_there;
use crate::vehicle::Provenance;
use wrasse_document::{Complaint, Document, Step};
use wrasse_hardware::{RateGyro, Sensors, StarTracker};
use wrasse_spatial::Vec3;

/// One degree in an hour (rad/s).
const DEG_PER_HOUR: f64 = core::f64::consts::PI / 180.0 / 3600.0;
/// The square root of an hour (√s).
const ROOT_HOUR: f64 = 60.0;

/// The sensors of a table `[sensors]` that stands at `path` in a document, and all complaints about it.
pub fn read_sensors(
    document: &Document,
    path: &[Step<'_>],
    file: &SensorsFile,
) -> (Sensors<f64>, Vec<Complaint>) {
    let mut reading = Reading::new(document);
    let mut sources = Sources::within("sensors", file.source.as_ref(), true);
    let (sensors, _) = sensors(&mut reading, &mut sources, path, file);
    (sensors, reading.found.into_complaints())
}

/// The sensors of a table, and where their numbers come from.
pub(crate) fn sensors(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    path: &[Step<'_>],
    file: &SensorsFile,
) -> (Sensors<f64>, Vec<Provenance>) {
    let mut models = ModelsUsed::default();
    let gyro_path = under(path, "gyro");
    let gyro = file.gyro.as_ref().map(|given| rate_gyro(reading, &mut models, &gyro_path, given));
    let tracker_path = under(path, "star_tracker");
    let tracker = file.star_tracker.as_ref();
    let tracker = tracker.map(|given| star_tracker(reading, &mut models, &tracker_path, given));
    check_pair(reading, path, file);
    let encoder_step = file.encoder_step_deg.unwrap_or(0.0);
    if encoder_step < 0.0 {
        let message =
            format!("`encoder_step_deg` of the sensors must be zero or more, found {encoder_step}");
        reading.error(&under(path, "encoder_step_deg"), message, "this step", "");
    } else if encoder_step > 5.0 {
        let message = format!("joint positions are felt in steps of {encoder_step} deg");
        let label = "this step";
        reading.warning(&under(path, "encoder_step_deg"), message, label, "is it in degrees?");
    }
    blocks(reading, sources, path, file);
    let mut provenance = std::mem::take(&mut sources.rows);
    provenance.append(&mut models.rows);
    let attitude = gyro.flatten().zip(tracker.flatten());
    (Sensors { attitude, encoder_step: encoder_step.to_radians() }, provenance)
}

/// Attitude is estimated from both or known perfectly.
fn check_pair(reading: &mut Reading<'_>, path: &[Step<'_>], file: &SensorsFile) {
    let (alone, other) = match (&file.gyro, &file.star_tracker) {
        (Some(_), None) => ("gyro", "star_tracker"),
        (None, Some(_)) => ("star_tracker", "gyro"),
        _ => return,
    };
    let message = format!("the sensors have `{alone}`, but not `{other}`: attitude takes both");
    let help = format!("add `{other}`; without either of them attitude is known perfectly");
    reading.wrong_key(&under(path, alone), message, "alone", &help);
}

fn rate_gyro(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &RateGyroFile,
) -> Option<RateGyro<f64>> {
    let own: RateGyroNumbers = file.numbers;
    let numbers = models.numbers(reading, path, "the rate gyro", file.model.as_deref(), own)?;
    let due = [
        ("angle_random_walk_deg_sqrt_h", numbers.angle_random_walk_deg_sqrt_h),
        ("bias_random_walk_deg_h_sqrt_h", numbers.bias_random_walk_deg_h_sqrt_h),
    ];
    check_there(reading, path, "the rate gyro", &due);
    let bias = Vec3::from_array(file.bias_deg_h.unwrap_or_default());
    Some(RateGyro {
        bias_B: bias * DEG_PER_HOUR,
        angle_random_walk: numbers.angle_random_walk_deg_sqrt_h?.to_radians() / ROOT_HOUR,
        bias_random_walk: numbers.bias_random_walk_deg_h_sqrt_h? * DEG_PER_HOUR / ROOT_HOUR,
        rate_step: numbers.rate_step_deg_s.unwrap_or(0.0).to_radians(),
    })
}

fn star_tracker(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &StarTrackerFile,
) -> Option<StarTracker<f64>> {
    let of = "the star tracker";
    let boresight = direction(reading, path, of, "boresight", file.boresight);
    let own: StarTrackerNumbers = file.numbers;
    let numbers = models.numbers(reading, path, of, file.model.as_deref(), own)?;
    let due = [
        ("noise_across_arcsec", numbers.noise_across_arcsec),
        ("noise_about_arcsec", numbers.noise_about_arcsec),
        ("rate_hz", numbers.rate_hz),
        ("rate_limit_deg_s", numbers.rate_limit_deg_s),
    ];
    check_there(reading, path, of, &due);
    let arcsec = |angle: f64| (angle / 3600.0).to_radians();
    Some(StarTracker {
        boresight_B: boresight?,
        noise_across: arcsec(numbers.noise_across_arcsec?),
        noise_about: arcsec(numbers.noise_about_arcsec?),
        interval: 1.0 / numbers.rate_hz?,
        latency: numbers.latency_s.unwrap_or(0.0),
        rate_limit: numbers.rate_limit_deg_s?.to_radians(),
    })
}

/// Where the numbers of each block come from.
fn blocks(reading: &mut Reading<'_>, sources: &mut Sources, path: &[Step<'_>], file: &SensorsFile) {
    // Only the encoders' step stands in the table itself.
    if file.encoder_step_deg.is_some() || !file.source_of.is_empty() {
        sources.block(reading, path, "sensors", None, &file.source_of);
    }
    if let Some(gyro) = &file.gyro {
        let (source, source_of) = (gyro.source.as_ref(), &gyro.source_of);
        sources.block(reading, &under(path, "gyro"), "sensors.gyro", source, source_of);
    }
    if let Some(tracker) = &file.star_tracker {
        let (source, source_of) = (tracker.source.as_ref(), &tracker.source_of);
        let path = under(path, "star_tracker");
        sources.block(reading, &path, "sensors.star_tracker", source, source_of);
    }
}

//! The table `[sensors]`: what a vehicle is felt with.

use super::catalogue::ModelsUsed;
use super::rate_gyro::{RateGyroFile, rate_gyro};
use super::star_tracker::{StarTrackerFile, star_tracker};
use crate::provenance::Provenance;
use crate::table::{ProvenanceFile, Reading, Sources, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Complaint, Document, Step};
use wrasse_hardware::Sensors;

/// What a vehicle is felt with. What is not there is perfect.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorsFile {
    /// Rate gyro of three axes; it comes together with a star tracker.
    pub(crate) gyro: Option<RateGyroFile>,
    /// Star tracker; it comes together with a rate gyro.
    pub(crate) star_tracker: Option<StarTrackerFile>,
    /// Joint positions are rounded to multiples of this (deg); those of joints that slide to as many
    /// metres as it has radians. Not rounded if not given.
    pub(crate) encoder_step_deg: Option<f64>,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The sensors of a table `[sensors]` that stands at `path` in a document, and all complaints about it.
pub fn read_sensors(
    document: &Document,
    path: &[Step<'_>],
    file: &SensorsFile,
) -> (Sensors<f64>, Vec<Complaint>) {
    let mut reading = Reading::new(document);
    let mut sources = Sources::within("sensors", file.provenance.source.as_ref(), true);
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

/// Where the numbers of each block come from.
fn blocks(reading: &mut Reading<'_>, sources: &mut Sources, path: &[Step<'_>], file: &SensorsFile) {
    // Only the encoders' step stands in the table itself.
    if file.encoder_step_deg.is_some() || !file.provenance.source_of.is_empty() {
        let own = ProvenanceFile { source: None, ..file.provenance.clone() };
        sources.block(reading, path, "sensors", &own);
    }
    if let Some(gyro) = &file.gyro {
        sources.block(reading, &under(path, "gyro"), "sensors.gyro", &gyro.provenance);
    }
    if let Some(tracker) = &file.star_tracker {
        let path = under(path, "star_tracker");
        sources.block(reading, &path, "sensors.star_tracker", &tracker.provenance);
    }
}

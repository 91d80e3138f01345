//! The tables `[[actuators.wheel_array]]`: where the spin axis of each wheel points, in the array's frame.

use super::catalogue::ModelsUsed;
use super::numbers::WheelNumbers;
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile};
use super::wheel::{RPM, check_speed, wheel};
use crate::rotation::{about_z, sin_cos};
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::{ReactionWheel, WHEELS};
use wrasse_spatial::{Vec3, vec3};

/// An array of equal reaction wheels in a frame of its own, its axis along z. They are called NAME-1,
/// NAME-2, ….
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelArrayFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A reaction wheel of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// How the wheels are mounted.
    pub(crate) arrangement: WheelArrangementFile,
    /// Angle between spin axes and z (deg), of a pyramid.
    pub(crate) skew_deg: Option<f64>,
    /// Number of wheels of a pyramid, 3 to 8; 4 if not given.
    #[schemars(range(min = 3, max = 8))]
    pub(crate) count: Option<usize>,
    /// How the array is turned from the base's axes; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// Speed at the start (rpm): one for all wheels, or one for each; zero if not given.
    pub(crate) speed_rpm: Option<SpeedsFile>,
    /// What each wheel can do.
    #[serde(flatten)]
    pub(crate) numbers: WheelNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// A way of mounting several wheels. s and c are sine and cosine of the skew.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum WheelArrangementFile {
    /// Spin axes at one angle from z, evenly about it: wheel 1 at (s, 0, c), each further one of n turned
    /// by another 360/n deg about z.
    Pyramid,
    /// Three wheels along x, y and z.
    Orthogonal,
    /// Four wheels along the lines from the middle of a regular tetrahedron to its corners: (1, 1, 1),
    /// (1, -1, -1), (-1, 1, -1), (-1, -1, 1), each over √3. Equal speeds add up to no momentum.
    Tetrahedron,
}

/// Speeds at the start (rpm).
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum SpeedsFile {
    /// That of all wheels.
    OfAll(f64),
    /// That of each.
    OfEach(Vec<f64>),
}

impl UnitFile for WheelArrayFile {
    const KEY: &'static str = "wheel_array";
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
        let of = format!("wheel array '{}'", self.name);
        let R_BA = reading.pose(path, [0.0; 3], self.orientation.as_ref()).rotation;
        let axes = axes(reading, path, &of, self);
        let speeds = axes.as_ref().map(|axes| speeds(reading, path, &of, self, axes.len()));
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let wheel = wheel(reading, path, &of, &numbers)?;
        let speeds = speeds?;
        let fastest = speeds.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        check_speed(reading, path, &of, &wheel, fastest.unwrap_or(0.0));
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "wheel", mass_power);
        let each = axes?.into_iter().zip(speeds).enumerate();
        let units = each.map(|(k, (axis, rpm))| MountedUnit {
            unit: ReactionWheel { axis_B: R_BA * axis, ..wheel },
            start: rpm * RPM,
            entry: entry.numbered(k),
        });
        Some(units.collect())
    }
}

/// The spin axes of an array in its frame; complains of keys that do not belong to the arrangement.
fn axes(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &WheelArrayFile,
) -> Option<Vec<Vec3<f64>>> {
    if file.arrangement == WheelArrangementFile::Pyramid {
        return pyramid(reading, path, of, file);
    }
    for (key, there) in [("skew_deg", file.skew_deg.is_some()), ("count", file.count.is_some())] {
        if there {
            let message = format!("{of} has `{key}`, which says nothing of this arrangement");
            reading.wrong_key(&under(path, key), message, "not for this one", "leave it out");
        }
    }
    Some(match file.arrangement {
        WheelArrangementFile::Tetrahedron => {
            let part = 1.0 / 3.0_f64.sqrt();
            let corners =
                [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)];
            corners.map(|(x, y, z)| vec3(x, y, z) * part).to_vec()
        }
        _ => vec![vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)],
    })
}

/// Spin axes on a cone about z; complains of a skew that leaves a direction without torque.
fn pyramid(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &WheelArrayFile,
) -> Option<Vec<Vec3<f64>>> {
    let Some(skew) = file.skew_deg else {
        let message = format!("{of} has no `skew_deg`: the angle between spin axes and z");
        reading.error(&under(path, "arrangement"), message, "how?", "");
        return None;
    };
    if !(skew > 0.0 && skew < 90.0) {
        let message =
            format!("`skew_deg` of {of} must be between 0 and 90, both left out, found {skew}");
        let help = "at 0 no torque across z can be made, at 90 none about it; 54.74 deg gives four \
                    wheels the same momentum about x, y and z";
        reading.error(&under(path, "skew_deg"), message, "this skew", help);
        return None;
    }
    let count = file.count.unwrap_or(4).clamp(3, WHEELS);
    let (s, c) = sin_cos(skew);
    let turned = |k: usize| about_z(360.0 * k as f64 / count as f64) * vec3(s, 0.0, c);
    Some((0..count).map(turned).collect())
}

/// Speeds at the start (rpm), one for each wheel.
fn speeds(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &WheelArrayFile,
    count: usize,
) -> Vec<f64> {
    match &file.speed_rpm {
        None => vec![0.0; count],
        Some(SpeedsFile::OfAll(rpm)) => vec![*rpm; count],
        Some(SpeedsFile::OfEach(given)) if given.len() == count => given.clone(),
        Some(SpeedsFile::OfEach(given)) => {
            let message = format!("{of} has {count} wheels and {} speeds", given.len());
            let help = "one speed for each wheel, in order, or one for all";
            reading.error(&under(path, "speed_rpm"), message, "these speeds", help);
            vec![0.0; count]
        }
    }
}

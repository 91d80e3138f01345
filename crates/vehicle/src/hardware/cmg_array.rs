//! The tables `[[actuators.cmg_array]]`: where the axes of each CMG point, in the array's frame, and
//! where the gimbals start.

use super::catalogue::ModelsUsed;
use super::cmg::{Mounting, mounted, rotor};
use super::numbers::CmgNumbers;
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile};
use crate::rotation::sin_cos;
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::ControlMomentGyro;
#[cfg(doc)]
use wrasse_spatial::references::WieBaileyHeiberg2001;
use wrasse_spatial::vec3;

/// An array of equal CMGs in a frame of its own, its axis along z. They are called NAME-1, NAME-2, ….
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CmgArrayFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A control moment gyro of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// How the CMGs are mounted.
    pub(crate) arrangement: CmgArrangementFile,
    /// Angle between gimbal axes and z (deg), of a pyramid or a roof.
    pub(crate) skew_deg: Option<f64>,
    /// Number of CMGs of a roof: 4, 6 or 8.
    #[schemars(range(min = 4, max = 8))]
    pub(crate) count: Option<usize>,
    /// How the array is turned from the base's axes; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// Gimbal angle of each CMG at the start (deg). If not given: zero in a pyramid; evenly from -45 to
    /// 45 along each row of a roof; 45, -45, 45, -45 in a box. All of these add up to no momentum and
    /// can make torque about any axis.
    pub(crate) gimbal_angles_deg: Option<Vec<f64>>,
    /// What each CMG can do.
    #[serde(flatten)]
    pub(crate) numbers: CmgNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// A way of mounting several CMGs. s and c are sine and cosine of the skew.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum CmgArrangementFile {
    /// Four CMGs on the faces of a pyramid: gimbal axes stand on the faces, CMG 1 at (s, 0, c) with
    /// its spin axis at zero angle along y; each of the others is turned a further 90 deg about z.
    Pyramid,
    /// Two rows of CMGs on the slopes of a roof whose ridge is x: gimbal axes stand on the slopes, at
    /// (0, s, c) for the first half of the CMGs and (0, -s, c) for the second. Spin axes at zero angle
    /// lie along x in the first row and along -x in the second.
    Roof,
    /// Four CMGs in the four upright sides of a box, gimbal axes pointing out along x, y, -x, -y: a
    /// pyramid of 90 deg skew, two pairs of parallel gimbals.
    Box,
}

impl UnitFile for CmgArrayFile {
    const KEY: &'static str = "cmg_array";
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
        let of = format!("CMG array '{}'", self.name);
        let R_BA = reading.pose(path, [0.0; 3], self.orientation.as_ref()).rotation;
        let mountings = mountings(reading, path, &of, self);
        let angles = mountings.as_ref().map(|m| start_angles(reading, path, &of, self, m.len()));
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let rotor = rotor(reading, path, &of, &numbers)?;
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "cmg", mass_power);
        let each = mountings?.into_iter().zip(angles?).enumerate();
        let units = each.map(|(k, ((gimbal, spin), angle))| MountedUnit {
            unit: mounted(rotor, (R_BA * gimbal, R_BA * spin)),
            start: angle.to_radians(),
            entry: entry.numbered(k),
        });
        Some(units.collect())
    }
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

/// Four CMGs on the faces of a pyramid; CMG k+1 is CMG 1 turned by k right angles about z.
///
/// With spin axes `s cos δ + (g × s) sin δ` its momentum, in units of one rotor's, is
/// `(-c s1 - c2 + c s3 + c4, c1 - c s2 - c3 + c s4, s (s1 + s2 + s3 + s4))`.
///
/// # Source
/// The numbering and the zero angles of [WieBaileyHeiberg2001].
fn pyramid(skew_deg: f64) -> Vec<Mounting> {
    let (s, c) = sin_cos(skew_deg);
    [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
        .map(|(x, y)| (vec3(s * x, s * y, c), vec3(-y, x, 0.0)))
        .to_vec()
}

/// Two rows of CMGs on the slopes of a roof whose ridge is x.
fn roof(skew_deg: f64, count: usize) -> Vec<Mounting> {
    let (s, c) = sin_cos(skew_deg);
    let row = |side: f64| (vec3(0.0, side * s, c), vec3(side, 0.0, 0.0));
    let half = count / 2;
    (0..count).map(|k| row(if k < half { 1.0 } else { -1.0 })).collect()
}

/// Four CMGs in the upright sides of a box.
fn four_sides() -> Vec<Mounting> {
    pyramid(90.0)
}

/// Gimbal angles of a roof (deg) without momentum and with torque about every axis: the CMGs of a row
/// are spread, and what is left along the ridge is made up for by the other row.
fn roof_angles_deg(count: usize) -> Vec<f64> {
    let half = count / 2;
    let last = half.saturating_sub(1).max(1) as f64;
    (0..count).map(|k| 45.0 * (2.0 * (k % half.max(1)) as f64 / last - 1.0)).collect()
}

/// Gimbal angles of a box (deg) without momentum and with torque about every axis.
const BOX_ANGLES_DEG: [f64; 4] = [45.0, -45.0, 45.0, -45.0];

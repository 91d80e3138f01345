//! How a file says how a frame is turned, and where it is.

use super::reading::{Reading, under};
use crate::rotation::from_rpy_deg;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::Step;
use wrasse_spatial::{Mat3, Pose, Quat, Vec3};

/// How far the length of a quaternion may be from 1: six decimals of each part are enough.
const QUATERNION_ROUND_OFF: f64 = 1e-5;

/// How a frame is turned.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum OrientationFile {
    /// Roll, pitch and yaw (deg): turns about the fixed axes x, then y, then z of the frame it is
    /// turned from.
    RpyDeg([f64; 3]),
    /// Unit quaternion (–): turns components in this frame into components in the one it is turned
    /// from.
    Quaternion(QuaternionFile),
}

/// A unit quaternion by its named parts (–).
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct QuaternionFile {
    /// Scalar part (–).
    pub w: f64,
    /// Along x (–).
    pub x: f64,
    /// Along y (–).
    pub y: f64,
    /// Along z (–).
    pub z: f64,
}

/// An attitude, from the axes of the thing to those it is measured in: an orientation, or a unit
/// quaternion by its parts alone, `{ w = …, x = …, y = …, z = … }`.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum AttitudeFile {
    /// Roll, pitch and yaw, or a quaternion under its name.
    Orientation(OrientationFile),
    /// A unit quaternion by its parts alone.
    Parts(QuaternionFile),
}

/// Why four numbers are no rotation: what is wrong with them, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotARotation {
    /// What was found.
    pub message: String,
    /// What would be a rotation.
    pub help: String,
}

impl OrientationFile {
    /// `R_PB` of a frame B that is turned so from P.
    ///
    /// # Errors
    /// The quaternion has not length 1.
    pub fn rotation(self) -> Result<Mat3<f64>, NotARotation> {
        match self {
            Self::RpyDeg(angles) => Ok(from_rpy_deg(angles)),
            Self::Quaternion(parts) => parts.rotation(),
        }
    }
}

impl AttitudeFile {
    /// `R_NB` of a thing with axes B that is turned so in N.
    ///
    /// # Errors
    /// The quaternion has not length 1.
    pub fn rotation(self) -> Result<Mat3<f64>, NotARotation> {
        match self {
            Self::Orientation(orientation) => orientation.rotation(),
            Self::Parts(parts) => parts.rotation(),
        }
    }
}

impl QuaternionFile {
    /// The rotation, made of length 1 where the parts are so but for their round-off.
    fn rotation(self) -> Result<Mat3<f64>, NotARotation> {
        let quat = Quat::new(self.w, self.x, self.y, self.z);
        let length = quat.norm();
        if (length - 1.0).abs() <= QUATERNION_ROUND_OFF {
            return Ok(quat.normalized().to_matrix());
        }
        let help = if length > 0.0 && length.is_finite() {
            let unit = quat.normalized();
            let [w, x, y, z] = [unit.w, unit.x, unit.y, unit.z].map(|part| format!("{part:.9}"));
            format!("of length 1 it would be {{ w = {w}, x = {x}, y = {y}, z = {z} }}")
        } else {
            "no rotation is { w = 1, x = 0, y = 0, z = 0 }".into()
        };
        Err(NotARotation {
            message: format!("a quaternion must have length 1, found {length}"),
            help,
        })
    }
}

impl Reading<'_> {
    /// The pose of a frame that the table at a path places with `position_m` and `orientation`.
    pub(crate) fn pose(
        &mut self,
        path: &[Step<'_>],
        position: [f64; 3],
        orientation: Option<&OrientationFile>,
    ) -> Pose<f64> {
        let rotation = match orientation {
            None => Mat3::identity(),
            Some(OrientationFile::RpyDeg(angles)) => from_rpy_deg(*angles),
            Some(OrientationFile::Quaternion(parts)) => {
                self.quaternion(&under(path, "orientation"), *parts)
            }
        };
        Pose::new(rotation, Vec3::from_array(position))
    }
    /// The rotation of a quaternion, which must have length 1.
    pub(crate) fn quaternion(&mut self, path: &[Step<'_>], parts: QuaternionFile) -> Mat3<f64> {
        parts.rotation().unwrap_or_else(|NotARotation { message, help }| {
            self.error(path, message, "not a rotation", &help);
            Mat3::identity()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_document::Document;

    #[test]
    fn quaternion_and_angles_turn_the_same_way() {
        let document = Document::parse("empty.toml", "").unwrap();
        let mut reading = Reading::new(&document);
        // Half a right angle about each axis in turn: w = cos 22.5 deg, the rest sin 22.5 deg.
        let (w, part) = (0.923_879_532_511_286_8, 0.382_683_432_365_089_8);
        for axis in 0..3 {
            let (mut rpy, mut xyz) = ([0.0; 3], [0.0; 3]);
            (rpy[axis], xyz[axis]) = (45.0, part);
            let [x, y, z] = xyz;
            let quaternion = OrientationFile::Quaternion(QuaternionFile { w, x, y, z });
            let by_quaternion = reading.pose(&[], [0.0; 3], Some(&quaternion));
            let by_angles = reading.pose(&[], [0.0; 3], Some(&OrientationFile::RpyDeg(rpy)));
            let off = (by_quaternion.rotation - by_angles.rotation).rows.map(Vec3::norm);
            let off = wrasse_testing::largest(off);
            assert!(off < 4.0 * f64::EPSILON, "measured 1.6e-16: {off:e}");
        }
        assert!(reading.found.into_complaints().is_empty());
    }
}

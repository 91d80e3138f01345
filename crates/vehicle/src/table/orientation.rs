//! How a file says how a frame is turned, and where it is.

use super::reading::{Reading, under};
use crate::rotation::from_rpy_deg;
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_spatial::{Mat3, Pose, Quat, Vec3};

/// How far the length of a quaternion may be from 1: six decimals of each part are enough.
const QUATERNION_ROUND_OFF: f64 = 1e-5;

/// How a frame is turned.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum OrientationFile {
    /// Roll, pitch and yaw (deg): turns about the fixed axes x, then y, then z of the frame it is
    /// turned from.
    RpyDeg([f64; 3]),
    /// Unit quaternion (–): turns components in this frame into components in the one it is turned
    /// from.
    Quaternion(QuaternionFile),
}

/// A unit quaternion by its named parts (–).
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct QuaternionFile {
    /// Scalar part (–).
    pub(crate) w: f64,
    /// Along x (–).
    pub(crate) x: f64,
    /// Along y (–).
    pub(crate) y: f64,
    /// Along z (–).
    pub(crate) z: f64,
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
        let quat = Quat::new(parts.w, parts.x, parts.y, parts.z);
        let length = quat.norm();
        if (length - 1.0).abs() <= QUATERNION_ROUND_OFF {
            return quat.normalized().to_matrix();
        }
        let help = if length > 0.0 && length.is_finite() {
            let unit = quat.normalized();
            let [w, x, y, z] = [unit.w, unit.x, unit.y, unit.z].map(|part| format!("{part:.9}"));
            format!("of length 1 it would be {{ w = {w}, x = {x}, y = {y}, z = {z} }}")
        } else {
            "no rotation is { w = 1, x = 0, y = 0, z = 0 }".into()
        };
        let message = format!("a quaternion must have length 1, found {length}");
        self.error(path, message, "not a rotation", &help);
        Mat3::identity()
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

//! A TOML vehicle file that is being read: the document, and what was found wrong with it so far.

use crate::findings::Findings;
use crate::format::{OrientationFile, QuaternionFile};
use crate::rotation_in_degrees::from_rpy_deg;
use std::ops::Range;
use wrasse_document::{Document, Step};
use wrasse_spatial::{Mat3, Pose, Quat, Vec3};

/// How far the length of a quaternion may be from 1: six decimals of each part are enough.
const QUATERNION_ROUND_OFF: f64 = 1e-5;

/// The document and the complaints.
#[derive(Debug)]
pub(crate) struct Reading<'d> {
    pub(crate) document: &'d Document,
    pub(crate) found: Findings,
}

/// The path one step further.
pub(crate) fn under<'p>(path: &[Step<'p>], key: &'p str) -> Vec<Step<'p>> {
    [path, &[Step::Key(key)]].concat()
}

impl<'d> Reading<'d> {
    pub(crate) fn new(document: &'d Document) -> Self {
        Self { document, found: Findings::new(document.source()) }
    }
    /// Where the value at a path stands.
    pub(crate) fn at(&self, path: &[Step<'_>]) -> Range<usize> {
        self.document.span(path).unwrap_or(0..0)
    }
    /// Where the value at a key below a path stands.
    pub(crate) fn below(&self, path: &[Step<'_>], key: &str) -> Range<usize> {
        self.at(&under(path, key))
    }
    pub(crate) fn error(&mut self, path: &[Step<'_>], message: String, label: &str, help: &str) {
        let at = self.at(path);
        self.found.error(&at, message, label, help);
    }
    pub(crate) fn warning(&mut self, path: &[Step<'_>], message: String, label: &str, help: &str) {
        let at = self.at(path);
        self.found.warning(&at, message, label, help);
    }
    /// An error about a key rather than its value.
    pub(crate) fn wrong_key(
        &mut self,
        path: &[Step<'_>],
        message: String,
        label: &str,
        help: &str,
    ) {
        let at = self.document.key_span(path).unwrap_or(0..0);
        self.found.error(&at, message, label, help);
    }
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
            let off = off.into_iter().fold(0.0, f64::max);
            assert!(off < 4.0 * f64::EPSILON, "measured 1.6e-16: {off:e}");
        }
        assert!(reading.found.into_complaints().is_empty());
    }
}

//! The `<origin>` of a URDF.

use crate::rotation::from_roll_pitch_yaw;
use crate::xml::{Element, Kind, Reading};
use core::f64::consts::TAU;
use roxmltree::Node;
use wrasse_spatial::{Mat3, Pose, Quat};

const ORIGIN: Kind =
    Kind { tag: "origin", attributes: &["xyz", "rpy", "quat_xyzw"], children: &[], unused: &[] };

/// How far the length of a quaternion may be from 1: six decimals of each part are enough.
const QUATERNION_ROUND_OFF: f64 = 1e-5;

impl Reading<'_> {
    /// The pose that an `<origin>` gives; the identity where there is none.
    pub(crate) fn pose(&mut self, origin: Option<Node<'_, '_>>) -> Pose<f64> {
        let Some(node) = origin else { return Pose::identity() };
        let element = self.open(node, &ORIGIN);
        let p = self.vector(&element, "xyz").unwrap_or_default();
        if let Some(rotation) = self.quaternion(&element) {
            return Pose::new(rotation, p);
        }
        let rpy = self.vector(&element, "rpy").unwrap_or_default();
        if let Some(written) = element.attribute("rpy")
            && rpy.to_array().iter().any(|angle| angle.abs() > TAU)
        {
            let message =
                format!("`rpy` of <origin> turns by more than a full turn: {}", written.text);
            self.found.warning(&written.at, message, "in degrees?", "angles are in radians");
        }
        Pose::new(from_roll_pitch_yaw(rpy), p)
    }

    /// The rotation of `quat_xyzw` (URDF 1.1 and later), if it is there; complains of one that is no
    /// rotation, and of `rpy` beside it.
    fn quaternion(&mut self, element: &Element<'_, '_>) -> Option<Mat3<f64>> {
        let written = element.attribute("quat_xyzw")?.clone();
        let [x, y, z, w] = self.numbers(element, "quat_xyzw", 4)?[..] else { return None };
        if let Some(rpy) = element.attribute("rpy") {
            let message = "<origin> has both `rpy` and `quat_xyzw`".to_owned();
            let help = "leave out one of them: they say the same thing";
            self.found.error(&rpy.at.clone(), message, "and this", help);
        }
        let quat = Quat::new(w, x, y, z);
        let length = quat.norm();
        if (length - 1.0).abs() > QUATERNION_ROUND_OFF {
            let message = format!("`quat_xyzw` must have length 1, found {length}");
            let help = "its order is x y z w: no rotation is \"0 0 0 1\"";
            self.found.error(&written.at, message, "not a rotation", help);
            return Some(Mat3::identity());
        }
        Some(quat.normalized().to_matrix())
    }
}
